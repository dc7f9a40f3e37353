/*---
summary = "The device's own normalize"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

vec3 builtin_normalize(vec3 v)
{
    return normalize(v);
}
