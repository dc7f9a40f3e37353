/*---
summary = "exp2(y log2(x))"
source  = "The Vulkan specification, precision of GLSL.std.450 instructions"

[[variant]]
name = "exp2_log2"
---*/

// The formula from which the specification takes its limit. An error of log2 grows by y.
// Bound: relative y times that of log2.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                       strata             edge
//   exp2_log2   0, 1.2e4, 0.95   0, 6.2e9, 0.97

float builtin_pow(float x, float y)
{
    return exp2(y * log2(x));
}
