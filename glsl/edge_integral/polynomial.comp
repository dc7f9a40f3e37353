/*---
summary = "theta/sin(theta) as a polynomial in the cosine"
source  = "Public renderers (the quadratic); ours, minimax of degrees found there (cubic, degree 7)"

[[variant]]
name = "quadratic"
summary = "Degree 2; no guard"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_none" }

[[variant]]
name = "quadratic_1e7"
summary = "Degree 2; max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_1e7" }

[[variant]]
name = "quadratic_flt_min"
summary = "Degree 2; max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_flt_min" }

[[variant]]
name = "quadratic_epsilon"
summary = "Degree 2; max(1 - x^2, 2^-24)"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_epsilon" }

[[variant]]
name = "quadratic_saturate"
summary = "Degree 2; saturate(1 - x^2)"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_saturate" }

[[variant]]
name = "quadratic_clamped"
summary = "Degree 2; the dot product clamped to +-0.9999"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_1e7", CLAMP_DOT = 1 }

[[variant]]
name = "quadratic_split"
summary = "Degree 2; no guard, but nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_none", SPLIT = 1 }

[[variant]]
name = "cubic"
summary = "Degree 3; no guard"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_none" }

[[variant]]
name = "cubic_1e7"
summary = "Degree 3; max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_1e7" }

[[variant]]
name = "cubic_flt_min"
summary = "Degree 3; max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_flt_min" }

[[variant]]
name = "cubic_epsilon"
summary = "Degree 3; max(1 - x^2, 2^-24)"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_epsilon" }

[[variant]]
name = "cubic_saturate"
summary = "Degree 3; saturate(1 - x^2)"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_saturate" }

[[variant]]
name = "cubic_clamped"
summary = "Degree 3; the dot product clamped to +-0.9999"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_1e7", CLAMP_DOT = 1 }

[[variant]]
name = "cubic_split"
summary = "Degree 3; no guard, but nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_none", SPLIT = 1 }

[[variant]]
name = "poly7"
summary = "Degree 7; no guard"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_none" }

[[variant]]
name = "poly7_1e7"
summary = "Degree 7; max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_1e7" }

[[variant]]
name = "poly7_flt_min"
summary = "Degree 7; max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_flt_min" }

[[variant]]
name = "poly7_epsilon"
summary = "Degree 7; max(1 - x^2, 2^-24)"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_epsilon" }

[[variant]]
name = "poly7_saturate"
summary = "Degree 7; saturate(1 - x^2)"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_saturate" }

[[variant]]
name = "poly7_clamped"
summary = "Degree 7; the dot product clamped to +-0.9999"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_1e7", CLAMP_DOT = 1 }

[[variant]]
name = "poly7_split"
summary = "Degree 7; no guard, but nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_none", SPLIT = 1 }
---*/

// edge = theta/(2 pi sin theta) a x b, the factor by a polynomial of glsl/common/edge_fit.glsl, with the guards that
// ports put on 1 - x^2.
//
// Domain: as of `rational`.
// Bound: 1.5e-3 (degree 2), 1.4e-4 (3), 9e-8 (7) for theta <= pi/2; beyond it the loss in 1 - x^2 as in `rational`.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                              scene       near     antipodal  right_angle       edge
//   quadratic               50% 2e-2  8.1% 8e-4      79% n42%     18% 1e-3   35% n24%
//   quadratic_1e7           50% 2e-2  8.1% 8e-4      73% 5e-1     18% 1e-3   13% 5e-1
//   quadratic_flt_min       50% 2e-2  8.1% 8e-4     79% 2e+15     18% 1e-3  21% 1e+15
//   quadratic_epsilon       50% 2e-2  8.1% 8e-4      73% 6e-1     18% 1e-3   13% 5e-1
//   quadratic_saturate      50% 2e-2  8.1% 8e-4      79% n42%     18% 1e-3   35% n24%
//   quadratic_clamped       50% 5e-1  8.1% 8e-4      76% 5e-1     18% 1e-3   13% 5e-1
//   quadratic_split         50% 2e-3  8.1% 8e-4   13% n0.013%     18% 1e-3   24% n14%
//   cubic                  7.8% 2e-2     0 9e-5      71% n42%     86% 1e-4   36% n24%
//   cubic_1e7              7.8% 2e-2     0 9e-5      65% 5e-1     86% 1e-4   14% 5e-1
//   cubic_flt_min          7.8% 2e-2     0 9e-5     71% 2e+15     86% 1e-4  22% 1e+15
//   cubic_epsilon          7.8% 2e-2     0 9e-5      65% 6e-1     86% 1e-4   14% 5e-1
//   cubic_saturate         7.8% 2e-2     0 9e-5      71% n42%     86% 1e-4   36% n24%
//   cubic_clamped          7.8% 5e-1     0 9e-5      68% 5e-1     86% 1e-4   14% 5e-1
//   cubic_split            7.8% 1e-3     0 9e-5   18% n0.013%     86% 1e-4   25% n14%
//   poly7                0.017% 2e-2     0 9e-8      71% n42%       0 2e-7   25% n24%
//   poly7_1e7            0.017% 2e-2     0 9e-8      65% 5e-1       0 2e-7  2.9% 5e-1
//   poly7_flt_min        0.017% 2e-2     0 9e-8     71% 2e+15       0 2e-7  11% 1e+15
//   poly7_epsilon        0.017% 2e-2     0 9e-8      65% 6e-1       0 2e-7  2.9% 5e-1
//   poly7_saturate       0.017% 2e-2     0 9e-8      71% n42%       0 2e-7   25% n24%
//   poly7_clamped        0.024% 5e-1     0 9e-8      68% 5e-1       0 2e-7  2.9% 5e-1
//   poly7_split          0.015% 1e-3     0 9e-8  5.3% n0.013%       0 2e-7   14% n14%

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
