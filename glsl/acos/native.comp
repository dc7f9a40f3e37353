/*---
summary = "The device's own acos"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   native   0, 3878, 0.90   0, 4204, 0.91

float builtin_acos(float x)
{
    return acos(x);
}
