/*---
summary = "Sheared so that the ray is the z axis; then two dimensions"
source  = "ours, after the shear of Woop, Benthin & Wald, Watertight Ray/Triangle Intersection, 2013"

[[variant]]
name = "sheared"
---*/

// With k the direction's largest component, x and y of q = origin - center, u and v lose their share of k along d. What is
// left are determinants of two dimensions, [u, v], [q, v], [u, q], and t from the equation of k.
//
// Domain: finite; products of two components within 2^+-120.
// Bound: as Cramer's rule, with fewer roundings; t adds u times its terms' magnitudes over |d|, u = 2^-24.
// Measured: failed / of these missed; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//            scene  border  grazing    far     needle  at_plane  scale           edge
//   sheared  0 / 0   0 / 0    0 / 0  0 / 0  1.33% / 0     0 / 0  0 / 0  0.12% / 0.05%

#include "common/ray_miss.glsl"

float determinant2(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

RayEllipse ray_ellipse(vec3 origin, vec3 direction, vec3 center, vec3 u, vec3 v)
{
    vec3 q = origin - center;
    vec3 a = abs(direction);
    // A cyclic permutation keeps handedness, so nothing has to be turned round.
    if (a.x >= a.y && a.x >= a.z) {
        direction = direction.yzx;
        q = q.yzx;
        u = u.yzx;
        v = v.yzx;
    } else if (a.y >= a.z) {
        direction = direction.zxy;
        q = q.zxy;
        u = u.zxy;
        v = v.zxy;
    }
    if (direction.z == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
    vec2 shear = direction.xy / direction.z;
    vec2 q2 = q.xy - shear * q.z;
    vec2 u2 = u.xy - shear * u.z;
    vec2 v2 = v.xy - shear * v.z;
    float area = determinant2(u2, v2);
    if (area == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
    vec2 place = vec2(determinant2(q2, v2), determinant2(u2, q2)) / area;
    float t = (place.x * u.z + place.y * v.z - q.z) / direction.z;
    bool hit = dot(place, place) <= 1.0 && t >= 0.0 && t < RAY_MISS;
    return hit ? RayEllipse(t, place.x, place.y) : RayEllipse(RAY_MISS, 0.0, 0.0);
}
