/*---
summary = "The device's own length"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_length(vec3 v)
{
    return length(v);
}
