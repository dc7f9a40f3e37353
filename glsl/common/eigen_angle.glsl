// The rotation that diagonalises a symmetric 2x2 matrix.

#ifndef ROOTQ_EIGEN_ANGLE
#define ROOTQ_EIGEN_ANGLE

// The tangent of the angle from the longer of two vectors to the major axis, in their coordinates, for the dot
// products d_long >= d_short and d12: k = d12 / (tau + h) with tau = (d_long - d_short)/2, h = hypot(tau, d12).
// |k| <= 1; 0 for a circle. Written with z = tau/|d12|, so that nothing is squared that could leave the range.
// Then d_long + k d12 is the larger eigenvalue, and long + k short its axis, both without cancellation.
// Source: the angle of Jacobi's method (Golub & Van Loan, "Matrix Computations", section 8.5), small root.
float eigen_tangent(float d_long, float d_short, float d12)
{
    if (d12 == 0.0) {
        return 0.0;
    }
    float z = min(0.5 * (d_long - d_short) / abs(d12), 1.0e18);
    float k = 1.0 / (z + sqrt(1.0 + z * z));
    return d12 < 0.0 ? -k : k;
}

#endif
