/*---
summary = "64 x 64 table of the clipped sphere's irradiance over its form factor, bilinear in the shader"
source  = "Heitz & Hill 2017 (indexing); table computed anew from the closed form"

[[variant]]
name = "lut"
tables = { sphere_lut = "buffer" }

[[variant]]
name = "lut_sampler"
summary = "64 x 64 table of the clipped sphere's irradiance over its form factor, through a sampler: weights as the hardware quantises them"
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
// Bound: the bilinear interpolation's own; worst where the horizon just cuts a small sphere, whose transition is
// narrower than a texel. NO_HALF_TEXEL, as ports without the scale and bias have it, shifts by up to half a texel.
// Measured: -

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
#ifdef NO_HALF_TEXEL
    return sin2_half_angle * textureLod(sphere_lut, vec2(0.5 * cos_theta + 0.5, sin2_half_angle), 0.0).x;
#else
    return horizon_lut(cos_theta, sin2_half_angle);
#endif
}
