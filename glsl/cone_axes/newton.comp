/*---
summary = "The characteristic cubic's negative root by Newton's iteration from -1, the other two from their sum and product"
source  = "Newton's and Halley's iterations; the quotient by Vieta's formulas"

[[variant]]
name = "newton"

[[variant]]
name = "newton_precise"
precise = true

[[variant]]
name = "halley"
summary = "The characteristic cubic's negative root by Halley's iteration from -1, the other two from their sum and product"
defines = { HALLEY = 1 }
---*/

// P(e) = e^3 + c2 e^2 + c1 e + c0 is increasing and concave below its least root, which lies in [-1, 0): Newton's steps
// from -1 climb to it without passing it, Halley's in fewer. The positive roots follow from their sum -c2 - e and their
// product -c0/e.
//
// Domain: centres off the light's plane, non-zero semi-axes, lights within 1000 radii. Source: textbook.
// Bound: c1 and c2 cancel as in `blinn`; no square root here has a negative radicand by more than rounding, and that one
// is clamped. A root much below 1 takes a step for each factor of 1.5 (Newton's) or 2 (Halley's).
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                 scene      facing         far  near_plane     needle      edge
//   newton   0.98% n57x  0.67% 4e-3  0.048% 5e3   67% n8.6%  1.7% n23x  53% n47%
//   halley   0.78% n57x  0.67% 4e-3  5.5% n4.6%   65% n8.6%  1.4% n23x  53% n48%

#include "common/cone_quadric.glsl"

#ifdef HALLEY
const int STEPS = 8;
#else
const int STEPS = 12;
#endif

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
    float a;
    float b;
    float x0;
    float y0;
    cone_quadric(half_x, half_y, center, a, b, x0, y0);
    vec3 c = cone_polynomial(a, b, x0, y0);

    float e = -1.0;
    for (int i = 0; i < STEPS; ++i) {
        float value = ((e + c.z) * e + c.y) * e + c.x;
        float slope = (3.0 * e + 2.0 * c.z) * e + c.y;
#ifdef HALLEY
        float curvature = 6.0 * e + 2.0 * c.z;
        e -= 2.0 * value * slope / (2.0 * slope * slope - value * curvature);
#else
        e -= value / slope;
#endif
    }

    float sum = -c.z - e;
    float product = -c.x / e;
    float large = 0.5 * (sum + sqrt(max(sum * sum - 4.0 * product, 0.0)));
    vec3 axis = cone_direction(a, b, x0, y0, e, center.z < 0.0 ? -1.0 : 1.0);
    vec2 tangents = cone_root_tangents(e, product / large, large);
    return ConeAxes(axis, tangents.x, tangents.y);
}
