/*---
summary = "mu = cz^2/lambda by Newton's iteration on g(mu) = mu (1 + u^2/(a + mu) + v^2/(b + mu)) - 1 from the best of three lower bounds"
source  = "ours: g is increasing and concave, so every step climbs"

[[variant]]
name = "secular_newton"
---*/

// With a = (cz/hx)^2, b = (cz/hy)^2, u = cx/hx, v = cy/hy the negative eigenvalue of the cone's quadric is -mu, the root
// of g in (0, 1]. Lower bounds of it: 1/(1 + x0^2 + y0^2), 1 - u^2 - v^2, and the root for min(a, b) in place of both,
// exact for a circle. Newton's steps climb from any of them.
//
// Domain: centres off the light's plane, non-zero semi-axes, lengths within 2^-30..2^30 of 1. Source: ours.
// Bound: as `secular`, for heights and semi-axes whose squares and quotients stay in range.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                     scene  facing     far  near_plane  needle      edge
//   secular_newton   0 3e-5  0 4e-7  0 4e-7      0 8e-4  0 5e-5  36% n26%

#include "common/cone_secular.glsl"

const int NEWTON_STEPS = 8;

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
    vec2 h2 = vec2(half_x * half_x, half_y * half_y);
    vec3 c2 = center * center;
    vec2 ab = c2.z / h2;
    vec2 w = c2.xy / h2;

    float least = min(ab.x, ab.y);
    float m = 0.5 * (least + w.x + w.y - 1.0);
    float d = sqrt(m * m + least);
    float circle = m > 0.0 ? least / (m + d) : d - m;
    float mu = max(max(circle, 1.0 - w.x - w.y), c2.z / (c2.x + c2.y + c2.z));
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        vec2 inverse = 1.0 / (ab + mu);
        vec2 t = w * inverse;
        float value = mu * (1.0 + t.x + t.y) - 1.0;
        float slope = 1.0 + dot(t * ab, inverse);
        mu -= value / slope;
    }
    mu = clamp(mu, CONE_SMALLEST, 1.0);

    float lambda = c2.z / mu;
    vec2 tangents = cone_tangents(vec2(half_x, half_y), center, lambda);
    return ConeAxes(cone_axis(h2, center, lambda), tangents.x, tangents.y);
}
