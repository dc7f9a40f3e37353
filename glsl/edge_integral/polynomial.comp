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
// Measured: -

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
