/*---
summary = "The device's own sqrt"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   native   0, 0.50, 0.14   0, 0.50, 0.14

float builtin_sqrt(float x)
{
    return sqrt(x);
}
