/*---
summary = "The device's own cos"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_cos(float x)
{
    return cos(x);
}
