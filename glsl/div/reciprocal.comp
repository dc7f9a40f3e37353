/*---
summary = "x times the reciprocal of y"
source  = "Folklore; what a compiler may do"

[[variant]]
name = "reciprocal"

[[variant]]
name = "reciprocal_precise"
precise = true
---*/

// Two roundings; the reciprocal overflows for subnormal y and is subnormal for large.
// Bound: 1.5 ULP with an exact reciprocal.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                               strata            edge
//   reciprocal           0, 1.43, 0.57   0, 1.49, 0.60
//   reciprocal_precise   0, 1.43, 0.57   0, 1.49, 0.60

float builtin_div(float x, float y)
{
    return x * (1.0 / y);
}
