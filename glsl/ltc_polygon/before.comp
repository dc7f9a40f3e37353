/*---
summary = "Clipping to the surface in the shading frame, before Minv; nothing after it"
source  = "Public ports of the 2016 code; edges as in glsl/common/edge_*.glsl"

[[variant]]
name = "before_acos"
summary = "Clipping in the shading frame, then Minv, normalising; edges by acos and its small-angle test"
defines = { EDGE = "edge_acos_small_angle" }

[[variant]]
name = "before_rational_1e7"
summary = "Clipping in the shading frame, then Minv, normalising; edges by the rational fit, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "before_stable"
summary = "Clipping in the shading frame, then Minv, normalising; edges by the cross product that does not cancel"
defines = { EDGE = "edge_stable" }
---*/

// Clip the light itself to the surface's half space, then transform and sum. Minv does not keep the plane z = 0 unless
// its third row is (0, 0, 1): the transformed lobe has a horizon of its own, and light below that counts negative here.
//
// Domain: as of `cases`. An approximation: exact where Minv keeps the horizon or the light clears both.
// Bound: none; the lobe's share between the two horizons, small for smooth and for upright lobes.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                              ggx   grazing     facing          far  near_plane     needle   horizon  inside_out      edge
//   before_acos            24% 3e3   44% 3e3  7.4% 8e-3  0.015% 3e-3     45% 4e3  2.5% 3e-2   31% 3e3     88% 4e3  20% n15%
//   before_rational_1e7   24% 5e-1  44% 5e-1  6.3% 8e-3  0.015% 4e-3     45% 1e0  2.4% 3e-2  31% 5e-1    89% 5e-1  19% n15%
//   before_stable         24% 1e-2  44% 2e-2  6.2% 8e-3  0.015% 4e-3     43% 1e0  2.4% 1e-2  31% 1e-2    89% 1e-2  19% n15%

#include "common/edge_any.glsl"

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 p[4] = vec3[4](p0, p1, p2, p3);
    vec3 clipped[8];
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        vec3 a = p[i];
        vec3 b = p[(i + 1) & 3];
        if (a.z > 0.0) {
            clipped[count++] = a;
        }
        if ((a.z > 0.0) != (b.z > 0.0)) {
            clipped[count++] = a + a.z / (a.z - b.z) * (b - a);
        }
    }
    if (count == 0) {
        return 0.0;
    }
    vec3 last = normalize(minv * clipped[count - 1]);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 next = normalize(minv * clipped[i]);
        sum += edge_any(last, next).z;
        last = next;
    }
    return abs(sum);
}
