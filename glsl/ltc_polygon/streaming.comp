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
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                    ggx       far  near_plane      needle  inside_out       edge
//   streaming_acos            1.94% 3069  0 5.7e-5   28.1% inf  0.10% 0.03  33.2% 3096  16.6% inf
//   streaming_rational_1e7    0.29% 0.50  0 3.0e-7   23.6% inf  0.02% 0.03  5.56% 0.47  16.0% inf
//   streaming_stable            0 1.1e-5  0 1.1e-7   0.27% inf    0 1.8e-5    0 2.7e-5  15.4% inf

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
