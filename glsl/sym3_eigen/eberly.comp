/*---
summary = "Prescaled trigonometric eigenvalues; first vector by cross products, second in its complement, third by orthogonality"
source  = "Eberly, A Robust Eigensolver for 3x3 Symmetric Matrices, Geometric Tools 2014"

[[variant]]
name = "eberly"

[[variant]]
name = "eberly_precise"
precise = true
---*/

// Eigenvalues as Smith's (see `wikipedia`) of the matrix over its largest entry. The sign of the determinant says which
// of the extreme eigenvalues is the farther from the middle one: its vector comes first, from the largest cross product
// of rows; that of the middle one from a 2x2 problem in the plane orthogonal to it; the last by orthogonality.
//
// Domain: any finite matrix. Source: Eberly 2014.
// Bound: with an exact acos (Vulkan allows 4096 ULP) values within some 2^-22 of the norm, near a double eigenvalue its two
// within 2^-11 of it; vectors orthonormal always, those of a close pair as wrong as its values.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                      scene  near_equal   graded  indefinite  light_cone       edge
//   eberly           11% 2e0     41% 2e0  86% 3e9    5.4% 1e1     65% 2e4  19% 1e+36
//   eberly_precise   11% 2e0     41% 2e0  86% 3e9    5.4% 1e1     65% 2e4  20% 1e+36

#include "common/sym3.glsl"

vec3 in_complement(mat3 a, vec3 first, float value)
{
    vec3 u = abs(first.x) > abs(first.y) ? vec3(-first.z, 0.0, first.x) * inversesqrt(first.x * first.x + first.z * first.z)
                                         : vec3(0.0, first.z, -first.y) * inversesqrt(first.y * first.y + first.z * first.z);
    vec3 v = cross(first, u);
    vec3 au = a * u;
    vec3 av = a * v;
    float m00 = dot(u, au) - value;
    float m01 = dot(u, av);
    float m11 = dot(v, av) - value;

    // The row of larger size; the vector orthogonal to it, scaled by its larger entry.
    float row0 = abs(m00) >= abs(m11) ? m00 : m11;
    bool upper = abs(m00) >= abs(m11);
    float largest = max(abs(row0), abs(m01));
    if (!(largest > 0.0)) {
        return u;
    }
    float ratio;
    float x;
    float y;
    if (abs(row0) >= abs(m01)) {
        ratio = m01 / row0;
        y = inversesqrt(1.0 + ratio * ratio);
        x = ratio * y;
    } else {
        ratio = row0 / m01;
        x = inversesqrt(1.0 + ratio * ratio);
        y = ratio * x;
    }
    return upper ? x * u - y * v : y * u - x * v;
}

Sym3Eigen sym3_eigen(float xx, float yy, float zz, float xy, float xz, float yz)
{
    vec3 diagonal = vec3(xx, yy, zz);
    vec3 off = vec3(xy, xz, yz);
    vec3 sizes = max(abs(diagonal), abs(off));
    float scale = max(sizes.x, max(sizes.y, sizes.z));
    if (!(scale > 0.0)) {
        return Sym3Eigen(0.0, 0.0, 0.0, vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    }
    diagonal /= scale;
    off /= scale;
    float norm = dot(off, off);
    if (!(norm > 0.0)) {
        mat3 vectors = mat3(1.0);
        sym3_sort(diagonal, vectors);
        diagonal *= scale;
        return Sym3Eigen(diagonal.x, diagonal.y, diagonal.z, vectors[0], vectors[1], vectors[2]);
    }

    float q = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
    vec3 b = diagonal - q;
    float p = sqrt((dot(b, b) + 2.0 * norm) / 6.0);
    float c00 = b.y * b.z - off.z * off.z;
    float c01 = off.x * b.z - off.z * off.y;
    float c02 = off.x * off.z - b.y * off.y;
    float half_determinant = clamp(0.5 * (b.x * c00 - off.x * c01 + off.y * c02) / (p * p * p), -1.0, 1.0);
    float angle = acos(half_determinant) / 3.0;
    float beta2 = 2.0 * cos(angle);
    float beta0 = 2.0 * cos(angle + 2.09439510239);
    float beta1 = -(beta0 + beta2);
    vec3 values = q + p * vec3(beta0, beta1, beta2);

    mat3 a = sym3_matrix(diagonal, off);
    vec3 q0;
    vec3 q1;
    vec3 q2;
    if (half_determinant >= 0.0) {
        q2 = normalize(sym3_largest_cross(a - mat3(values.z)));
        q1 = in_complement(a, q2, values.y);
        q0 = cross(q1, q2);
    } else {
        q0 = normalize(sym3_largest_cross(a - mat3(values.x)));
        q1 = in_complement(a, q0, values.y);
        q2 = cross(q0, q1);
    }
    values *= scale;
    return Sym3Eigen(values.x, values.y, values.z, q0, q1, q2);
}
