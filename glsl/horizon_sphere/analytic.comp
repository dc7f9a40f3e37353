/*---
summary = "Closed form of the clipped sphere as published"
source  = "Lagarde & de Rousiers 2014"

[[variant]]
name = "sphere_analytic"

[[variant]]
name = "sphere_analytic_clamped"
summary = "sphere_analytic behind the clamps found in production: cosine to -1..1, squared sine at most 0.999"
defines = { CLAMPED = 1 }
---*/

// The closed form with a cotangent and three angles.
//
// Domain: 0 < s <= 1, |c| < 1 where the horizon cuts: at s = 0 the cotangent is 1/0, and s slightly above 1 takes the
// root of a negative number. The production form clamps both, and so loses what lies above 0.999.
// Source: Lagarde & de Rousiers, "Moving Frostbite to Physically Based Rendering", 2014.
// Bound: absolute, a few roundings of sin sigma: the terms are that large and cancel to its third power; none where s
// and |c| near 1 together, for then cotangent and sine both vanish.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                scene      grazing   horizon   small  near_full      edge
//   sphere_analytic             0 5e-5       0 8e-6  19x 3e-1  0 7e-8     0 6e-5  9.7% 1e0
//   sphere_analytic_clamped   95x 2e-2  0.011% 2e-2  23x 3e-1  0 7e-8   49% 2e-2   25% 1e0

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
#ifdef CLAMPED
    cos_theta = clamp(cos_theta, -1.0, 1.0);
    sin2_half_angle = min(sin2_half_angle, 0.999);
#endif
    return horizon_sphere_analytic(cos_theta, sin2_half_angle);
}
