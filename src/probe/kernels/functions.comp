/*---
summary = "Functions at the ends of their domains"
source  = "ours"

[[variant]]
name = "functions"
---*/

Functions functions(float x)
{
    return Functions(sqrt(x), inversesqrt(x), log(x), exp(x));
}
