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
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                       scene          near  antipodal   right_angle       edge
//   sqrt_linear    87.1% 0.11  18.2% 6.6e-4  99.2% inf  11.4% 8.2e-4  36.9% inf

#include "common/edge_fit.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_sqrt_linear(a, b);
}
