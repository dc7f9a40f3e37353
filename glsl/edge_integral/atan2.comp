/*---
summary = "Angle by atan(|a x b|, a.b)"
source  = "Textbook form of the angle between two vectors"

[[variant]]
name = "atan2"
defines = { EDGE = "edge_atan2" }

[[variant]]
name = "atan2_precise"
defines = { EDGE = "edge_atan2" }
precise = true

[[variant]]
name = "atan2_guarded"
summary = "The sine kept above FLT_MIN"
defines = { EDGE = "edge_atan2_guarded" }

[[variant]]
name = "atan2_split"
summary = "atan2_guarded, with nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_atan2_guarded", SPLIT = 1 }
---*/

// theta = atan(|a x b|, a.b), edge = theta/(2 pi) times the normalised cross product.
//
// Domain: unit vectors; as written neither parallel nor opposite (0/0).
// Bound: atan's own error over 2 pi, and half the angle by which a x b turns: 2^-23/sin(theta), 1e-4 within 1e-3 of pi.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                    scene    near       antipodal  right_angle         edge
//   atan2           0 2e-6  0 5e-7          0 2e-1       0 3e-7     45% n45%
//   atan2_guarded   0 2e-6  0 5e-7          0 2e-1       0 3e-7  0.067% 7e-1
//   atan2_split     0 1e-5  0 5e-7  0.015% n0.013%       0 3e-7     14% n14%

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
