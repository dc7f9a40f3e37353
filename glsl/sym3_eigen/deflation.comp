/*---
summary = "The best separated eigenvector by cross products, then a stable 2x2 problem in its complement: no trigonometry, no iteration"
source  = "ours; the order of steps after Eberly 2014, the 2x2 problem by Jacobi's angle"

[[variant]]
name = "deflation"

[[variant]]
name = "deflation_precise"
precise = true

[[variant]]
name = "deflation_polished"
summary = "deflation, then one sweep of Jacobi rotations on the matrix in the basis found"
defines = { POLISHED = 1 }
---*/

// The matrix, scaled exactly, is q I + p B with tr B = 0, tr B^2 = 6; its eigenvalues are the roots of
// beta^3 - 3 beta = 2 r, r = det B/2. The one farthest from the others has the sign of r and a size in sqrt(3)..2, where
// Newton's iteration from a line needs two steps: no acos. It is at least sqrt(3) from the others, so its vector from the
// largest cross product is good to rounding whatever the other two do. Those come from the 2x2 matrix that A is
// in the plane orthogonal to it, by Jacobi's angle, and the first eigenvalue once more as a Rayleigh quotient.
//
// Where the eigenvalues are nearly equal the mean q is taken off the diagonal before, exactly, and added at the end.
//
// POLISHED rotates A into that basis and sweeps once: what the vector's rounding left off the diagonal counts.
//
// Domain: any finite matrix, where entries below 2^-60 of the largest count as 0. Source: ours.
// Bound: values within some 2^-21 of the norm, vectors within that over their gap, always orthonormal within 2^-21; no
// loss at equal eigenvalues.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                         scene  near_equal      graded  indefinite  light_cone         edge
//   deflation            0 1e-1  0.027% 2e0  0.034% 5e4      0 3e-3      3x 7e0  0.88% 3e+32
//   deflation_polished   0 1e-1  0.023% 2e0  0.034% 5e4      0 3e-3      3x 7e0  0.95% 3e+32

#include "common/orthogonal.glsl"
#include "common/power_of_two.glsl"
#include "common/jacobi3.glsl"
#include "common/sym3.glsl"

Sym3Eigen sym3_eigen(float xx, float yy, float zz, float xy, float xz, float yz)
{
    vec3 diagonal = vec3(xx, yy, zz);
    vec3 off = vec3(xy, xz, yz);
    float scale = scale_to_one(max(largest_component(diagonal), largest_component(off)));
    diagonal *= scale;
    off *= scale;

    float q = (diagonal.x + diagonal.y + diagonal.z) * (1.0 / 3.0);
    vec3 b = diagonal - q;
    float p = sqrt((dot(b, b) + 2.0 * dot(off, off)) * (1.0 / 6.0));
    vec3 first = vec3(1.0, 0.0, 0.0);
    // Near a multiple of one the differences from it are exact, and their norm is what rounding is small against.
    float shift = 8.0 * p < abs(q) ? q : 0.0;
    diagonal -= shift;
    if (p > 0.0) {
        b /= p;
        vec3 o = off / p;
        float r = 0.5 * (b.x * (b.y * b.z - o.z * o.z) - o.x * (o.x * b.z - o.z * o.y) + o.y * (o.x * o.z - b.y * o.y));
        float size = min(abs(r), 1.0);
        // The line through (0, sqrt(3)) and (1, 2) is within 0.014 of the root, two steps of Newton's leave 1e-8.
        float beta = 1.7320508 + 0.2679492 * size;
        beta -= (beta * (beta * beta - 3.0) - 2.0 * size) / (3.0 * beta * beta - 3.0);
        beta -= (beta * (beta * beta - 3.0) - 2.0 * size) / (3.0 * beta * beta - 3.0);
        beta = r < 0.0 ? -beta : beta;
        first = normalize(sym3_largest_cross(sym3_matrix(b - beta, o)));
    }

    vec3 u = any_orthogonal(first);
    vec3 v = cross(first, u);
    mat3 a = sym3_matrix(diagonal, off);
    vec3 a_first = a * first;
    vec3 au = a * u;
    vec3 av = a * v;
    vec3 values = vec3(dot(first, a_first), dot(u, au), dot(v, av));
    mat3 vectors = mat3(first, u, v);
    float uv = dot(u, av);
    float fu = 0.0;
    float fv = 0.0;
    jacobi_rotate(values.y, values.z, uv, fu, fv, vectors[1], vectors[2]);
#ifdef POLISHED
    fu = dot(a_first, vectors[1]);
    fv = dot(a_first, vectors[2]);
    jacobi_rotate(values.x, values.y, fu, fv, uv, vectors[0], vectors[1]);
    jacobi_rotate(values.x, values.z, fv, fu, uv, vectors[0], vectors[2]);
    jacobi_rotate(values.y, values.z, uv, fu, fv, vectors[1], vectors[2]);
#endif

    sym3_sort(values, vectors);
    values = (values + shift) * reciprocal_power_of_two(scale);
    return Sym3Eigen(values.x, values.y, values.z, vectors[0], vectors[1], vectors[2]);
}
