/*---
summary = "The device's own log2"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_log2(float x)
{
    return log2(x);
}
