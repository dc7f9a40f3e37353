/*---
summary = "A line light times the strip's half width"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course"

[[variant]]
name = "line"

[[variant]]
name = "line_center_cosine"
summary = "A line light times the half width times the cosine between the strip's normal and the way to its middle"
defines = { CENTER_COSINE = 1 }

[[variant]]
name = "line_cosine"
summary = "A line light times the half width that the point sees, |side . w|: first order in the width"
defines = { SEEN_WIDTH = 1 }
---*/

// The line light is the limit of a thin cylinder, which shows its diameter from everywhere. A thin strip shows the
// part of its width across the plane of axis and point: |side . w|, w that plane's unit normal (SEEN_WIDTH). The talk
// calls the factor an extra dot product, and leaves open which; CENTER_COSINE is the one that needs no foot point.
//
// Domain: strips thin against their distance and against the lobe; nothing else is an approximation here.
// Source: Heitz & Hill 2017; the line's integral is that of ltc_line/positive.
// Bound: SEEN_WIDTH is off by second order in the width over the distance, and over the lobe's width; the others by
// zeroth order where the strip is seen obliquely. Half a strip above the horizon counts whole or not at all.
// By half width over distance, all roughnesses, they are off at 1e-3 to 3e-3, to 1e-2, to 0.03, to 0.1, to 0.3 and to 1 for
//   line 7.6, 17, 30, 45, 71, 90 %     line_center_cosine 1.9, 6.3, 15, 30, 64, 91 %     line_cosine 0, 0.007, 0.28, 3.5, 32, 82 %
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                        ggx_alpha_02  ggx_alpha_01  ggx_alpha_05       edge
//   line                      17% 6e0       10% 5e0       30% 3e0  43% n1.2%
//   line_center_cosine       8.9% 1e0      5.6% 3e0      15% 9e-1   43% n11%
//   line_cosine              1.1% 5e0      1.2% 5e0     0.68% 2e0  28% n1.2%

#include "common/line_light.glsl"

float ltc_strip(mat3 minv, vec3 p1, vec3 p2, vec3 side)
{
    vec3 normal = line_normal(p1, p2);
    float light = line_light_of(minv, p1, p2, normal);
    if (!(light > 0.0)) {
        return 0.0;
    }
#if defined(SEEN_WIDTH)
    return light * abs(dot(side, normal)) * inversesqrt(dot(normal, normal));
#elif defined(CENTER_COSINE)
    vec3 facing = normalize(cross(p2 - p1, side));
    return light * length(side) * abs(dot(facing, normalize(p1 + p2)));
#else
    return light * length(side);
#endif
}
