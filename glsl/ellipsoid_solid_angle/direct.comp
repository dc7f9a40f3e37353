/*---
summary = "The ellipsoid's ellipse without a division, and its solid angle without an eigensystem"
source  = "ours, after Heitz 2016"

[[variant]]
name = "direct"

[[variant]]
name = "direct_precise"
precise = true
---*/

// Domain: any lengths whose ratios are within 2^40, scaled exactly by a power of two first. From inside 4 pi; one semi-axis 0 is
// an ellipse, two are nothing: 0.
// Source: ours (glsl/common/ellipsoid_disk.glsl, glsl/common/cone_solid_angle.glsl).
// Bound: 64 u, u = 2^-24, and 4 u over the height off the surface.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//              scene    sphere       flat       far  near_surface            edge
//   direct  0 2.5e-6  0 1.8e-6  5x 1.3e-3  0 1.2e-6      0 1.7e-4  0.787 % 1.1e+1

#include "common/ellipse_solid_angle_direct.glsl"
#include "common/ellipsoid_disk.glsl"

float ellipsoid_solid_angle(vec3 center, vec4 rotation, vec3 radius)
{
    radius = abs(radius);
    float scale = scale_to_one(max(largest_component(center), largest_component(radius)));
    vec3 C = center * scale;
    vec3 v1;
    vec3 v2;
    int seen = ellipsoid_disk(C, ellipsoid_rotation(rotation), radius * scale, v1, v2);
    if (seen < 1) {
        return seen < 0 ? 2.0 * CONE_TAU : 0.0;
    }
    // Beside the surface the ellipse is small, and near.
    scale = scale_to_one(largest_component(max(abs(C), max(abs(v1), abs(v2)))));
    return ellipse_solid_angle_direct(C * scale, v1 * scale, v2 * scale);
}
