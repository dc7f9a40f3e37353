/*---
summary = "The device's own normalize"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   strata            edge
//   native   0, 2.48, 0.64   0, 2.65, 0.65

vec3 builtin_normalize(vec3 v)
{
    return normalize(v);
}
