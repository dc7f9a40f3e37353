/*---
summary = "lambda from the secular equation by rational steps with two poles, everything else as sums of positive terms"
source  = "ours; the step is the fixed-form interpolation of secular equations (Bunch, Nielsen & Sorensen 1978; Li 1993)"
tried   = "Three and four steps, always (secular_3, secular_4). Not tried: an iteration in log lambda"

[[variant]]
name = "secular"
defines = { SCALED = 1 }

[[variant]]
name = "secular_precise"
defines = { SCALED = 1 }
precise = true

[[variant]]
name = "secular_plain"
summary = "secular without the exact scaling by a power of two: lengths of 2^-30 to 2^30"

[[variant]]
name = "secular_3"
summary = "secular_plain with three steps, always: enough for scenes, no divergence"
defines = { CONE_STEPS = 3, CONE_DONE = "-1.0" }

[[variant]]
name = "secular_4"
summary = "secular_plain with four steps, always: enough but for aspects of 1e4 seen from close by"
defines = { CONE_STEPS = 4, CONE_DONE = "-1.0" }
---*/

// The cone's dual matrix S = diag(hx^2, hy^2, 0) - c c^T has one negative eigenvalue -lambda, the positive root of
// cx^2/(hx^2 + lambda) + cy^2/(hy^2 + lambda) + cz^2/lambda = 1: `common/cone_secular.glsl` has the step, its proof of
// monotony and the formulas of what follows. Neither a polynomial nor a difference of large numbers occurs, no
// division is by a vanishing height, and no radicand can be negative.
//
// Domain: any centre and semi-axes, where a height or semi-axis below 2^-60 of the largest length counts as zero;
// without SCALED lengths within 2^-30..2^30 of 1. The origin in the light itself: axis +z, tangents the largest number.
// Source: ours.
// Bound: outside the reach of the rim (1 - u^2 - v^2 away from 0, u = cx/hx, v = cy/hy, for points near the plane) all
// within 12 u, u = 2^-24; beside it the error is that of rounding the inputs.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                      scene  facing     far  near_plane   needle        edge
//   secular           0 2e-5  0 4e-7  0 4e-7      0 1e-3   0 2e-5  3.4% 3e+76
//   secular_precise   0 2e-5  0 4e-7  0 4e-7      0 1e-3   0 1e-5  3.4% 3e+76
//   secular_plain     0 2e-5  0 4e-7  0 4e-7      0 1e-3   0 2e-5  5.8% n4.3%
//   secular_3         0 2e-4  0 4e-7  0 4e-7    48x 2e-3  1x 2e-3  4.5% n1.9%
//   secular_4         0 2e-5  0 4e-7  0 4e-7      0 1e-3   0 2e-5  5.7% n4.1%

#include "common/cone_secular.glsl"
#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
    half_x = abs(half_x);
    half_y = abs(half_y);
#ifdef SCALED
    float scale = scale_to_one(max(max(half_x, half_y), largest_component(center)));
    half_x *= scale;
    half_y *= scale;
    center *= scale;
#endif
    ConeAxes result;
    cone_secular(half_x, half_y, center, result.axis, result.tan_major, result.tan_minor);
    return result;
}
