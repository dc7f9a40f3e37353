/*---
summary = "The device's own asin"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_asin(float x)
{
    return asin(x);
}
