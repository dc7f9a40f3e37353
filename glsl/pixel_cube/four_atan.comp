/*---
summary = "Four-corner difference of atan(x y/sqrt(1 + x^2 + y^2)): cancels as the square of the resolution"
source  = "Ohrstrom's thesis, by way of AMD's cube map generator and Driscoll, Cubemap texel solid angle, 2012"

[[variant]]
name = "four_atan"

[[variant]]
name = "four_atan_arctangent"
summary = "The same with an arctangent of our own: what is left is the difference's, not the device's"
defines = { OURS = 1 }

[[variant]]
name = "as_printed"
summary = "The primitive printed with its absolute value, which is right in the first quadrant only: a control"
defines = { ABSOLUTE = 1 }
---*/

// The summed-area trick: A(x1, y1) - A(x0, y1) - A(x1, y0) + A(x0, y0).
//
// Domain: x0 <= x1, y0 <= y1, corners to 2^60. ABSOLUTE keeps the bars that equation 1 of the page on orthographic pixels
// puts round the primitive, and fails across an axis and in two of four quadrants. No guard is added.
// Source: as above; atan with one argument, as printed.
// Bound: four errors of an arctangent of up to 1, over 4/n^2: u n^2, u = 2^-24, with a perfect arctangent: 0.1 % at 128 pixels.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                              cube_map        decimal           fine         window           wide        edge
//   four_atan             35.7 % 6.0e+0  91.9 % 4.0e+1  99.7 % 3.4e+5  52.5 % 5.1e+5    91 % 2.0e+8  35.6 % inf
//   four_atan_arctangent  33.8 % 3.5e+0  91.2 % 2.3e+1  99.7 % 3.2e+5  51.4 % 4.9e+5  90.1 % 2.3e+8  35.5 % inf
//   as_printed            67.7 % 7.4e+0  95.8 % 4.0e+1  99.8 % 3.4e+5  85.1 % 4.3e+5  98.8 % 2.0e+8    55 % inf

#ifdef OURS
#include "common/arctangent.glsl"
#endif

float corner_area(float x, float y)
{
    float r = sqrt(1.0 + x * x + y * y);
#if defined(OURS)
    return arctangent(x * y, r);
#elif defined(ABSOLUTE)
    return abs(atan(x * y / r));
#else
    return atan(x * y, r);
#endif
}

float pixel_cube(float x0, float y0, float x1, float y1)
{
    return corner_area(x0, y0) + corner_area(x1, y1) - corner_area(x0, y1) - corner_area(x1, y0);
}
