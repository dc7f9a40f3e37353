/*---
summary = "Cephes: two reductions and four terms"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// See cephes_atan.glsl.
// Bound: 3 ULP.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain              edge
//   cephes   0, 2.73, 6.7e-4   0, 2.62, 6.4e-4

#include "common/cephes_atan.glsl"

float builtin_atan(float x)
{
    float angle = cephes_atan(abs(x));
    return x < 0.0 ? -angle : angle;
}
