// One edge of a polygon's vector irradiance with the angle from acos: theta/(2 pi sin theta) a x b.
//
// a and b are unit vectors. acos has no information left near +-1: a dot product rounded at 2^-24 leaves theta off by
// 2^-24/sin(theta), so by 3e-4 at both ends. A dot product above 1 is NaN where nothing clamps it.
// Source: Lambert's formula as in Heitz et al., "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines",
// 2016, and public ports of its sample code.

#ifndef ROOTQ_EDGE_ACOS
#define ROOTQ_EDGE_ACOS

const float EDGE_INV_TWO_PI = 0.15915494309189535;

// As written: 0/0 for parallel and opposite vectors.
vec3 edge_acos(vec3 a, vec3 b)
{
    float theta = acos(dot(a, b));
    return cross(a, b) * (theta / sin(theta) * EDGE_INV_TWO_PI);
}

// The authors' first sample code: no angle below 0.014 or above pi - 0.014.
vec3 edge_acos_clamped(vec3 a, vec3 b)
{
    float theta = acos(clamp(dot(a, b), -0.9999, 0.9999));
    return cross(a, b) * (theta / sin(theta) * EDGE_INV_TWO_PI);
}

// Clamped to acos's domain: no NaN from acos, but 0/0 remains.
vec3 edge_acos_saturated(vec3 a, vec3 b)
{
    float theta = acos(clamp(dot(a, b), -1.0, 1.0));
    return cross(a, b) * (theta / sin(theta) * EDGE_INV_TWO_PI);
}

// theta/sin(theta) is 1 below a thousandth.
vec3 edge_acos_small_angle(vec3 a, vec3 b)
{
    float theta = acos(clamp(dot(a, b), -1.0, 1.0));
    float factor = theta > 0.001 ? theta / sin(theta) : 1.0;
    return cross(a, b) * (factor * EDGE_INV_TWO_PI);
}

// The cross product normalised, times the angle: acos's error is no longer divided out by its own sine (rings).
vec3 edge_acos_normalized(vec3 a, vec3 b)
{
    return normalize(cross(a, b)) * (acos(dot(a, b)) * EDGE_INV_TWO_PI);
}

vec3 edge_acos_normalized_saturated(vec3 a, vec3 b)
{
    return normalize(cross(a, b)) * (acos(clamp(dot(a, b), -1.0, 1.0)) * EDGE_INV_TWO_PI);
}

#endif
