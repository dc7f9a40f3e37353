/*---
summary = "Cone from conjugate semi-axes without a 2D eigensystem; secular equation by two poles and one step of third order; exact horizon"
source  = "ours"
tried   = """Of 0.2 M to 2 M lights a scenario on lavapipe, or 60-digit emulation. Up to 6 rational steps from the pole at infinity: 84 ns a \
light beside 64 of talk2017 on a busy machine, where two steps from a start by both poles took 58 to 62. One step alone: 0.16 % of ggx fails. \
Halley's and Newton's steps for Householder's one: 1.03 of the time. 1 - W3^2 by subtraction: 1 of 200 K in ggx, worst 1.5e-4. The \
crossings' angle from the rim and not from the cone: 6 of 2 M in grazing, 11 in near_plane. The mean direction's height from the rim's heights: \
17 % of near_plane. A frame that turns one conjugate axis level, with the distance along it from images: 0.75 % of edge fails, hunts \
find ggx, grazing and near_plane off by up to 1. In exact arithmetic its absolute threshold of 1e-18 of the light's size for points \
on the light explains two thirds of those, the rounding of its plane coordinates the rest. No cut of endless lights: 1.4 % of edge. Cut at 1024 instead of 16384 times \
the distance: errors of 7e-4. One power of two for the whole matrix: 0.58 for 0.16 % of edge. The centre's height from its image and not from its coordinates here: hunts find horizon off by 1, where the light lies almost in it. \
Vectors normalised before their products and a start from the scaled ellipse's polynomials: 1.10 of the time, most of which is one chain of dependent operations. \
A power of two for each component and its column by the root of their product, for units of the middle product: 0.034 % of edge, in 0.97 of the time. \
Rows of the matrix brought within 2^20 to 2^56 of each other: 0.8 to 0.13 % of edge. The centre with its part along the axis: needles that pass the point lose 1e-4 for 2e-6, and hunts find them off by 1. \
What failed of 8 M edge lights, emulated in f32, with unlimited exponents and in f64, said the rest: 27 of a million before; 19 with powers of two down to 2^-126 and areas 2^80 times; \
13 with the centre's part along the axis left in by the smaller sum of terms, 1.03 of the time; 6.5 with one t for all angles of the horizon, in no more time; 3 with the centre scaled in two steps \
where it is next to nothing beside the axes; 2 with a smallest z. Of what is left half are points on the light whose side the cut of endless lights takes. No bound by the whole cone: 2 more of a million. \
The smallest width and height at 1e-16 for 1e-13 of the distance: 75 more. Needles of 2^29 for 2^28: as many"""
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

// The longer semi-axis, and what the other has along and across it (glsl/common/disk_frame.glsl), the confocal coordinate of
// the point (disk_direct.glsl), and Stokes' theorem along the visible rim (clipped_ellipse.glsl).
//
// Domain: any finite light and matrix; lights without area, seen edge-on or under a singular matrix give 0, and a point on the
// light sees the half space on the side it is.
// Source: ours.
// Bound: a few 2^-24 of the light's measures, which the image has in its own coordinates; observed, not proved. What fails in edge
// are lights that f32's range is too small for: axis ratios from 2^126, points within 1e-13 of the light's size of it. The sphere of equal form factor (all but direct_exact) is an
// approximation, not a rounding: with its own horizon exact (direct_sphere_analytic) 5.2 % of ggx are off by more than 1e-4 of
// the hemisphere, one in a hundred by more than 2e-3, and some by 0.05.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                  ggx    grazing      facing          far  near_plane     needle   horizon  inside_out     edge
//   direct_exact                0 1e-5     0 2e-5      0 5e-7       0 5e-8      0 2e-3     0 1e-6    0 1e-5      0 2e-5    0 1e0
//   direct_lut               5.3% 5e-2  9.8% 4e-2  0.17% 1e-4     38x 2e-3    35% 8e-2  6.4% 8e-2  44% 7e-2    90% 7e-2  16% 1e0
//   direct_lut_sampler       5.3% 5e-2  9.8% 4e-2  0.17% 1e-4     38x 2e-3    35% 8e-2  6.4% 8e-2  44% 7e-2    90% 7e-2  16% 1e0
//   direct_sphere_analytic   5.2% 5e-2  9.7% 4e-2      0 4e-7     40x 2e-3    20% 8e-2  6.4% 8e-2  44% 7e-2    80% 7e-2  15% 1e0
//   direct_rational           26% 2e-1   25% 2e-1    65% 1e-1  0.086% 3e-2    36% 2e-1  8.4% 2e-1  51% 2e-1   100% 2e-1  20% 1e0

#include "common/disk_direct.glsl"

float ltc_disk(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    return disk_direct(minv, center, v1, v2);
}
