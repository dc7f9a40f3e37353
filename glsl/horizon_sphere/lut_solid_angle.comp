/*---
summary = "64 x 64 table as lut's, its rows spaced evenly in solid angle: one root more, a fifteenth of the worst error"
source  = "ours, after Heitz & Hill 2017"
tried   = "rows by the half angle, or by (1 + sin sigma - cos sigma)/2: the same worst error, a larger mean"

[[variant]]
name = "lut_solid_angle"
tables = { sphere_lut_solid_angle = "buffer" }

[[variant]]
name = "lut_solid_angle_sampler"
summary = "lut_solid_angle through a sampler: weights as the hardware quantises them"
tables = { sphere_lut_solid_angle = "image" }
---*/

// The horizon by a table whose second coordinate is 1 - cos sigma, the solid angle over the hemisphere's.
//
// Domain: all; beyond its ends the table is clamped.
// Source: ours; the table's first coordinate and its content as in Heitz & Hill, "Real-Time Line- and Disk-Light
// Shading with Linearly Transformed Cosines", 2017.
// Bound: 1.4e-3 absolute, where the largest spheres are straight above or below; 2e-4 for centres near the horizon.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                scene  grazing   horizon   small   near_full    edge
//   lut_solid_angle           15x 1e-3   0 6e-5  59x 1e-3  0 6e-7  0.71% 1e-3  0 7e-4
//   lut_solid_angle_sampler   15x 1e-3   0 6e-5  59x 1e-3  0 6e-7  0.71% 1e-3  0 7e-4

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_lut_solid_angle(cos_theta, sin2_half_angle);
}
