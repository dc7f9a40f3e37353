// One edge of a polygon's vector irradiance, accurate for all angles. Ours.
//
// a and b are unit vectors up to rounding. a x b = a x (b - a) = a x (b + a), and of the two the one with the shorter
// second factor loses nothing: the sum or difference is exact where the vectors are nearly opposite or parallel, and
// its cross product with a, to which it is nearly orthogonal, does not cancel. Six additions more than cross(), and the
// direction is good to 2^-22 until sin(theta) reaches the rounding of the inputs themselves.

#ifndef ROOTQ_EDGE_STABLE
#define ROOTQ_EDGE_STABLE

// a x b; cosine is the sign of a.b or anything with that sign.
vec3 edge_cross(vec3 a, vec3 b, float cosine)
{
    precise vec3 d = cosine < 0.0 ? b + a : b - a;
    return cross(a, d);
}

// theta/(2 pi sin theta) for cos(theta) = y in 0..1: minimax, 7.5e-9 beside roundings of 4e-8.
float edge_factor(float y)
{
    return (0.25 + (0.175587766 + (0.00912251006 - 0.000547394726 * y) * y) * y)
        / (1.0 + (1.33896761 + 0.388958304 * y) * y);
}

// The fit with the sine from the cross product itself, so that nothing is left of 1 - x^2.
vec3 edge_stable(vec3 a, vec3 b)
{
    float x = dot(a, b);
    vec3 n = edge_cross(a, b, x);
    float v = edge_factor(abs(x));
    float factor = x < 0.0 ? 0.5 * inversesqrt(max(dot(n, n), 1.175494351e-38)) - v : v;
    return factor * n;
}

// The same with the classical fit of theta/(2 pi sin theta) (Hill & Heitz 2016).
vec3 edge_stable_hill(vec3 a, vec3 b)
{
    float x = dot(a, b);
    float y = abs(x);
    vec3 n = edge_cross(a, b, x);
    float v = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y);
    float factor = x < 0.0 ? 0.5 * inversesqrt(max(dot(n, n), 1.175494351e-38)) - v : v;
    return factor * n;
}

// The same with atan: as good as the device's.
vec3 edge_stable_atan2(vec3 a, vec3 b)
{
    float x = dot(a, b);
    vec3 n = edge_cross(a, b, x);
    float sine = max(length(n), 1.175494351e-38);
    return n * (atan(sine, x) / sine * 0.15915494309189535);
}

#endif
