/*---
summary = "1 / sqrt(x)"
source  = "ours"

[[variant]]
name = "quotient"
---*/

// Two roundings where the device has an exact root and quotient.
// Bound: 1 ULP with both exact, else that of the device's two.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain            edge
//   quotient   0, 1.48, 0.74   0, 1.46, 0.73

float builtin_inversesqrt(float x)
{
    return 1.0 / sqrt(x);
}
