/*---
summary = "The device's own inversesqrt"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_inversesqrt(float x)
{
    return inversesqrt(x);
}
