/*---
summary = "The paper's pipeline: M = R D R^T, asin, textbook eigensystem; the ellipse by 2 pi less an integral of the third kind"
source  = "Heitz, Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid, 2016, with the form of Conway 2010"

[[variant]]
name = "rdrt_third_kind"
defines = { SEMI_AXES = 1, METHOD = 2 }

[[variant]]
name = "rdrt_trapezoid16"
summary = "The paper's ellipse, textbook eigensystem, the ellipse by 16 steps a quarter"
defines = { SEMI_AXES = 1, POINTS = 16 }

[[variant]]
name = "rd_trapezoid16"
summary = "M = R D, share 1 - 1/|P|^2, the minor axis through the area, 16 steps a quarter"
defines = { MAP = 1, SQUARE = 1, POINTS = 16 }

[[variant]]
name = "rd_carlson"
summary = "M = R D, share 1 - 1/|P|^2, the minor axis through the area, R_J by Carlson's duplication"
defines = { MAP = 1, SQUARE = 1, METHOD = 1 }

[[variant]]
name = "rd_equal_sphere"
summary = "M = R D, share 1 - 1/|P|^2, the minor axis through the area, the sphere of the same irradiance"
defines = { MAP = 1, SQUARE = 1, METHOD = 3 }

[[variant]]
name = "as_printed"
summary = "The listing's M = R^T D R^T: a control that must fail wherever the ellipsoid is turned"
defines = { MAP = 2, POINTS = 16 }
---*/

// Domain: the point outside, semi-axes not 0; lengths within 2^-20..2^20 of 1. No guard is added: from inside NaN, not 4 pi.
// Source: as above; the cone between the ellipse and the integral is ours (glsl/common/cone_secular.glsl).
// Bound: as ellipsoid_ellipse and ellipse_solid_angle have it.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                             scene         sphere           flat             far   near_surface           edge
//   rdrt_third_kind         5 % inf     82.6 % inf  22.1 % 2.4e+1      75.9 % inf    0.395 % inf     51.4 % inf
//   rdrt_trapezoid16    0.634 % inf     82.1 % inf  39.1 % 2.8e+1    0.0385 % inf    0.395 % inf     38.2 % inf
//   rd_trapezoid16       25x 1.9e-2     32x 2.1e-2  32.6 % 2.8e+1      29x 2.4e-2      1x 1.3e-3  22.8 % 5.3e+2
//   rd_carlson           25x 1.9e-2     32x 2.1e-2     15x 1.2e-2      29x 2.4e-2      1x 1.3e-3  22.5 % 1.0e+1
//   rd_equal_sphere     42 % 5.5e-2     32x 2.1e-2  68.1 % 2.1e-1  0.141 % 2.4e-2  26.5 % 5.5e-2  49.9 % 1.0e+1
//   as_printed        98.2 % 3.9e+0  9.11 % 3.6e-2  99.8 % 1.8e+4   98.6 % 2.8e+0  99.8 % 1.3e+0       55 % inf

#include "common/cone_solid_angle.glsl"
#include "common/ellipsoid_ellipse_2016.glsl"
#include "common/ellipse_tangents.glsl"

float ellipsoid_solid_angle(vec3 center, vec4 rotation, vec3 radius)
{
    vec3 v1;
    vec3 v2;
    ellipsoid_ellipse_2016(center, rotation, radius, v1, v2);
    vec2 tangents = ellipse_tangents(center, v1, v2);
    return cone_by_tangents(tangents.x, tangents.y);
}
