/*---
summary = "Rounded outwards: encloses the ellipse on every device that keeps Vulkan's limits"
source  = "ours"

[[variant]]
name = "outward"
summary = "Each component scaled by a power of two of its own: any size"
defines = { SCALED = 1 }

[[variant]]
name = "outward_tight"
summary = "outward, the root corrected by its exact remainder: within a few roundings, however good the device's root"
defines = { SCALED = 1, TIGHT = 1 }

[[variant]]
name = "outward_unscaled"
summary = "outward for half extents whose squares are normal numbers"
---*/

// e = sqrt(u^2 + v^2) made larger by 2^-20, and every side moved to the next number outwards.
//
// Proof, with w = 2^-23, in whatever direction the device rounds. The two squares and their sum are each low by a factor
// of 1 - w at most, together (1 - w)^2, whose root is 1 - w. The square root is as 1/inversesqrt: 2 ULP of one and 2.5 of
// the other, 1 - 4.5 w. The product with 1 + 8 w is low by 1 - w again: (1 - w)(1 - 4.5 w)(1 - w)(1 + 8 w) > 1, so the
// half extent is not too small. A sum that is rounded is one of the two numbers next to the exact one, so that its
// outward neighbour is beyond it. All this needs the operations as they are written: they are precise.
//
// Underflow: of two components scaled by the larger one's power of two, the smaller's square is lost only where it is
// 2^-126 of the sum, which 1.5 w to spare cover. A semi-axis's subnormal component counts as 2^-126. Sides that are zero or
// subnormal stay as they are, as addition is exact there, or flushed: within 2^-126 of the ellipse.
//
// TIGHT: e + r/(2 e) is no less than the root, r = u^2 + v^2 - e^2, and r is known from products with their errors up to a
// few w^2, in directed modes too. The sum is one of the two numbers next to the exact one, the second step outwards is for
// the w^2.
//
// Domain: boxes within f32, half extents between 2^-60 and 2^60 or zero, or SCALED.
// Bound: sides 13.5 w e + 2 ULP out at most; TIGHT: 3 w e + 2 ULP. Subnormal components add 2^-125: what fails in edge are
// ellipses of that size, and without TIGHT corners that cancel.
// Measured: failed / of these not enclosing; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     scene   disk   flat  conjugate  offset          scale           edge
//   outward           0 / 0  0 / 0  0 / 0      0 / 0   0 / 0         1x / 0      2.14% / 0
//   outward_tight     0 / 0  0 / 0  0 / 0      0 / 0   0 / 0          0 / 0      1.80% / 0
//   outward_unscaled  0 / 0  0 / 0  0 / 0      0 / 0   0 / 0  19.0% / 8.78%  21.7% / 12.6%

#include "common/neighbour.glsl"
#ifdef SCALED
#include "common/power_of_two.glsl"
#ifdef TIGHT
#include "common/error_free.glsl"

// x^2 less its rounded square.
vec3 square_error(vec3 x, vec3 square)
{
    vec3 high = mask_high(x);
    precise vec3 low = x - high;
    return product_error(square, high, low, high, low);
}
#endif

// |x|, subnormals as the smallest normal number, zero as zero.
vec3 normal_magnitude(vec3 x)
{
    uvec3 bits = floatBitsToUint(x) & 0x7fffffffu;
    return uintBitsToFloat(mix(max(bits, uvec3(0x00800000u)), bits, equal(bits, uvec3(0u))));
}
#endif

EllipseBounds ellipse_bounds(vec3 center, vec3 u, vec3 v)
{
    const float GROW = 1.0 + 9.5367431640625e-7;
#ifdef SCALED
    u = normal_magnitude(u);
    v = normal_magnitude(v);
    vec3 larger = max(u, v);
    vec3 scale = vec3(scale_to_one(larger.x), scale_to_one(larger.y), scale_to_one(larger.z));
    u *= scale;
    v *= scale;
#endif
    precise vec3 u2 = u * u;
    precise vec3 v2 = v * v;
    precise vec3 square = u2 + v2;
#ifdef TIGHT
    vec3 e = sqrt(square);
    vec3 low;
    vec3 sum = sum_pair(u2, v2, low);
    precise vec3 e2 = e * e;
    precise vec3 small = low + (square_error(u, u2) + square_error(v, v2) - square_error(e, e2));
    precise vec3 remainder = (sum - e2) + small;
    precise vec3 corrected = e + remainder / max(2.0 * e, 1.0);
    e = mix(next_above(next_above(corrected)), vec3(0.0), equal(larger, vec3(0.0)));
#else
    precise vec3 e = sqrt(square) * GROW;
#endif
#ifdef SCALED
    e *= vec3(reciprocal_power_of_two(scale.x), reciprocal_power_of_two(scale.y), reciprocal_power_of_two(scale.z));
#endif
    precise vec3 lower = center - e;
    precise vec3 upper = center + e;
    return EllipseBounds(next_below(lower), next_above(upper));
}
