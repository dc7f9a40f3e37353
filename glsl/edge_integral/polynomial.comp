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
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                scene          near     antipodal   right_angle          edge
//   quadratic             51.9% 7.5e-3  8.10% 8.4e-4     78.9% inf  18.2% 1.3e-3     35.1% inf
//   quadratic_1e7         51.9% 7.5e-3  8.10% 8.4e-4    73.3% 0.50  18.2% 1.3e-3    12.9% 0.50
//   quadratic_flt_min     51.9% 7.5e-3  8.10% 8.4e-4  78.9% 2.5e15  18.2% 1.3e-3  21.0% 1.1e15
//   quadratic_epsilon     51.9% 7.5e-3  8.10% 8.4e-4    73.3% 0.60  18.2% 1.3e-3    12.9% 0.50
//   quadratic_saturate    51.9% 7.5e-3  8.10% 8.4e-4     78.9% inf  18.2% 1.3e-3     35.1% inf
//   quadratic_clamped       52.0% 0.46  8.10% 8.4e-4    75.7% 0.50  18.2% 1.3e-3    12.9% 0.50
//   quadratic_split       51.9% 1.7e-3  8.10% 8.4e-4     13.5% inf  18.2% 1.3e-3     24.3% inf
//   cubic                 8.15% 7.5e-3      0 9.4e-5     70.8% inf  86.0% 1.4e-4     35.8% inf
//   cubic_1e7             8.15% 7.5e-3      0 9.4e-5    65.2% 0.50  86.0% 1.4e-4    13.6% 0.50
//   cubic_flt_min         8.15% 7.5e-3      0 9.4e-5  70.8% 2.5e15  86.0% 1.4e-4  21.6% 1.1e15
//   cubic_epsilon         8.15% 7.5e-3      0 9.4e-5    65.2% 0.60  86.0% 1.4e-4    13.6% 0.50
//   cubic_saturate        8.15% 7.5e-3      0 9.4e-5     70.8% inf  86.0% 1.4e-4     35.8% inf
//   cubic_clamped           8.15% 0.46      0 9.4e-5    67.6% 0.50  86.0% 1.4e-4    13.6% 0.50
//   cubic_split           8.15% 1.7e-3      0 9.4e-5     18.0% inf  86.0% 1.4e-4     25.0% inf
//   poly7                   65x 7.5e-3      0 8.6e-8     70.8% inf      0 2.0e-7     25.0% inf
//   poly7_1e7               65x 7.5e-3      0 8.6e-8    65.2% 0.50      0 2.0e-7    2.85% 0.50
//   poly7_flt_min           65x 7.5e-3      0 8.6e-8  70.8% 2.5e15      0 2.0e-7  10.9% 1.1e15
//   poly7_epsilon           65x 7.5e-3      0 8.6e-8    65.2% 0.60      0 2.0e-7    2.85% 0.50
//   poly7_saturate          65x 7.5e-3      0 8.6e-8     70.8% inf      0 2.0e-7     25.0% inf
//   poly7_clamped             99x 0.46      0 8.6e-8    67.6% 0.50      0 2.0e-7    2.88% 0.50
//   poly7_split             60x 1.7e-3      0 8.6e-8     5.35% inf      0 2.0e-7     14.3% inf

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
