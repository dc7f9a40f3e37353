/*---
summary = "Control: the course slide exactly as printed, with its three errors; an audit must reject it"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course, as printed"

[[variant]]
name = "as_printed"

[[variant]]
name = "as_printed_precise"
precise = true
---*/

// The formulas of the slide on the 2D eigensystem, errors included, as a control: an audit that lets this through
// is broken.
//
//     e1, e2 = (tr Q - sqrt(tr^2 Q - 4 det Q)) / 2       both printed with a minus: e2 needs a plus
//     E      = q12 V1 + (e - q11) V2   if q11 > q22
//     E      = q12 V2 + (e - q11) V1   otherwise         printed with q11: it is e - q22
//     l      = 1/sqrt(e)                                 printed: with semi-axis vectors it is sqrt(e)
//
// Domain: none. Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines",
// SIGGRAPH 2017 course. Bound: none; two parallel axes of equal length, and the length is 1/l_min.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                         scene           aspect      near_circle            scale             edge
//   as_printed      100 % 3e+11        100 % inf        100 % inf        100 % inf        100 % inf

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    float q11 = dot(v1, v1);
    float q22 = dot(v2, v2);
    float q12 = dot(v1, v2);

    float trace = q11 + q22;
    float det = q11 * q22 - q12 * q12;
    float root = sqrt(trace * trace - 4.0 * det);
    float e1 = 0.5 * (trace - root);
    float e2 = 0.5 * (trace - root);

    vec3 axis1;
    vec3 axis2;
    if (q11 > q22) {
        axis1 = q12 * v1 + (e1 - q11) * v2;
        axis2 = q12 * v1 + (e2 - q11) * v2;
    } else {
        axis1 = q12 * v2 + (e1 - q11) * v1;
        axis2 = q12 * v2 + (e2 - q11) * v1;
    }

    return EllipseAxes(normalize(axis2), normalize(axis1), 1.0 / sqrt(e2), 1.0 / sqrt(e1));
}
