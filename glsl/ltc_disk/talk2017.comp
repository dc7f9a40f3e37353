/*---
summary = "sqrt(Q) ordered with the 1e-4 shortcut, Blinn's cubic, equal-area sphere at the horizon: the published pipeline"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course; cubic by Blinn and Peters"
[[variant]]
name = "talk2017"
tables = { sphere_lut = "image" }
[[variant]]
name = "talk2017_sphere_analytic"
summary = "The published pipeline with the closed form of the clipped sphere"
defines = { HORIZON = 1 }
[[variant]]
name = "talk2017_rational"
summary = "The published pipeline with a rational fit at the horizon"
defines = { HORIZON = 2 }
[[variant]]
name = "talk2017_discriminant"
summary = "The published pipeline with the cubic's discriminant clamped to >= 0"
tables = { sphere_lut = "image" }
defines = { CLAMP_DISCRIMINANT = 1 }
[[variant]]
name = "talk2017_form_factor"
summary = "The published pipeline with the form factor clamped to >= 0 (a web engine)"
tables = { sphere_lut = "image" }
defines = { CLAMP_FORM_FACTOR = 1 }
[[variant]]
name = "talk2017_pass_nan"
summary = "The published pipeline with an arctangent that hands NaN on, as on devices whose own does"
tables = { sphere_lut = "image" }
defines = { PASS_NAN = 1 }
[[variant]]
name = "talk2017_over_b"
summary = "The published pipeline with the cubic solved for e/b"
tables = { sphere_lut = "image" }
defines = { OVER_B = 1 }
[[variant]]
name = "talk2017_over_b_discriminant"
summary = "The published pipeline with the cubic solved for e/b and its discriminant clamped to >= 0: the two that mend facing and far"
tables = { sphere_lut = "image" }
defines = { OVER_B = 1, CLAMP_DISCRIMINANT = 1 }
[[variant]]
name = "talk2017_shortcut"
summary = "The published pipeline with the near-diagonal shortcut at 1e-3 (a hobby engine)"
tables = { sphere_lut = "image" }
defines = { SHORTCUT = "1e-3" }
[[variant]]
name = "talk2017_det"
summary = "The published pipeline with det Q clamped to >= 0 (a hobby engine)"
tables = { sphere_lut = "image" }
defines = { CLAMP_DET = 1 }
[[variant]]
name = "talk2017_tangents"
summary = "The published pipeline with the tangents' radicands clamped to >= 0 (a hobby engine)"
tables = { sphere_lut = "image" }
defines = { CLAMP_TANGENTS = 1 }
[[variant]]
name = "talk2017_sanitize"
summary = "The published pipeline with a NaN turned to 0 at the end (a web engine's diffuse path)"
tables = { sphere_lut = "image" }
defines = { SANITIZE = 1 }
[[variant]]
name = "talk2017_scaled"
summary = "Shortcut at 7e-4, cubic for e/b, discriminant and form factor >= 0, third axis normalised (a content suite)"
tables = { sphere_lut = "image" }
defines = { SHORTCUT = "7e-4", OVER_B = 1, CLAMP_DISCRIMINANT = 1, CLAMP_FORM_FACTOR = 1, NORMALIZE_THIRD = 1 }
[[variant]]
name = "talk2017_radicands"
summary = "Shortcut at 1e-3, det Q, discriminant and tangents' radicands >= 0 (a hobby engine)"
tables = { sphere_lut = "image" }
defines = { SHORTCUT = "1e-3", CLAMP_DET = 1, CLAMP_DISCRIMINANT = 1, CLAMP_TANGENTS = 1 }
[[variant]]
name = "talk2017_floors"
summary = "Absolute floors of 1e-7, everything clamped, the result sanitised (a C++ engine's HLSL)"
tables = { sphere_lut = "image" }
defines = { FLOOR = "1e-7", CLAMP_DET = 1, CLAMP_DISCRIMINANT = 1, CLAMP_RADICANDS = 1, CLAMP_TANGENTS = 1, CLAMP_FORM_FACTOR = 1, SANITIZE = 1 }
---*/

