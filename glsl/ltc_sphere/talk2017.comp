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
// Measured (lavapipe, Mesa 22.3, 1 M a scenario): failed 42 % of ggx, 41 % of diffuse, 5.1 % of far, 98 % of near_surface, 24 % of
// horizon; with the discriminant clamped 16 % of diffuse (the table's own error) and 5.1 % of far still; with all of the
// content suite's fixes 16 % and 3 in a million. facing_disk: 55 % of ggx, 77 % of diffuse.

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
