/*---
summary = "The device's own log"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    domain             edge
//   native   0, 8.7e4, 0.92   0, 6.1e6, 0.68

float builtin_log(float x)
{
    return log(x);
}
