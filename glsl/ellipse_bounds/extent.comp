/*---
summary = "Half extents as square roots of u^2 + v^2, added to the centre"
source  = "Quilez, Planar ellipses: bounding box and ray intersection (iquilezles.org)"

[[variant]]
name = "naive"
summary = "As published: sqrt(u*u + v*v)"
defines = { EXTENT = 1 }

[[variant]]
name = "length2"
summary = "length(vec2(u, v)), component by component"
defines = { EXTENT = 2 }

[[variant]]
name = "hypot"
summary = "The longer times sqrt(1 + ratio^2): any size"
defines = { EXTENT = 3 }

[[variant]]
name = "padded"
summary = "naive, and 1e-5 more on every side: what an absolute epsilon does at other scales, a control"
defines = { EXTENT = 1, PADDING = 1e-5 }
---*/

// Domain: boxes within f32; half extents between 2^-63 and 2^63, hypot any.
// Bound: the corners within 2 u (|c| + e), u = 2^-24, if square roots round correctly. Half of all sides are rounded
// inwards.
// Measured: failed / of these not enclosing; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    scene           disk           flat      conjugate         offset          scale           edge
//   naive    92.7% / 92.7%  90.2% / 90.2%  93.3% / 93.3%  92.2% / 92.2%  92.3% / 92.3%  96.0% / 85.8%  78.8% / 70.0%
//   length2  92.7% / 92.7%  90.2% / 90.2%  93.3% / 93.3%  92.2% / 92.2%  92.3% / 92.3%  96.0% / 85.8%  78.8% / 70.0%
//   hypot    92.4% / 92.4%  90.1% / 90.1%  91.2% / 91.2%  92.0% / 92.0%  91.8% / 91.8%  94.9% / 94.9%  64.7% / 64.7%
//   padded       0.61% / 0      6.56% / 0      15.3% / 0      0.66% / 0  42.0% / 34.6%  91.6% / 33.7%  55.3% / 14.8%

#if EXTENT == 3
#include "common/hypot.glsl"
#endif

EllipseBounds ellipse_bounds(vec3 center, vec3 u, vec3 v)
{
#if EXTENT == 1
    vec3 e = sqrt(u * u + v * v);
#elif EXTENT == 2
    vec3 e = vec3(length(vec2(u.x, v.x)), length(vec2(u.y, v.y)), length(vec2(u.z, v.z)));
#else
    vec3 e = vec3(hypot(u.x, v.x), hypot(u.y, v.y), hypot(u.z, v.z));
#endif
#ifdef PADDING
    e += PADDING;
#endif
    return EllipseBounds(center - e, center + e);
}
