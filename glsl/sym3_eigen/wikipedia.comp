/*---
summary = "Shift, scale, acos(det/2)/3; eigenvectors as columns of products of two shifted matrices"
source  = "Smith, Eigenvalues of a symmetric 3x3 matrix, CACM 1961, as in Wikipedia's article on eigenvalue algorithms"

[[variant]]
name = "wikipedia"

[[variant]]
name = "wikipedia_precise"
precise = true

[[variant]]
name = "wikipedia_cross"
summary = "The same eigenvalues; each eigenvector by itself, from the largest cross product of two rows (point-cloud tools)"
defines = { CROSS = 1 }
---*/

// Eigenvalues of A with q = tr A/3, p = sqrt(tr (A - q I)^2/6), r = det((A - q I)/p)/2, phi = acos(r)/3:
//
//     e2 = q + 2 p cos(phi), e0 = q + 2 p cos(phi + 120 degrees), e1 = 3 q - e0 - e2
//
// By Cayley and Hamilton the columns of (A - ej I)(A - ek I) are eigenvectors of the third eigenvalue; the largest is
// taken. CROSS: rows of A - e I are orthogonal to its eigenvector. Nothing but the published guard on r is added.
//
// Domain: entries within 2^-20..2^20, three distinct eigenvalues. Source: Smith 1961.
// Bound: with an exact acos (Vulkan allows 4096 ULP) values within some 2^-22 of the norm, and near a double eigenvalue,
// r = +-1, the two within the root of that, 2^-11; vectors have no bound there (0/0), and nothing makes them
// orthogonal.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                       scene   near_equal       graded  indefinite  light_cone      edge
//   wikipedia         11% n1x      83% 2e0  89% n0.097%    5.4% 1e1     65% 2e4  48% n15%
//   wikipedia_cross   11% n1x  83% n0.014%   89% n0.11%    5.4% 1e1     65% 2e4  48% n15%

#include "common/sym3.glsl"

#ifdef CROSS
vec3 eigenvector(mat3 a, float value, float other1, float other2)
{
    return normalize(sym3_largest_cross(a - mat3(value)));
}
#else
vec3 eigenvector(mat3 a, float value, float other1, float other2)
{
    mat3 product = (a - mat3(other1)) * (a - mat3(other2));
    float xx = dot(product[0], product[0]);
    float yy = dot(product[1], product[1]);
    float zz = dot(product[2], product[2]);
    vec3 column = xx >= yy && xx >= zz ? product[0] : (yy >= zz ? product[1] : product[2]);
    return normalize(column);
}
#endif

Sym3Eigen sym3_eigen(float xx, float yy, float zz, float xy, float xz, float yz)
{
    vec3 diagonal = vec3(xx, yy, zz);
    vec3 off = vec3(xy, xz, yz);
    float p1 = dot(off, off);
    if (p1 == 0.0) {
        mat3 vectors = mat3(1.0);
        sym3_sort(diagonal, vectors);
        return Sym3Eigen(diagonal.x, diagonal.y, diagonal.z, vectors[0], vectors[1], vectors[2]);
    }

    float q = (xx + yy + zz) / 3.0;
    vec3 shifted = diagonal - q;
    float p2 = dot(shifted, shifted) + 2.0 * p1;
    float p = sqrt(p2 / 6.0);
    vec3 b = shifted / p;
    vec3 o = off / p;
    float r = 0.5 * (b.x * (b.y * b.z - o.z * o.z) - o.x * (o.x * b.z - o.z * o.y) + o.y * (o.x * o.z - b.y * o.y));

    float phi;
    if (r <= -1.0) {
        phi = 1.04719755120;
    } else if (r >= 1.0) {
        phi = 0.0;
    } else {
        phi = acos(r) / 3.0;
    }
    float e2 = q + 2.0 * p * cos(phi);
    float e0 = q + 2.0 * p * cos(phi + 2.09439510239);
    float e1 = 3.0 * q - e0 - e2;

    mat3 a = sym3_matrix(diagonal, off);
    return Sym3Eigen(e0, e1, e2, eigenvector(a, e0, e1, e2), eigenvector(a, e1, e0, e2), eigenvector(a, e2, e0, e1));
}
