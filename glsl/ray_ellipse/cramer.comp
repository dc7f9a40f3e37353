/*---
summary = "Cramer's rule on the three equations: four determinants over one"
source  = "Quilez, Planar ellipses: bounding box and ray intersection (iquilezles.org)"

[[variant]]
name = "as_printed"
summary = "As published: a miss is -1, which is a parameter as well, hits from behind are hits, parallel rays divide by 0; a control"
defines = { AS_PRINTED = 1 }

[[variant]]
name = "cramer"
summary = "The published determinants, with t >= 0, parallel rays a miss, and a miss that is no parameter"

[[variant]]
name = "cramer_unguarded"
summary = "cramer without a look at the denominator: a parallel ray is a miss if the device keeps NaN"
defines = { UNGUARDED = 1 }

[[variant]]
name = "cramer_scaled"
summary = "cramer, every vector first scaled by a power of two: any size"
defines = { SCALED = 1 }
---*/

// With q = origin - center, lambda and gamma are the determinants [d, q, v] and [d, u, q] over [d, u, v], and t is
// -[q, u, v] over it; all with the other sign here, as published.
//
// Domain: finite rays and semi-axes; products of three of their components within 2^+-120, or SCALED.
// Bound: a determinant is off by u = 2^-24 times a few sums of its products, so that the border moves by about
// u distance/radius, and by u over the sine of two conjugate semi-axes. A change of the inputs by u does as much.
// Measured: failed / of these missed; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                             scene         border        grazing            far         needle       at_plane          scale           edge
//   as_printed        40.0% / 40.0%  30.4% / 27.5%  23.6% / 22.3%  29.9% / 29.6%  30.7% / 29.3%  40.5% / 40.5%  33.3% / 33.3%  70.3% / 65.7%
//   cramer                    0 / 0       10x / 7x    0.19% / 17x       98x / 4x    1.13% / 13x          0 / 0          0 / 0  0.19% / 0.14%
//   cramer_unguarded          0 / 0       10x / 7x    0.19% / 17x       98x / 4x    1.13% / 13x          0 / 0          0 / 0  0.19% / 0.14%
//   cramer_scaled             0 / 0       10x / 7x    0.19% / 17x       98x / 4x    1.13% / 13x          0 / 0          0 / 0      23x / 16x

#include "common/ray_miss.glsl"
#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

RayEllipse ray_ellipse(vec3 origin, vec3 direction, vec3 center, vec3 u, vec3 v)
{
    vec3 q = origin - center;
#ifdef AS_PRINTED
    vec3 r = vec3(dot(cross(u, v), q), dot(cross(q, u), direction), dot(cross(v, q), direction)) /
        dot(cross(v, u), direction);
    // y is gamma and z is lambda.
    return dot(r.yz, r.yz) < 1.0 ? RayEllipse(r.x, r.z, r.y) : RayEllipse(-1.0, 0.0, 0.0);
#else
#ifdef SCALED
    float scale_q = scale_to_one(largest_component(q));
    float scale_d = scale_to_one(largest_component(direction));
    float scale_u = scale_to_one(largest_component(u));
    float scale_v = scale_to_one(largest_component(v));
    q *= scale_q;
    direction *= scale_d;
    u *= scale_u;
    v *= scale_v;
#endif
    float denominator = dot(cross(v, u), direction);
#ifndef UNGUARDED
    if (denominator == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
#endif
    float t = dot(cross(u, v), q) / denominator;
    vec2 place = vec2(dot(cross(v, q), direction), dot(cross(q, u), direction)) / denominator;
#ifdef SCALED
    t = times_ratio(t, scale_d, scale_q);
    place = vec2(times_ratio(place.x, scale_u, scale_q), times_ratio(place.y, scale_v, scale_q));
#endif
    bool hit = dot(place, place) <= 1.0 && t >= 0.0 && t < RAY_MISS;
    return hit ? RayEllipse(t, place.x, place.y) : RayEllipse(RAY_MISS, 0.0, 0.0);
#endif
}
