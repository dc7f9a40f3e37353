/*---
summary = "x * y + z, which a device may contract"
source  = "ours"

[[variant]]
name = "expression"

[[variant]]
name = "expression_precise"
summary = "The same with contraction forbidden"
precise = true
---*/

// The formula from which the specification takes its limit.
// Bound: one rounding if contracted, else that of the product and that of the sum.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                strata             edge
//   expression           0, 3.3e5, 1.00   0, 1.7e7, 1.00
//   expression_precise   0, 3.3e5, 1.00   0, 1.7e7, 1.00

float builtin_fma(float x, float y, float z)
{
    return x * y + z;
}
