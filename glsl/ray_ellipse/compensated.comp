/*---
summary = "Cramer's rule in error-free products: the border moves by no more than rounding the inputs moves it"
source  = "ours, after Dekker 1971 and Ogita, Rump & Oishi, Accurate sum and dot product, 2005"

[[variant]]
name = "compensated"
summary = "Determinants in pairs of f32, the test by a compensated sum of squares"

[[variant]]
name = "compensated_plain_test"
summary = "compensated, but hit or miss by the rounded quotients"
defines = { PLAIN_TEST = 1 }
---*/

// Every vector is scaled by a power of two. q = origin - center and the cross products v x d, d x u and u x v are pairs of
// f32, off by 2^-45 of their products at most, and so are the determinants, which are then rounded once:
//
//     D = [d, u, v]    lambda = [d, q, v]/D    gamma = [d, u, q]/D    t = -[q, u, v]/D
//
// A hit has [d, q, v]^2 + [d, u, q]^2 <= D^2; the difference is formed from exact squares.
//
// Domain: any finite ray and semi-axes; where components lie 2^-60 below their vector's largest, less is exact.
// Bound, with u = 2^-24: rounding the determinants moves |D| - hypot of the others by 2 u |D| at most. At the border,
// where the two are equal, a change of d, u and v by u moves it by u |D| (D has three of them as factors, the others two)
// and one of q by as much: the class turns within one rounding of the inputs. lambda, gamma and t are within 3 ulp, with
// Vulkan's division within 4.5, while their determinants exceed 2^-20 of their products; below, 2^-45 of those is lost.
// Measured: failed / of these missed; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                           scene  border  grazing    far  needle  at_plane  scale       edge
//   compensated             0 / 0   0 / 0    0 / 0  0 / 0   0 / 0     0 / 0  0 / 0  18x / 12x
//   compensated_plain_test  0 / 0   0 / 0    0 / 0  0 / 0   0 / 0     0 / 0  0 / 0  19x / 12x

#include "common/error_free.glsl"
#include "common/power_of_two.glsl"
#include "common/ray_miss.glsl"

RayEllipse ray_ellipse(vec3 origin, vec3 direction, vec3 center, vec3 u, vec3 v)
{
    // A difference of the largest numbers must not overflow.
    float shrink = max(largest_component(origin), largest_component(center)) > 1.0e38 ? 0.25 : 1.0;
    vec3 q_low;
    vec3 q = sum_pair(shrink * origin, -shrink * center, q_low);
    float scale_q = scale_to_one(largest_component(q));
    float scale_d = scale_to_one(largest_component(direction));
    float scale_u = scale_to_one(largest_component(u));
    float scale_v = scale_to_one(largest_component(v));
    q *= scale_q;
    q_low *= scale_q;
    direction *= scale_d;
    u *= scale_u;
    v *= scale_v;

    vec3 by_u_low;
    vec3 by_v_low;
    vec3 normal_low;
    vec3 by_u = cross_pair(v, direction, by_u_low);
    vec3 by_v = cross_pair(direction, u, by_v_low);
    vec3 normal = cross_pair(u, v, normal_low);

    float denominator = dot_pair(direction, vec3(0.0), normal, normal_low);
    if (denominator == 0.0) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
    vec2 place = vec2(dot_pair(q, q_low, by_u, by_u_low), dot_pair(q, q_low, by_v, by_v_low));
    float t = -dot_pair(q, q_low, normal, normal_low) / denominator;

    // In units in which the denominator is that of lambda and gamma; beyond the square around the ellipse it is a miss.
    place = vec2(times_ratio(place.x, scale_u, scale_q), times_ratio(place.y, scale_v, scale_q)) / shrink;
    t = times_ratio(t, scale_d, scale_q) / shrink;
    if (max(abs(place.x), abs(place.y)) > abs(denominator) || !(t >= 0.0 && t < RAY_MISS)) {
        return RayEllipse(RAY_MISS, 0.0, 0.0);
    }
#ifdef PLAIN_TEST
    place /= denominator;
    bool hit = dot(place, place) <= 1.0;
#else
    // The denominator of grazing rays is small: its square must not be lost.
    float grow = scale_to_one(abs(denominator));
    vec3 sides = grow * vec3(place, denominator);
    precise vec3 squares = sides * sides;
    vec3 high = mask_high(sides);
    vec3 errors = product_error(squares, high, sides - high, high, sides - high);
    vec3 low;
    float legs = sum_pair(squares.xxx, squares.yyy, low).x;
    precise float rest = low.x + (errors.x + errors.y) - errors.z;
    precise float excess = (legs - squares.z) + rest;
    bool hit = excess <= 0.0;
    place /= denominator;
#endif
    return hit ? RayEllipse(t, place.x, place.y) : RayEllipse(RAY_MISS, 0.0, 0.0);
}
