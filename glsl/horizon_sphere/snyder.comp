/*---
summary = "Closed form by the four cases of the original report, angles by asin and acos"
source  = "Snyder 1996"

[[variant]]
name = "snyder"

[[variant]]
name = "snyder_saturated"
summary = "snyder with every radicand and arcsine argument saturated, and the result too, as found in production"
defines = { SATURATED = 1 }
---*/

// The closed form as first given. With omega the angle to the normal, sigma the half angle,
// gamma = asin(cos sigma/sin omega),
//
//     G = pi/2 - gamma + sin gamma cos gamma - 2 sin omega cos sigma cos gamma
//     H = cos omega (cos gamma sqrt(sin^2 sigma - cos^2 gamma) + sin^2 sigma asin(cos gamma/sin sigma))
//
// the whole sphere, the whole sphere + (G - H)/pi, (G + H)/pi, or nothing.
//
// Domain: 0 < s <= 1, |c| < 1 where the horizon cuts; there an arcsine's argument rounds beyond 1 at the rim, and
// sin^2 sigma - cos^2 gamma below 0, unless SATURATED. Which case holds is decided between angles, to a rounding.
// Source: Snyder, "Area Light Sources for Real-Time Graphics", Microsoft Research MSR-TR-96-11, 1996.
// Bound: absolute, a few roundings of sin sigma, plus a root of a rounding where gamma nears pi/2 (small spheres).
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                         scene   grazing     horizon       small  near_full      edge
//   snyder             80x n80x  34% n34%  1.3% n1.3%  2.2% n2.2%   49x n49x  25% n25%
//   snyder_saturated     0 1e-4    0 1e-4      0 1e-4      0 1e-6     0 1e-4  2.8% 1e0

#include "common/horizon_sphere.glsl"

#ifdef SATURATED
float saturated(float x) { return clamp(x, 0.0, 1.0); }
#else
float saturated(float x) { return x; }
#endif

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    float omega = acos(cos_theta);
    float sin_omega = sqrt(saturated(1.0 - cos_theta * cos_theta));
    float sin_sigma = sqrt(sin2_half_angle);
    float sigma = asin(sin_sigma);
    float cos_sigma = sqrt(saturated(1.0 - sin2_half_angle));
    float whole = cos_theta * sin2_half_angle;
    if (omega <= HORIZON_HALF_PI - sigma) {
        return whole;
    }
    if (omega >= HORIZON_HALF_PI + sigma) {
        return 0.0;
    }
    float sin_gamma = saturated(cos_sigma / sin_omega);
    float cos_gamma = sqrt(saturated(1.0 - sin_gamma * sin_gamma));
    float gamma = asin(sin_gamma);
    float g = HORIZON_HALF_PI - gamma + sin_gamma * cos_gamma - 2.0 * sin_omega * cos_sigma * cos_gamma;
    float root = sqrt(saturated(sin2_half_angle - cos_gamma * cos_gamma));
    float h = cos_theta * (cos_gamma * root + sin2_half_angle * asin(saturated(cos_gamma / sin_sigma)));
    float irradiance = omega < HORIZON_HALF_PI ? whole + HORIZON_INV_PI * (g - h) : HORIZON_INV_PI * (g + h);
    return saturated(irradiance);
}
