/*---
summary = "The device's own atan of two arguments"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_atan2(float y, float x)
{
    return atan(y, x);
}
