/*---
summary = "Cephes: asin's polynomial below 1/2, the half angle's beyond"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// acos(x) = 2 asin sqrt((1 - x)/2) for x > 1/2, pi minus that for x < -1/2, pi/2 - asin(x) between: 1 - x is exact where
// it matters, so nothing is lost at 1.
// Bound: 2.5 ULP.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain              edge
//   cephes   0, 1.22, 3.0e-4   0, 1.13, 2.8e-4

#include "common/cephes_asin.glsl"

float builtin_acos(float x)
{
    float a = abs(x);
    if (a > 0.5) {
        float angle = 2.0 * cephes_asin(sqrt(0.5 * (1.0 - a)));
        return x < 0.0 ? 3.14159265358979 - angle : angle;
    }
    float small = cephes_asin(a);
    return 1.57079632679490 - (x < 0.0 ? -small : small);
}
