/*---
summary = "Sum, difference, product and quotient"
source  = "ours"

[[variant]]
name = "arithmetic"
precise = true
---*/

Arithmetic arithmetic(float a, float b)
{
    return Arithmetic(a + b, a - b, a * b, a / b);
}
