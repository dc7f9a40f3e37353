/*---
summary = "The angle in turns, as sinpi: the reduction is exact, its scaling is not"
source  = "ours"

[[variant]]
name = "turns"
---*/

// x/(2 pi) is rounded once, and that rounding grows with |x|: 2^-24 |x| of the angle.
// Bound: 1e-7 + 6e-8 |x| absolute.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     domain               edge
//   turns   0, 1.5e5, 7.1e-4   0, 1.3e7, 6.9e-4

#include "common/sine_of_turns.glsl"

float builtin_cos(float x)
{
    return sine_of_turns(x * 0.159154943091895 + 0.25);
}
