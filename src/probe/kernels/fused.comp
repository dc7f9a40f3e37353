/*---
summary = "fma(), and the expression that a compiler may contract to it"
source  = "ours"

[[variant]]
name = "fused"
---*/

Fused fused(float a, float b, float c)
{
    return Fused(fma(a, b, c), a * b + c);
}