// Two eigensystems and a table, on the light's centre and semi-axes after Minv: glsl/common/disk_talk2017.glsl, with each
// fix named there.
//
// Domain: generic lights. A disk that faces the point has a double root, and the discriminant's sign is rounding; a far
// light overflows the discriminant as (4/81)(d/r)^12, to infinity less infinity. No guard but those that a variant names.
// Bound: none.
//
// Where the discriminant is negative or NaN so is its root, which the cubic hands to atan(). Mesa's atan takes min(|y/x|, 1) on
// its way, which drops a NaN for 1: the angle becomes a number, and the light a wrong one (facing: off by up to 0.02) or, far
// away, one that is small anyway. So lavapipe shows as NaN only what overflows later. An arctangent that hands NaN on
// (talk2017_pass_nan) gives NaN in 42 % of facing and 37 % of far on lavapipe; SwiftShader's own atan gives talk2017 28 % and
// 37 % there (100 K a scenario).
//
// What each fix mends, where the table's own error does not hide it: a clamped discriminant mends facing, and on devices
// that hand NaN on all of far but 2 %; e/b mends far, but for 8 NaN in a million, and not facing; both together mend both, and
// fail more of edge. Clamped tangents, a clamped form factor or a NaN turned to 0 mend far and the NaN of needle by darkness,
// which is nearly right there, and facing not; on SwiftShader a clamped form factor makes facing lights black. A wider shortcut
// mends the few NaN of ggx, those of sharp matrices; a clamped det Q nothing. Absolute floors cost a little of grazing, near_plane and
// needle. No fix helps at the horizon, which is the sphere's and the table's error.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                        ggx      grazing      facing          far  near_plane      needle   horizon   inside_out       edge
//   talk2017                        5.4% n5x  10% n0.011%    33% 2e-2   2.1% n2.1%    35% 8e-2  7.8% n1.3%  44% 7e-2     90% 7e-2   65% n51%
//   talk2017_sphere_analytic       5.2% 8e-2     10% 2e-1    33% 2e-2     48x 2e-3     22% 1e0   6.5% 8e-2   44% 1e0     80% 7e-2    20% 1e0
//   talk2017_rational               26% 2e-1     25% 2e-1    70% 1e-1  0.087% 3e-2    36% 2e-1   8.5% 2e-1  51% 2e-1    100% 2e-1    24% 1e0
//   talk2017_discriminant           5.4% n5x  10% n0.011%  0.17% 1e-4       2% n2%    35% 8e-2  7.8% n1.3%  44% 7e-2     90% 7e-2   65% n51%
//   talk2017_form_factor           5.4% 8e-2     10% 2e-1    33% 2e-2     46x 2e-3    35% 8e-2   6.5% 8e-2  44% 7e-2     90% 7e-2    21% 1e0
//   talk2017_pass_nan               5.4% n5x  10% n0.011%    43% n42%     37% n37%  36% n0.49%   10% n4.1%  44% 7e-2  90% n0.021%   70% n55%
//   talk2017_over_b                 5.4% n6x  10% n0.011%    33% 2e-2      54x n8x    35% 8e-2  7.8% n1.3%   44% n1x     90% 7e-2   78% n64%
//   talk2017_over_b_discriminant    5.4% n6x  10% n0.011%  0.17% 1e-4      54x n8x    35% 8e-2  7.8% n1.3%   44% n1x     90% 7e-2   78% n64%
//   talk2017_shortcut              5.4% 5e-2  10% n0.011%    33% 2e-2   2.1% n2.1%    35% 8e-2  7.8% n1.3%  44% 7e-2     90% 7e-2   65% n51%
//   talk2017_det                    5.4% n5x  10% n0.011%    33% 2e-2   2.1% n2.1%    35% 8e-2  7.8% n1.3%  44% 7e-2     90% 7e-2   65% n51%
//   talk2017_tangents              5.4% 8e-2     10% 2e-1    33% 2e-2     46x 2e-3    35% 8e-2   6.5% 8e-2  44% 7e-2     90% 7e-2  21% n0.7%
//   talk2017_sanitize              5.4% 8e-2     10% 2e-1    33% 2e-2     46x 2e-3    35% 8e-2   6.5% 8e-2  44% 7e-2     90% 7e-2    21% 1e0
//   talk2017_scaled                5.4% 5e-2     10% 2e-1  0.17% 1e-4     40x 2e-3    35% 8e-2   6.5% 8e-2  44% 3e-1     90% 7e-2    21% 1e0
//   talk2017_radicands             5.4% 5e-2     10% 2e-1  0.17% 1e-4     40x 2e-3    35% 8e-2   6.5% 8e-2  44% 7e-2     90% 7e-2  22% n1.8%
//   talk2017_floors                5.4% 8e-2     10% 4e-1  0.17% 1e-4     46x 2e-3    36% 8e-2     7% 8e-2  44% 7e-2     90% 7e-2    22% 1e0

#include "common/disk_talk2017.glsl"

float ltc_disk(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    return disk_talk2017(minv * center, minv * v1, minv * v2);
}
