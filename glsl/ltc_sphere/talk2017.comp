/*---
summary = "The disk that covers the same directions (asin, tan), then the published pipeline"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course; Heitz 2016 for the disk"
[[variant]]
name = "talk2017"
tables = { sphere_lut = "image" }
[[variant]]
name = "talk2017_discriminant"
summary = "The published pipeline with the cubic's discriminant clamped to >= 0"
tables = { sphere_lut = "image" }
defines = { CLAMP_DISCRIMINANT = 1 }
[[variant]]
name = "talk2017_scaled"
summary = "Shortcut at 7e-4, cubic for e/b, discriminant and form factor >= 0, third axis normalised (a content suite)"
tables = { sphere_lut = "image" }
defines = { SHORTCUT = "7e-4", OVER_B = 1, CLAMP_DISCRIMINANT = 1, CLAMP_FORM_FACTOR = 1, NORMALIZE_THIRD = 1 }
[[variant]]
name = "talk2017_rational"
summary = "The published pipeline without clipping, by a rational fit"
defines = { HORIZON = 2 }
[[variant]]
name = "facing_disk"
summary = "A disk of the sphere's own radius through its centre, as engines take it, then the published pipeline"
tables = { sphere_lut = "image" }
defines = { OWN_RADIUS = 1 }
---*/

// Domain: the point outside. A sphere's disk faces the point before Minv, and after any Minv that is a multiple of a
// rotation: the cubic's double root. OWN_RADIUS is right far away only: the light is (r/d)^2 too small.
// Source: the talk, and Heitz, "Analytical calculation of the solid angle subtended by an arbitrarily positioned
// ellipsoid", 2016.
// Bound: none; cos(asin(r/d)) loses half its digits at the surface.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                ggx   diffuse    grazing          far  near_surface   horizon      edge
//   talk2017                 36% n6x  41% 2e-2  1.4% 2e-2   4.9% n4.9%       99% n7x   26% n1x  54% n47%
//   talk2017_discriminant    36% n6x  16% 5e-4  1.4% 2e-2   4.8% n4.8%       99% n7x   20% n1x  50% n47%
//   talk2017_scaled         36% 5e-2  16% 5e-4  1.4% 2e-2  0.012% 1e-2      99% 3e-2  20% 3e-2   24% 1e0
//   talk2017_rational       64% 5e-1  73% 1e-1   16% 1e-1   0.28% 3e-2       99% 1e0  51% 6e-1   34% 1e0
//   facing_disk              64% n8x  77% 4e-1   16% 7e-1   5.1% n4.9%       99% n5x   42% 1e0  61% n35%

#include "common/disk_talk2017.glsl"
#include "common/sphere_disk.glsl"

float ltc_sphere(mat3 minv, vec3 center, float radius)
{
    vec3 C = center;
    vec3 v1;
    vec3 v2;
#ifdef OWN_RADIUS
    sphere_basis(normalize(C), v1, v2);
    v1 *= radius;
    v2 *= radius;
#else
    sphere_disk_2016(C, radius, v1, v2);
#endif
    return disk_talk2017(minv * C, minv * v1, minv * v2);
}
