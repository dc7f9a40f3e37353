/*---
summary = "Semi-axes, cone, half angles' tangents, and their integral over the azimuth by 8 equal steps a quarter"
source  = "The integral itself; cone and axes ours"

[[variant]]
name = "trapezoid8"
defines = { POINTS = 8 }

[[variant]]
name = "trapezoid16"
summary = "trapezoid8 with 16 steps"
defines = { POINTS = 16 }

[[variant]]
name = "trapezoid32"
summary = "trapezoid8 with 32 steps"
defines = { POINTS = 32 }

[[variant]]
name = "carlson"
summary = "The same tangents, (4/3) a b R_J(0, 1 + a^2, 1 + b^2, 1) by Carlson's duplication"
defines = { METHOD = 1 }

[[variant]]
name = "third_kind"
summary = "The same tangents, 2 pi less a complete elliptic integral of the third kind, the form of Paxton 1959 and Conway 2010"
defines = { METHOD = 2 }

[[variant]]
name = "equal_sphere"
summary = "The sphere of the same irradiance across the axis: exact for circles"
defines = { METHOD = 3 }

[[variant]]
name = "naive_trapezoid16"
summary = "trapezoid16 with the textbook's eigensystem for the semi-axes"
defines = { POINTS = 16, SEMI_AXES = 1 }
---*/

// Domain: any ellipse, scaled exactly by a power of two first; in its own plane 2 pi from inside, 0 from outside.
// Source: as named; each integral in glsl/common/cone_solid_angle.glsl.
// Bound: the trapezoid converges geometrically, POINTS times minor over major tangent deciding how far: a needle between two
// azimuths is missed, one on an azimuth counted in full. third_kind is off by 2^-22 absolutely, which leaves nothing of a light 1000 radii away.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                              scene         facing              far     near_plane         needle         edge
//   trapezoid8         29.3 % 1.1e+5       0 1.2e-6      38 % 5.6e+4  48.9 % 9.5e+3  83.2 % 9.6e+7   22.6 % inf
//   trapezoid16        13.8 % 5.4e+4       0 1.2e-6    17.9 % 2.8e+4  46.6 % 4.7e+3  76.7 % 4.8e+7   15.8 % inf
//   trapezoid32        6.81 % 2.7e+4       0 1.4e-6    8.89 % 1.4e+4    43 % 2.4e+3  69.8 % 2.4e+7   11.5 % inf
//   carlson                 0 3.9e-2       0 1.8e-5         0 9.4e-3      2x 1.9e-2       0 1.2e+0  0.452 % inf
//   third_kind         14.4 % 1.7e+3  4.62 % 6.8e-2    85.2 % 1.3e+8   6.4 % 1.0e+0  19.9 % 1.2e+4   27.6 % inf
//   equal_sphere       51.9 % 2.1e-1       0 4.5e-6  0.0303 % 9.4e-3  59.8 % 2.2e-1  91.1 % 7.6e-1   36.8 % inf
//   naive_trapezoid16  14.1 % 5.4e+4   100 % 3.1e+5    18.2 % 2.8e+4  46.6 % 7.6e+5  76.7 % 4.8e+7     40 % inf

#include "common/cone_solid_angle.glsl"
#include "common/ellipse_tangents.glsl"
#include "common/power_of_two.glsl"

float ellipse_solid_angle(vec3 center, vec3 v1, vec3 v2)
{
    float scale = scale_to_one(largest_component(max(abs(center), max(abs(v1), abs(v2)))));
    vec2 tangents = ellipse_tangents(center * scale, v1 * scale, v2 * scale);
    if (tangents.x >= CONE_LARGEST) {
        return CONE_TAU;
    }
    return cone_by_tangents(tangents.x, tangents.y);
}
