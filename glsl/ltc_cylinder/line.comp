/*---
summary = "A line light times the radius"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course"

[[variant]]
name = "line"

[[variant]]
name = "line_caps"
summary = "A line light times the radius, and each cap that is seen as its area times the lobe at its centre"
defines = { CAPS = 1 }

[[variant]]
name = "line_disks"
summary = "A line light times the radius, and each cap that is seen as a disk light in closed form, cut by the horizon"
defines = { DISKS = 1, EXACT_HORIZON = 1 }

[[variant]]
name = "line_inside"
summary = "line, clamped to the hemisphere, and 1 for a point within the cylinder"
defines = { INSIDE = 1 }
---*/

// The line light is the limit of the cylinder over its radius, so the cylinder is about radius times the line. The limit
// loses the caps, which are of second order in the radius. CAPS adds them as the publication does: the transformed
// cosine's density at the cap's centre, times the solid angle pi r^2 cos/distance^2. DISKS adds them exactly, so that what is
// left of the error is the line's alone.
//
// Domain: cylinders thin against their distance and against the lobe, not seen end-on. Nothing bounds the result by 1.
// Source: Heitz & Hill 2017; the line's integral is that of ltc_line/positive.
// Bound: relative, second order in the radius over the distance (after Minv); seen end-on without caps all of it.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                 ggx_alpha_02  ggx_alpha_01  ggx_alpha_05        edge
//   line              9.3% 7e0      5.7% 2e1       16% 1e0  63% n0.73%
//   line_caps         5.4% 7e0      3.9% 2e1      7.3% 2e0  60% n0.73%
//   line_disks        5.4% 7e0      3.8% 2e1      7.2% 1e0  44% n0.73%
//   line_inside      9.3% 9e-1      5.7% 1e0      16% 6e-1  52% n0.02%

#include "common/line_light.glsl"
#ifdef DISKS
#include "common/disk_secular.glsl"
#include "common/orthogonal.glsl"
#endif

#ifdef CAPS
// The lobe's density in direction p, times the solid angle over the area of a small disk at p with normal n.
float cap(mat3 minv, vec3 p, vec3 n)
{
    float distance2 = dot(p, p);
    vec3 w = p * inversesqrt(distance2);
    vec3 q = minv * w;
    float reach = length(q);
    float density = max(q.z, 0.0) * abs(determinant(minv)) / (reach * reach * reach * reach);
    return density * max(dot(n, w), 0.0) / distance2;
}
#endif

float ltc_cylinder(mat3 minv, vec3 p1, vec3 p2, float radius)
{
#ifdef INSIDE
    vec3 along = p2 - p1;
    float place = -dot(p1, along) / dot(along, along);
    vec3 foot = p1 + place * along;
    if (place >= 0.0 && place <= 1.0 && dot(foot, foot) <= radius * radius) {
        return 1.0;
    }
#endif
    float sum = radius * line_light(minv, p1, p2);
#ifdef CAPS
    vec3 axis = normalize(p2 - p1);
    sum += radius * radius * (cap(minv, p1, axis) + cap(minv, p2, -axis));
#endif
#ifdef DISKS
    vec3 axis = normalize(p2 - p1);
    vec3 v1 = radius * any_orthogonal(axis);
    vec3 v2 = cross(axis, v1);
    // A cap is seen from beyond its end only.
    if (dot(axis, p1) > 0.0) {
        sum += disk_secular(minv, p1, v1, v2);
    } else if (dot(axis, p2) < 0.0) {
        sum += disk_secular(minv, p2, v1, v2);
    }
#endif
#ifdef INSIDE
    sum = min(sum, 1.0);
#endif
    return sum;
}
