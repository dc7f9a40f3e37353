/*---
summary = "acos as (1.5708 - 0.175 x) sqrt(1 - x), for all angles alike"
source  = "Public renderers"

[[variant]]
name = "sqrt_linear"
---*/

// edge = (1.5708 - 0.175 x)/(2 pi sqrt(1 + x)) a x b, x = a.b: one root, no branch, no fit of the supplement.
//
// Domain: unit vectors, not opposite.
// Bound: theta is off by up to 0.02 for x >= 0, where acos's fit belongs, and by 0.7 for x < 0: 3e-3 and 0.1 of the
// result's scale. 1 + x cancels within 0.03 of pi as 1 - x^2 does.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                    scene      near  antipodal  right_angle      edge
//   sqrt_linear   86% 1e-1  18% 7e-4   99% n42%     11% 8e-4  37% n24%

#include "common/edge_fit.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_sqrt_linear(a, b);
}
