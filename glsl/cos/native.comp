/*---
summary = "The device's own cos"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain              edge
//   native   0, 1.47, 1.6e-4   0, 1.40, 1.2e-4

float builtin_cos(float x)
{
    return cos(x);
}
