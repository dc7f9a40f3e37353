/*---
summary = "atan by an odd polynomial on -1..1, of the reciprocal beyond"
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

// atan(x) = sign(x) pi/2 - atan(1/x) for |x| > 1.
// Bound: the polynomials', 1.4e-3 to 2.6e-6 absolute, and twice as much relative.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                             domain                  edge
//   eberly_5    46.8 %, 4.5e4, 11.07    17 %, 4.5e4, 11.07
//   eberly_7      3.11 %, 5579, 1.36   0.179 %, 5577, 1.36
//   eberly_9           0, 1012, 0.25         0, 1011, 0.25
//   eberly_11           0, 166, 0.04          0, 165, 0.04

#include "common/fast_atan.glsl"

float builtin_atan(float x)
{
    bool steep = abs(x) > 1.0;
    float angle = FAST_ATAN(steep ? 1.0 / x : x);
    return steep ? (x < 0.0 ? -1.57079632679490 : 1.57079632679490) - angle : angle;
}
