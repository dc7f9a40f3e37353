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
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                   ggx       grazing       facing     far  near_plane       needle       horizon    inside_out      edge
//   loop_acos                  1.9% 3e3       12% 3e3    1.9% 3e-3  0 6e-5     28% n9x    0.1% 3e-2     0.67% 3e3       33% 3e3  17% n15%
//   loop_atan2                   0 1e-5        0 1e-5       0 2e-6  0 9e-7   0.27% n9x       0 2e-5        0 5e-6        0 3e-5  15% n15%
//   loop_rational            0.29% n44x  4.3% n0.022%  0.056% 3e-3  0 3e-7    24% n11%  0.024% 3e-2   0.099% n13x  5.6% n0.063%  20% n20%
//   loop_rational_1e7        0.29% 5e-1     4.3% 5e-1  0.056% 3e-3  0 3e-7     24% n9x  0.024% 3e-2   0.099% 5e-1     5.6% 5e-1  16% n15%
//   loop_rational_flt_min   0.29% 2e+15    4.3% 2e+15  0.056% 3e-3  0 2e-7     24% n9x  0.024% 3e-2  0.099% 2e+15    5.6% 2e+15  17% n15%
//   loop_poly7_1e7           0.29% 5e-1     4.3% 5e-1  0.056% 3e-3  0 2e-7     24% n9x  0.024% 3e-2   0.099% 5e-1     5.6% 5e-1  16% n15%
//   loop_stable                  0 1e-5        0 1e-5       0 6e-7  0 1e-7   0.27% n9x       0 2e-5        0 5e-6        0 3e-5  15% n15%

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
