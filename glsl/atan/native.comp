/*---
summary = "The device's own atan"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                  domain           edge
//   native   0, 347, 0.08   0, 347, 0.08

float builtin_atan(float x)
{
    return atan(x);
}
