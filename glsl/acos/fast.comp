/*---
summary = "acos as sqrt(1 - |x|) times a polynomial, mirrored for x < 0"
source  = "Abramowitz & Stegun 1964, 4.4.45 and 4.4.46; Eberly, GPGPU Programming for Games and Science, 2014; Lagarde 2014"

[[variant]]
name = "eberly_1"
summary = "Degree 1 of Eberly: one product, one root"
defines = { FAST_ACOS = "fast_acos_eberly1" }

[[variant]]
name = "eberly_2"
summary = "Degree 2 of Eberly"
defines = { FAST_ACOS = "fast_acos_eberly2" }

[[variant]]
name = "eberly_3"
summary = "Degree 3 of Eberly"
defines = { FAST_ACOS = "fast_acos_eberly3" }

[[variant]]
name = "abramowitz_3"
summary = "4.4.45 of Abramowitz and Stegun, NVIDIA's Cg acos"
defines = { FAST_ACOS = "fast_acos_abramowitz3" }

[[variant]]
name = "abramowitz_7"
summary = "4.4.46 of Abramowitz and Stegun"
defines = { FAST_ACOS = "fast_acos_abramowitz7" }
---*/

// acos(x) = pi - acos(-x) for x < 0; see fast_acos.glsl for the polynomials and their sources.
// Bound: the polynomials' own, 9.0e-3 to 2e-8 absolute; relative near 1, where the root is exact to a rounding of 1 - x.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                domain                   edge
//   eberly_1       55.6 %, 1.3e5, 31.33   17.1 %, 1.3e5, 31.18
//   eberly_2           27 %, 8315, 2.03     3.88 %, 8279, 2.02
//   eberly_3              0, 1092, 0.27          0, 1088, 0.27
//   abramowitz_3           0, 795, 0.18           0, 800, 0.18
//   abramowitz_7        0, 2.80, 6.8e-4        0, 2.83, 6.5e-4

#include "common/fast_acos.glsl"

float builtin_acos(float x)
{
    float positive = FAST_ACOS(abs(x));
    return x < 0.0 ? FAST_ACOS_PI - positive : positive;
}
