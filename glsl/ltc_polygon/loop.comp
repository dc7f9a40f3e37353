/*---
summary = "Minv, then clipping by a Sutherland-Hodgman loop, normalising, edges"
source  = "Sutherland & Hodgman, Reentrant polygon clipping, 1974, as ports of the 2016 code use it; edges as in glsl/common/edge_*.glsl"

[[variant]]
name = "loop_acos"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by acos and its small-angle test"
defines = { EDGE = "edge_acos_small_angle" }

[[variant]]
name = "loop_atan2"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by atan, its sine kept above FLT_MIN"
defines = { EDGE = "edge_atan2_guarded" }

[[variant]]
name = "loop_rational"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by the rational fit, unguarded"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_none", FIT_SCALED = 1 }

[[variant]]
name = "loop_rational_1e7"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by the rational fit, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "loop_rational_flt_min"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by the rational fit (5.42), max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_flt_min" }

[[variant]]
name = "loop_poly7_1e7"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by the fit of degree 7, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_1e7" }

[[variant]]
name = "loop_stable"
summary = "Minv, Sutherland-Hodgman loop, normalising; edges by the cross product that does not cancel"
defines = { EDGE = "edge_stable" }
---*/

// Transform, clip to z > 0 by a loop over the edges into an array, normalise, sum the z of the edges.
//
// Domain: as of `cases`, and any contour: opposite corners above the horizon count here.
// Source: Sutherland & Hodgman 1974; a cut by interpolation, a + t (b - a) with t = a.z/(a.z - b.z).
// Bound: as of `cases`; a cut by interpolation is off by 2^-24 of the first corner, however close to the point it is.
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                     ggx       far  near_plane      needle    inside_out       edge
//   loop_acos                  1.94% 3069  0 5.7e-5   28.1% inf  0.10% 0.03    33.2% 3096  16.6% inf
//   loop_atan2                   0 1.1e-5  0 8.5e-7   0.27% inf    0 1.8e-5      0 2.6e-5  15.3% inf
//   loop_rational               0.29% inf  0 3.0e-7   23.6% inf  0.02% 0.03     5.56% inf  20.4% inf
//   loop_rational_1e7          0.29% 0.50  0 3.0e-7   23.6% inf  0.02% 0.03    5.56% 0.47  16.0% inf
//   loop_rational_flt_min    0.29% 2.5e15  0 2.4e-7   23.6% inf  0.02% 0.03  5.56% 2.5e15  17.2% inf
//   loop_poly7_1e7             0.29% 0.50  0 1.8e-7   23.6% inf  0.02% 0.03    5.56% 0.47  16.0% inf
//   loop_stable                  0 1.1e-5  0 1.3e-7   0.27% inf    0 1.8e-5      0 2.7e-5  15.4% inf

#include "common/edge_any.glsl"

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 q[4] = vec3[4](minv * p0, minv * p1, minv * p2, minv * p3);
    vec3 clipped[8];
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        vec3 a = q[i];
        vec3 b = q[(i + 1) & 3];
        if (a.z > 0.0) {
            clipped[count++] = a;
        }
        if ((a.z > 0.0) != (b.z > 0.0)) {
            clipped[count++] = vec3((a + a.z / (a.z - b.z) * (b - a)).xy, 0.0);
        }
    }
    if (count == 0) {
        return 0.0;
    }
    vec3 last = normalize(clipped[count - 1]);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 next = normalize(clipped[i]);
        sum += edge_any(last, next).z;
        last = next;
    }
    return abs(sum);
}
