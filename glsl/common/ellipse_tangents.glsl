// The tangents of the half angles of the cone over an ellipse: its semi-axes (semi_axes.glsl, as SEMI_AXES chooses), the centre in
// their frame, and the cone's secular equation. Vectors of about 1.

#ifndef ROOTQ_ELLIPSE_TANGENTS
#define ROOTQ_ELLIPSE_TANGENTS

#include "common/cone_secular.glsl"
#include "common/semi_axes.glsl"

// (major, minor); (0, 0) without an area, CONE_LARGEST where the origin lies in the ellipse.
vec2 ellipse_tangents(vec3 C, vec3 v1, vec3 v2)
{
    vec3 major;
    vec3 minor;
    semi_axes(v1, v2, major, minor);
    float hx = length(major);
    float hy = length(minor);
    if (!(hy > 0.0)) {
        return vec2(0.0);
    }
    vec3 x = major / hx;
    vec3 y = minor / hy;
    vec3 axis;
    float tan_major;
    float tan_minor;
    cone_secular(hx, hy, vec3(dot(x, C), dot(y, C), dot(cross(x, y), C)), axis, tan_major, tan_minor);
    return vec2(tan_major, tan_minor);
}

#endif
