/*---
summary = "A parabola each half turn, a quarter turn on"
source  = "Capens, devmaster.net 2006"

[[variant]]
name = "parabola"

[[variant]]
name = "parabola_refined"
summary = "The parabola corrected by its own square"
defines = { REFINED = 1 }
---*/

// Domain: -pi..pi, no reduction.
// Bound: 5.6e-2 and 1.1e-3 absolute.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                   domain                  edge
//   parabola            54.5 %, 4.6e6, 115    11.2 %, 1.2e8, 115
//   parabola_refined   29.5 %, 4.4e5, 2.23   7.22 %, 9.2e7, 2.23

#include "common/parabola_sine.glsl"

float builtin_cos(float x)
{
    // cos x = sin(x + pi/2), brought back into -pi..pi.
    x = x + 1.57079632679490;
    x = x > 3.14159265358979 ? x - 6.28318530717959 : x;
#ifdef REFINED
    return parabola_sine_refined(x);
#else
    return parabola_sine(x);
#endif
}
