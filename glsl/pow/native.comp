/*---
summary = "The device's own pow"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    strata             edge
//   native   0, 1.2e4, 0.95   0, 6.2e9, 0.97

float builtin_pow(float x, float y)
{
    return pow(x, y);
}
