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
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                 ggx           far  near_plane      needle  inside_out       edge
//   before_acos            24.3% 3080  0.02% 3.5e-3  45.3% 3800  2.47% 0.03  87.8% 3541  19.7% inf
//   before_rational_1e7    24.1% 0.50  0.02% 3.5e-3  45.1% 0.98  2.41% 0.03  88.6% 0.55  19.4% inf
//   before_stable          24.0% 0.01  0.02% 3.5e-3  43.4% 0.99  2.40% 0.01  88.5% 0.01  18.8% inf

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
