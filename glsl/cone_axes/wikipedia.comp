/*---
summary = "Eigenvalues of the cone's quadric by shift, scale and acos(det/2)/3: the snippet that the talk warns of"
source  = "Smith, Eigenvalues of a symmetric 3x3 matrix, CACM 1961, as in Wikipedia's article on eigenvalue algorithms"

[[variant]]
name = "wikipedia"

[[variant]]
name = "wikipedia_precise"
precise = true
---*/

// Eigenvalues of A = [a, 0, -a x0; 0, b, -b y0; -a x0, -b y0, a x0^2 + b y0^2 - 1] from
//
//     q = tr A/3, p = sqrt(tr (A - q I)^2/6), r = det((A - q I)/p)/2, phi = acos(r)/3
//     e = q + 2 p cos(phi), q + 2 p cos(phi + 120 degrees), and the third from the trace
//
// with the published guard on r, which makes acos safe: nothing else turns NaN, and nothing says how little is right.
//
// Domain: centres off the light's plane, non-zero semi-axes. Source: Smith 1961.
// Bound: every root is off by 2^-24 of the largest, more by what acos loses near r = +-1; a far light's largest root is
// its squared distance in radii, its negative root about 1.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                   scene     facing       far  near_plane    needle      edge
//   wikipedia   48% n4.7%  3.5% 1e-1  99% n52%    85% n11%  78% n13%  66% n45%

#include "common/cone_quadric.glsl"

ConeAxes cone_axes(float half_x, float half_y, vec3 center)
{
    float a;
    float b;
    float x0;
    float y0;
    cone_quadric(half_x, half_y, center, a, b, x0, y0);

    float a33 = a * x0 * x0 + b * y0 * y0 - 1.0;
    float a13 = -a * x0;
    float a23 = -b * y0;
    float q = (a + b + a33) / 3.0;
    float p1 = a13 * a13 + a23 * a23;
    float p2 = (a - q) * (a - q) + (b - q) * (b - q) + (a33 - q) * (a33 - q) + 2.0 * p1;
    float p = sqrt(p2 / 6.0);
    float b11 = (a - q) / p;
    float b22 = (b - q) / p;
    float b33 = (a33 - q) / p;
    float b13 = a13 / p;
    float b23 = a23 / p;
    float r = 0.5 * (b11 * (b22 * b33 - b23 * b23) - b13 * b13 * b22);

    float phi;
    if (r <= -1.0) {
        phi = 1.04719755120;
    } else if (r >= 1.0) {
        phi = 0.0;
    } else {
        phi = acos(r) / 3.0;
    }
    float largest = q + 2.0 * p * cos(phi);
    float smallest = q + 2.0 * p * cos(phi + 2.09439510239);
    float middle = 3.0 * q - largest - smallest;

    vec3 axis = cone_direction(a, b, x0, y0, smallest, center.z < 0.0 ? -1.0 : 1.0);
    vec2 tangents = cone_root_tangents(smallest, middle, largest);
    return ConeAxes(axis, tangents.x, tangents.y);
}
