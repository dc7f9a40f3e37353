/*---
summary = "The first octant's atan by Cephes, reflected to the others"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// The smaller over the larger of |x| and |y|, so that the quotient is in 0..1 and never overflows; 0 at the origin.
// Bound: 3 ULP of the octant's angle, 4 of the result.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     strata              edge
//   cephes   0, 3.04, 7.4e-4   0, 2.88, 7.0e-4

#include "common/cephes_atan.glsl"

float builtin_atan2(float y, float x)
{
    float a = abs(y);
    float b = abs(x);
    float largest = max(a, b);
    // At the origin the quotient would be 0/0.
    float angle = cephes_atan(largest > 0.0 ? min(a, b) / largest : 0.0);
    angle = a > b ? 1.57079632679490 - angle : angle;
    angle = x < 0.0 ? 3.14159265358979 - angle : angle;
    return y < 0.0 ? -angle : angle;
}
