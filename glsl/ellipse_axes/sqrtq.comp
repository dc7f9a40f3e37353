/*---
summary = "Eigenvalues of the square root of Q, from its trace t and determinant d; axes always from the first row"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course"

[[variant]]
name = "sqrtq"

[[variant]]
name = "sqrtq_precise"
precise = true
---*/

// The semi-axis lengths are the eigenvalues of sqrt(Q) itself, whose trace and determinant are known without
// forming it; its diagonal spans half as many orders of magnitude as that of Q.
//
//     d = sqrt(det Q), t = sqrt(tr Q + 2 d)              determinant and trace of sqrt(Q)
//     l = (t +- sqrt(t^2 - 4 d)) / 2,  e = l^2
//     axis = q12 V1 + (e - q11) V2
//
// Domain: aspect ratios up to about 100, V1 and V2 neither orthogonal nor parallel; no guard is added.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", SIGGRAPH 2017.
// Bound: det Q = q11 q22 - q12^2 still cancels, relative error about 2^-24 aspect^2 for skewed vectors, and its
// square root passes half of that on to l_min; det Q < 0 gives NaN throughout. For orthogonal vectors det Q does
// not cancel, and the difference in l_min costs 2^-24 aspect only.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                    scene           aspect      near_circle            scale             edge
//   sqrtq   0.0634 % 1e+03       51.9 % inf         80 % inf       45.5 % inf       98.5 % inf

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    float q11 = dot(v1, v1);
    float q22 = dot(v2, v2);
    float q12 = dot(v1, v2);

    float d = sqrt(q11 * q22 - q12 * q12);
    float t = sqrt(q11 + q22 + 2.0 * d);
    float root = sqrt(t * t - 4.0 * d);
    float l_max = 0.5 * (t + root);
    float l_min = 0.5 * (t - root);

    vec3 major = q12 * v1 + (l_max * l_max - q11) * v2;
    vec3 minor = q12 * v1 + (l_min * l_min - q11) * v2;

    return EllipseAxes(normalize(major), normalize(minor), l_max, l_min);
}
