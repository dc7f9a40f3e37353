// A line light under a linearly transformed cosine, per unit radius: the formula of ltc_line/positive.

#ifndef ROOTQ_LINE_LIGHT
#define ROOTQ_LINE_LIGHT

#include "common/line_cosine.glsl"
#ifdef SPLIT_NORMAL
#include "common/error_free.glsl"
#endif

// p1 x p2. The nearer end with p2 - p1 keeps the terms small for a far light; SPLIT_NORMAL: exact partial products.
vec3 line_normal(vec3 p1, vec3 p2)
{
#ifdef SPLIT_NORMAL
    return cross_split(p1, p2);
#else
    vec3 nearer = dot(p1, p1) < dot(p2, p2) ? p1 : p2;
    return cross(nearer, p2 - p1);
#endif
}

// |det Minv| |n| share / (pi ra rb) [ (a.z/ra)(f1/rb + f2/ra) + (b.z/rb)(f1/ra + f2/rb) ], a and b the visible ends
// after Minv and n = p1 x p2; every term is positive. 0 below the horizon and for n = 0. Bound: see ltc_line/positive.
// Source: ours.
float line_light_of(mat3 minv, vec3 p1, vec3 p2, vec3 normal)
{
    vec3 a = minv * p1;
    vec3 b = minv * p2;
    if (max(a.z, b.z) <= 0.0) {
        return 0.0;
    }

    vec3 cofactor0 = cross(minv[1], minv[2]);
    vec3 cofactor1 = cross(minv[2], minv[0]);
    vec3 cofactor2 = cross(minv[0], minv[1]);
    vec3 area = cofactor0 * normal.x + cofactor1 * normal.y + cofactor2 * normal.z;
    float weight = abs(dot(minv[0], cofactor0)) * length(normal);
    if (!(weight > 0.0)) {
        return 0.0;
    }

    float share = 1.0;
    if (a.z < 0.0) {
        share = b.z / (b.z - a.z);
        a = vec3(-area.y, area.x, 0.0) / (b.z - a.z);
    } else if (b.z < 0.0) {
        share = a.z / (a.z - b.z);
        b = vec3(area.y, -area.x, 0.0) / (a.z - b.z);
    }

    float inverse_a = 1.0 / length(a);
    float inverse_b = 1.0 / length(b);
    float sine = min(length(area) * share * inverse_a * inverse_b, 1.0);
    float cosine = dot(a * inverse_a, b * inverse_b);
    vec2 f = line_factors(sine, cosine);
    float sum = a.z * inverse_a * (f.x * inverse_b + f.y * inverse_a)
              + b.z * inverse_b * (f.x * inverse_a + f.y * inverse_b);
    return 0.318309886183790672 * share * (weight * inverse_a * inverse_b) * sum;
}

float line_light(mat3 minv, vec3 p1, vec3 p2)
{
    return line_light_of(minv, p1, p2, line_normal(p1, p2));
}

#endif
