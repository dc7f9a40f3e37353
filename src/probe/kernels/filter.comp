/*---
summary = "A table between its texels, by the sampler"
source  = "ours"

[[variant]]
name = "filter"
tables = { sphere_lut = "image" }
---*/

float filtered(vec2 at)
{
    return sphere_lut_at(at);
}
