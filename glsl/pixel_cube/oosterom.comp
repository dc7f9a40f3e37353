/*---
summary = "Two plane triangles whose determinant is dx dy exactly: no cancellation at any resolution"
source  = "van Oosterom & Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 1983; the exact numerator ours"

[[variant]]
name = "oosterom"

[[variant]]
name = "oosterom_arctangent"
summary = "oosterom with an arctangent of our own: Mesa's is off by 2e-5 of small angles"
defines = { OURS = 1 }

[[variant]]
name = "oosterom_one"
summary = "oosterom_arctangent with both triangles' tangents added first: one arctangent"
defines = { OURS = 1, ONE = 1 }

[[variant]]
name = "oosterom_split"
summary = "oosterom_one cut along the axes, where every term of the denominator is positive: any rectangle"
defines = { OURS = 1, ONE = 1, SPLIT = 1 }

[[variant]]
name = "oosterom_split_precise"
summary = "oosterom_one cut along the axes, where every term of the denominator is positive: any rectangle"
defines = { OURS = 1, ONE = 1, SPLIT = 1 }
precise = true
---*/

// With corners a, b, c, d round the rectangle, each of its triangles has tan(Omega/2) = dx dy/D,
//
//     D = |a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|
//
// Domain: corners to 1e10, in any order, empty ones included. Without SPLIT the dot products of corners on either side of
// an axis are negative, and D cancels for wide strips (|x| > 10 or so).
// Source: as above.
// Bound: 16 u, u = 2^-24, with an arctangent within 3 roundings, for pixels that no axis cuts and for all with SPLIT.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                        cube_map   decimal      fine    window             wide        edge
//   oosterom             0 2.1e-5  0 2.1e-5  0 2.1e-5  0 2.1e-5  0.0177 % 5.9e-2  6.64 % inf
//   oosterom_arctangent  0 2.2e-7  0 3.3e-7  0 2.9e-7  0 3.3e-7  0.0177 % 5.9e-2  6.64 % inf
//   oosterom_one         0 2.5e-7  0 3.3e-7  0 2.9e-7  0 3.7e-7   0.921 % 1.0e+0  6.73 % inf
//   oosterom_split       0 2.2e-7  0 3.3e-7  0 2.8e-7  0 3.4e-7         0 3.4e-7    0 4.1e-7

#ifdef OURS
#include "common/arctangent.glsl"
#else
#define arctangent atan
#endif

float rectangle(float x0, float y0, float x1, float y1)
{
    float area = (x1 - x0) * (y1 - y0);
    float x = 1.0 + x0 * x1;
    float y = y0 * y1;
    vec4 r = vec4(x0, x1, x1, x0);
    vec4 s = vec4(y0, y0, y1, y1);
    r = sqrt(1.0 + r * r + s * s);
    float diagonal = x + y;
    float lower = r.x * r.y * r.z + (x + y0 * y0) * r.z + (1.0 + x1 * x1 + y) * r.x + diagonal * r.y;
    float upper = r.x * r.z * r.w + diagonal * r.w + (x + y1 * y1) * r.x + (1.0 + x0 * x0 + y) * r.z;
#ifdef ONE
    vec2 t = area / vec2(lower, upper);
    return 2.0 * arctangent(t.x + t.y, 1.0 - t.x * t.y);
#else
    return 2.0 * (arctangent(area, lower) + arctangent(area, upper));
#endif
}

float pixel_cube(float x0, float y0, float x1, float y1)
{
#ifdef SPLIT
    vec2 low = min(vec2(x0, y0), vec2(x1, y1));
    vec2 high = max(vec2(x0, y0), vec2(x1, y1));
    float sum = 0.0;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        bvec2 mirrored = bvec2((quadrant & 1) != 0, (quadrant & 2) != 0);
        vec2 from = max(mix(low, -high, mirrored), vec2(0.0));
        vec2 to = max(mix(high, -low, mirrored), vec2(0.0));
        if (to.x > from.x && to.y > from.y) {
            sum += rectangle(from.x, from.y, to.x, to.y);
        }
    }
    return sum;
#else
    return abs(rectangle(x0, y0, x1, y1));
#endif
}
