/*---
summary = "The ellipse's own axes in its plane, secular equation by two poles and Halley's step in shares of it; exact horizon"
source  = "ours; the angle as in Jacobi's method"
tried   = "What direct.comp says of the frame and the horizon holds here too. Axes in space, cone axes and their principal frame: 123 ns beside 92 of talk2017 and 51 of an empty kernel, on a busy machine. Three rational steps for one and Halley's: 1.12 of the time. The centre's part along the axis left in by the smaller sum of terms, as direct has it: 6.5 for 24 of a million edge lights, but 1.00 to 1.02 of talk2017's time on lavapipe for 0.96; direct_exact takes 0.97 to 1.00 with it"
[[variant]]
name = "secular_exact"
defines = { EXACT_HORIZON = 1 }
[[variant]]
name = "secular_lut"
summary = "The secular cone; the horizon by the 64 x 64 table of spheres, bilinear in the shader"
tables = { sphere_lut = "buffer" }
[[variant]]
name = "secular_lut_sampler"
summary = "The secular cone; the horizon by the table of spheres through a sampler"
tables = { sphere_lut = "image" }
[[variant]]
name = "secular_sphere_analytic"
summary = "The secular cone; an equal-area sphere clipped by the stable closed form"
defines = { HORIZON = 3 }
[[variant]]
name = "secular_rational"
summary = "The secular cone; the horizon by a rational fit"
defines = { HORIZON = 2 }
---*/

// As `direct`, with the axes of the ellipse in its plane first, from half the angle of (difference of squares, product): the poles of
// the secular equation and the centre's coordinates along them are then at hand, and all the cone needs are shares of that equation.
//
// Domain: as `direct_exact`.
// Source: ours; the angle as in Jacobi's method.
// Bound: as `direct_exact`.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                   ggx    grazing      facing          far  near_plane     needle   horizon  inside_out     edge
//   secular_exact                0 1e-5     0 2e-5      0 4e-7       0 5e-8      0 2e-3     0 1e-6    0 2e-5      0 2e-5  24x 1e0
//   secular_lut               5.3% 5e-2  9.8% 4e-2  0.17% 1e-4     38x 2e-3    35% 8e-2  6.4% 8e-2  44% 7e-2    90% 7e-2  16% 1e0
//   secular_lut_sampler       5.3% 5e-2  9.8% 4e-2  0.17% 1e-4     38x 2e-3    35% 8e-2  6.4% 8e-2  44% 7e-2    90% 7e-2  16% 1e0
//   secular_sphere_analytic   5.2% 5e-2  9.7% 4e-2      0 5e-7     40x 2e-3    20% 8e-2  6.4% 8e-2  44% 7e-2    80% 7e-2  16% 1e0
//   secular_rational           26% 2e-1   25% 2e-1    65% 1e-1  0.086% 3e-2    36% 2e-1  8.4% 2e-1  51% 2e-1   100% 2e-1  20% 1e0

#include "common/disk_secular.glsl"

float ltc_disk(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    return disk_secular(minv, center, v1, v2);
}
