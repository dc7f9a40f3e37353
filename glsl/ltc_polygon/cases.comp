/*---
summary = "Minv, then clipping by a table of 16 cases, normalising, edges"
source  = "Heitz et al., Real-Time Polygonal-Light Shading with Linearly Transformed Cosines, 2016; edges as in glsl/common/edge_*.glsl"

[[variant]]
name = "cases_acos_clamped"
summary = "Minv, clipping by 16 cases, normalising; edges by acos of the dot product within +-0.9999"
defines = { EDGE = "edge_acos_clamped" }

[[variant]]
name = "cases_acos"
summary = "Minv, clipping by 16 cases, normalising; edges by acos and its small-angle test"
defines = { EDGE = "edge_acos_small_angle" }

[[variant]]
name = "cases_acos_normalized"
summary = "Minv, clipping by 16 cases, normalising; edges by the normalised cross product times acos (rings)"
defines = { EDGE = "edge_acos_normalized_saturated" }

[[variant]]
name = "cases_atan2"
summary = "Minv, clipping by 16 cases, normalising; edges by atan, its sine kept above FLT_MIN"
defines = { EDGE = "edge_atan2_guarded" }

[[variant]]
name = "cases_rational"
summary = "Minv, clipping by 16 cases, normalising; edges by the rational fit, unguarded"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_none", FIT_SCALED = 1 }

[[variant]]
name = "cases_rational_1e7"
summary = "Minv, clipping by 16 cases, normalising; edges by the rational fit, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "cases_rational_flt_min"
summary = "Minv, clipping by 16 cases, normalising; edges by the rational fit (5.42), max(1 - x^2, FLT_MIN)"
defines = { EDGE = "edge_fit", FIT = "fit_rational_542", GUARD = "guard_flt_min" }

[[variant]]
name = "cases_rational_epsilon"
summary = "Minv, clipping by 16 cases, normalising; edges by the rational fit, max(1 - x^2, 2^-24)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_epsilon", FIT_SCALED = 1 }

[[variant]]
name = "cases_rational_saturate"
summary = "Minv, clipping by 16 cases, normalising; edges by the rational fit, saturate(1 - x^2)"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_saturate", FIT_SCALED = 1 }

[[variant]]
name = "cases_rational_split"
summary = "Minv, clipping by 16 cases, normalising; edges by the rational fit, nearly opposite vectors split"
defines = { EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_none", FIT_SCALED = 1, SPLIT = 1 }

[[variant]]
name = "cases_quadratic_1e7"
summary = "Minv, clipping by 16 cases, normalising; edges by the quadratic fit, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_quadratic", GUARD = "guard_1e7" }

[[variant]]
name = "cases_cubic_1e7"
summary = "Minv, clipping by 16 cases, normalising; edges by the cubic fit, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_cubic", GUARD = "guard_1e7" }

[[variant]]
name = "cases_poly7_1e7"
summary = "Minv, clipping by 16 cases, normalising; edges by the fit of degree 7, max(1 - x^2, 1e-7)"
defines = { EDGE = "edge_fit", FIT = "fit_poly7", GUARD = "guard_1e7" }

[[variant]]
name = "cases_stable"
summary = "Minv, clipping by 16 cases, normalising; edges by the cross product that does not cancel"
defines = { EDGE = "edge_stable" }
---*/

