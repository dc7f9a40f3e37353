/*---
summary = "Cyclic Jacobi rotations, five sweeps at most"
source  = "Jacobi 1846; Rutishauser, The Jacobi method for real symmetric matrices, 1966"

[[variant]]
name = "jacobi"

[[variant]]
name = "jacobi_precise"
precise = true

[[variant]]
name = "jacobi_shifted"
summary = "Cyclic Jacobi rotations of the matrix less its mean eigenvalue, where that is exact"
defines = { SHIFTED = 1 }

[[variant]]
name = "jacobi_3"
summary = "Cyclic Jacobi rotations, three sweeps"
defines = { JACOBI_SWEEPS = 3 }

[[variant]]
name = "jacobi_4"
summary = "Cyclic Jacobi rotations, four sweeps"
defines = { JACOBI_SWEEPS = 4 }
---*/

// Each rotation makes one off-diagonal entry 0; sweeps over all three converge quadratically, and stop when nothing is
// left to do. Graded matrices keep more of their small eigenvalues than any closed form leaves.
//
// SHIFTED (ours): near a multiple of one the differences from it are exact in f32, and rounding is small against them.
//
// Domain: any finite matrix. Source: Rutishauser 1966.
// Bound: values within some 2^-22 of the norm, vectors within that over their gap and orthonormal within 2^-21.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                     scene  near_equal     graded  indefinite  light_cone        edge
//   jacobi           0 8e-2   0.15% 2e0  0.26% 2e4      0 5e-3     22x 7e0  1.5% 6e+32
//   jacobi_shifted   0 8e-2  0.066% 2e0  0.26% 2e4      0 5e-3     22x 7e0  1.5% 6e+32
//   jacobi_3         0 8e-2   0.14% 2e0  0.26% 2e4      0 5e-3     22x 7e0  1.5% 6e+32
//   jacobi_4         0 8e-2   0.14% 2e0  0.26% 2e4      0 5e-3     22x 7e0  1.5% 6e+32

#include "common/jacobi3.glsl"
#include "common/sym3.glsl"

Sym3Eigen sym3_eigen(float xx, float yy, float zz, float xy, float xz, float yz)
{
    vec3 values = vec3(xx, yy, zz);
    vec3 off = vec3(xy, xz, yz);
    mat3 vectors;
#ifdef SHIFTED
    float mean = (xx + yy + zz) / 3.0;
    vec3 deviation = max(abs(values - mean), abs(off));
    float shift = 8.0 * max(deviation.x, max(deviation.y, deviation.z)) < abs(mean) ? mean : 0.0;
    values -= shift;
    jacobi3(values, off, vectors);
    values += shift;
#else
    jacobi3(values, off, vectors);
#endif
    sym3_sort(values, vectors);
    return Sym3Eigen(values.x, values.y, values.z, vectors[0], vectors[1], vectors[2]);
}
