/*---
summary = "sin(x) / cos(x)"
source  = "The Vulkan specification, precision of GLSL.std.450 instructions"

[[variant]]
name = "quotient"
---*/

// The formula from which the specification takes its limit.
// Bound: those of the device's sin and cos.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                       domain              edge
//   quotient   0, 2.96, 1.4e-4   0, 2.65, 1.4e-4

float builtin_tan(float x)
{
    return sin(x) / cos(x);
}
