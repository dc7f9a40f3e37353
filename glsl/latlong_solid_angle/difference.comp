/*---
summary = "(sin lat1 - sin lat0)(lon1 - lon0): the difference of sines cancels for thin rectangles and towards the poles"
source  = "Bourke, Solid angle of a pixel, 2017 (test case)"

[[variant]]
name = "difference"

[[variant]]
name = "difference_unsigned"
summary = "The same made positive, so that the order of the ends does not count"
defines = { UNSIGNED = 1 }
---*/

// Domain: lat0 <= lat1 and lon0 <= lon1, as published; UNSIGNED: any order. No guard is added.
// Source: Bourke, "Solid angle of a pixel", 2017.
// Bound: the error of two sines over their difference: 2^-24 over the height in radians at the equator, over its square at
// a pole. Vulkan promises 2^-11 absolute of sin, which is all of a pixel.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                 image           fine       rectangle           pole           edge
//   difference           0.242 % 2.7e-2  47.1 % 4.0e+1  0.676 % 5.6e+1  68.1 % 1.0e+3  21.8 % 2.2e+0
//   difference_unsigned  0.242 % 2.7e-2  47.1 % 4.0e+1  0.676 % 5.6e+1  48.7 % 1.0e+3  1.43 % 1.0e+0

float latlong_solid_angle(float lat0, float lat1, float lon0, float lon1)
{
    float area = (sin(lat1) - sin(lat0)) * (lon1 - lon0);
#ifdef UNSIGNED
    area = abs(area);
#endif
    return area;
}
