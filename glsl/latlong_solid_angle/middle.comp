/*---
summary = "cos(middle latitude) x height x width: the weight that image-based lighting code gives a pixel"
source  = "The midpoint rule, as renderers use it"

[[variant]]
name = "middle"

[[variant]]
name = "upper"
summary = "cos(lat0) for the middle latitude: weights by the pixel's first row, as loops over rows do"
defines = { UPPER = 1 }
---*/

// Domain: small pixels. The midpoint rule is too large by height^2/24: 0.1 % at 0.15 rad, a row of 20; UPPER is off by half a
// height over the distance from the pole, and gives the whole first row nothing.
// Source: common code.
// Bound: as stated, and the error of cos, beside a pole over the distance from it.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   image           fine      rectangle           pole           edge
//   middle       0 4.0e-4       0 4.1e-2  15.9 % 5.7e-1  11.6 % 3.8e+0    50 % 3.8e+0
//   upper   72.6 % 1.0e+0  14.3 % 1.0e+0  39.6 % 1.0e+0  73.9 % 3.8e+0  53.2 % 3.8e+0

float latlong_solid_angle(float lat0, float lat1, float lon0, float lon1)
{
#ifdef UPPER
    float latitude = lat0;
#else
    float latitude = 0.5 * (lat0 + lat1);
#endif
    return abs(cos(latitude) * (lat1 - lat0) * (lon1 - lon0));
}
