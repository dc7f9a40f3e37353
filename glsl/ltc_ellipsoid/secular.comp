/*---
summary = "The ellipsoid's ellipse by M = R D (two matrix products fewer), secular cone, exact horizon"
source  = "Heitz, Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid, 2016, with M = R D; cone and horizon ours"
[[variant]]
name = "secular_exact"
defines = { EXACT_HORIZON = 1 }
[[variant]]
name = "secular_lut"
summary = "The ellipsoid's ellipse by M = R D, secular cone, horizon by the table of spheres"
tables = { sphere_lut = "buffer" }
[[variant]]
name = "secular_rational"
summary = "The ellipsoid's ellipse by M = R D, secular cone, no clipping but a rational fit"
defines = { HORIZON = 2 }
---*/

// M = R D O serves with any orthogonal O, the paper's with O = R^T. P_b is never formed (glsl/common/ellipsoid_disk.glsl).
//
// Domain: any semi-axes of ratios up to about 1e6, one of them 0 included; from inside the answer is 1.
// Source: as above.
// Bound: the disk's, and 2^-22 over the height off the surface in radii.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                           ggx      flat          far  near_surface      edge
//   secular_exact        0 2e-5    0 7e-5       0 9e-8        0 9e-5    0 5e-6
//   secular_lut        46% 5e-2  37% 8e-2  0.022% 6e-3      98% 5e-2  14% 4e-3
//   secular_rational   73% 2e-1  51% 2e-1   0.44% 2e-2     100% 2e-1  58% 3e-2

#include "common/disk_secular.glsl"
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
    return disk_secular(minv, C, v1, v2);
}
