/*---
summary = "asin as pi/2 - acos, with acos as sqrt(1 - |x|) times a polynomial"
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

// asin(x) = sign(x) (pi/2 - acos |x|): an absolute error, so that nothing is left of a small x.
// Bound: the polynomials' own, 9.0e-3 to 2e-8 absolute.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                  domain                     edge
//   eberly_1          97.1 %, 2.5e7, 6138      35.1 %, 2.5e7, 6137
//   eberly_2          85.5 %, 2.5e7, 6138      25.9 %, 2.5e7, 6137
//   eberly_3          55.3 %, 2.5e7, 6138      19.4 %, 2.5e7, 6137
//   abramowitz_3   52.3 %, 6.2e14, 1.5e11   23.2 %, 4.8e40, 1.2e37
//   abramowitz_7    35.5 %, 1.1e12, 2.7e8   21.2 %, 8.5e37, 2.1e34

#include "common/fast_acos.glsl"

float builtin_asin(float x)
{
    float positive = FAST_ACOS_HALF_PI - FAST_ACOS(abs(x));
    return x < 0.0 ? -positive : positive;
}
