/*---
summary = "Reduced by multiples of ln 2 in two parts, then a polynomial"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"

[[variant]]
name = "cephes_precise"
precise = true
---*/

// x - n ln 2 with a first part of 9 bits, whose products are exact (Cody and Waite).
// Bound: 1.5 ULP, and the subnormal results' own last bit.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                           domain            edge
//   cephes           0, 1.27, 0.33   0, 1.20, 0.33
//   cephes_precise   0, 0.98, 0.22   0, 0.94, 0.21

#include "common/cephes_exp2.glsl"

float builtin_exp(float x)
{
    x = clamp(x, -105.0, 89.0);
    float whole = roundEven(x * 1.44269504088896);
    float r = x - whole * 0.693359375;
    r = r + whole * 2.12194440e-4;
    float p = 1.9875691500e-4 * r + 1.3981999507e-3;
    p = p * r + 8.3334519073e-3;
    p = p * r + 4.1665795894e-2;
    p = p * r + 1.6666665459e-1;
    p = p * r + 5.0000001201e-1;
    return times_power(p * r * r + r + 1.0, whole);
}
