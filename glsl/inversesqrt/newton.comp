/*---
summary = "The device's own, and a Newton step on it"
source  = "ours"

[[variant]]
name = "newton"

[[variant]]
name = "newton_precise"
precise = true
---*/

// y + y (1 - x y^2)/2: the bracket holds little but its own rounding once y is good to a few units.
// Bound: 1.5 ULP where 1 - x y^2 is rounded twice; less where it is fused.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                           domain            edge
//   newton           0, 0.91, 0.46   0, 0.90, 0.45
//   newton_precise   0, 0.91, 0.46   0, 0.90, 0.45

float builtin_inversesqrt(float x)
{
    float y = inversesqrt(x);
    return y + 0.5 * y * (1.0 - x * y * y);
}
