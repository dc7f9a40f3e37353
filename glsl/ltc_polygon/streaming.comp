/*---
summary = "Minv, clipping edge by edge without an array of corners"
source  = "Public n-gon lights; edges as in glsl/common/edge_*.glsl"

[[variant]]
name = "streaming_acos"
summary = "Minv, clipping edge by edge without an array; edges by acos and its small-angle test"
defines = { EDGE = "edge_acos_small_angle" }

[[variant]]
name = "streaming_rational_1e7"
summary = "Minv, clipping edge by edge without an array; edges by the rational fit, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "streaming_stable"
summary = "Minv, clipping edge by edge without an array; edges by the cross product that does not cancel"
defines = { EDGE = "edge_stable" }
---*/

// Each edge is clipped and added as it comes; a cut waits for the next one, and the first for the last.
//
// Domain: any contour; otherwise as of `cases`.
// Bound: as of `cases`; a cut by interpolation is off by 2^-24 of the first corner, however close to the point it is.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                   ggx    grazing       facing     far  near_plane       needle      horizon  inside_out      edge
//   streaming_acos             1.9% 3e3    12% 3e3    1.9% 3e-3  0 6e-5     28% n9x    0.1% 3e-2    0.67% 3e3     33% 3e3  17% n15%
//   streaming_rational_1e7   0.29% 5e-1  4.3% 5e-1  0.056% 3e-3  0 3e-7     24% n9x  0.024% 3e-2  0.099% 5e-1   5.6% 5e-1  16% n15%
//   streaming_stable             0 1e-5     0 1e-5       0 7e-7  0 1e-7   0.27% n9x       0 2e-5       0 5e-6      0 3e-5  15% n15%

#include "common/edge_any.glsl"

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 q[4] = vec3[4](minv * p0, minv * p1, minv * p2, minv * p3);
    float sum = 0.0;
    bool below = false;
    bool begun = false;
    vec3 begin = vec3(0.0);
    vec3 last = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 a = q[i];
        vec3 b = q[(i + 1) & 3];
        if (a.z <= 0.0 && b.z <= 0.0) {
            continue;
        }
        vec3 meet = vec3((a + a.z / (a.z - b.z) * (b - a)).xy, 0.0);
        vec3 from = normalize(a.z > 0.0 ? a : meet);
        vec3 to = normalize(b.z > 0.0 ? b : meet);
        if (begun) {
            sum += a.z > 0.0 ? 0.0 : edge_any(last, from).z;
        } else {
            begin = from;
            begun = true;
            below = a.z <= 0.0;
        }
        sum += edge_any(from, to).z;
        last = to;
        if (b.z <= 0.0) {
            below = true;
        }
    }
    return begun ? abs(sum + (below ? edge_any(last, begin).z : 0.0)) : 0.0;
}
