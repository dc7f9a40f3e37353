/*---
summary = "The device's own sqrt"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_sqrt(float x)
{
    return sqrt(x);
}
