/*---
summary = "What depends on NaN, infinity and the sign of zero"
source  = "ours"

[[variant]]
name = "special"
---*/

Special special(float x, float y)
{
    return Special(min(x, y), max(x, y), clamp(x, 0.0, 1.0), float(x == y), float(x != y), float(x < y),
        float(isnan(x)), float(isinf(x)));
}
