// One edge of a polygon's vector irradiance with the angle from atan(|a x b|, a.b).
//
// a and b are unit vectors. The angle is well conditioned everywhere; what is left is the cross product, whose
// components carry 2^-24 of their products: a direction off by 2^-24/sin(theta) for nearly parallel vectors, where it
// does not matter, and for nearly opposite ones, where it does.

#ifndef ROOTQ_EDGE_ATAN2
#define ROOTQ_EDGE_ATAN2

// As written: 0/0 for parallel and opposite vectors.
vec3 edge_atan2(vec3 a, vec3 b)
{
    vec3 n = cross(a, b);
    float sine = length(n);
    return n * (atan(sine, dot(a, b)) / sine * 0.15915494309189535);
}

// The sine kept above the smallest normal number: 0 for parallel and for opposite vectors.
vec3 edge_atan2_guarded(vec3 a, vec3 b)
{
    vec3 n = cross(a, b);
    float sine = max(length(n), 1.175494351e-38);
    return n * (atan(sine, dot(a, b)) / sine * 0.15915494309189535);
}

#endif
