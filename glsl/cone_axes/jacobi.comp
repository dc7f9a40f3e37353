/*---
summary = "All eigenvalues of the cone's quadric by cyclic Jacobi rotations"
source  = "Jacobi 1846; Rutishauser, The Jacobi method for real symmetric matrices, 1966; the quadric as in Heitz & Hill 2017"

[[variant]]
name = "jacobi"

[[variant]]
name = "jacobi_dual"
summary = "All eigenvalues of the dual matrix S = diag(hx^2, hy^2, 0) - c c^T by cyclic Jacobi rotations"
defines = { DUAL = 1 }
---*/

// The eigenvector of the one negative eigenvalue is the mean direction; tan^2 of the half angles are its size over the
// two positive ones, or, for DUAL, theirs over it.
//
// Domain: centres off the light's plane, non-zero semi-axes, lengths within 2^-20..2^20 of 1.
// Source: Rutishauser 1966.
// Bound: every eigenvalue within some 2^-21 of the largest in size. The quadric's negative one is about 1 beside
// the squared distance in radii, S's positive ones are about 1 beside it: far lights lose either. Small eigenvalues
// of the wrong sign are clamped to 0, and no better for it.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                     scene  facing      far  near_plane   needle       edge
//   jacobi        3.4% 3e-1  0 1e-6  70% 2e2      0 1e-3  32% 3e1  36% n1.7%
//   jacobi_dual   4.5% 5e-1  0 2e-6  72% 2e2      0 9e-4  36% 6e1  29% n6.6%

#include "common/jacobi3.glsl"

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
#ifdef DUAL
    vec3 d = vec3(half_x * half_x, half_y * half_y, 0.0) - center * center;
    vec3 o = -vec3(center.x * center.y, center.x * center.z, center.y * center.z);
#else
    float height = abs(center.z);
    float a = height * height / (half_x * half_x);
    float b = height * height / (half_y * half_y);
    float x0 = center.x / center.z;
    float y0 = center.y / center.z;
    vec3 d = vec3(a, b, a * x0 * x0 + b * y0 * y0 - 1.0);
    vec3 o = vec3(0.0, -a * x0, -b * y0);
#endif
    mat3 vectors;
    jacobi3(d, o, vectors);

    float least = d.x;
    vec3 axis = vectors[0];
    vec2 others = d.yz;
    if (d.y < least) {
        least = d.y;
        axis = vectors[1];
        others = d.xz;
    }
    if (d.z < least) {
        least = d.z;
        axis = vectors[2];
        others = d.xy;
    }
    axis = normalize(dot(axis, center) < 0.0 ? -axis : axis);
#ifdef DUAL
    vec2 squares = max(others, 0.0) / -least;
#else
    vec2 squares = max(-least / others, 0.0);
#endif
    vec2 tangents = sqrt(squares);
    return ConeAxes(axis, max(tangents.x, tangents.y), min(tangents.x, tangents.y));
}
