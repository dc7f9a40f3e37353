/*---
summary = "Both roots"
source  = "ours"

[[variant]]
name = "roots"
precise = true
---*/

Roots roots(float x)
{
    return Roots(sqrt(x), inversesqrt(x));
}
