/*---
summary = "exp2(x log2 e)"
source  = "Folklore; what most devices do"

[[variant]]
name = "exp2"
---*/

// The product's rounding grows with |x|: the reason for the specification's 3 + 2 |x| ULP.
// Bound: those of exp2, and |x|/2 ULP and more of the product.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    domain              edge
//   exp2   12x, 63.28, 1.07   1x, 65.09, 1.02

float builtin_exp(float x)
{
    return exp2(x * 1.44269504088896);
}
