/*---
summary = "dx dy (1 + x^2 + y^2)^(-3/2) at the pixel's middle: the weight that spherical-harmonics code gives a texel"
source  = "The midpoint rule; Sloan, Stupid Spherical Harmonics (SH) Tricks, 2008, weighs texels so"

[[variant]]
name = "midpoint"

[[variant]]
name = "gauss2"
summary = "The same at Gauss's four points: the square of the error for four roots"
defines = { GAUSS = 1 }
---*/

// Domain: pixels of side h, in any order, corners to 2^40; empty ones give 0.
// Source: quadrature.
// Bound: 4 roundings, and h^2/4 at the centre of the face (0.1 % at 32 pixels; a face's corner is better); GAUSS h^4/70 or so
// (0.1 % at 4 pixels).
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                  cube_map   decimal      fine         window           wide           edge
//   midpoint  11.1 % 1.4e-2  0 1.4e-6  0 4.7e-7  25.3 % 8.9e-1  36.5 % 1.1e+5     54.4 % inf
//   gauss2         0 6.0e-5  0 4.0e-7  0 3.7e-7  9.45 % 1.1e-1  19.3 % 2.9e+2  44.4 % 3.3e+0

float density(float x, float y)
{
    float s = inversesqrt(1.0 + x * x + y * y);
    return s * s * s;
}

float pixel_cube(float x0, float y0, float x1, float y1)
{
    float dx = x1 - x0;
    float dy = y1 - y0;
#ifdef GAUSS
    const float NEAR = 0.211324865405187118;
    const float FAR = 0.788675134594812882;
    vec2 x = x0 + dx * vec2(NEAR, FAR);
    vec2 y = y0 + dy * vec2(NEAR, FAR);
    float mean = 0.25 * (density(x.x, y.x) + density(x.y, y.x) + density(x.x, y.y) + density(x.y, y.y));
#else
    float mean = density(x0 + 0.5 * dx, y0 + 0.5 * dy);
#endif
    return abs(dx * dy) * mean;
}
