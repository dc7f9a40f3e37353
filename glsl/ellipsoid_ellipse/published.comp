/*---
summary = "M = R D R^T, half angle by asin, and the ellipse's axes by the textbook eigensystem"
source  = "Heitz, Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid, 2016"

[[variant]]
name = "rdrt_naive"
defines = { SEMI_AXES = 1 }

[[variant]]
name = "rdrt_sqrtq"
summary = "M = R D R^T, half angle by asin, axes by sqrt(Q) in order"
defines = { SEMI_AXES = 2 }

[[variant]]
name = "rdrt_cross"
summary = "M = R D R^T, half angle by asin, the minor axis through the area"

[[variant]]
name = "rd_naive"
summary = "M = R D (two matrix products and the inverse fewer), share 1 - 1/|P|^2, textbook eigensystem"
defines = { MAP = 1, SQUARE = 1, SEMI_AXES = 1 }

[[variant]]
name = "rd_cross"
summary = "M = R D (two matrix products and the inverse fewer), share 1 - 1/|P|^2, the minor axis through the area"
defines = { MAP = 1, SQUARE = 1 }

[[variant]]
name = "as_printed"
summary = "The listing's M = R^T D R^T: a control that must fail wherever the ellipsoid is turned"
defines = { MAP = 2 }
---*/

// Domain: the point outside, semi-axes not 0. No guard is added; the family's answer from inside, all zero, is not given.
// Source: as above, equations 1 to 13; its listing transposes R on the left too (as_printed).
// Bound: rounding of D^-1 R^T C: u aspect; 1 - 1/|P|^2 and asin lose u over the height off the surface; the minor axis as the
// eigensystem's (glsl/common/semi_axes.glsl).
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                         scene         sphere            flat              far   near_surface        edge
//   rdrt_naive    15.1 % 5.4e-1       97 % inf   8.75 % 1.4e-1      0.353 % inf     69.7 % inf  51.3 % inf
//   rdrt_sqrtq    15.2 % 5.4e-1     97.4 % inf   8.55 % 1.4e-1   0.398 % 7.0e-1     69.7 % inf  51.3 % inf
//   rdrt_cross    14.8 % 2.8e-2  19.4 % 1.4e+0   8.28 % 1.4e-1       74x 1.4e-1  69.6 % 8.1e-2  36.8 % inf
//   rd_naive        0.667 % inf     97.1 % inf  0.509 % 5.2e-2      0.656 % inf    0.683 % inf  50.7 % inf
//   rd_cross    0.0117 % 2.8e-1  3.47 % 1.4e+0      55x 5.2e-2  0.0131 % 6.1e-2  0.01 % 1.2e+0  33.1 % inf
//   as_printed     100 % 1.1e+1  56.9 % 1.4e+0    100 % 6.6e+2     100 % 3.7e+0   100 % 7.0e+2  65.9 % inf

#include "common/ellipsoid_ellipse_2016.glsl"
#include "common/semi_axes.glsl"

EllipsoidEllipse ellipsoid_ellipse(vec3 center, vec4 rotation, vec3 radius)
{
    EllipsoidEllipse ellipse;
    vec3 v1;
    vec3 v2;
    ellipsoid_ellipse_2016(center, rotation, radius, v1, v2);
    ellipse.center = center;
    semi_axes(v1, v2, ellipse.major, ellipse.minor);
    return ellipse;
}
