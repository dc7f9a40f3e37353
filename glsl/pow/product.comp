/*---
summary = "x^y by squarings for whole y up to 1023, the device's own for others"
source  = "ours"

[[variant]]
name = "squarings"
---*/

// Repeated squaring: one rounding a factor.
// Bound: relative 2 y 2^-24 where y is whole; that of the device's pow where it is not.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                       strata             edge
//   squarings   0, 1.2e4, 0.95   0, 6.2e9, 0.97

float builtin_pow(float x, float y)
{
    float whole = abs(y);
    if (whole != floor(whole) || whole > 1023.0) {
        return pow(x, y);
    }
    uint exponent = uint(whole);
    float power = 1.0;
    for (int i = 0; i < 10; ++i) {
        power = (exponent & 1u) != 0u ? power * x : power;
        exponent >>= 1;
        x *= exponent != 0u ? x : 1.0;
    }
    return y < 0.0 ? 1.0 / power : power;
}
