/*---
summary = "Line lights at Gauss points across the strip, each with the width it shows there"
source  = "ours"
tried   = "Equidistant lines need twice as many for the same error"

[[variant]]
name = "gauss2"
defines = { POINTS = 2 }

[[variant]]
name = "gauss3"
defines = { POINTS = 3 }
---*/

// A rectangle is an integral of parallel lines: with I(v) the line light of p1 + v side .. p2 + v side and w(v) the unit
// normal of its plane through the point,
//
//     E = 1/2 integral over v in -1..1 of I(v) |side . w(v)|
//
// exactly, the horizon included, and |side . n(v)| is the same for all v, n = (p1 + v side) x (p2 + v side).
//
// Domain: half widths up to about half the distance, and lobes not much narrower than the strip. Strips whose plane
// holds the point answer 0.
// Source: ours; Gauss-Legendre abscissae.
// Bound: with r the half width over the distance (after Minv), error r^4 for 2 points and r^6 for 3, relative; where
// the horizon cuts the strip lengthwise, the step between two lines.
// By half width over distance, all roughnesses, they are off at 0.01 to 0.03, to 0.1, to 0.3 and to 1 for
//   gauss2 0.005, 0.26, 4.9, 50 %     gauss3 0.0005, 0.06, 1.4, 25 %
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//            ggx_alpha_02  ggx_alpha_01  ggx_alpha_05       edge
//   gauss2      0.11% 1e0     0.21% 2e0    0.054% 2e0  24% n1.3%
//   gauss3     0.035% 2e0    0.073% 2e0   0.017% 8e-1  22% n1.3%

#include "common/line_light.glsl"

float seen(mat3 minv, vec3 p1, vec3 p2)
{
    vec3 normal = line_normal(p1, p2);
    float size = length(normal);
    return size > 0.0 ? line_light_of(minv, p1, p2, normal) / size : 0.0;
}

float ltc_strip(mat3 minv, vec3 p1, vec3 p2, vec3 side)
{
    float volume = abs(dot(side, line_normal(p1, p2)));
#if POINTS == 2
    vec3 offset = 0.577350269189625765 * side;
    float sum = seen(minv, p1 - offset, p2 - offset) + seen(minv, p1 + offset, p2 + offset);
    return 0.5 * volume * sum;
#else
    vec3 offset = 0.774596669241483377 * side;
    float outer = seen(minv, p1 - offset, p2 - offset) + seen(minv, p1 + offset, p2 + offset);
    return volume * (outer * (5.0 / 18.0) + seen(minv, p1, p2) * (8.0 / 18.0));
#endif
}
