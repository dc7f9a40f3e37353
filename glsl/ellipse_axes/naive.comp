/*---
summary = "Eigenvalues of Q = V^T V from tr^2 - 4 det, axes always from the first row of Q - e I"
source  = "The textbook form that Heitz & Hill (Real-Time Line- and Disk-Light Shading, SIGGRAPH 2017 course) start from, its printing errors corrected"

[[variant]]
name = "naive"

[[variant]]
name = "naive_precise"
precise = true

[[variant]]
name = "ordered"
summary = "The naive eigenvalues, axes from the row of Q - e I with the larger diagonal"
defines = { ORDERED = 1 }

[[variant]]
name = "ordered_precise"
summary = "The naive eigenvalues, axes from the row of Q - e I with the larger diagonal"
defines = { ORDERED = 1 }
precise = true
---*/

// Axes of the ellipse V1 cos t + V2 sin t from the 2x2 matrix Q of the dot products: its eigenvalues are the
// squared semi-axis lengths, its eigenvectors the coordinates of the axes in V1, V2.
//
//     e    = (tr Q +- sqrt(tr^2 Q - 4 det Q)) / 2
//     axis = q12 V1 + (e - q11) V2                       from the first row of Q - e I
//     axis = q12 V2 + (e - q22) V1                       from the second row; ORDERED takes it unless q11 > q22
//
// Domain: aspect ratios up to about 100, V1 and V2 neither orthogonal nor parallel. No guard is added to the
// published formulas: orthogonal vectors and exact circles give 0/0.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", SIGGRAPH 2017
// course. The slide prints both eigenvalues with a minus, the lengths as 1/sqrt(e) and q11 in the second row; the
// forms above follow from Q (`as_printed` keeps the slide's).
// Bound: e_min is a difference of numbers of size tr Q, so its relative error is about 2^-24 aspect^2, and so is
// that of det Q: past aspect 4096 nothing is left, and e_min < 0 makes the minor length NaN.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                      scene           aspect      near_circle            scale             edge
//   naive     0.0332 % 8e+02       56.2 % inf       77.9 % inf       45.4 % inf       99.1 % inf
//   ordered   0.0321 % 8e+02       56.2 % inf       77.9 % inf       44.9 % inf         99 % inf

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    float q11 = dot(v1, v1);
    float q22 = dot(v2, v2);
    float q12 = dot(v1, v2);

    float trace = q11 + q22;
    float det = q11 * q22 - q12 * q12;
    float root = sqrt(trace * trace - 4.0 * det);
    float e_max = 0.5 * (trace + root);
    float e_min = 0.5 * (trace - root);

    vec3 major = q12 * v1 + (e_max - q11) * v2;
    vec3 minor = q12 * v1 + (e_min - q11) * v2;
#ifdef ORDERED
    if (!(q11 > q22)) {
        major = q12 * v2 + (e_max - q22) * v1;
        minor = q12 * v2 + (e_min - q22) * v1;
    }
#endif

    return EllipseAxes(normalize(major), normalize(minor), sqrt(e_max), sqrt(e_min));
}
