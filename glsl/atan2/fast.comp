/*---
summary = "The first octant's atan by an odd polynomial, reflected to the others"
source  = "Eberly, GPGPU Programming for Games and Science, 2014"

[[variant]]
name = "eberly_5"
summary = "Degree 5 of Eberly"
defines = { FAST_ATAN = "fast_atan_5" }

[[variant]]
name = "eberly_7"
summary = "Degree 7 of Eberly"
defines = { FAST_ATAN = "fast_atan_7" }

[[variant]]
name = "eberly_9"
summary = "Degree 9 of Eberly"
defines = { FAST_ATAN = "fast_atan_9" }

[[variant]]
name = "eberly_11"
summary = "Degree 11 of Eberly"
defines = { FAST_ATAN = "fast_atan_11" }
---*/

// The smaller over the larger of |x| and |y|, so that the quotient is in 0..1 and never overflows; 0 at the origin.
// Bound: the polynomials', 1.4e-3 to 2.6e-6 absolute.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                             strata                    edge
//   eberly_5    5.97 %, 4.5e4, 11.07   0.911 %, 4.5e4, 11.07
//   eberly_7     0.651 %, 5578, 1.36    0.0828 %, 5559, 1.36
//   eberly_9           0, 1012, 0.25           0, 1009, 0.25
//   eberly_11           0, 166, 0.04            0, 165, 0.04

#include "common/fast_atan.glsl"

float builtin_atan2(float y, float x)
{
    float a = abs(y);
    float b = abs(x);
    float largest = max(a, b);
    // At the origin the quotient would be 0/0.
    float angle = FAST_ATAN(largest > 0.0 ? min(a, b) / largest : 0.0);
    angle = a > b ? 1.57079632679490 - angle : angle;
    angle = x < 0.0 ? 3.14159265358979 - angle : angle;
    return y < 0.0 ? -angle : angle;
}
