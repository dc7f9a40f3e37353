/*---
summary = "Angle by acos of the dot product, over its sine"
source  = "Heitz et al., Real-Time Polygonal-Light Shading with Linearly Transformed Cosines, 2016, and public ports of its sample code"

[[variant]]
name = "acos"
defines = { EDGE = "edge_acos" }

[[variant]]
name = "acos_precise"
defines = { EDGE = "edge_acos" }
precise = true

[[variant]]
name = "acos_clamped"
summary = "The dot product clamped to +-0.9999, as in the authors' first sample code"
defines = { EDGE = "edge_acos_clamped" }

[[variant]]
name = "acos_saturated"
summary = "The dot product clamped to +-1"
defines = { EDGE = "edge_acos_saturated" }

[[variant]]
name = "acos_small_angle"
summary = "The dot product clamped to +-1, and theta/sin(theta) = 1 below 0.001"
defines = { EDGE = "edge_acos_small_angle" }

[[variant]]
name = "acos_split"
summary = "acos_small_angle, with nearly opposite vectors split at the chord's closest point"
defines = { EDGE = "edge_acos_small_angle", SPLIT = 1 }

[[variant]]
name = "acos_normalized"
summary = "The cross product normalised, times acos: rings around lights"
defines = { EDGE = "edge_acos_normalized" }

[[variant]]
name = "acos_normalized_saturated"
summary = "The cross product normalised, times acos of the dot product clamped to +-1"
defines = { EDGE = "edge_acos_normalized_saturated" }
---*/

// theta = acos(a.b), edge = theta/(2 pi sin theta) a x b, in the forms of glsl/common/edge_acos.glsl.
//
// Domain: unit vectors, neither parallel nor opposite.
// Bound: theta is off by 2^-24/sin(theta), so theta/sin(theta) by 2^-24/sin(theta)^2: 1e-4 of the result is lost below
// theta = 0.02 (where the cross product makes it small), and within 0.02 of pi (where nothing does).
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                    scene          near     antipodal  right_angle       edge
//   acos                        0.59% n51x      42% n42%    81% n0.93%       0 9e-6   35% n32%
//   acos_clamped                0.59% 5e-1        0 2e-6      79% 5e-1       0 9e-6  3.3% 5e-1
//   acos_saturated              0.59% n51x      42% n42%       81% 3e3       0 9e-6   30% n24%
//   acos_small_angle            0.59% 2e-2        0 2e-6       81% 3e3       0 9e-6   5.6% 1e3
//   acos_split                  0.58% 1e-3        0 2e-6   17% n0.013%       0 9e-6   15% n14%
//   acos_normalized                 3x n3x  0.91% n0.91%  0.93% n0.93%       0 8e-6   61% n58%
//   acos_normalized_saturated       0 7e-5        0 8e-5        0 2e-1       0 8e-6   48% n45%

#include "common/edge_any.glsl"

vec3 edge_integral(vec3 a, vec3 b)
{
    return edge_any(a, b);
}
