/*---
summary = "The strip as the polygon it is: clipped edges, angles by atan2"
source  = "Heitz, Dupuy, Hill & Neubelt, Real-Time Polygonal-Light Shading with Linearly Transformed Cosines, 2016; clipping by pieces ours"

[[variant]]
name = "polygon"

[[variant]]
name = "polygon_precise"
precise = true

[[variant]]
name = "polygon_scaled"
summary = "polygon, the corners first scaled exactly by a power of two: any size of the scene"
defines = { SCALED = 1 }
---*/

// Four edges after Minv, each clipped to z > 0 by itself, and the way along the horizon between the two crossings.
//
// Domain: any strip. What the four edges' sum leaves of a thin, far one is 2^-24 of its terms, absolutely.
// Source: Heitz et al. 2016 for the edges; the closing along the horizon ours.
// Bound: 1e-6 absolutely, more where the point nearly touches an edge.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                    ggx_alpha_02  ggx_alpha_01  ggx_alpha_05      edge
//   polygon                0 1e-6        0 1e-6        0 1e-6  2.9% 1e0
//   polygon_scaled         0 1e-6        0 1e-6        0 1e-6  1.3% 1e0

#include "common/cosine_contour.glsl"
#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

float ltc_strip(mat3 minv, vec3 p1, vec3 p2, vec3 side)
{
#ifdef SCALED
    float size = max(max(largest_component(p1), largest_component(p2)), largest_component(side));
    float scale = scale_to_one(size);
    p1 *= scale;
    p2 *= scale;
    side *= scale;
#endif
    vec3 a = minv * (p1 - side);
    vec3 b = minv * (p2 - side);
    vec3 c = minv * (p2 + side);
    vec3 d = minv * (p1 + side);
    CosineContour contour = cosine_contour();
    contour_segment(contour, a, b);
    contour_segment(contour, b, c);
    contour_segment(contour, c, d);
    contour_segment(contour, d, a);
    return contour_irradiance(contour);
}
