/*---
summary = "The device's own atan"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_atan(float x)
{
    return atan(x);
}
