/*---
summary = "The device's own sin"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_sin(float x)
{
    return sin(x);
}
