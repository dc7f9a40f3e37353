// Irradiance of an ellipse with conjugate semi-axes by the published pipeline, and what public ports of it add:
//
//     SHORTCUT            |cos| of V1, V2 up to which they count as the axes; 1e-4 as published
//     CLAMP_DET           det Q >= 0
//     CLAMP_DISCRIMINANT  the cubic's discriminant >= 0
//     CLAMP_RADICANDS     the depressed cubics' radicands >= 0
//     CLAMP_TANGENTS      the radicands of both tangents >= 0
//     CLAMP_FORM_FACTOR   the form factor >= 0: on devices whose max() drops a NaN, NaN becomes darkness
//     OVER_B              the cubic's unknown is e/b, which a far light does not overflow
//     NORMALIZE_THIRD     the third axis is normalised after the cross product
//     FLOOR               d11, d22, e_min, e_max, a - e2 and the dividing roots are at least this
//     SANITIZE            a result that is not a number becomes 0
//
// Domain: generic lights. A disk that faces the point has a double root, and the discriminant's sign is rounding; a far
// light overflows the discriminant as (4/81)(d/r)^12. No guard beyond those named.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", SIGGRAPH 2017; fixes as
// seen in public ports.

#ifndef ROOTQ_DISK_TALK2017
#define ROOTQ_DISK_TALK2017

#ifndef SHORTCUT
#define SHORTCUT 1e-4
#endif

#include "common/cone_quadric.glsl"
#include "common/cubic_blinn.glsl"
#include "common/horizon_choice.glsl"

// Centre C and conjugate semi-axes V1, V2 after Minv.
float disk_talk2017(vec3 C, vec3 V1, vec3 V2)
{
    float d11 = dot(V1, V1);
    float d22 = dot(V2, V2);
    float d12 = dot(V1, V2);
#ifdef FLOOR
    d11 = max(d11, FLOOR);
    d22 = max(d22, FLOOR);
#endif
    // Squared semi-axis lengths.
    float e_x = d11;
    float e_y = d22;
    if (abs(d12) / sqrt(d11 * d22) > SHORTCUT) {
        float trace = d11 + d22;
        float det = d11 * d22 - d12 * d12;
#ifdef CLAMP_DET
        det = max(det, 0.0);
#endif
        float root = sqrt(det);
        float u = 0.5 * sqrt(trace - 2.0 * root);
        float v = 0.5 * sqrt(trace + 2.0 * root);
        e_x = (u + v) * (u + v);
        e_y = (u - v) * (u - v);
#ifdef FLOOR
        e_x = max(e_x, FLOOR);
        e_y = max(e_y, FLOOR);
#endif
        vec3 major;
        vec3 minor;
        if (d11 > d22) {
            major = d12 * V1 + (e_x - d11) * V2;
            minor = d12 * V1 + (e_y - d11) * V2;
        } else {
            major = d12 * V2 + (e_x - d22) * V1;
            minor = d12 * V2 + (e_y - d22) * V1;
        }
        V1 = normalize(major);
        V2 = normalize(minor);
    } else {
        V1 *= inversesqrt(d11);
        V2 *= inversesqrt(d22);
    }

    vec3 V3 = cross(V1, V2);
#ifdef NORMALIZE_THIRD
    V3 = normalize(V3);
#endif
    if (dot(C, V3) < 0.0) {
        V3 = -V3;
    }
    float height = dot(V3, C);
    float x0 = dot(V1, C) / height;
    float y0 = dot(V2, C) / height;

    vec3 direction;
    vec2 tangents;
#ifdef OVER_B
    float ratio = e_y / e_x;
    float inverse_b = e_y / (height * height);
    vec3 roots = cubic_blinn(cone_polynomial_over_b(ratio, inverse_b, x0, y0));
    direction = normalize(vec3(x0 / (1.0 - roots.y / ratio), y0 / (1.0 - roots.y), 1.0));
    tangents = cone_root_tangents(roots.y, roots.x, roots.z);
#else
    float a = height * height / e_x;
    float b = height * height / e_y;
    vec3 roots = cubic_blinn(cone_polynomial(a, b, x0, y0));
    direction = cone_direction(a, b, x0, y0, roots.y, 1.0);
    tangents = cone_root_tangents(roots.y, roots.x, roots.z);
#endif
    float z = dot(vec3(V1.z, V2.z, V3.z), direction);

    vec2 squares = tangents * tangents;
    float form = tangents.x * tangents.y * inversesqrt((1.0 + squares.x) * (1.0 + squares.y));
#ifdef CLAMP_FORM_FACTOR
    form = max(form, 0.0);
#endif
    float irradiance = horizon_of_sphere(z, form);
#ifdef SANITIZE
    irradiance = isnan(irradiance) || isinf(irradiance) ? 0.0 : irradiance;
#endif
    return irradiance;
}

#endif
