/*---
summary = "The device's own exp"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                      domain              edge
//   native   12x, 63.28, 1.07   1x, 65.09, 1.02

float builtin_exp(float x)
{
    return exp(x);
}
