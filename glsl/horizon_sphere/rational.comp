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
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                 scene   grazing   horizon   small  near_full       edge
//   rational   22% 1e-1  27% 1e-1  12% 7e-2  0 2e-7   44% 1e-1  6.1% 1e-1

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_rational(cos_theta, sin2_half_angle);
}
