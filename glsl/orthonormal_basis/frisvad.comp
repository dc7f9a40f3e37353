/*---
summary = "Quaternion rotation of z to n, no square root; the pole -z by a fixed basis"
source  = "Frisvad, Building an orthonormal basis from a 3D unit vector without normalization, 2012"

[[variant]]
name = "frisvad2012"
summary = "As published: the fixed basis for z < -0.9999999, which leaves 1 + z two steps of f32 wide"
defines = { POLE = "-0.9999999" }

[[variant]]
name = "frisvad_999999"
summary = "The fixed basis for z < -0.999999, as many ports have it"
defines = { POLE = "-0.999999" }

[[variant]]
name = "frisvad_max2017"
summary = "The fixed basis for z < -0.9999805689, where both branches are equally wrong (Max, Improved accuracy when building an orthonormal basis, 2017)"
defines = { POLE = "-0.9999805689" }

[[variant]]
name = "frisvad_unguarded"
summary = "No fixed basis at all: a control"
---*/

// b1, b2 are the images of x and y under the shortest rotation of z to n.
//
// Domain: unit n, not -z without POLE.
// Bound: with d = | |n|^2 - 1 | the residuals are up to d/(1 + z), and rounding 1 + z adds u/(1 + z), u = 2^-24: 1e-3
// is passed at 1 + z = 1e-4, long before any published POLE. In the fixed basis n leans by sqrt(2 (1 + z)).
// Measured: failed, and worst residual; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                          sphere   near_minus_z  near_plus_z    equator      not_unit           edge
//   frisvad2012          24x 0.12    35.9 % 1.25     0 1.6e-7  1x 5.8e-3  18.7 % 5.5e6    1.49 % 2.00
//   frisvad_999999       24x 0.01    24.4 % 0.12     0 1.6e-7  1x 5.8e-3  18.0 % 1.7e5    0.78 % 0.10
//   frisvad_max2017    25x 5.6e-3  25.6 % 6.2e-3     0 1.6e-7  1x 5.1e-3    17.3 % 566  2.72 % 6.2e-3
//   frisvad_unguarded     25x inf    38.4 % 3.00     0 1.6e-7  1x 5.8e-3    20.3 % inf     5.41 % inf

OrthonormalBasis orthonormal_basis(vec3 n)
{
#ifdef POLE
    if (n.z < POLE) {
        return OrthonormalBasis(vec3(0.0, -1.0, 0.0), vec3(-1.0, 0.0, 0.0));
    }
#endif
    float a = 1.0 / (1.0 + n.z);
    float b = -n.x * n.y * a;
    return OrthonormalBasis(vec3(1.0 - n.x * n.x * a, b, -n.x), vec3(b, 1.0 - n.y * n.y * a, -n.y));
}
