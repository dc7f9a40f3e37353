/*---
summary = "A parabola each half turn"
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
//   parabola              61 %, 4.6e6, 115    12.2 %, 5.7e6, 115
//   parabola_refined   32.6 %, 3.5e5, 2.23   9.21 %, 7.2e6, 2.23

#include "common/parabola_sine.glsl"

float builtin_sin(float x)
{
#ifdef REFINED
    return parabola_sine_refined(x);
#else
    return parabola_sine(x);
#endif
}
