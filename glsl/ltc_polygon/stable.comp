/*---
summary = "Clipping without new planes: each edge keeps its own cross product, unnormalised, and loses part of its angle"
source  = "ours, from Lambert's formula"

[[variant]]
name = "stable"

[[variant]]
name = "stable_precise"
precise = true

[[variant]]
name = "stable_differences"
summary = "stable, with the edges as Minv times differences of the light's corners: small and distant lights keep their digits"
defines = { DIFFERENCES = 1 }

[[variant]]
name = "stable_scaled"
summary = "stable, the corners first scaled exactly by a power of two: any size"
defines = { SCALED = 1 }

[[variant]]
name = "stable_compensated"
summary = "stable_differences, the cross products from exact partial products"
defines = { DIFFERENCES = 1, COMPENSATED = 1 }

[[variant]]
name = "stable_atan2"
summary = "stable, with atan for the angles"
defines = { ATAN2 = 1 }
---*/

// With q = Minv p, e = b - a the edge from a to b and N = a x e, an edge adds theta N.z/(2 pi |N|), where
//
//     theta = atan(part |N|, u.w)
//
// and u, w are the ends of the part that lies above the horizon: its plane is the whole edge's. N comes from the
// shorter of a and b, so it is small only with the edge. The horizon adds the angles between the cuts. No vector is
// normalised, and for obtuse angles the factor is 1/(2|N|) less that of the supplement, with |N| itself.
//
// Domain: any contour; squares of squares within f32's range, so corners of 2^-15 to 2^31 (SCALED: any, within 2^60 of
// each other).
// Source: ours.
// Bound: a few 2^-24 of the irradiance's terms, and what rounding q does to edges that nearly pass the point.
// Measured: -

#include "common/edge_stable.glsl"
#include "common/error_free.glsl"
#include "common/power_of_two.glsl"

// normal.z theta/(2 pi |normal|), for an arc whose ends u, w have |u||w| = 1/inverse and span that part of |normal|.
float arc(float normal_z, float normal2, float part, float cosine, float inverse)
{
#ifdef ATAN2
    float sine = sqrt(max(normal2, 1.175494351e-38));
    return normal_z / sine * (atan(part * sine, cosine) * 0.15915494309189535);
#else
    float x = cosine * inverse;
    float v = edge_factor(min(abs(x), 1.0)) * part * inverse;
    return normal_z * (x < 0.0 ? 0.5 * inversesqrt(max(normal2, 1.175494351e-38)) - v : v);
#endif
}

float inverse_lengths(float uu, float ww)
{
    return inversesqrt(max(uu, 1.175494351e-38)) * inversesqrt(max(ww, 1.175494351e-38));
}

// The way along the horizon between two cuts.
float along_horizon(vec2 c, vec2 d)
{
    precise vec2 way = d - c;
    float sine = c.x * way.y - c.y * way.x;
    return arc(sine, sine * sine, 1.0, dot(c, d), inverse_lengths(dot(c, c), dot(d, d)));
}

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 p[4] = vec3[4](p0, p1, p2, p3);
    vec3 q[4] = vec3[4](minv * p0, minv * p1, minv * p2, minv * p3);
    float scale = 1.0;
#ifdef SCALED
    vec3 largest = max(max(abs(q[0]), abs(q[1])), max(abs(q[2]), abs(q[3])));
    scale = scale_to_one(largest_component(largest));
    for (int i = 0; i < 4; ++i) {
        q[i] *= scale;
    }
#endif

    float sum = 0.0;
    vec2 left = vec2(0.0);
    vec2 first = vec2(0.0);
    bool below = false;
    bool open = false;
    for (int i = 0; i < 4; ++i) {
        int j = (i + 1) & 3;
        vec3 a = q[i];
        vec3 b = q[j];
        bool above_a = a.z > 0.0;
        bool above_b = b.z > 0.0;
        if (!above_a && !above_b) {
            continue;
        }
#ifdef DIFFERENCES
        precise vec3 difference = p[j] - p[i];
        vec3 e = minv * (scale * difference);
#else
        precise vec3 e = b - a;
#endif
        float aa = dot(a, a);
        float bb = dot(b, b);
#ifdef COMPENSATED
        vec3 n = cross_split(aa < bb ? a : b, e);
#else
        vec3 n = cross(aa < bb ? a : b, e);
#endif

        vec3 u = a;
        vec3 w = b;
        float part = 1.0;
        if (above_a != above_b) {
            float drop = a.z - b.z;
            if (above_a) {
                part = a.z / drop;
                w = vec3(a.xy + part * e.xy, 0.0);
                left = w.xy;
                below = true;
            } else {
                part = -b.z / drop;
                u = vec3(b.xy - part * e.xy, 0.0);
                if (below) {
                    sum += along_horizon(left, u.xy);
                    below = false;
                } else {
                    first = u.xy;
                    open = true;
                }
            }
        }
        sum += arc(n.z, dot(n, n), part, dot(u, w), inverse_lengths(dot(u, u), dot(w, w)));
    }
    if (below && open) {
        sum += along_horizon(left, first);
    }
    return abs(sum);
}
