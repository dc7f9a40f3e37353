/*---
summary = "The device's own fma"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_fma(float x, float y, float z)
{
    return fma(x, y, z);
}
