/*---
summary = "The device's own exp2"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    domain            edge
//   native   4x, 3.16, 1.01   0, 3.01, 0.95

float builtin_exp2(float x)
{
    return exp2(x);
}
