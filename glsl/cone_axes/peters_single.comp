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
// Measured: -

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
