/*---
summary = "The exponent's bits from the number itself, the fraction by one quotient"
source  = "P. Mineiro, fastapprox, 2011"

[[variant]]
name = "mineiro"

[[variant]]
name = "mineiro_faster"
summary = "No correction of the fraction at all"
defines = { FASTER = 1 }
---*/

// 2^23 (x + 127) as an integer is 2^x where x is whole; between, the bits go straight. Below -126 it is 2^-126.
// Bound: relative 2e-5 to 6e-5; 3e-2 without the correction.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                 domain                   edge
//   mineiro             75.8 %, 810, 219   49.2 %, 1.7e7, 6.2e4
//   mineiro_faster   100 %, 4.8e5, 1.6e5   71.9 %, 1.7e7, 1.6e5

float builtin_exp2(float x)
{
    float clipped = max(x, -126.0);
#ifdef FASTER
    return uintBitsToFloat(uint(8388608.0 * (clipped + 126.94269504)));
#else
    float fraction = clipped - float(int(clipped)) + (x < 0.0 ? 1.0 : 0.0);
    float corrected = clipped + 121.2740575 + 27.7280233 / (4.84252568 - fraction) - 1.49012907 * fraction;
    return uintBitsToFloat(uint(8388608.0 * corrected));
#endif
}
