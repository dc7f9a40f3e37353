/*---
summary = "Each edge by the cross product of its shorter end with the edge itself, nothing normalised; edges clipped one by one"
source  = "ours, from Lambert's formula"
tried   = "Error-free cross products (stable_compensated) change nothing that counts. Keeping the whole edge's cross product for its clipped part leaves the contour open by the rounding of the cuts"

[[variant]]
name = "stable"

[[variant]]
name = "stable_precise"
precise = true

[[variant]]
name = "stable_scaled"
summary = "stable, the corners first scaled exactly by a power of two: any size"
defines = { SCALED = 1 }

[[variant]]
name = "stable_scaled_precise"
summary = "stable, the corners first scaled exactly by a power of two: any size"
defines = { SCALED = 1 }
precise = true

[[variant]]
name = "stable_differences"
summary = "stable_scaled, whole edges as Minv times differences of the light's corners: distant lights keep their digits"
defines = { SCALED = 1, DIFFERENCES = 1 }

[[variant]]
name = "stable_compensated"
summary = "stable_scaled, the cross products by error-free products (Dekker)"
defines = { SCALED = 1, COMPENSATED = 1 }

[[variant]]
name = "stable_hill"
summary = "stable with the published fit, good to 1.4e-6 of theta/sin(theta)"
defines = { HILL = 1 }

[[variant]]
name = "stable_atan2"
summary = "stable with atan for the angles"
defines = { ATAN2 = 1 }
---*/

// With q = Minv p, an edge's part above the horizon from u to w adds theta N.z/(2 pi |N|), where
//
//     N = u x w = u x (w - u) = w x (w - u), by the shorter of u and w      theta = atan(|N|, u.w)
//
// so N loses no digits to the length of the corners, only to that of the edge; the horizon adds the angles between the
// cuts, in the same way. The cuts are used by the edge and by the horizon alike, so the contour stays closed. No vector
// is normalised. The angle over its sine is a fit in the cosine; for obtuse angles it is 1/(2|N|) less that of the
// supplement, with |N| itself, so nothing is guarded but 1/0.
//
// Domain: any contour; squares of squares within f32's range, so corners of 2^-31 to 2^31 (SCALED: any, within 2^60 of
// each other).
// Source: ours; the fits in glsl/common/edge_stable.glsl.
// Bound: a few 2^-24 of the irradiance's terms, and what rounding q does to edges that nearly pass the point.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                           ggx  grazing  facing     far  near_plane  needle  horizon  inside_out       edge
//   stable               0 4e-6   0 3e-6  0 9e-7  0 1e-7  0.025% 1e0  0 4e-5   0 3e-6      0 2e-5  0.35% 1e0
//   stable_scaled        0 4e-6   0 3e-6  0 9e-7  0 1e-7  0.025% 1e0  0 4e-5   0 3e-6      0 2e-5    95x 1e0
//   stable_differences   0 4e-6   0 3e-6  0 1e-6  0 1e-7  0.025% 1e0  0 4e-5   0 3e-6      0 2e-5    95x 1e0
//   stable_compensated   0 4e-6   0 3e-6  0 8e-7  0 2e-7  0.025% 1e0  0 4e-5   0 4e-6      0 2e-5    95x 1e0
//   stable_hill          0 4e-6   0 3e-6  0 1e-6  0 3e-7  0.025% 1e0  0 4e-5   0 3e-6      0 2e-5  0.35% 1e0
//   stable_atan2         0 4e-6   0 4e-6  0 2e-6  0 9e-7  0.025% 1e0  0 4e-5   0 3e-6      0 2e-5  0.87% 1e0

#include "common/edge_fit.glsl"
#include "common/edge_stable.glsl"
#include "common/error_free.glsl"
#include "common/power_of_two.glsl"

const float SMALLEST = 1.175494351e-38;

// normal.z theta/(2 pi |normal|) for normal = u x w.
float arc(float normal_z, float normal2, float cosine, float uu, float ww)
{
#ifdef ATAN2
    float sine = sqrt(max(normal2, SMALLEST));
    return normal_z / sine * (atan(sine, cosine) * 0.15915494309189535);
#else
    float inverse = inversesqrt(max(uu, SMALLEST)) * inversesqrt(max(ww, SMALLEST));
    float x = cosine * inverse;
#ifdef HILL
    float v = fit_rational(min(abs(x), 1.0)) * inverse;
#else
    float v = edge_factor(min(abs(x), 1.0)) * inverse;
#endif
    return normal_z * (x < 0.0 ? 0.5 * inversesqrt(max(normal2, SMALLEST)) - v : v);
#endif
}

// The part of an edge from u to w.
float along_edge(vec3 u, vec3 w, vec3 e)
{
    float uu = dot(u, u);
    float ww = dot(w, w);
#ifdef COMPENSATED
    vec3 n = cross_dekker(uu < ww ? u : w, e);
#else
    vec3 n = cross(uu < ww ? u : w, e);
#endif
    return arc(n.z, dot(n, n), dot(u, w), uu, ww);
}

// The way along the horizon between two cuts.
float along_horizon(vec2 c, vec2 d)
{
    precise vec2 e = d - c;
    float cc = dot(c, c);
    float dd = dot(d, d);
    vec2 shorter = cc < dd ? c : d;
    float n = shorter.x * e.y - shorter.y * e.x;
    return arc(n, n * n, dot(c, d), cc, dd);
}

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 q[4] = vec3[4](minv * p0, minv * p1, minv * p2, minv * p3);
#ifdef SCALED
    vec3 largest = max(max(abs(q[0]), abs(q[1])), max(abs(q[2]), abs(q[3])));
    float scale = scale_to_one(largest_component(largest));
    for (int i = 0; i < 4; ++i) {
        q[i] *= scale;
    }
#endif
#ifdef DIFFERENCES
    vec3 p[4] = vec3[4](p0, p1, p2, p3);
#endif

    float sum = 0.0;
    vec2 left = vec2(0.0);
    vec2 first = vec2(0.0);
    bool below = false;
    bool open = false;
    for (int i = 0; i < 4; ++i) {
        int j = (i + 1) & 3;
        vec3 u = q[i];
        vec3 w = q[j];
        bool above_u = u.z > 0.0;
        bool above_w = w.z > 0.0;
        if (!above_u && !above_w) {
            continue;
        }
        precise vec3 e = w - u;
        if (above_u != above_w) {
            // Both corners weighted: a cut close to the point is not the small difference of a far corner and its way.
            vec3 cut = vec3((u.z * w.xy - w.z * u.xy) / (u.z - w.z), 0.0);
            if (above_u) {
                w = cut;
                left = w.xy;
                below = true;
            } else {
                u = cut;
                if (below) {
                    sum += along_horizon(left, u.xy);
                    below = false;
                } else {
                    first = u.xy;
                    open = true;
                }
            }
            e = w - u;
        }
#ifdef DIFFERENCES
        else {
            precise vec3 difference = p[j] - p[i];
            e = minv * (scale * difference);
        }
#endif
        sum += along_edge(u, w, e);
    }
    if (below && open) {
        sum += along_horizon(left, first);
    }
    return abs(sum);
}
