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

// M = R D O serves with any orthogonal O, the paper's with O = R^T.
//
// Domain: semi-axes of one sign or another, none 0, of ratios up to about 1e4; from inside the answer is 1.
// Source: as above.
// Bound: 1 - 1/|P_b|^2 is formed as a product; a flat ellipsoid seen along its plane has large P_b, and loses the
// direction's digits in proportion.
// Measured: -

#include "common/disk_direct.glsl"
#include "common/ellipsoid_disk.glsl"

float ltc_ellipsoid(mat3 minv, vec3 center, vec4 rotation, vec3 radius)
{
    float scale = scale_to_one(max(largest_component(center), largest_component(radius)));
    radius = abs(radius) * scale;
    if (!(min(radius.x, min(radius.y, radius.z)) > 1.0e-18)) {
        return 0.0;
    }
    mat3 R = ellipsoid_rotation(rotation);
    vec3 C = (center * scale) * R / radius;
    vec3 v1;
    vec3 v2;
    if (!sphere_disk(C, 1.0, v1, v2)) {
        return 1.0;
    }
    return disk_direct(minv, R * (radius * C), R * (radius * v1), R * (radius * v2));
}
