/*---
summary = "The device's own tan"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_tan(float x)
{
    return tan(x);
}
