/*---
summary = "M = R D without a division by a semi-axis, the minor axis through the area V1 x V2"
source  = "ours, after Heitz 2016"

[[variant]]
name = "direct"

[[variant]]
name = "direct_normal"
summary = "direct with the area known beforehand, share r.yzx r.zxy n, for V1 x V2: its difference of products cancels"
defines = { NORMAL = 1 }

[[variant]]
name = "direct_shifted"
summary = "direct_normal with the eigensystem of D^2 less its smallest entry: the axes of nearly spherical bodies are right too"
defines = { NORMAL = 1, SHIFTED = 1 }

[[variant]]
name = "direct_shifted_precise"
summary = "direct_normal with the eigensystem of D^2 less its smallest entry: the axes of nearly spherical bodies are right too"
defines = { NORMAL = 1, SHIFTED = 1 }
precise = true
---*/

// Lengths are scaled exactly by a power of two first. P_b is never formed: with b = R^T c its direction n is along
// (b.x r.y r.z, b.y r.z r.x, b.z r.x r.y), and the plane's normal is r.yzx r.zxy n in the ellipsoid's frame
// (glsl/common/ellipsoid_disk.glsl), where everything happens until the axes are turned by R.
//
// SHIFTED: the axes are those of B^T D^2 B, B = [b1 b2] across n, and so of B^T (D^2 - r_min^2 I) B, whose entries
// (r - r_min)(r + r_min) do not cancel: what rounding leaves of the angle no longer grows as the body nears a sphere.
//
// Domain: any lengths whose ratios are within 2^40, one semi-axis 0 included. From inside, and where nothing is seen, centre
// and axes are all zero.
// Source: ours.
// Bound: centre and major axis 16 u, u = 2^-24, and 4 u over the height off the surface; the minor axis as well with NORMAL, and
// u aspect without. The axes turn by 8 u over the relative difference of their lengths without SHIFTED.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                      scene          sphere      flat       far  near_surface   edge
//   direct          0 1.8e-4  0.232 % 1.4e+0  0 2.5e-2  0 1.2e-4     3x 2.2e-2  0 inf
//   direct_normal   0 1.8e-4  0.232 % 1.4e+0  0 2.5e-2  0 1.2e-4     3x 2.2e-2  0 inf
//   direct_shifted  0 2.3e-5        0 2.8e-3  0 2.5e-2  0 4.2e-5     3x 2.2e-2  0 inf

#include "common/ellipsoid_disk.glsl"
#include "common/semi_axes.glsl"

EllipsoidEllipse ellipsoid_ellipse(vec3 center, vec4 rotation, vec3 radius)
{
    radius = abs(radius);
    float scale = scale_to_one(max(largest_component(center), largest_component(radius)));
    mat3 R = ellipsoid_rotation(rotation);
    vec3 r = radius * scale;
    vec3 n;
    float share;
    if (ellipsoid_outline(center * scale, R, r, n, share) != 1) {
        return EllipsoidEllipse(vec3(0.0), vec3(0.0), vec3(0.0));
    }
    vec3 b1;
    vec3 b2;
    sphere_basis(n, b1, b2);
    float root = sqrt(share);
    vec3 major;
    vec3 minor;
#if defined(SHIFTED)
    float least = min(r.x, min(r.y, r.z));
    vec3 shifted = (r - least) * (r + least);
    float t11 = dot(shifted, b1 * b1);
    float t22 = dot(shifted, b2 * b2);
    float t12 = dot(shifted, b1 * b2);
    bool first_is_longer = t11 >= t22;
    float k = eigen_tangent(max(t11, t22), min(t11, t22), t12);
    vec3 along = first_is_longer ? b1 + k * b2 : b2 + k * b1;
    major = r * along * (root * inversesqrt(1.0 + k * k));
    minor = cross(share * (r.yzx * r.zxy * n), major) / dot(major, major);
#elif defined(NORMAL)
    semi_axes_by_area(root * r * b1, root * r * b2, share * (r.yzx * r.zxy * n), major, minor);
#else
    semi_axes(root * r * b1, root * r * b2, major, minor);
#endif
    float back = reciprocal_power_of_two(scale);
    return EllipsoidEllipse(center * share, R * (major * back), R * (minor * back));
}
