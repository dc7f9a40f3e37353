/*---
summary = "The ray against the plane first; then the point's place in the plane"
source  = "folklore of ray tracers: disks and parallelograms"

[[variant]]
name = "plane_gram"
summary = "The place by the 2x2 system of the dot products"
defines = { PLACE = 1 }

[[variant]]
name = "plane_cross"
summary = "The place by cross products with the normal"
defines = { PLACE = 2 }

[[variant]]
name = "plane_orthogonal"
summary = "The place by one dot product each: right only where the semi-axes are perpendicular, a control"
defines = { PLACE = 3 }
---*/

// t = -N.q / N.d with N = u x v and q = origin - center, and the point p = q + t d relative to the centre.
//
// Domain: finite; products of four components within 2^+-120. plane_orthogonal: u.v = 0.
// Bound: t is as good as by Cramer's rule, but p has lost u |q|, u = 2^-24, and grazing rays carry the error of t along
// the plane. plane_gram loses u over the square of the sine between the semi-axes.
// Measured: failed / of these missed; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     scene   border  grazing         far         needle  at_plane          scale           edge
//   plane_gram        0 / 0  1x / 1x    0 / 0  0.13% / 6x  18.4% / 5.99%     0 / 0  10.8% / 8.61%  1.07% / 0.96%
//   plane_cross       0 / 0  1x / 1x    0 / 0  0.13% / 6x  4.86% / 1.43%     0 / 0  10.9% / 8.71%  0.81% / 0.70%
//   plane_orthogonal  0 / 0  1x / 1x    0 / 0  0.13% / 6x  63.8% / 28.2%     0 / 0          0 / 0  1.02% / 0.70%

#include "common/ray_miss.glsl"

RayEllipse ray_ellipse(vec3 origin, vec3 direction, vec3 center, vec3 u, vec3 v)
{
    vec3 q = origin - center;
    vec3 normal = cross(u, v);
    float slope = dot(normal, direction);
    if (slope == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
    float t = -dot(normal, q) / slope;
    vec3 p = q + t * direction;
#if PLACE == 1
    float uu = dot(u, u);
    float uv = dot(u, v);
    float vv = dot(v, v);
    float pu = dot(p, u);
    float pv = dot(p, v);
    float area = uu * vv - uv * uv;
    if (area == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
    vec2 place = vec2(vv * pu - uv * pv, uu * pv - uv * pu) / area;
#elif PLACE == 2
    float area = dot(normal, normal);
    if (area == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
    vec2 place = vec2(dot(cross(p, v), normal), dot(cross(u, p), normal)) / area;
#else
    vec2 place = vec2(dot(p, u) / dot(u, u), dot(p, v) / dot(v, v));
#endif
    bool hit = dot(place, place) <= 1.0 && t >= 0.0 && t < RAY_MISS;
    return hit ? RayEllipse(t, place.x, place.y) : RayEllipse(RAY_MISS, 0.0, 0.0);
}
