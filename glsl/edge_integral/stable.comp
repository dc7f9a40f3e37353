/*---
summary = "The cross product of a with b - a or b + a, which does not cancel, and the sine from it"
source  = "ours, from a x b = a x (b - a) = a x (b + a)"
tried   = "a x b by error-free products (compensated) is right whatever the lengths of the vectors, at three times the operations; from exact partial products only where the compiler leaves them alone (precise)"

[[variant]]
name = "stable"
defines = { EDGE = "edge_stable" }

[[variant]]
name = "stable_precise"
defines = { EDGE = "edge_stable" }
precise = true

[[variant]]
name = "stable_hill"
summary = "stable with the published fit, good to 1.4e-6 of theta/sin(theta)"
defines = { EDGE = "edge_stable_hill" }

[[variant]]
name = "stable_atan2"
summary = "stable with atan for the angle"
defines = { EDGE = "edge_stable_atan2" }

[[variant]]
name = "stable_atan2_precise"
summary = "stable with atan for the angle"
defines = { EDGE = "edge_stable_atan2" }
precise = true

[[variant]]
name = "compensated"
summary = "a x b by error-free products (Dekker), atan for the angle"
defines = { EDGE = "edge_compensated", CROSS = "cross_dekker" }

[[variant]]
name = "compensated_split"
summary = "a x b from exact partial products, atan for the angle"
defines = { EDGE = "edge_compensated", CROSS = "cross_split" }

[[variant]]
name = "compensated_split_precise"
summary = "a x b from exact partial products, atan for the angle"
defines = { EDGE = "edge_compensated", CROSS = "cross_split" }
precise = true
---*/

// The forms of glsl/common/edge_stable.glsl: a x b is taken as a x d, with d the shorter of b - a and b + a, and the
// sine of the angle from it. For a.b < 0 the factor theta/(2 pi sin theta) is 1/(2 sin) - fit(|a.b|).
//
// Domain: vectors within 1e-6 of unit length, any angle; parallel and opposite ones give 0.
// Bound: 8e-9 of the fit and roundings of a few 2^-24 of the result, until pi - theta is as small as the deviation of
// the lengths from each other: then d is no longer orthogonal to a, and the direction is off by 2^-24 of their ratio.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                scene    near  antipodal  right_angle         edge
//   stable                      0 1e-7  0 4e-8     0 1e-7       0 1e-7       0 2e-4
//   stable_hill                 0 3e-7  0 1e-7     0 1e-7       0 3e-7       0 2e-4
//   stable_atan2                0 6e-7  0 5e-7     0 6e-7       0 3e-7       0 2e-4
//   compensated                 0 6e-7  0 5e-7     0 6e-7       0 3e-7       0 6e-7
//   compensated_split           0 1e-6  0 5e-7     0 1e-1       0 3e-7  0.046% 7e-1
//   compensated_split_precise   0 6e-7  0 5e-7     0 8e-5       0 3e-7       0 5e-1

#include "common/edge_stable.glsl"
#include "common/error_free.glsl"

#ifdef CROSS
// a x b itself, in more than f32's precision.
vec3 edge_compensated(vec3 a, vec3 b)
{
    vec3 n = CROSS(a, b);
    float sine = max(length(n), 1.175494351e-38);
    return n * (atan(sine, dot(a, b)) / sine * 0.15915494309189535);
}
#endif

vec3 edge_integral(vec3 a, vec3 b)
{
    return EDGE(a, b);
}
