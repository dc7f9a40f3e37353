/*---
summary = "The device's own asin"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   native   0, 3831, 0.93   0, 3646, 0.89

float builtin_asin(float x)
{
    return asin(x);
}
