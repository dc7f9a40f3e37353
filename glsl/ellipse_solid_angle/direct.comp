/*---
summary = "No eigensystem: one root of the secular equation, and a complete elliptic integral of its sum and product"
source  = "ours"

[[variant]]
name = "direct"

[[variant]]
name = "direct_precise"
precise = true

[[variant]]
name = "direct_3"
summary = "direct with three steps of the elliptic integral"
defines = { CEL_STEPS = 3 }
---*/

// Omega = (4/3) |[C, V1, V2]| R_J(0, l + e1, l + e3, l) for the dual quadric V1 V1^T + V2 V2^T - C C^T with eigenvalues e1, e3, -l;
// R_J is symmetric, so that only l, e1 + e3 and e1 e3 are needed (glsl/common/cone_solid_angle.glsl).
//
// Domain: any ellipse, scaled exactly by a power of two first; areas below 1e-15 of the squared largest length count as none.
// Source: ours.
// Bound: 32 u, u = 2^-24, where [C, V1, V2] does not cancel.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                scene    facing       far  near_plane      needle        edge
//   direct    0 7.7e-3  0 6.7e-7  0 9.4e-3    0 1.5e-2  14x 1.1e+0  2.91 % inf
//   direct_3  0 7.7e-3  0 6.7e-7  0 9.4e-3    0 1.5e-2  14x 1.1e+0  5.39 % inf

#include "common/ellipse_solid_angle_direct.glsl"

float ellipse_solid_angle(vec3 center, vec3 v1, vec3 v2)
{
    float scale = scale_to_one(largest_component(max(abs(center), max(abs(v1), abs(v2)))));
    return ellipse_solid_angle_direct(center * scale, v1 * scale, v2 * scale);
}
