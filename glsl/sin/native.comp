/*---
summary = "The device's own sin"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain              edge
//   native   0, 1.30, 1.4e-4   0, 1.29, 1.3e-4

float builtin_sin(float x)
{
    return sin(x);
}
