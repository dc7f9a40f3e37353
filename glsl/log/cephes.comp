/*---
summary = "Whole octaves from bits, the rest by a polynomial"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// ln 2 in two parts, the first of 9 bits, so that its product is exact.
// Bound: 1 ULP, also close to 1; normal x only.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   cephes   0, 0.85, 0.27   0, 0.78, 0.26

#include "common/cephes_log.glsl"

float builtin_log(float x)
{
    vec2 split = split_at_one(x);
    float rest = cephes_log_rest(split.y) - 2.12194440e-4 * split.x;
    return (rest + split.y) + 0.693359375 * split.x;
}
