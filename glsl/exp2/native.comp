/*---
summary = "The device's own exp2"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_exp2(float x)
{
    return exp2(x);
}
