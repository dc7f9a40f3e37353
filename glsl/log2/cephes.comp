/*---
summary = "Whole octaves from bits, the rest by a polynomial"
source  = "Moshier, Cephes Mathematical Library, 1989"

[[variant]]
name = "cephes"
---*/

// log2(m) = log(m) + (log2(e) - 1) log(m), the small terms first.
// Bound: 3 ULP, also close to 1; normal x only.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                   domain            edge
//   cephes   0, 1.28, 0.28   0, 1.13, 0.25

#include "common/cephes_log.glsl"

float builtin_log2(float x)
{
    vec2 split = split_at_one(x);
    float r = split.y;
    float rest = cephes_log_rest(r);
    const float LOG2E_LESS_1 = 0.44269504088896340735992;
    return ((rest * LOG2E_LESS_1 + r * LOG2E_LESS_1) + rest) + r + split.x;
}
