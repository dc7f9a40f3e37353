// Principal semi-axes, as vectors, of the ellipse V1 cos t + V2 sin t, by one of three steps that the including text chooses:
//
//     SEMI_AXES 0   the smaller through the area |V1 x V2| (ours): finite for any V1, V2
//     SEMI_AXES 1   tr^2 - 4 det and the row of the larger diagonal, the textbook form: no guards
//     SEMI_AXES 2   sqrt(Q) by u, v and the row of the larger diagonal: no guards
//
// Source: 1 and 2 as Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", SIGGRAPH 2017,
// correct them. 1 and 2 give 0/0 for circles and orthogonal vectors, and lose the minor axis with aspect^2 2^-24.

#ifndef ROOTQ_SEMI_AXES
#define ROOTQ_SEMI_AXES

#ifndef SEMI_AXES
#define SEMI_AXES 0
#endif

#if SEMI_AXES == 0
#include "common/eigen_angle.glsl"
#endif

// `area` is V1 x V2, which the caller may know better than a difference of products does.
void semi_axes_by_area(vec3 v1, vec3 v2, vec3 area, out vec3 major, out vec3 minor)
{
#if SEMI_AXES == 0
    float d11 = dot(v1, v1);
    float d22 = dot(v2, v2);
    float d12 = dot(v1, v2);
    bool first_is_longer = d11 >= d22;
    float d_long = first_is_longer ? d11 : d22;
    major = vec3(0.0);
    minor = vec3(0.0);
    if (!(d_long > 0.0)) {
        return;
    }
    float k = eigen_tangent(d_long, first_is_longer ? d22 : d11, d12);
    // The conjugate pair turned by the angle whose tangent is k: of length l_max.
    major = (first_is_longer ? v1 + k * v2 : v2 + k * v1) * inversesqrt(1.0 + k * k);
    minor = cross(area, major) / (d_long + k * d12);
#endif
}

void semi_axes(vec3 v1, vec3 v2, out vec3 major, out vec3 minor)
{
#if SEMI_AXES == 0
    semi_axes_by_area(v1, v2, cross(v1, v2), major, minor);
#else
    float q11 = dot(v1, v1);
    float q22 = dot(v2, v2);
    float q12 = dot(v1, v2);
    float trace = q11 + q22;
    float det = q11 * q22 - q12 * q12;
#if SEMI_AXES == 1
    float root = sqrt(trace * trace - 4.0 * det);
    float e_max = 0.5 * (trace + root);
    float e_min = 0.5 * (trace - root);
#else
    float root = sqrt(det);
    float u = 0.5 * sqrt(trace - 2.0 * root);
    float v = 0.5 * sqrt(trace + 2.0 * root);
    float e_max = (u + v) * (u + v);
    float e_min = (u - v) * (u - v);
#endif
    if (q11 > q22) {
        major = q12 * v1 + (e_max - q11) * v2;
        minor = q12 * v1 + (e_min - q11) * v2;
    } else {
        major = q12 * v2 + (e_max - q22) * v1;
        minor = q12 * v2 + (e_min - q22) * v1;
    }
    major = sqrt(e_max) * normalize(major);
    minor = sqrt(e_min) * normalize(minor);
#endif
}

#endif
