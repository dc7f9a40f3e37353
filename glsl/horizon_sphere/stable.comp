/*---
summary = "Closed form regrouped so that nothing cancels, by one polynomial and its divided differences: no trigonometry"
source  = "ours, from Snyder 1996"

[[variant]]
name = "stable"
---*/

// The irradiance as the whole sphere's plus what lies beyond the horizon, a product of non-negative factors.
//
// Domain: all; both inputs beyond their ends count as the ends.
// Source: ours; horizon_stable states the form.
// Bound: relative, not only absolute: 256 u, u = 2^-24, wherever the result is a normal number, below the horizon and at
// the rim too.
// Measured: failed, and worst absolute error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   scene        grazing        horizon          small      near_full           edge
//   stable       0 1.3e-7       0 1.3e-7       0 6.6e-8      0 3.6e-12       0 1.5e-7       0 1.4e-7

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_stable(cos_theta, sin2_half_angle);
}
