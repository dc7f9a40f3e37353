/*---
summary = "The primitive at four corners, nothing where a corner leaves the circle: cancels, and loses the boundary"
source  = "Solid Angle of an Orthogonally-Projected Surface Element, a web page after Driscoll and Ohrstrom"

[[variant]]
name = "as_printed"
summary = "The published code: six arctangents a corner, zero if any corner leaves the circle, never negative: a control"
defines = { AS_PRINTED = 1 }

[[variant]]
name = "primitive"

[[variant]]
name = "primitive_clipped"
summary = "The primitive with its height 0 outside the circle, which is the clipped area exactly: only the cancellation is left"
defines = { CLIPPED = 1 }

[[variant]]
name = "primitive_clipped_arctangent"
summary = "primitive_clipped with an arctangent of our own: what is left is the difference's, not the device's"
defines = { CLIPPED = 1, OURS = 1 }
---*/

// A(x, y) = y atan(x/z) + x atan(y/z) - atan(x y/z), z = sqrt(1 - x^2 - y^2); the published form has half the difference of
// two arctangents for the last. Beyond the circle the area over 0..x, 0..y is (pi/2)(x + y - 1), a quarter of the sphere's
// half less two zones', which is what the same formula gives for z = 0: CLIPPED needs no other case (ours).
//
// Domain: x0 <= x1, y0 <= y1; without CLIPPED all four corners inside the circle, else 0, also on half of the boundary's area.
// AS_PRINTED moves a zero coordinate to 1e-12 only where a corner lies on the circle, and divides by y elsewhere too.
// Source: as above, equation 2 and the code below it.
// Bound: four sums of angles up to 1 over the pixel's 4/n^2: u n^2, u = 2^-24: 0.1 % at 128 pixels.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                         image       boundary        decimal           fine         window        grazing        edge
//   as_printed                    47.6 % 1.1e+1   100 % 1.0e+0  99.1 % 3.9e+5  99.4 % 2.3e+6  38.4 % 2.2e+0  99.1 % 1.0e+0  51.9 % inf
//   primitive                     38.2 % 1.1e+1   100 % 1.0e+0    95 % 6.7e+1  99.2 % 7.2e+5  33.9 % 1.5e+0  98.7 % 1.7e+0  50.3 % inf
//   primitive_clipped             29.4 % 1.1e+1  38.1 % 2.8e+1  89.4 % 1.7e+2  98.6 % 7.2e+5     7.71 % inf  84.7 % 1.6e+2  27.2 % inf
//   primitive_clipped_arctangent  22.6 % 2.3e+0  21.2 % 5.8e+1  81.4 % 1.7e+2  98.3 % 4.4e+4     3.47 % inf  76.6 % 1.2e+2  26.9 % inf

#ifdef OURS
#include "common/arctangent.glsl"
#else
#define arctangent atan
#endif

#ifdef AS_PRINTED
bool corner_area(float x, float y, out float area)
{
    area = 0.0;
    float square = x * x + y * y;
    if (square > 1.0) {
        return false;
    }
    float secant = 1.0 / sqrt(1.0 - square);
    if (isinf(secant)) {
        x = x == 0.0 ? 1e-12 : x;
        y = y == 0.0 ? 1e-12 : y;
    }
    area = y * atan(x * secant) + x * atan(y * secant)
        + 0.5 * (atan((1.0 - x - y * y) * secant / y) - atan((1.0 + x - y * y) * secant / y));
    return true;
}
#else
bool corner_area(float x, float y, out float area)
{
#ifdef CLIPPED
    x = clamp(x, -1.0, 1.0);
    y = clamp(y, -1.0, 1.0);
#endif
    float square = 1.0 - x * x - y * y;
    bool inside = square >= 0.0;
    float z = sqrt(max(square, 0.0));
    area = y * arctangent(x, z) + x * arctangent(y, z) - arctangent(x * y, z);
#ifdef CLIPPED
    inside = true;
#endif
    return inside;
}
#endif

float pixel_ortho(float x0, float y0, float x1, float y1)
{
    float a00;
    float a10;
    float a01;
    float a11;
    if (!corner_area(x0, y0, a00) || !corner_area(x1, y0, a10) || !corner_area(x0, y1, a01)
        || !corner_area(x1, y1, a11)) {
        return 0.0;
    }
    return max(0.0, a11 - a10 - a01 + a00);
}
