/*---
summary = "theta/sin(theta) as a quotient of two quadratics in the cosine"
source  = "Hill & Heitz, Real-Time Area Lighting: a Journey from Research to Production, SIGGRAPH 2016, and public ports of it"

[[variant]]
name = "rational"
summary = "The 0.854 scaling; no guard"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_none", FIT_SCALED = 1 }

[[variant]]
name = "rational_1e7"
summary = "The 0.854 scaling; max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "rational_flt_min"
summary = "The 0.854 scaling; max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_flt_min", FIT_SCALED = 1 }

[[variant]]
name = "rational_epsilon"
summary = "The 0.854 scaling; max(1 - x^2, 2^-24)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_epsilon", FIT_SCALED = 1 }

[[variant]]
name = "rational_saturate"
summary = "The 0.854 scaling; saturate(1 - x^2)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_saturate", FIT_SCALED = 1 }

[[variant]]
name = "rational_clamped"
summary = "The 0.854 scaling; the dot product clamped to +-0.9999"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", CLAMP_DOT = 1, FIT_SCALED = 1 }

[[variant]]
name = "rational_split"
summary = "The 0.854 scaling; no guard, but nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_none", SPLIT = 1, FIT_SCALED = 1 }

[[variant]]
name = "rational_542"
summary = "The 5.42 scaling; no guard"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_none" }

[[variant]]
name = "rational_542_1e7"
summary = "The 5.42 scaling; max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_1e7" }

[[variant]]
name = "rational_542_flt_min"
summary = "The 5.42 scaling; max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_flt_min" }

[[variant]]
name = "rational_542_epsilon"
summary = "The 5.42 scaling; max(1 - x^2, 2^-24)"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_epsilon" }

[[variant]]
name = "rational_542_saturate"
summary = "The 5.42 scaling; saturate(1 - x^2)"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_saturate" }

[[variant]]
name = "rational_542_clamped"
summary = "The 5.42 scaling; the dot product clamped to +-0.9999"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_1e7", CLAMP_DOT = 1 }

[[variant]]
name = "rational_542_split"
summary = "The 5.42 scaling; no guard, but nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_none", SPLIT = 1 }

[[variant]]
name = "rational_542_as_ported"
summary = "The 5.42 scaling with sqrt for inversesqrt, a mistake seen in a port: a control"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_none", AS_PORTED_SQRT = 1 }

[[variant]]
name = "rational_precise"
summary = "The 0.854 scaling; no guard"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_none", FIT_SCALED = 1 }
precise = true

[[variant]]
name = "rational_1e7_precise"
summary = "The 0.854 scaling; max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }
precise = true
---*/

// edge = theta/(2 pi sin theta) a x b, the factor by the fit of glsl/common/edge_fit.glsl, in its two scalings and with
// the guards that ports put on 1 - x^2.
//
// Domain: unit vectors. Not exactly opposite ones, nor (without a guard) those whose dot product rounds to -1: 0 times
// infinity.
// Bound: 1.4e-6/(2 pi) for theta <= pi/2; beyond it 1/sin(theta) comes from 1 - x^2, off by 2^-23/sin(theta)^2 in
// relative terms: 1e-4 within 0.03 of pi, and whatever the guard says within 3e-4.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                  scene    near     antipodal  right_angle       edge
//   rational                 0.017% 2e-2  0 1e-7      71% n42%       0 2e-7   25% n24%
//   rational_1e7             0.017% 2e-2  0 1e-7      65% 5e-1       0 2e-7  2.9% 5e-1
//   rational_flt_min         0.017% 2e-2  0 1e-7     71% 2e+15       0 2e-7  11% 1e+15
//   rational_epsilon         0.017% 2e-2  0 1e-7      65% 6e-1       0 2e-7  2.9% 5e-1
//   rational_saturate        0.017% 2e-2  0 1e-7      71% n42%       0 2e-7   25% n24%
//   rational_clamped         0.024% 5e-1  0 1e-7      68% 5e-1       0 2e-7  2.9% 5e-1
//   rational_split           0.015% 1e-3  0 1e-7  5.3% n0.013%       0 2e-7   14% n14%
//   rational_542             0.017% 2e-2  0 1e-7      71% n42%       0 4e-7   25% n24%
//   rational_542_1e7         0.017% 2e-2  0 1e-7      65% 5e-1       0 4e-7  2.9% 5e-1
//   rational_542_flt_min     0.017% 2e-2  0 1e-7     71% 2e+15       0 4e-7  11% 1e+15
//   rational_542_epsilon     0.017% 2e-2  0 1e-7      65% 6e-1       0 4e-7  2.9% 5e-1
//   rational_542_saturate    0.017% 2e-2  0 1e-7      71% n42%       0 4e-7   25% n24%
//   rational_542_clamped     0.024% 5e-1  0 1e-7      68% 5e-1       0 4e-7  2.9% 5e-1
//   rational_542_split       0.015% 1e-3  0 1e-7  5.3% n0.013%       0 4e-7   14% n14%
//   rational_542_as_ported      14% 5e-1  0 1e-7    94% n0.93%    6.1% 5e-3  16% n7.6%

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
