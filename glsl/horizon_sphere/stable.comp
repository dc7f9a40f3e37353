/*---
summary = "Closed form regrouped so that nothing cancels, by one polynomial: no trigonometric function, no table"
source  = "ours, from Snyder 1996"

[[variant]]
name = "stable"
---*/

// The irradiance as the whole sphere's plus what lies beyond the horizon, a product of non-negative factors.
//
// Domain: all; both inputs beyond their ends count as the ends.
// Source: ours; horizon_stable states the form.
// Bound: 16 u relative, u = 2^-24, where c >= 0; below the horizon 16 u/(1 - |c|), plus the rounding of 1 - s for the
// largest spheres.
// Measured: -

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_stable(cos_theta, sin2_half_angle);
}
