/*---
summary = "sqrt(dot(v, v))"
source  = "The Vulkan specification, precision of GLSL.std.450 instructions"

[[variant]]
name = "dot"

[[variant]]
name = "scaled"
summary = "Divided by the largest component first, so that no square leaves the range"
defines = { SCALED = 1 }
---*/

// The formula from which the specification takes its limit.
// Bound: 2 ULP with an exact root while the squares are normal numbers.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   strata            edge
//   dot      0, 1.39, 0.25   0, 1.42, 0.27
//   scaled   0, 1.39, 0.25   0, 1.42, 0.27

#include "common/power_of_two.glsl"

float builtin_length(vec3 v)
{
#ifdef SCALED
    float scale = scale_to_one(largest_component(v));
    v *= scale;
    return sqrt(dot(v, v)) * reciprocal_power_of_two(scale);
#else
    return sqrt(dot(v, v));
#endif
}
