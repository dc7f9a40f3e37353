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
// Measured: -

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
