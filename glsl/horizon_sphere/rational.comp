/*---
summary = "(F.z + |F|^2)/(|F| + 1): no branch, no table, exact for hemispheres"
source  = "Hill & Heitz 2016"

[[variant]]
name = "rational"
---*/

// The rational approximation of the clipped sphere.
//
// Domain: all. Exact for s = 1; below it light leaks from down to c = -s, and the whole sphere above the horizon is
// right only where c = 1.
// Source: Hill & Heitz, "Real-Time Area Lighting: a Journey from Research to Production", 2016.
// Bound: 0.135 absolute, at c = 0.16, s = 0.82.
// Measured: failed, and worst absolute error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     scene        grazing        horizon          small      near_full           edge
//   rational  21.9 % 1.3e-1  27.5 % 1.3e-1  12.1 % 6.9e-2       0 2.0e-7  43.9 % 1.3e-1  6.15 % 1.3e-1

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_rational(cos_theta, sin2_half_angle);
}
