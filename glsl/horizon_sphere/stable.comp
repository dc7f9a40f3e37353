/*---
summary = "Closed form regrouped so that nothing cancels, by a polynomial and its divided differences: no trigonometry"
source  = "ours, from Snyder 1996"

[[variant]]
name = "stable"
---*/

// The irradiance as the whole sphere's plus what lies beyond the horizon, a product of non-negative factors.
//
// Domain: all; both inputs beyond their ends count as the ends.
// Source: ours; horizon_stable states the form.
// Bound: relative, not only absolute: 256 u, u = 2^-24, wherever the result is a normal number, below the horizon and
// at the rim too.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//             scene  grazing  horizon    small  near_full    edge
//   stable   0 1e-7   0 1e-7   0 7e-8  0 4e-12     0 1e-7  0 1e-7

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_stable(cos_theta, sin2_half_angle);
}
