/*---
summary = "x inversesqrt(x)"
source  = "Folklore"

[[variant]]
name = "product"

[[variant]]
name = "product_guarded"
summary = "The same with 0 for 0"
defines = { GUARDED = 1 }
---*/

// 0 inf = NaN at 0 without the guard.
// Bound: that of inversesqrt and a rounding.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                            domain            edge
//   product           0, 1.74, 0.33   0, 1.74, 0.33
//   product_guarded   0, 1.74, 0.33   0, 1.74, 0.33

float builtin_sqrt(float x)
{
#ifdef GUARDED
    return x > 0.0 ? x * inversesqrt(x) : 0.0;
#else
    return x * inversesqrt(x);
#endif
}
