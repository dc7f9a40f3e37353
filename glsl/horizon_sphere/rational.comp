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
// Bound: 0.11 absolute.
// Measured: -

#include "common/horizon_sphere.glsl"

float horizon_sphere(float cos_theta, float sin2_half_angle)
{
    return horizon_rational(cos_theta, sin2_half_angle);
}
