/*---
summary = "Cephes: a polynomial below 1/2, the half angle's beyond"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// asin(x) = pi/2 - 2 asin sqrt((1 - x)/2) for x > 1/2.
// Bound: 2.5 ULP.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain              edge
//   cephes   0, 2.35, 5.7e-4   0, 1.89, 4.6e-4

#include "common/cephes_asin.glsl"

float builtin_asin(float x)
{
    float a = abs(x);
    float angle = a > 0.5 ? 1.57079632679490 - 2.0 * cephes_asin(sqrt(0.5 * (1.0 - a))) : cephes_asin(a);
    return x < 0.0 ? -angle : angle;
}
