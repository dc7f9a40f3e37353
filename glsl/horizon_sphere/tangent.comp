/*---
summary = "Closed form with squared tangents: two roots fewer, result saturated"
source  = "a production engine's rearrangement of Lagarde & de Rousiers 2014"

[[variant]]
name = "sphere_tangent"

[[variant]]
name = "sphere_tangent_clamped"
summary = "sphere_tangent behind the clamps found in production: cosine to -1..1, squared sine at most 0.999"
defines = { CLAMPED = 1 }
---*/

// The closed form rearranged so that only tan^2 and cot^2 of the half angle occur:
//
//     y = sqrt(sin^2 theta tan^2 sigma - cos^2 theta),  E = (s (c acos x - y cot^2 sigma) + atan y)/pi
//     x = -c / sqrt(sin^2 theta tan^2 sigma)
//
// Domain: 0 < s < 1 where the horizon cuts: at s = 1 tan^2 is 1/0 and 0 inf follows; the clamp at 0.999 is there for
// it. The radicand is s - c^2 in disguise, and may round below zero at the rim.
// Source: a production engine, after Lagarde & de Rousiers, "Moving Frostbite to Physically Based Rendering", 2014.
// Bound: absolute, a few roundings of sin sigma, as for the form it comes from, and with the same exception.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                               scene      grazing   horizon   small  near_full     edge
//   sphere_tangent             0 5e-5       0 8e-6  12x 2e-1  0 7e-8     0 6e-5  22% 1e0
//   sphere_tangent_clamped   95x 2e-2  0.011% 2e-2  16x 2e-1  0 7e-8   49% 2e-2  26% 1e0

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
#ifdef CLAMPED
    cos_theta = clamp(cos_theta, -1.0, 1.0);
    sin2_half_angle = min(sin2_half_angle, 0.999);
#endif
    float cos2 = cos_theta * cos_theta;
    if (cos2 > sin2_half_angle) {
        return clamp(sin2_half_angle * cos_theta, 0.0, 1.0);
    }
    float cot2_sigma = 1.0 / sin2_half_angle - 1.0;
    float tan2_sigma = 1.0 / cot2_sigma;
    float scaled = (1.0 - cos2) * tan2_sigma;
    float x = -cos_theta * inversesqrt(scaled);
    float y = sqrt(scaled - cos2);
    float azimuth = cos_theta * acos(x) - y * cot2_sigma;
    return clamp(HORIZON_INV_PI * (azimuth * sin2_half_angle + atan(y)), 0.0, 1.0);
}
