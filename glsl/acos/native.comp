/*---
summary = "The device's own acos"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_acos(float x)
{
    return acos(x);
}
