/*---
summary = "The reflection that brings a pole to n/|n|, of a normal of any length"
source  = "ours, after Householder, Unitary triangularization of a nonsymmetric matrix, 1958, and Duff et al. 2017"

[[variant]]
name = "reflect"

[[variant]]
name = "reflect_scaled"
summary = "reflect, n first scaled by a power of two: any finite n but 0, and a basis for 0"
defines = { SCALED = 1 }
---*/

// With l = |n|, s = copysign(1, z) and v = n + s l z, the reflection x -> x - 2 v (v.x)/(v.v) brings -s z to n/l, and
// v.v = 2 l (l + |z|) does not cancel:
//
//     b1 = x - n.x w    b2 = s (y - n.y w)    with w = v / (l (l + |z|))
//
// A reflection turns handedness round, and so does -s z for z where s = 1: b2 has the sign that makes up for both.
// Duff's form is this for l = 1, and passes on what l lacks to it.
//
// Domain: |n| between 2^-30 and 2^30; SCALED: any finite n, for 0 the basis x, y.
// Bound: residuals of 8 u, u = 2^-24, if square root and division round correctly.
// Measured: failed, and worst residual; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     sphere  near_minus_z  near_plus_z   equator  not_unit      edge
//   reflect         0 2.9e-7      0 2.6e-7     0 2.7e-7  0 2.9e-7  0 3.2e-7  0 2.5e-7
//   reflect_scaled  0 2.9e-7      0 2.6e-7     0 2.7e-7  0 2.9e-7  0 3.2e-7  0 2.5e-7

#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

OrthonormalBasis orthonormal_basis(vec3 n)
{
#ifdef SCALED
    n *= scale_to_one(largest_component(n));
    if (!(dot(n, n) > 0.0)) {
        return OrthonormalBasis(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
    }
#endif
    float l = sqrt(dot(n, n));
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float reach = l + abs(n.z);
    vec2 w = n.xy / (l * reach);
    // v.z = s (l + |z|), so w.z = s/l.
    vec3 b1 = vec3(1.0 - n.x * w.x, -n.x * w.y, -s * n.x / l);
    vec3 b2 = vec3(-s * n.y * w.x, s - s * n.y * w.y, -n.y / l);
    return OrthonormalBasis(b1, b2);
}
