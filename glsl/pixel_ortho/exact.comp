/*---
summary = "Exact clip: spherical triangles between the corners and the horizon, and the segments between great and small circles"
source  = "ours; triangles after van Oosterom & Strackee 1983"

[[variant]]
name = "exact"

[[variant]]
name = "exact_precise"
precise = true

[[variant]]
name = "exact_compensated"
summary = "exact with 1 - x^2 - y^2 by error-free products: corners at the circle are those of the inputs' bits"
defines = { COMPENSATED = 1 }
---*/

// Cut along the axes, the rectangle is up to four in one quadrant each. Such a region's sides are arcs of circles x = c or
// y = c and of the horizon. It is the geodesic polygon of its three to five corners, plus the segments of the near sides,
// less those of the far ones:
//
//     tan(Omega/2) = [a, b, c]/(1 + a.b + b.c + c.a)       each triangle, from the nearest corner
//     S = 2 (atan(c T) - c atan T)                         each segment, T the tangent of a quarter of its azimuths
//
// Every product is of non-negative numbers: differences of heights are z0 - z1 = (x1^2 - x0^2)/(z0 + z1), ends on the horizon
// are (1 - x^2 - y^2)/(x + rho) away. What cancels is segments against each other, for rectangles longer than wide.
//
// Domain: any rectangle, in any order; 0 outside the circle.
// Source: ours.
// Bound: 30 u, u = 2^-24, times length over width; at the circle what rounding a corner does, without COMPENSATED.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                         image  boundary   decimal      fine    window   grazing          edge
//   exact              0 5.7e-7  0 5.7e-7  0 1.7e-2  0 9.1e-1  0 1.9e-2  0 3.4e-2  0.0706 % inf
//   exact_compensated  0 5.7e-7  0 5.7e-7  0 3.9e-7  0 3.7e-7  0 1.6e-4  0 9.7e-5      0 1.0e+0

#include "common/arctangent.glsl"
#ifdef COMPENSATED
#include "common/error_free.glsl"
#endif

// 1 - x^2 - y^2 for x, y >= 0.
float remainder(float x, float y)
{
#ifdef COMPENSATED
    // Larger coordinates are far outside, and squares must not overflow.
    vec3 a = vec3(min(max(x, y), 2.0), min(min(x, y), 2.0), 0.0);
    precise vec3 p = a * a;
    vec3 high = split_high(a);
    precise vec3 low = a - high;
    vec3 e = product_error(p, high, low, high, low);
    precise float s = 1.0 - p.x;
    precise float s_error = p.x > 1.0 ? 1.0 - (p.x + s) : (1.0 - s) - p.x;
    precise float r = s - p.y;
    precise float back = r - s;
    precise float r_error = (s - (r - back)) + (-p.y - back);
    precise float result = r + ((s_error + r_error) - (e.x + e.y));
    return result;
#else
    float longer = max(x, y);
    float shorter = min(x, y);
    return (1.0 - longer) * (1.0 + longer) - shorter * shorter;
#endif
}