// The published way: transform, clip the quad to z > 0 by the signs of its corners (16 cases), normalise the corners
// that remain, sum the z of the edges.
//
// A cut is -b.z a + a.z b, unnormalised. The two diagonal cases (opposite corners above, the others below) are no
// planar quad and count as nothing.
// Domain: corners and their products within f32's range; no corner at the point.
// Source: Heitz, Dupuy, Hill & Neubelt, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", 2016.
// Bound: normalising rounds every corner by 2^-24, which turns an edge's plane by 2^-24/sin(theta): 1e-4 of the result
// within 1e-3 of pi. What the form of the edge adds is stated there.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                     ggx       grazing       facing          far     near_plane       needle       horizon    inside_out      edge
//   cases_acos_clamped            2% 6e-1      13% 8e-1    1.9% 3e-1       0 6e-5        29% n1x   0.11% 4e-1     0.7% 7e-1      34% 8e-1  17% n15%
//   cases_acos                   1.9% 3e3       12% 3e3    1.9% 3e-3       0 6e-5        28% n1x    0.1% 7e-2     0.68% 3e3       33% 3e3  17% n15%
//   cases_acos_normalized         3x 1e-4      45x 2e-4       0 9e-5    1.8% 2e-4  0.11% n0.032%   0.19% n21x       8x 1e-4        0 1e-4  45% n45%
//   cases_atan2                    0 4e-6        0 4e-6       0 2e-6       0 9e-7     0.025% n1x       0 4e-5        0 5e-6        0 2e-5  15% n15%
//   cases_rational             0.29% n47x  4.3% n0.023%  0.057% 3e-3       0 3e-7       23% n11%  0.024% 7e-2   0.099% n13x  5.5% n0.065%  20% n20%
//   cases_rational_1e7         0.29% 5e-1     4.3% 5e-1  0.057% 3e-3       0 3e-7        23% n1x  0.024% 7e-2   0.099% 5e-1     5.5% 5e-1  16% n15%
//   cases_rational_flt_min    0.29% 2e+15    4.3% 2e+15  0.057% 3e-3       0 2e-7        23% n1x  0.024% 7e-2  0.099% 2e+15    5.5% 3e+15  17% n15%
//   cases_rational_epsilon     0.29% 5e-1     4.3% 5e-1  0.057% 3e-3       0 3e-7        23% n1x  0.024% 7e-2   0.099% 6e-1     5.5% 6e-1  16% n15%
//   cases_rational_saturate    0.29% n47x  4.3% n0.023%  0.057% 3e-3       0 3e-7       23% n11%  0.024% 7e-2   0.099% n13x  5.5% n0.065%  20% n20%
//   cases_rational_split       0.19% 3e-3     2.8% 5e-3  0.056% 2e-3       0 3e-7       2.6% n3x  0.022% 3e-3   0.067% 3e-3     3.8% 4e-3  19% n19%
//   cases_quadratic_1e7          48% 5e-1      29% 5e-1     56% 5e-3  0.011% 3e-3        61% n1x    5.6% 7e-2      28% 5e-1      74% 5e-1  35% n15%
//   cases_cubic_1e7              14% 5e-1      11% 5e-1     21% 3e-3     22x 3e-4        34% n1x   0.98% 7e-2       8% 5e-1      27% 5e-1  21% n15%
//   cases_poly7_1e7            0.29% 5e-1     4.3% 5e-1  0.057% 3e-3       0 2e-7        23% n1x  0.024% 7e-2   0.099% 5e-1     5.5% 5e-1  16% n15%
//   cases_stable                   0 4e-6        0 4e-6       0 7e-7       0 1e-7     0.025% n1x       0 4e-5        0 5e-6        0 2e-5  16% n15%

#include "common/edge_any.glsl"

// Where the way from a, above, to b, below, meets the horizon.
vec3 cut(vec3 a, vec3 b)
{
    return a.z * b - b.z * a;
}

// Replaces a quad by what of it lies above the horizon; returns the count of corners.
int clip_quad(inout vec3 q[5])
{
    int above = (q[0].z > 0.0 ? 1 : 0) + (q[1].z > 0.0 ? 2 : 0) + (q[2].z > 0.0 ? 4 : 0) + (q[3].z > 0.0 ? 8 : 0);
    switch (above) {
    case 1:
        q[1] = cut(q[0], q[1]);
        q[2] = cut(q[0], q[3]);
        return 3;
    case 2:
        q[0] = cut(q[1], q[0]);
        q[2] = cut(q[1], q[2]);
        return 3;
    case 3:
        q[2] = cut(q[1], q[2]);
        q[3] = cut(q[0], q[3]);
        return 4;
    case 4:
        q[0] = cut(q[2], q[3]);
        q[1] = cut(q[2], q[1]);
        return 3;
    case 6:
        q[0] = cut(q[1], q[0]);
        q[3] = cut(q[2], q[3]);
        return 4;
    case 7:
        q[4] = cut(q[0], q[3]);
        q[3] = cut(q[2], q[3]);
        return 5;
    case 8:
        q[0] = cut(q[3], q[0]);
        q[1] = cut(q[3], q[2]);
        q[2] = q[3];
        return 3;
    case 9:
        q[1] = cut(q[0], q[1]);
        q[2] = cut(q[3], q[2]);
        return 4;
    case 11:
        q[4] = q[3];
        q[3] = cut(q[3], q[2]);
        q[2] = cut(q[1], q[2]);
        return 5;
    case 12:
        q[0] = cut(q[3], q[0]);
        q[1] = cut(q[2], q[1]);
        return 4;
    case 13:
        q[4] = q[3];
        q[3] = q[2];
        q[2] = cut(q[2], q[1]);
        q[1] = cut(q[0], q[1]);
        return 5;
    case 14:
        q[4] = cut(q[3], q[0]);
        q[0] = cut(q[1], q[0]);
        return 5;
    case 15:
        return 4;
    default:
        return 0;
    }
}

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 q[5] = vec3[5](minv * p0, minv * p1, minv * p2, minv * p3, vec3(0.0));
    int count = clip_quad(q);
    if (count == 0) {
        return 0.0;
    }
    for (int i = 0; i < count; ++i) {
        q[i] = normalize(q[i]);
    }
    float sum = edge_any(q[count - 1], q[0]).z;
    for (int i = 1; i < count; ++i) {
        sum += edge_any(q[i - 1], q[i]).z;
    }
    return abs(sum);
}
