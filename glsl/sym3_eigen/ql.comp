/*---
summary = "One rotation to tridiagonal form, then the QL iteration with implicit shifts"
source  = "Bowdler, Martin, Reinsch & Wilkinson, The QR and QL algorithms for symmetric matrices, 1968; Golub & Van Loan, Matrix Computations, section 8.3"

[[variant]]
name = "ql"

[[variant]]
name = "ql_precise"
precise = true
---*/

// A rotation of y and z takes xz to 0. Then sweeps of rotations with Wilkinson's shift chase the off-diagonal entries to
// 0 from the top down: cubic convergence, two or three sweeps an eigenvalue, twelve allowed.
//
// Domain: entries within 2^-60..2^60. Source: as above.
// Bound: values within some 2^-21 of the norm, vectors within that over their gap and orthonormal within 2^-20.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//           scene  near_equal   graded  indefinite  light_cone        edge
//   ql   51x 4e-1    1.8% 2e0  17% 2e7    28x 3e-2    5.5% 3e1  2.5% 1e+33

#include "common/hypot.glsl"
#include "common/sym3.glsl"

const float NEGLIGIBLE = 5.9604645e-8;
const int SWEEPS = 12;

Sym3Eigen sym3_eigen(float xx, float yy, float zz, float xy, float xz, float yz)
{
    float d[3];
    float e[3];
    vec3 z[3];
    float r = hypot(xy, xz);
    float c = r > 0.0 ? xy / r : 1.0;
    float s = r > 0.0 ? xz / r : 0.0;
    d[0] = xx;
    d[1] = c * c * yy + 2.0 * c * s * yz + s * s * zz;
    d[2] = s * s * yy - 2.0 * c * s * yz + c * c * zz;
    e[0] = r;
    e[1] = (c * c - s * s) * yz + c * s * (zz - yy);
    e[2] = 0.0;
    z[0] = vec3(1.0, 0.0, 0.0);
    z[1] = vec3(0.0, c, s);
    z[2] = vec3(0.0, -s, c);

    for (int l = 0; l < 2; ++l) {
        for (int sweep = 0; sweep < SWEEPS; ++sweep) {
            int m = l;
            while (m < 2 && abs(e[m]) > NEGLIGIBLE * (abs(d[m]) + abs(d[m + 1]))) {
                ++m;
            }
            if (m == l) {
                break;
            }
            // Wilkinson's shift from the leading 2x2 block.
            float g = 0.5 * (d[l + 1] - d[l]) / e[l];
            float root = hypot(g, 1.0);
            g = d[m] - d[l] + e[l] / (g < 0.0 ? g - root : g + root);
            float sine = 1.0;
            float cosine = 1.0;
            float p = 0.0;
            bool split = false;
            for (int i = m - 1; i >= l; --i) {
                float f = sine * e[i];
                float b = cosine * e[i];
                float length = hypot(f, g);
                e[i + 1] = length;
                if (length == 0.0) {
                    d[i + 1] -= p;
                    e[m] = 0.0;
                    split = true;
                    break;
                }
                sine = f / length;
                cosine = g / length;
                g = d[i + 1] - p;
                float t = (d[i] - g) * sine + 2.0 * cosine * b;
                p = sine * t;
                d[i + 1] = g + p;
                g = cosine * t - b;
                vec3 upper = z[i + 1];
                z[i + 1] = sine * z[i] + cosine * upper;
                z[i] = cosine * z[i] - sine * upper;
            }
            if (!split) {
                d[l] -= p;
                e[l] = g;
                e[m] = 0.0;
            }
        }
    }

    vec3 values = vec3(d[0], d[1], d[2]);
    mat3 vectors = mat3(z[0], z[1], z[2]);
    sym3_sort(values, vectors);
    return Sym3Eigen(values.x, values.y, values.z, vectors[0], vectors[1], vectors[2]);
}
