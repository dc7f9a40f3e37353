/*---
summary = "The device's own pow"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_pow(float x, float y)
{
    return pow(x, y);
}
