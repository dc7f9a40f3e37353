/*---
summary = "Stable 2D step (Jacobi's angle, area from the cross product), secular equation, exact horizon"
source  = "ours"
[[variant]]
name = "secular_exact"
defines = { EXACT_HORIZON = 1 }
[[variant]]
name = "secular_lut"
summary = "The secular cone; the horizon by the 64 x 64 table of spheres, bilinear in the shader"
tables = { sphere_lut = "buffer" }
[[variant]]
name = "secular_lut_sampler"
summary = "The secular cone; the horizon by the table of spheres through a sampler"
tables = { sphere_lut = "image" }
[[variant]]
name = "secular_sphere_analytic"
summary = "The secular cone; an equal-area sphere clipped by the stable closed form"
defines = { HORIZON = 3 }
[[variant]]
name = "secular_rational"
summary = "The secular cone; the horizon by a rational fit"
defines = { HORIZON = 2 }
---*/

// The ellipse's own axes first, then the confocal coordinate of the point in their frame, whose equation has positive
// terms only.
//
// Domain: any finite light and matrix; edge-on and empty lights give 0.
// Source: ours; the angle as in Jacobi's method.
// Bound: as `direct_exact`.
// Measured (lavapipe, Mesa 22.3, 1 M a scenario): secular_exact has no failure in any scenario but edge (3.5 %, extreme
// matrices), p99 of the error below 7e-7, nothing that is not finite.

#ifndef EXACT_HORIZON
#include "common/horizon_choice.glsl"
#else
#include "common/clipped_ellipse.glsl"
#endif
#include "common/disk_cone.glsl"
#include "common/eigen_angle.glsl"

float ltc_disk(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    vec3 C = center;
    vec3 V1 = v1;
    vec3 V2 = v2;
    disk_image(minv, C, V1, V2);

    float swing = length(vec2(V1.z, V2.z));
    vec3 N = cross(V1, V2);
    float area2 = dot(N, N);
    if (C.z <= -swing || !(area2 > DISK_FLAT)) {
        return 0.0;
    }
    float d11 = dot(V1, V1);
    float d22 = dot(V2, V2);
    bool first_is_longer = d11 >= d22;
    vec3 longer = first_is_longer ? V1 : V2;
    vec3 shorter = first_is_longer ? V2 : V1;
    float k = eigen_tangent(max(d11, d22), min(d11, d22), dot(V1, V2));
    vec3 X = longer + k * shorter;
    float x2 = dot(X, X);
    float inverse = inversesqrt(x2);
    X *= inverse;
    vec3 Z = N * inversesqrt(area2);
    vec3 Y = cross(Z, X);
    float hx2 = x2 / (1.0 + k * k);
    vec2 h2 = vec2(hx2, min(area2 / hx2, hx2));

    vec3 c = vec3(dot(X, C), dot(Y, C), dot(Z, C));
    vec3 c2 = c * c;
    float l = cone_lambda(h2, c2);
    if (!(l > 0.0)) {
        return 0.0;
    }
    vec3 axis = cone_axis(h2, c, l);
    float z = dot(vec3(X.z, Y.z, Z.z), axis);
    vec2 w = l / (h2 + l);
    // sqrt(e1 e3/((l + e1)(l + e3))) in the frame's own terms.
    float form = abs(c.z) * sqrt(h2.x / (h2.x + l)) * sqrt(h2.y / (h2.y + l)) * inversesqrt(dot(c2.xy, w * w) + c2.z);
    form = min(form, 1.0);
#ifndef EXACT_HORIZON
    return horizon_of_sphere(z, form);
#else
    if (C.z >= swing) {
        return form * max(z, 0.0);
    }
    DiskCone cone;
    cone.axis = axis.x * X + axis.y * Y + axis.z * Z;
    cone.l = l;
    cone.product = h2.x * h2.y * (c2.z / l);
    cone.form = form;
    vec3 heights;
    vec2 e;
    disk_principal(cone, C, V1, V2, heights, e);
    return clipped_ellipse(heights, e, l, (swing - C.z) * (swing + C.z));
#endif
}
