/*---
summary = "The ellipsoid's ellipse as published (M = R D R^T, asin, tan), then the published disk pipeline"
source  = "Heitz, Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid, 2016; Heitz & Hill 2017"
[[variant]]
name = "talk2017"
tables = { sphere_lut = "image" }
[[variant]]
name = "talk2017_scaled"
summary = "The same with the content suite's fixes: e/b cubic, discriminant and form factor >= 0, third axis normalised"
tables = { sphere_lut = "image" }
defines = { SHORTCUT = "7e-4", OVER_B = 1, CLAMP_DISCRIMINANT = 1, CLAMP_FORM_FACTOR = 1, NORMALIZE_THIRD = 1 }
[[variant]]
name = "as_printed"
summary = "The listing's M = R^T D R^T: a control that must fail wherever the ellipsoid is turned"
tables = { sphere_lut = "image" }
defines = { AS_PRINTED = 1, SHORTCUT = "7e-4", OVER_B = 1, CLAMP_DISCRIMINANT = 1, CLAMP_FORM_FACTOR = 1, NORMALIZE_THIRD = 1 }
---*/

// Domain: the point outside, a unit quaternion up to rounding. No guard is added.
// Source: equation 1 of the paper, M = R D R^T; its listing writes R^T on the left too (AS_PRINTED).
// Bound: none.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                          ggx      flat          far  near_surface      edge
//   talk2017          51% 5e-2   39% n1x   5.1% n5.1%       99% n3x  51% n29%
//   talk2017_scaled   51% 5e-2  39% 1e-1  0.022% 6e-3      99% 5e-2   39% 1e0
//   as_printed         82% 1e0   87% 1e0    6.3% 1e-1      100% 1e0   55% 1e0

#include "common/disk_talk2017.glsl"
#include "common/ellipsoid_disk.glsl"

float ltc_ellipsoid(mat3 minv, vec3 center, vec4 rotation, vec3 radius)
{
    mat3 R = ellipsoid_rotation(rotation);
    mat3 D = mat3(radius.x, 0.0, 0.0, 0.0, radius.y, 0.0, 0.0, 0.0, radius.z);
#ifdef AS_PRINTED
    mat3 M = transpose(R) * D * transpose(R);
#else
    mat3 M = R * D * transpose(R);
#endif
    vec3 C = inverse(M) * center;
    vec3 v1;
    vec3 v2;
    sphere_disk_2016(C, 1.0, v1, v2);
    return disk_talk2017(minv * (M * C), minv * (M * v1), minv * (M * v2));
}
