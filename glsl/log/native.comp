/*---
summary = "The device's own log"
source  = "GLSL.std.450"

[[variant]]
name = "native"
---*/

float builtin_log(float x)
{
    return log(x);
}
