/*---
summary = "lambda as the one positive root of the cubic of S = V1 V1^T + V2 V2^T - C C^T: Newton's iteration from above"
source  = "ours, by Descartes' rule of signs; the start after Hong, Bounds for absolute positiveness of multivariate polynomials, 1998"
tried   = "Newton from |C|^2 alone, 12 steps of it (variant direct): not enough near the light's plane"

[[variant]]
name = "direct"

[[variant]]
name = "direct_precise"
precise = true

[[variant]]
name = "direct_balanced"
summary = "direct from the bound that balances each negative term with a positive one: within a factor of 6 of the root"
defines = { BALANCED = 1 }
---*/

// lambda^3 + c2 lambda^2 + c1 lambda - c0 = 0 with c2 = hx^2 + hy^2 - |c|^2, c1 = hx^2 hy^2 - |c x V1|^2 - |c x V2|^2 and
// c0 = (hx hy cz)^2, which for conjugate semi-axes V1, V2 needs no 2D eigensystem. The cubic is convex from the root up,
// so Newton's steps descend to it. Its root is perfectly conditioned in its coefficients (a factor of 2), but they
// themselves are differences. What follows from lambda is that of `secular`.
//
// BALANCED starts from 3 times the largest of the sizes at which a negative term is as large as a positive one.
//
// Domain: any centre off the light's plane, non-zero semi-axes, lengths within 2^-20..2^20 of 1. Source: ours.
// Bound: c1, c2 round to 2^-24 of their largest terms: as if the inputs were rounded.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                       scene  facing     far  near_plane      needle      edge
//   direct            5x 2e-1  0 4e-7  0 4e-7    0.3% 2e0  0.025% 1e0  15% n10%
//   direct_balanced    0 3e-5  0 4e-7  0 4e-7      0 7e-4      0 2e-5  17% n15%

#include "common/cone_secular.glsl"

#ifdef BALANCED
const int NEWTON_STEPS = 7;
#else
const int NEWTON_STEPS = 12;
#endif

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
    vec2 h2 = vec2(half_x * half_x, half_y * half_y);
    vec3 k2 = center * center;
    float c2 = h2.x + h2.y - (k2.x + k2.y + k2.z);
    float c1 = h2.x * h2.y - h2.x * (k2.y + k2.z) - h2.y * (k2.x + k2.z);
    float c0 = h2.x * h2.y * k2.z;

    float lambda = k2.x + k2.y + k2.z;
#ifdef BALANCED
    float by_c2 = max(-c2, 0.0);
    float by_c1 = c1 < 0.0 ? min(sqrt(-c1), c2 > 0.0 ? -c1 / c2 : CONE_LARGEST) : 0.0;
    float by_c0 = min(pow(c0, 1.0 / 3.0), c2 > 0.0 ? sqrt(c0 / c2) : CONE_LARGEST);
    by_c0 = min(by_c0, c1 > 0.0 ? c0 / c1 : CONE_LARGEST);
    lambda = min(lambda, 3.0 * max(by_c2, max(by_c1, by_c0)));
#endif
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        float value = ((lambda + c2) * lambda + c1) * lambda - c0;
        float slope = (3.0 * lambda + 2.0 * c2) * lambda + c1;
        lambda -= value / slope;
    }
    lambda = max(lambda, k2.z);

    vec2 tangents = cone_tangents(vec2(half_x, half_y), center, lambda);
    return ConeAxes(cone_axis(h2, center, lambda), tangents.x, tangents.y);
}
