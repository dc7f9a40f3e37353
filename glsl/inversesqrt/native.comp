/*---
summary = "The device's own inversesqrt"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   native   0, 1.48, 0.74   0, 1.46, 0.73

float builtin_inversesqrt(float x)
{
    return inversesqrt(x);
}
