/*---
summary = "The disk of the tangent circle, secular cone, exact horizon"
source  = "ours"
[[variant]]
name = "secular_exact"
defines = { EXACT_HORIZON = 1 }
[[variant]]
name = "secular_lut"
summary = "The disk of the tangent circle, secular cone, horizon by the table of spheres"
tables = { sphere_lut = "buffer" }
[[variant]]
name = "secular_sphere_analytic"
summary = "The disk of the tangent circle, secular cone, an equal-area sphere clipped by the stable closed form"
defines = { HORIZON = 3 }
[[variant]]
name = "secular_rational"
summary = "The disk of the tangent circle, secular cone, no clipping but a rational fit"
defines = { HORIZON = 2 }
---*/

// Domain: any sphere and matrix within f32's squares; from inside the answer is 1, the whole hemisphere.
// Source: ours.
// Bound: the disk's; 1 - (r/d)^2 is formed as a product, so a point just off the sphere loses nothing.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                  ggx     diffuse    grazing          far  near_surface   horizon      edge
//   secular_exact               0 1e-5      0 3e-7     0 3e-6       0 9e-8        0 7e-5    0 2e-6    4x 1e0
//   secular_lut               32% 3e-2  0.55% 3e-4  1.3% 2e-2  0.011% 1e-2      98% 3e-2  17% 3e-2  1.3% 1e0
//   secular_sphere_analytic   31% 3e-2      0 4e-7  1.3% 2e-2  0.011% 1e-2      74% 3e-2  16% 3e-2  1.2% 1e0
//   secular_rational          64% 2e-1    73% 1e-1   16% 1e-1   0.28% 3e-2      99% 2e-1  51% 2e-1   15% 1e0

#include "common/disk_secular.glsl"
#include "common/sphere_disk.glsl"

float ltc_sphere(mat3 minv, vec3 center, float radius)
{
    float scale = scale_to_one(max(largest_component(center), abs(radius)));
    vec3 C = center * scale;
    vec3 v1;
    vec3 v2;
    if (!sphere_disk(C, radius * scale, v1, v2)) {
        return radius == 0.0 ? 0.0 : 1.0;
    }
    return disk_secular(minv, C, v1, v2);
}
