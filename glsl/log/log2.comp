/*---
summary = "log2(x) ln 2"
source  = "Folklore; what most devices do"

[[variant]]
name = "log2"
---*/

// A product by a rounded constant.
// Bound: those of log2, and 1 ULP.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                  domain             edge
//   log2   0, 8.7e4, 0.92   0, 6.1e6, 0.68

float builtin_log(float x)
{
    return log2(x) * 0.693147180559945;
}
