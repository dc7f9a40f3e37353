/*---
summary = "The device's own log2"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    domain             edge
//   native   0, 1.9e5, 0.64   0, 8.9e6, 0.51

float builtin_log2(float x)
{
    return log2(x);
}
