/*---
summary = "The device's own division"
source  = "SPIR-V's OpFDiv"

[[variant]]
name = "native"
---*/

float builtin_div(float x, float y)
{
    return x / y;
}
