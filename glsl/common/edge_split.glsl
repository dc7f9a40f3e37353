// Splits an almost opposite pair of unit vectors at the point of their chord closest to the origin.

#ifndef ROOTQ_EDGE_SPLIT
#define ROOTQ_EDGE_SPLIT

// That point as a direction. For unit vectors it is the chord's middle, found here as a port finds it: by projection.
vec3 edge_split_point(vec3 a, vec3 b)
{
    vec3 along = normalize(b - a);
    return normalize(a - along * dot(a, along));
}

bool edge_needs_split(vec3 a, vec3 b)
{
    return dot(a, b) < -1.0 + 1e-5;
}

#endif
