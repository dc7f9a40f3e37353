/*---
summary = "The device's own tan"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain              edge
//   native   0, 2.96, 1.4e-4   0, 2.65, 1.4e-4

float builtin_tan(float x)
{
    return tan(x);
}
