/*---
summary = "The cross product of a with b - a or b + a, which does not cancel, and the sine from it"
source  = "ours, from a x b = a x (b - a) = a x (b + a)"
tried   = "a x b from exact partial products (stable_split) is no better until the rounding of the inputs decides"

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
name = "stable_split"
summary = "The cross product from exact partial products and atan for the angle"
defines = { EDGE = "edge_partial_products" }
---*/

// The forms of glsl/common/edge_stable.glsl: a x b is taken as a x d, with d the shorter of b - a and b + a, and the
// sine of the angle from it. For a.b < 0 the factor theta/(2 pi sin theta) is 1/(2 sin) - fit(|a.b|).
//
// Domain: vectors within 1e-6 of unit length, any angle; parallel and opposite ones give 0.
// Bound: 8e-9 of the fit and roundings of a few 2^-24 of the result, until pi - theta is as small as the deviation of
// the lengths from each other: then d is no longer orthogonal to a, and the direction is off by 2^-24 of their ratio.
// Measured: -

#include "common/edge_stable.glsl"
#include "common/error_free.glsl"

// stable_atan2 with the cross product of cross_split.
vec3 edge_partial_products(vec3 a, vec3 b)
{
    vec3 n = cross_split(a, b);
    float sine = max(length(n), 1.175494351e-38);
    return n * (atan(sine, dot(a, b)) / sine * 0.15915494309189535);
}

vec3 edge_integral(vec3 a, vec3 b)
{
    return EDGE(a, b);
}