float triangle(vec3 a, vec3 b, vec3 c, vec3 normal)
{
    return 2.0 * arctangent(dot(a, normal), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

// S(c, T) for T from (ends, heights) of the arc; step is the ends' difference.
float segment(float c, vec2 ends, float step, vec2 heights)
{
    float square = (1.0 - c) * (1.0 + c);
    float across = ends.y * heights.x + ends.x * heights.y;
    float along = square + ends.x * ends.y + heights.x * heights.y;
    float t = across > 0.0 ? square * step / across * ((ends.x + ends.y) / along) : 0.0;
    if (t < 0.25) {
        float s = t * t;
        float k = c * c;
        float g2 = 1.0 + k;
        float g3 = 1.0 + k * g2;
        float g4 = 1.0 + k * g3;
        float g5 = 1.0 + k * g4;
        float series = 0.333333333 - s * (0.2 * g2 - s * (0.142857143 * g3 - s * (0.111111111 * g4 - s * (0.0909090909 * g5))));
        return 2.0 * c * square * (t * s) * series;
    }
    float rest = 1.0 - c;
    return 2.0 * (c < 0.5 ? arctangent(c * t, 1.0) - c * arctangent(t, 1.0)
                          : rest * arctangent(t, 1.0) - arctangent(rest * t, 1.0 + c * t * t));
}

// 0 <= low < high in both coordinates.
float quadrant(vec2 low, vec2 high)
{
    float z2 = remainder(low.x, low.y);
    if (!(z2 > 0.0)) {
        return 0.0;
    }
    vec2 size = high - low;
    vec2 sum = high + low;
    // Towards high.x along the lower side, towards high.y along the left one.
    vec2 z2_end = vec2(remainder(high.x, low.y), remainder(low.x, high.y));
    float z2_far = remainder(high.x, high.y);
    float z = sqrt(z2);
    vec2 z_end = sqrt(max(z2_end, vec2(0.0)));
    // Radii of the circles x = low.x and y = low.y, and of the far ones.
    vec2 near_radius = sqrt((1.0 - low) * (1.0 + low));
    vec2 far_radius = sqrt(max((1.0 - high) * (1.0 + high), vec2(0.0)));
    bvec2 has = greaterThan(z2_end, vec2(0.0));
    vec2 step = mix(z2 / (near_radius.yx + low), size, has);
    vec2 fall = step * (low + low + step) / (z + z_end);

    vec3 a = vec3(low, z);
    vec3 b = vec3(low.x + step.x, low.y, z_end.x);
    vec3 d = vec3(low.x, low.y + step.y, z_end.y);
    float area = segment(low.y, vec2(a.x, b.x), step.x, vec2(z, z_end.x))
        + segment(low.x, vec2(a.y, d.y), step.y, vec2(z, z_end.y));
    if (z2_far > 0.0) {
        float z_far = sqrt(z2_far);
        vec3 c = vec3(high, z_far);
        vec2 rise = size * sum / (z_end.yx + z_far);
        area += triangle(a, b, c, vec3(size.y * fall.x, size.x * rise.y, size.x * size.y));
        area += triangle(a, c, d, vec3(size.y * rise.x, size.x * fall.y, size.x * size.y));
        area -= segment(high.x, vec2(low.y, high.y), size.y, vec2(z_end.x, z_far));
        area -= segment(high.y, vec2(low.x, high.x), size.x, vec2(z_end.y, z_far));
        return max(area, 0.0);
    }

    // The horizon cuts the far corner off, from first to second.
    vec3 first = b;
    vec2 first_step = vec2(step.x, 0.0);
    vec2 turn = step;
    if (has.x) {
        float end = z2_end.x / (far_radius.x + low.y);
        first = vec3(high.x, low.y + end, 0.0);
        first_step = vec2(size.x, end);
        area += triangle(a, b, first, vec3(end * fall.x, size.x * z_end.x, size.x * end));
        area -= segment(high.x, vec2(low.y, first.y), end, vec2(z_end.x, 0.0));
        turn = vec2(size.x, size.x * sum.x / (near_radius.x + far_radius.x));
    }
    vec3 second = d;
    float end = 0.0;
    if (has.y) {
        end = z2_end.y / (far_radius.y + low.x);
        second = vec3(low.x + end, high.y, 0.0);
        area -= segment(high.y, vec2(low.x, second.x), end, vec2(z_end.y, 0.0));
        turn = has.x ? -z2_far / (high + far_radius.yx)
                     : vec2(size.y * sum.y / (near_radius.y + far_radius.y), size.y);
    }
    area += triangle(a, first, second, vec3(z * turn.y, z * turn.x, first_step.x * turn.y + first_step.y * turn.x));
    if (has.y) {
        area += triangle(a, second, d, vec3(size.y * z_end.y, end * fall.y, size.y * end));
    }
    return max(area, 0.0);
}

float pixel_ortho(float x0, float y0, float x1, float y1)
{
    vec2 low = min(vec2(x0, y0), vec2(x1, y1));
    vec2 high = max(vec2(x0, y0), vec2(x1, y1));
    float sum = 0.0;
    for (int part = 0; part < 4; ++part) {
        bvec2 mirrored = bvec2((part & 1) != 0, (part & 2) != 0);
        vec2 from = max(mix(low, -high, mirrored), vec2(0.0));
        vec2 to = max(mix(high, -low, mirrored), vec2(0.0));
        if (to.x > from.x && to.y > from.y) {
            sum += quadrant(from, to);
        }
    }
    return sum;
}
