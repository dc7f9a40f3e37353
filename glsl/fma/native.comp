/*---
summary = "The device's own fma"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    strata             edge
//   native   0, 3.3e5, 1.00   0, 1.7e7, 1.00

float builtin_fma(float x, float y, float z)
{
    return fma(x, y, z);
}
