/*---
summary = "The bits as a number are nearly the logarithm; the mantissa by one quotient"
source  = "P. Mineiro, fastapprox, 2011"

[[variant]]
name = "mineiro"

[[variant]]
name = "mineiro_faster"
summary = "No correction of the mantissa at all"
defines = { FASTER = 1 }
---*/

// Subnormals are not numbers to the bits.
// Bound: absolute 1.5e-4; 6e-2 without the correction.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                  domain                    edge
//   mineiro            90.6 %, 1.6e8, 421       56 %, 1.7e39, 418
//   mineiro_faster   100 %, 4.0e12, 1.6e5   83.7 %, 4.1e43, 1.6e5

float builtin_log2(float x)
{
    uint bits = floatBitsToUint(x);
    float scaled = float(bits) * 1.1920928955078125e-7;
#ifdef FASTER
    return scaled - 126.94269504;
#else
    float mantissa = uintBitsToFloat((bits & 0x007fffffu) | 0x3f000000u);
    return scaled - 124.22551499 - 1.498030302 * mantissa - 1.72587999 / (0.3520887068 + mantissa);
#endif
}
