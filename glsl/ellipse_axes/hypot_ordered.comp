/*---
summary = "Eigenvalues mid +- hypot(tau, q12): no cancellation under the root, axes from the row of the larger diagonal"
source  = "The closed form of a symmetric 2x2 matrix (Jacobi's angle), as viewers of 2D covariances use it"

[[variant]]
name = "hypot_ordered"

[[variant]]
name = "hypot_ordered_precise"
precise = true
---*/

// The eigenvalues of Q about the middle of its diagonal. tr^2 - 4 det is a difference that cancels near circles;
// written as a sum of two squares it cannot, and is never negative.
//
//     mid = (q11 + q22)/2, tau = |q11 - q22|/2, h = hypot(tau, q12)
//     e_max = mid + h, e_min = mid - h
//     major ~ V_long + k V_short, minor ~ V_short - k V_long, k = q12 / (tau + h)
//
// Domain: lengths between 2^-30 and 2^30; parallel, equal and zero vectors and circles included: always finite unit
// axes. e_min is clamped at 0 and the minor axis made orthogonal (ours).
// Source: Golub & Van Loan, "Matrix Computations", section 8.5 (the angle).
// Bound: e_min = mid - h still cancels: relative error about 2^-24 aspect^2, as in `naive`; l_max within 4 u,
// u = 2^-24.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                            scene           aspect      near_circle            scale             edge
//   hypot_ordered          0 1e+03     57.8 % 4e+09           8x 2.1          0 1e+04       37.6 % inf

#include "common/hypot.glsl"
#include "common/orthogonal.glsl"

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    float q11 = dot(v1, v1);
    float q22 = dot(v2, v2);
    float q12 = dot(v1, v2);

    float mid = 0.5 * (q11 + q22);
    if (!(mid > 0.0)) {
        return EllipseAxes(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), 0.0, 0.0);
    }
    float tau = 0.5 * abs(q11 - q22);
    float h = hypot(tau, q12);
    float k = h > 0.0 ? q12 / (tau + h) : 0.0;

    vec3 major = q11 >= q22 ? v1 + k * v2 : v2 + k * v1;
    vec3 minor = q11 >= q22 ? v2 - k * v1 : v1 - k * v2;
    major = normalize(major);
    minor = orthogonal_part(minor, major);
    minor = dot(minor, minor) > 0.0 ? normalize(minor) : any_orthogonal(major);

    return EllipseAxes(major, minor, sqrt(mid + h), sqrt(max(mid - h, 0.0)));
}
