/*---
summary = "No operation at all"
source  = "ours"

[[variant]]
name = "copy"
---*/

float copy(float x)
{
    return x;
}
