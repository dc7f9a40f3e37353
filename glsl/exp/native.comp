/*---
summary = "The device's own exp"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_exp(float x)
{
    return exp(x);
}
