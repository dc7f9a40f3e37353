/*---
summary = "One Jacobi rotation applied to V1 and V2 themselves; the lengths are those of the rotated vectors"
source  = "One-sided Jacobi method: Hestenes 1958; Golub & Van Loan, Matrix Computations, section 8.6"

[[variant]]
name = "jacobi"

[[variant]]
name = "jacobi_precise"
precise = true
---*/

// A rotation of the pair (V1, V2) by the angle that makes its vectors orthogonal turns them into the semi-axes. No
// eigenvalue is formed, so nothing is lost to squaring: the error of the minor axis is that of one vector sum.
//
//     k     = d12 / (tau + h), tau = |d11 - d22|/2, h = hypot(tau, d12)       tangent of the angle
//     major = (V_long + k V_short) / sqrt(1 + k^2)
//     minor = (V_short - k V_long) / sqrt(1 + k^2)
//
// The sum of the minor axis cancels for nearly parallel vectors, and what the rounding of k leaves along the major
// axis is taken out by one orthogonalisation (ours).
//
// Domain: any V1, V2 with lengths between 2^-30 and 2^30, parallel, equal and zero vectors and circles included:
// always finite unit axes.
// Source: Hestenes, "Inversion of matrices by biorthogonalization and related results", 1958; Golub & Van Loan,
// "Matrix Computations", section 8.6.
// Bound: l_max within 6 u; l_min within 6 u for orthogonal vectors and 2 u aspect for skewed ones, u = 2^-24.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     scene           aspect      near_circle            scale             edge
//   jacobi            0 3.8          0 3e+05           8x 3.9             0 33       13.1 % inf

#include "common/eigen_angle.glsl"
#include "common/orthogonal.glsl"

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    float d11 = dot(v1, v1);
    float d22 = dot(v2, v2);
    float d12 = dot(v1, v2);

    bool first_is_longer = d11 >= d22;
    vec3 longer = first_is_longer ? v1 : v2;
    vec3 shorter = first_is_longer ? v2 : v1;
    float d_long = max(d11, d22);
    if (!(d_long > 0.0)) {
        return EllipseAxes(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), 0.0, 0.0);
    }
    float k = eigen_tangent(d_long, min(d11, d22), d12);
    float cosine = inversesqrt(1.0 + k * k);

    vec3 major = longer + k * shorter;
    float l_max = length(major);
    major /= l_max;

    vec3 minor = orthogonal_part(shorter - k * longer, major);
    float l_min = length(minor);
    minor = l_min > 0.0 ? minor / l_min : any_orthogonal(major);

    return EllipseAxes(major, minor, cosine * l_max, cosine * min(l_min, l_max));
}
