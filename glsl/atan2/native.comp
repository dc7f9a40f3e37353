/*---
summary = "The device's own atan of two arguments"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                  strata           edge
//   native   0, 348, 0.09   0, 348, 0.08

float builtin_atan2(float y, float x)
{
    return atan(y, x);
}
