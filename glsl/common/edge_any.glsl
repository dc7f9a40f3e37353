// edge_any(a, b): the form of a polygon's edge that EDGE names, for unit vectors a and b; with SPLIT, nearly opposite
// vectors are split first at their chord's point closest to the origin.

#ifndef ROOTQ_EDGE_ANY
#define ROOTQ_EDGE_ANY

#include "common/edge_acos.glsl"
#include "common/edge_atan2.glsl"
#include "common/edge_fit.glsl"
#include "common/edge_split.glsl"
#include "common/edge_stable.glsl"

vec3 edge_any(vec3 a, vec3 b)
{
#ifdef SPLIT
    if (edge_needs_split(a, b)) {
        vec3 middle = edge_split_point(a, b);
        return EDGE(a, middle) + EDGE(middle, b);
    }
#endif
    return EDGE(a, b);
}

#endif
