/*---
summary = "The ellipsoid's ellipse by M = R D (two matrix products fewer), direct cone, exact horizon"
source  = "Heitz, Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid, 2016, with M = R D; cone and horizon ours"
[[variant]]
name = "direct_exact"
defines = { EXACT_HORIZON = 1 }
[[variant]]
name = "direct_lut"
summary = "The ellipsoid's ellipse by M = R D, direct cone, horizon by the table of spheres"
tables = { sphere_lut = "buffer" }
[[variant]]
name = "direct_rational"
summary = "The ellipsoid's ellipse by M = R D, direct cone, no clipping but a rational fit"
defines = { HORIZON = 2 }
---*/

// M = R D O serves with any orthogonal O, the paper's with O = R^T. P_b is never formed (glsl/common/ellipsoid_disk.glsl).
//
// Domain: any semi-axes of ratios up to about 1e6, one of them 0 included; from inside the answer is 1.
// Source: as above.
// Bound: the disk's, and 2^-22 over the height off the surface in radii.
// Measured (lavapipe, Mesa 22.3, 1 M a scenario): direct_exact fails on 0.10 % of flat and on nothing else; the table on 50 % of
// ggx and 98 % of near_surface, the rational fit on 65 % and 100 %.

#include "common/disk_direct.glsl"
#include "common/ellipsoid_disk.glsl"

float ltc_ellipsoid(mat3 minv, vec3 center, vec4 rotation, vec3 radius)
{
    float scale = scale_to_one(max(largest_component(center), largest_component(radius)));
    vec3 C = center * scale;
    vec3 v1;
    vec3 v2;
    int seen = ellipsoid_disk(C, ellipsoid_rotation(rotation), abs(radius) * scale, v1, v2);
    if (seen < 1) {
        return seen < 0 ? 1.0 : 0.0;
    }
    return disk_direct(minv, C, v1, v2);
}
