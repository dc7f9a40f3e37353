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
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                       ggx           far  near_plane        needle    inside_out       edge
//   cases_acos_clamped           1.99% 0.61      0 5.7e-5   28.5% inf    0.11% 0.45    34.1% 0.84  16.6% inf
//   cases_acos                   1.94% 2534      0 5.7e-5   27.8% inf    0.10% 0.07    33.2% 3109  16.7% inf
//   cases_acos_normalized         3x 1.2e-4  1.75% 2.0e-4   0.11% inf     0.19% inf      0 1.0e-4  44.9% inf
//   cases_atan2                    0 4.1e-6      0 8.5e-7   0.03% inf      0 3.8e-5      0 1.9e-5  15.5% inf
//   cases_rational                0.29% inf      0 3.0e-7   23.4% inf    0.02% 0.07     5.55% inf  20.5% inf
//   cases_rational_1e7           0.29% 0.49      0 3.0e-7   23.4% inf    0.02% 0.07    5.55% 0.47  16.1% inf
//   cases_rational_flt_min     0.29% 2.0e15      0 2.4e-7   23.4% inf    0.02% 0.07  5.55% 2.5e15  17.1% inf
//   cases_rational_epsilon       0.29% 0.49      0 3.0e-7   23.4% inf    0.02% 0.07    5.55% 0.61  16.1% inf
//   cases_rational_saturate       0.29% inf      0 3.0e-7   23.4% inf    0.02% 0.07     5.55% inf  20.5% inf
//   cases_rational_split       0.19% 3.1e-3      0 3.0e-7   2.63% inf  0.02% 2.9e-3  3.84% 4.5e-3  18.8% inf
//   cases_quadratic_1e7          47.6% 0.50  0.01% 3.5e-3   60.7% inf    5.57% 0.07    73.7% 0.47  35.1% inf
//   cases_cubic_1e7              14.0% 0.49    22x 2.9e-4   34.3% inf    0.98% 0.07    27.4% 0.47  21.1% inf
//   cases_poly7_1e7              0.29% 0.49      0 1.8e-7   23.4% inf    0.02% 0.07    5.55% 0.47  16.1% inf
//   cases_stable                   0 4.5e-6      0 1.3e-7   0.03% inf      0 3.8e-5      0 2.0e-5  15.5% inf

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
