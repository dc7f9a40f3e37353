/*---
summary = "Cross product with a helper direction, normalised; then another cross product"
source  = "Hughes & Moeller, Building an Orthonormal Basis from a Unit Vector, 1999; the others are folklore"

[[variant]]
name = "hughes_moeller1999"
summary = "As published: n turned in the plane xy or yz, by the larger of x and z"
defines = { HELPER = 1 }

[[variant]]
name = "smallest_component"
summary = "The axis on which n has its smallest component: the widest angle to n that an axis can have"
defines = { HELPER = 2 }

[[variant]]
name = "up_z"
summary = "z, or x where |z| >= 0.999: the tangent frame of many importance samplers"
defines = { HELPER = 3 }

[[variant]]
name = "up_unguarded"
summary = "z whatever n is: a control"
defines = { HELPER = 4 }
---*/

// One vector orthogonal to n, normalised, and the cross product of both.
//
// Domain: unit n (up_unguarded: not along z).
// Bound: every helper is an axis or its cross product written out, so that product is n's own components and exact: it
// must only not vanish, however small the angle. With d = | |n|^2 - 1 | and u = 2^-24, residuals of d + 8 u.
// Measured: failed, and worst residual; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                         sphere  near_minus_z  near_plus_z   equator  not_unit        edge
//   hughes_moeller1999  0 4.6e-7      0 3.9e-7     0 4.0e-7  0 4.3e-7  0 4.9e-4    0 4.8e-7
//   smallest_component  0 3.5e-7      0 3.3e-7     0 3.5e-7  0 3.5e-7  0 4.9e-4    0 4.8e-7
//   up_z                0 3.5e-7      0 3.5e-7     0 3.5e-7  0 3.5e-7  0 4.9e-4    0 4.8e-7
//   up_unguarded        0 3.5e-7      0 3.5e-7     0 3.5e-7  0 3.5e-7  0 4.9e-4  10.1 % inf

OrthonormalBasis orthonormal_basis(vec3 n)
{
#if HELPER == 1
    vec3 b2 = abs(n.x) > abs(n.z) ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y);
    b2 *= inversesqrt(dot(b2, b2));
    return OrthonormalBasis(cross(b2, n), b2);
#else
#if HELPER == 2
    vec3 a = abs(n);
    bool x_is_smallest = a.x <= a.y && a.x <= a.z;
    vec3 helper = x_is_smallest ? vec3(1.0, 0.0, 0.0) : a.y <= a.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
#elif HELPER == 3
    vec3 helper = abs(n.z) < 0.999 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
#else
    vec3 helper = vec3(0.0, 0.0, 1.0);
#endif
    vec3 b1 = normalize(cross(helper, n));
    return OrthonormalBasis(b1, cross(n, b1));
#endif
}
