/*---
summary = "The device's own length"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   strata            edge
//   native   0, 1.39, 0.25   0, 1.42, 0.27

float builtin_length(vec3 v)
{
    return length(v);
}
