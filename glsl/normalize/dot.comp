/*---
summary = "v inversesqrt(dot(v, v))"
source  = "The Vulkan specification, precision of GLSL.std.450 instructions"

[[variant]]
name = "inverse"

[[variant]]
name = "over_length"
summary = "v / sqrt(dot(v, v)): exact root and quotient where the device has them"
defines = { OVER_LENGTH = 1 }

[[variant]]
name = "over_length_scaled"
summary = "The same, brought to the range of 1 first, so that no square leaves the range"
defines = { SCALED = 1, OVER_LENGTH = 1 }
---*/

// The formula from which the specification takes its limit, and two that are better.
// Bound: 2 ULP and those of inversesqrt, or 2 with exact root and quotient, while the squares are normal numbers.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                               strata            edge
//   inverse              0, 2.67, 0.65   0, 2.67, 0.72
//   over_length          0, 2.48, 0.64   0, 2.65, 0.65
//   over_length_scaled   0, 2.48, 0.64   0, 2.65, 0.65

#include "common/power_of_two.glsl"

vec3 builtin_normalize(vec3 v)
{
#ifdef SCALED
    v *= scale_to_one(largest_component(v));
#endif
#ifdef OVER_LENGTH
    return v / sqrt(dot(v, v));
#else
    return v * inversesqrt(dot(v, v));
#endif
}
