/*---
summary = "Reduced by multiples of pi/2 in three parts, then Cephes' polynomials"
source  = "Cody & Waite, Software Manual for the Elementary Functions, 1980; Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cody_waite"

[[variant]]
name = "cody_waite_precise"
precise = true
---*/

// See cody_waite.glsl.
// Bound: 2 ULP for |x| up to some thousands, but for the last part's rounding close to multiples of pi/2; beyond, the whole
// multiple's own rounding.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                 domain              edge
//   cody_waite           0, 1.89, 2.3e-4   0, 1.86, 2.3e-4
//   cody_waite_precise   0, 1.32, 1.4e-4   0, 1.19, 1.3e-4

#include "common/cody_waite.glsl"

float builtin_sin(float x)
{
    return cody_waite_sine(x, 0);
}
