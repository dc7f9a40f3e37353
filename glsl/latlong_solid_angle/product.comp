/*---
summary = "2 cos(m) sin(w) (lon1 - lon0) with m, w half the sum and half the difference of the latitudes: nothing cancels"
source  = "The sum-to-product identity"

[[variant]]
name = "product"

[[variant]]
name = "product_pole"
summary = "product with the distance from the pole in two parts of pi/2: right to the last bits in the first and last row too"
defines = { POLE = 1 }

[[variant]]
name = "product_polynomial"
summary = "product_pole with sines of our own, for devices whose sin is only as good as Vulkan promises"
defines = { POLE = 1, POLYNOMIAL = 1 }
---*/

// Where lat0 and lat1 are within a factor of two their difference is exact (Sterbenz), and so are, beside a pole, POLE's
// differences from the first part of pi/2.
//
// Domain: latitudes within the poles (rounded), longitudes any. The order of the ends does not count.
// Source: trigonometry; POLE: Cody & Waite's reduction.
// Bound: the relative error of sin, twice, and 4 roundings; without POLE also 2^-24 over the distance of m from the pole.
// POLYNOMIAL: 8 u, u = 2^-24.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                          image      fine  rectangle      pole      edge
//   product             0 2.5e-6  0 4.1e-2   0 2.9e-3  0 3.8e+0  0 3.8e+0
//   product_pole        0 1.9e-7  0 2.3e-7   0 2.9e-7  0 2.9e-7  0 3.2e-7
//   product_polynomial  0 1.9e-7  0 2.1e-7   0 2.9e-7  0 2.9e-7  0 3.2e-7

#ifdef POLYNOMIAL
// sin x for 0 <= x <= pi/2: x + x s p(s), s = x^2, p minimax of degree 4 for the relative error of the sine, 2.4e-11, so that
// only rounding is left: 2 u.
float latlong_sin(float x)
{
    float s = x * x;
    float p = -2.38883286e-8;
    p = p * s + 2.752535222e-6;
    p = p * s - 1.98408676e-4;
    p = p * s + 8.333331104e-3;
    p = p * s - 0.1666666663;
    return x + x * (s * p);
}
#else
#define latlong_sin sin
#endif

float latlong_solid_angle(float lat0, float lat1, float lon0, float lon1)
{
    float half_height = 0.5 * abs(lat1 - lat0);
#ifdef POLE
    // pi/2 = 1.57079637... - 4.37e-8. The middle itself would lose its last bit.
    float side = lat0 + lat1 < 0.0 ? -1.0 : 1.0;
    precise float below0 = 1.57079637050628662 - side * lat0;
    precise float below1 = 1.57079637050628662 - side * lat1;
    precise float from_pole = 0.5 * (below0 + below1) - 4.37113883e-8;
    float cosine = latlong_sin(abs(from_pole));
#else
    float cosine = abs(cos(0.5 * lat0 + 0.5 * lat1));
#endif
    return 2.0 * cosine * latlong_sin(half_height) * abs(lon1 - lon0);
}
