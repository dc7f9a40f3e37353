/*---
summary = "Polynomial of degree 2 in the cosine and 4 in the squared sine, saturated"
source  = "a production engine's fit of the clipped sphere"

[[variant]]
name = "polynomial"

[[variant]]
name = "polynomial_faded"
summary = "polynomial times a smoothstep that ends it where the sphere sets: the fix for its light below the horizon"
defines = { FADED = 1 }
---*/

// x (y + e) (1/2 + (y - e) (a + b x + c x^2 + d x^3)), fitted in the mean over the square.
//
// Domain: all. Light leaks below the horizon: the fit is positive for y > -e or so whatever the size, which FADED
// mends by smoothstep(-s, 0, c |c|).
// Source: a production engine's fit, mean absolute error stated as 0.0048, 0.0033 once saturated; the fade likewise.
// Bound: 0.066 absolute, 0.10 with FADED, both as s -> 1.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                         scene   grazing   horizon   small  near_full      edge
//   polynomial         24% 6e-2  23% 7e-2  14% 3e-2  0 1e-5   82% 7e-2  42% 7e-2
//   polynomial_faded   24% 1e-1  23% 7e-2  13% 4e-2  0 1e-5   82% 1e-1  39% 1e-1

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    float x = sin2_half_angle;
    float y = cos_theta;
    const float e = 0.9245867471551246;
    float in_x = 0.5359050373687144 + x * (-1.0054221851257754 + x * (1.8199061187417047 - x * 1.3172081704209504));
    float fit = clamp(x * (y + e) * (0.5 + (y - e) * in_x), 0.0, 1.0);
#ifdef FADED
    fit *= smoothstep(-x, 0.0, y * abs(y));
#endif
    return fit;
}
