/*---
summary = "64 x 64 table of the clipped sphere's irradiance over its form factor, bilinear in the shader"
source  = "Heitz & Hill 2017 (indexing); table computed anew from the closed form"

[[variant]]
name = "lut"
tables = { sphere_lut = "buffer" }

[[variant]]
name = "lut_sampler"
summary = "lut through a sampler: weights as the hardware quantises them"
tables = { sphere_lut = "image" }

[[variant]]
name = "lut_sampler_edge"
summary = "lut_sampler without the half-texel scale and bias: the coordinates in 0..1 go straight to the sampler"
tables = { sphere_lut = "image" }
defines = { NO_HALF_TEXEL = 1 }
---*/

// The horizon by table lookup.
//
// Domain: all; beyond its ends the table is clamped. The irradiance of small spheres is right to the table's relative
// error, since the table holds the ratio to the form factor.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", 2017.
// Bound: 0.020 absolute, in the last row of texels: the irradiance has a root of 1 - s in it, which no table in s
// follows; below s = 0.98 it is 1.4e-3. NO_HALF_TEXEL, as ports without the scale and bias have it, shifts by up to
// half a texel.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                           scene     grazing      horizon   small  near_full        edge
//   lut                0.21% 2e-2  0.25% 2e-2  0.057% 8e-3  0 6e-7   37% 2e-2  0.21% 2e-2
//   lut_sampler        0.21% 2e-2  0.25% 2e-2  0.057% 8e-3  0 6e-7   37% 2e-2  0.21% 2e-2
//   lut_sampler_edge     10% 5e-2   3.5% 5e-2    6.7% 2e-2  0 2e-6   63% 5e-2    21% 5e-2

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
#ifdef NO_HALF_TEXEL
    return sin2_half_angle * textureLod(sphere_lut, vec2(0.5 * cos_theta + 0.5, sin2_half_angle), 0.0).x;
#else
    return horizon_lut(cos_theta, sin2_half_angle);
#endif
}
