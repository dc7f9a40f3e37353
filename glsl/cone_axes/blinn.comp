/*---
summary = "Roots of the characteristic cubic by both of Blinn's algorithms, the middle one from the quotient; no guards"
source  = "Blinn, How to Solve a Cubic Equation, IEEE CG&A 2006-2007; Heitz & Hill, Real-Time Line- and Disk-Light Shading, SIGGRAPH 2017, sample code; fixes as in public renderers"

[[variant]]
name = "blinn"

[[variant]]
name = "blinn_precise"
precise = true

[[variant]]
name = "blinn_discriminant"
summary = "blinn with the discriminant clamped to >= 0: discs that face the point have a double root"
defines = { CLAMP_DISCRIMINANT = 1 }

[[variant]]
name = "blinn_tangents"
summary = "blinn with the discriminant and both radicands of the tangents clamped to >= 0 (seen in a hobby engine)"
defines = { CLAMP_DISCRIMINANT = 1, CLAMP_TANGENTS = 1 }

[[variant]]
name = "blinn_radicands"
summary = "blinn with every radicand clamped to >= 0"
defines = { CLAMP_DISCRIMINANT = 1, CLAMP_RADICANDS = 1, CLAMP_TANGENTS = 1 }

[[variant]]
name = "blinn_floors"
summary = "blinn with every radicand clamped, and a - e, b - e and dividing roots kept above an absolute 1e-7 (seen in an HLSL port)"
defines = { CLAMP_DISCRIMINANT = 1, CLAMP_RADICANDS = 1, CLAMP_TANGENTS = 1, FLOOR = "1e-7" }

[[variant]]
name = "blinn_be"
summary = "blinn solved for e/b instead of e: a far light's coefficients stay in range"
defines = { OVER_B = 1 }

[[variant]]
name = "blinn_be_discriminant"
summary = "blinn_be with the discriminant clamped to >= 0 (seen in a content suite's renderer)"
defines = { OVER_B = 1, CLAMP_DISCRIMINANT = 1 }

[[variant]]
name = "blinn_be_discriminant_precise"
summary = "blinn_be with the discriminant clamped to >= 0 (seen in a content suite's renderer)"
defines = { OVER_B = 1, CLAMP_DISCRIMINANT = 1 }
precise = true

[[variant]]
name = "blinn_be_radicands"
summary = "blinn_be with every radicand clamped to >= 0"
defines = { OVER_B = 1, CLAMP_DISCRIMINANT = 1, CLAMP_RADICANDS = 1, CLAMP_TANGENTS = 1 }
---*/

// The mean direction and half angles of the cone over an ellipse from the eigenvalues of its quadric, as roots of
//
//     e^3 + c2 e^2 + c1 e + c0,  c0 = a b, c1 = a b (1 + x0^2 + y0^2) - a - b, c2 = 1 - a (1 + x0^2) - b (1 + y0^2)
//
// with a = (cz/hx)^2, b = (cz/hy)^2, x0 = cx/cz, y0 = cy/cz. The negative root e gives the direction
// (a x0/(a - e), b y0/(b - e), 1) and, over each positive root, -tan^2.
//
// Shipped fixes differ by what they clamp (`common/cone_quadric.glsl`, `common/cubic_blinn.glsl`) and by OVER_B,
// which solves for t = e/b: the same polynomial with coefficients divided by b, b^2, b^3.
//
// Domain: centres off the light's plane, non-zero semi-axes, lights within about 50 radii (OVER_B: 2000), clear of a
// double root. Source: Heitz & Hill 2017; Blinn 2006-2007.
// Bound: c2, c1 and the discriminant cancel; nothing holds near a double root, where the discriminant's sign is noise
// and its root NaN unless clamped, nor past cz/hx of about 2100, where it overflows.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                scene    facing        far  near_plane         needle      edge
//   blinn                       0 8e-5  37% 1e-1  36% n6.3%     1x 5e-2     0.16% 1e-1  54% n49%
//   blinn_discriminant          0 8e-5    0 3e-4  36% n6.3%      0 1e-3     0.16% 1e-1  50% n49%
//   blinn_tangents              0 8e-5    0 3e-4  36% n6.3%      0 1e-3     0.16% 1e-1  50% n49%
//   blinn_radicands             0 8e-5    0 3e-4  36% n6.3%      0 1e-3     0.16% 1e-1  50% n49%
//   blinn_floors            0.034% 1e0    0 3e-4    36% 2e0     36% 1e0      0.23% 1e0  54% n40%
//   blinn_be                   6x 6e-2  34% 1e-1    3x 1e-1     2% 8e-1  0.52% n0.021%  53% n48%
//   blinn_be_discriminant      5x 6e-2    0 3e-4    3x 1e-1   1.7% 8e-1  0.29% n0.021%  49% n48%
//   blinn_be_radicands         5x 6e-2    0 3e-4    3x 1e-1   1.7% 8e-1  0.29% n0.021%  49% n48%

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
    vec3 roots = cubic_blinn(cone_polynomial_over_b(a, 1.0 / b, x0, y0));
    b = 1.0;
#else
    vec3 roots = cubic_blinn(cone_polynomial(a, b, x0, y0));
#endif
    vec3 axis = cone_direction(a, b, x0, y0, roots.y, center.z < 0.0 ? -1.0 : 1.0);
    vec2 tangents = cone_root_tangents(roots.y, roots.x, roots.z);
    return ConeAxes(axis, tangents.x, tangents.y);
}
