/*---
summary = "Moments of the line in the angle between its ends: every term positive, normal from the nearer end and p2 - p1"
source  = "ours"
tried   = "Fpo/Fwt differences with compensated areas keep the foot d in three places, each of which loses digits for near and long lines"

[[variant]]
name = "positive"

[[variant]]
name = "positive_precise"
precise = true

[[variant]]
name = "positive_split"
summary = "positive, with p1 x p2 from exact partial products: lines seen nearly end-on as well"
defines = { SPLIT_NORMAL = 1 }

[[variant]]
name = "positive_split_precise"
summary = "positive, with p1 x p2 from exact partial products: lines seen nearly end-on as well"
defines = { SPLIT_NORMAL = 1 }
precise = true

[[variant]]
name = "positive_split_scaled_precise"
summary = "positive_split, the ends first scaled exactly by a power of two: any size of the scene"
defines = { SPLIT_NORMAL = 1, SCALED = 1 }
precise = true
---*/

// With theta the angle between the visible ends a, b of the line after Minv, ra and rb their distances,
//
//     I = |det Minv| |n| share / (pi ra rb) [ (a.z/ra)(f1/rb + f2/ra) + (b.z/rb)(f1/ra + f2/rb) ],   n = p1 x p2
//     f1 = (sin theta - theta cos theta)/sin^3 theta        f2 = (theta - sin theta cos theta)/sin^3 theta
//
// share is the visible part of the segment. No term is negative, so nothing cancels but inside n and the ends
// themselves. n is the nearer end's cross product with p2 - p1, whose terms stay small for a far light (the difference of close f32
// is exact), and
// the area after Minv is cof(Minv) n, not a second cross product; a clipped end is read off that area too.
// SPLIT_NORMAL takes n from exact partial products instead; a compiler that factors a_high b_high + a_high b_low
// undoes them, so these belong to `precise`.
//
// Domain: any finite ends within 2^-30..2^30 (SCALED: any), any Minv of moderate condition. Equal ends and lines seen
// end-on answer 0.
// Source: ours.
// Bound: about 20 roundings times the condition of Minv, plus 2^-24/sin of the angle between the nearer end and p2 - p1; with
// SPLIT_NORMAL plus 2^-34 |p1| |p2|/|p1 x p2| instead.
// By distance over length: none fails beyond 1, whatever the distance; what fails without SPLIT_NORMAL lies closer to the infinite
// line than 1e-6 of the length.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                      ggx     far  grazing    near  horizon    long         edge
//   positive                        0 2e-3  0 2e-3   0 1e-2  1x 4e0   0 6e-3  1x 2e1   3.9% n3.1%
//   positive_split                  0 2e-3  0 6e-2   0 1e-2  0 9e-1   0 6e-3   0 1e0   3.6% n2.8%
//   positive_split_precise          0 2e-3  0 2e-3   0 1e-2  0 9e-3   0 6e-3  0 2e-4   3.9% n3.1%
//   positive_split_scaled_precise   0 2e-3  0 2e-3   0 1e-2  0 9e-3   0 6e-3  0 2e-4  1.2% n0.41%

#include "common/line_light.glsl"
#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

float ltc_line(mat3 minv, vec3 p1, vec3 p2)
{
#ifdef SCALED
    float scale = scale_to_one(max(largest_component(p1), largest_component(p2)));
    return scale * line_light(minv, scale * p1, scale * p2);
#else
    return line_light(minv, p1, p2);
#endif
}
