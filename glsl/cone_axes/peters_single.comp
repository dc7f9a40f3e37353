/*---
summary = "Roots of the characteristic cubic from one angle: one atan2, three cosines; no guards"
source  = "Peters, How to solve a cubic equation, revisited, Moments in Graphics 2016, after Blinn 2006-2007"

[[variant]]
name = "peters_single"

[[variant]]
name = "peters_single_precise"
precise = true

[[variant]]
name = "peters_single_discriminant"
summary = "peters_single with the discriminant clamped to >= 0"
defines = { CLAMP_DISCRIMINANT = 1 }

[[variant]]
name = "peters_single_be"
summary = "peters_single solved for e/b, with every radicand clamped to >= 0"
defines = { OVER_B = 1, CLAMP_DISCRIMINANT = 1, CLAMP_RADICANDS = 1, CLAMP_TANGENTS = 1 }
---*/

// As `blinn`, but with all three roots from algorithm A: half the work, and the roots of small size, among them the
// negative one, are differences of numbers as large as the largest.
//
// Domain: centres off the light's plane, non-zero semi-axes, lights within a few radii. Source: Peters 2016.
// Bound: the negative root's absolute error is some 2^-24 of the largest root, whatever its own size.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                     scene      facing       far  near_plane     needle      edge
//   peters_single                19% n0.11%    37% n18%  87% n49%   63% n9.9%  55% n1.8%  61% n48%
//   peters_single_discriminant   19% n0.11%  0.93% 2e-2  87% n45%   63% n9.9%  55% n1.8%  57% n47%
//   peters_single_be               19% n57x     1% 2e-2   87% n4x   63% n2.9%  55% n1.3%  57% n33%

#include "common/cone_quadric.glsl"
#include "common/cubic_blinn.glsl"

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
    float a;
    float b;
    float x0;
    float y0;
    cone_quadric(half_x, half_y, center, a, b, x0, y0);
#ifdef OVER_B
    a = a / b;
    vec3 roots = cubic_single(cone_polynomial_over_b(a, 1.0 / b, x0, y0));
    b = 1.0;
#else
    vec3 roots = cubic_single(cone_polynomial(a, b, x0, y0));
#endif
    vec3 axis = cone_direction(a, b, x0, y0, roots.y, center.z < 0.0 ? -1.0 : 1.0);
    vec2 tangents = cone_root_tangents(roots.y, roots.x, roots.z);
    return ConeAxes(axis, tangents.x, tangents.y);
}
