/*---
summary = "Cone from conjugate semi-axes without a 2D eigensystem; secular equation by two poles, Halley and Newton; exact horizon"
source  = "ours"
tried   = """Of 0.2 M to 2 M lights a scenario on lavapipe. Up to 6 rational steps from the pole at infinity: 84 ns a light beside 64 of \
talk2017 on a busy machine, where two steps from the present start took 58 to 62. One step: 0.16 % of ggx fails. No cofactors: 2 for 1 of 200 K \
fail in grazing and 4.5 for 3.5 % of edge. 1 - W3^2 by subtraction: 1 of 200 K in ggx, worst 1.5e-4. The crossings' angle from \
the rim and not from the cone: 6 of 2 M in grazing, 11 in near_plane. The mean direction over (h1 + l) (h2 + l) without the quotient: 3.5 \
for 2.4 % of edge. The arguments of the horizon's terms as differences, A m - e3 k W2^2 + k szz: 2.6 for 1.9 % of edge, and 10 for 0.9 % of its \
needles. Sizes of 1 for 2^10 of the image and 2^19 of the inputs: 1.6 for 0.9 % of edge. A height of 1e-17 for 1e-15 on the light: 0.05 % of edge \
less, but terms that are 0 over 0. B from N also of level lights: hunt finds ggx off by 1 and \
far by 0.96, where the image rises by 3e-10 and 4e-9 of its length. The mean direction's height from the rim's heights, c3 - a3 (A w): 17 % of near_plane. A polynomial of a third the degree in arctangent: 59 for 60 ns"""
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

// The ellipse in coordinates in which seven numbers are left of it (glsl/common/disk_frame.glsl), the confocal coordinate of the
// point (disk_cone.glsl), and Stokes' theorem along the visible rim (clipped_ellipse.glsl).
//
// Domain: any finite light and matrix whose products stay in f32's range. A light without area gives 0; a point on the
// light sees the half space on the side it is.
// Source: ours.
// Bound: a few 2^-24 of the light's measures, which the image has in its own coordinates. What fails in edge, 0.75 %,
// is what the exponents of f32 do not hold, for the products are of up to eight lengths: of lights and matrices of landmark values
// 7 %, of entries between 1e-12 and 1e12 1 %; and 1 % of needles 1e6 and more times as long as wide by their matrix. The same steps
// with 24 bits and unlimited exponents fail for a third of those. Elsewhere a hunt finds what draws do not: points on the light to
// 1e-9 of its size, where roundings decide which side they see (ggx, grazing, horizon); needles of aspect 1e3 that pass them as
// close as 1e-6, the same; and errors of 2e-3 within 1e-4 of the rim (near_plane). The sphere of equal form factor (all but direct_exact) is an approximation, not a rounding: with its own horizon exact
// (direct_sphere_analytic) 5.2 % of ggx are off by more than 1e-4 of the hemisphere, one in a hundred by more than 2e-3, and
// some by 0.05.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                  ggx    grazing      facing          far  near_plane     needle   horizon  inside_out       edge
//   direct_exact                0 3e-5     0 2e-5      0 4e-7       0 4e-8      0 4e-3     0 9e-5    0 3e-5      0 2e-5  0.75% 6e1
//   direct_lut               5.3% 5e-2  9.8% 4e-2  0.17% 1e-4     38x 2e-3    35% 8e-2  6.4% 8e-2  44% 7e-2    90% 2e-1    16% 6e1
//   direct_lut_sampler       5.3% 5e-2  9.8% 4e-2  0.17% 1e-4     38x 2e-3    35% 8e-2  6.4% 8e-2  44% 7e-2    90% 2e-1    16% 6e1
//   direct_sphere_analytic   5.2% 5e-2  9.7% 4e-2      0 5e-7     40x 2e-3    26% 8e-2  6.4% 8e-2  44% 7e-2    80% 2e-1    16% 6e1
//   direct_rational           26% 2e-1   25% 2e-1    65% 1e-1  0.086% 3e-2    36% 2e-1  8.4% 2e-1  51% 2e-1   100% 2e-1    20% 6e1

#include "common/disk_direct.glsl"

float ltc_disk(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    return disk_direct(minv, center, v1, v2);
}
