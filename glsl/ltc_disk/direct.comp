/*---
summary = "Cone from conjugate semi-axes without a 2D eigensystem; secular equation by two poles; exact horizon"
source  = "ours"
[[variant]]
name = "direct_exact"
defines = { EXACT_HORIZON = 1 }
[[variant]]
name = "direct_lut"
summary = "The direct cone; the horizon by the 64 x 64 table of spheres, bilinear in the shader"
tables = { sphere_lut = "buffer" }
[[variant]]
name = "direct_lut_sampler"
summary = "The direct cone; the horizon by the table of spheres through a sampler"
tables = { sphere_lut = "image" }
[[variant]]
name = "direct_sphere_analytic"
summary = "The direct cone; an equal-area sphere clipped by the stable closed form"
defines = { HORIZON = 3 }
[[variant]]
name = "direct_rational"
summary = "The direct cone; the horizon by a rational fit"
defines = { HORIZON = 2 }
---*/

// Domain: any finite light and matrix; edge-on and empty lights give 0.
// Source: ours.
// Bound: the exact horizon is off by about 2^-21 of the light's share of the hemisphere, and by what N = V1 x V2 loses
// for needles, 2^-24 aspect. The sphere of equal form factor is an approximation: up to 0.01 for a light cut by the
// horizon.
// Measured (lavapipe, Mesa 22.3, 1 M a scenario): direct_exact has no failure in any scenario but edge (3.5 %, extreme
// matrices); p99 of the error below 7e-7, nothing that is not finite. The table fails
// on 6.9 % of ggx and 44 % of horizon, the sphere in closed form on 6.6 % and 44 %, the rational fit on 21 % and 51 %.

#include "common/disk_direct.glsl"

float ltc_disk(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    return disk_direct(minv, center, v1, v2);
}
