/*---
summary = "The nearest whole power from bits, the rest by a polynomial"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// See cephes_exp2.glsl.
// Bound: 1.5 ULP, and the subnormal results' own last bit.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   cephes   0, 1.16, 0.27   0, 1.13, 0.27

#include "common/cephes_exp2.glsl"

float builtin_exp2(float x)
{
    return cephes_exp2(x);
}
