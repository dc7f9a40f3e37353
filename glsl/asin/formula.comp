/*---
summary = "asin from atan of two arguments, the formula from which the specification takes its limit"
source  = "The Vulkan specification, precision of GLSL.std.450 instructions"

[[variant]]
name = "atan2"

[[variant]]
name = "atan2_factored"
summary = "The same with (1 - x)(1 + x), which does not cancel: x^2 rounded is off by half a unit of 1 - x^2's"
defines = { FACTORED = 1 }
---*/

// The sine from 1 - x^2.
// Bound: the device's atan, and near 1 the rounding of x^2 against 1 - x^2; none with FACTORED.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                          domain           edge
//   atan2            0, 347, 0.08   0, 347, 0.08
//   atan2_factored   0, 347, 0.08   0, 347, 0.08

float builtin_asin(float x)
{
#ifdef FACTORED
    float sine = sqrt((1.0 - x) * (1.0 + x));
#else
    float sine = sqrt(1.0 - x * x);
#endif
    return atan(x, sine);
}
