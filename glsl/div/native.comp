/*---
summary = "The device's own division"
source  = "SPIR-V's OpFDiv"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   strata            edge
//   native   0, 0.50, 0.20   0, 0.50, 0.20

float builtin_div(float x, float y)
{
    return x / y;
}
