/*---
summary = "Frisvad's form about the nearer of +z and -z, so that nothing is divided by less than 1"
source  = "Duff, Burgess, Christensen, Hery, Kensler, Liani & Villemin, Building an Orthonormal Basis, Revisited, 2017"

[[variant]]
name = "duff2017"
summary = "Branchless as published, copysign(1, z) made of bits"
defines = { SIGN = "uintBitsToFloat((floatBitsToUint(n.z) & 0x80000000u) | 0x3f800000u)" }

[[variant]]
name = "duff2017_select"
summary = "The sign by a comparison, as ports to GLSL have it: -0 counts as above"
defines = { SIGN = "n.z >= 0.0 ? 1.0 : -1.0" }

[[variant]]
name = "duff2017_sign"
summary = "The sign by sign(z), as some ports to GLSL have it: 0 for z = 0, and a division by it"
defines = { SIGN = "sign(n.z)" }
---*/

// b1, b2 are the images of x and y under the reflection that brings the further of +z and -z to n, or both turned by
// pi: right-handed on either side.
//
// Domain: unit n, the poles and the equator included (duff2017_sign: not z = 0).
// Bound: with d = | |n|^2 - 1 | and u = 2^-24, residuals of d + 6 u.
// Measured: failed, and worst residual; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                      sphere  near_minus_z  near_plus_z   equator  not_unit        edge
//   duff2017         0 1.8e-7      0 1.6e-7     0 1.6e-7  0 1.8e-7  0 4.9e-4    0 4.8e-7
//   duff2017_select  0 1.8e-7      0 1.6e-7     0 1.6e-7  0 1.8e-7  0 4.9e-4    0 4.8e-7
//   duff2017_sign    0 1.8e-7      0 1.6e-7     0 1.6e-7  0 1.8e-7  0 4.9e-4  19.3 % inf

OrthonormalBasis orthonormal_basis(vec3 n)
{
    float s = SIGN;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return OrthonormalBasis(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y));
}
