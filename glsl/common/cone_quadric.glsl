// The cone over an ellipse as a quadric, in the notation of Heitz & Hill, "Real-Time Line- and Disk-Light Shading with
// Linearly Transformed Cosines", SIGGRAPH 2017: a (x - x0 z)^2 + b (y - y0 z)^2 <= z^2, its characteristic polynomial,
// and the result from that polynomial's roots. No guards but those that the including text defines:
//
//     CLAMP_TANGENTS   both radicands of the tangents >= 0
//     FLOOR            a - e, b - e and the roots that divide are at least FLOOR in size
//
// Pure functions. Source of the formulas: the talk; production fixes as named.

#ifndef ROOTQ_CONE_QUADRIC
#define ROOTQ_CONE_QUADRIC

// a, b, x0, y0 for an ellipse at height |cz|.
void cone_quadric(float hx, float hy, vec3 c, out float a, out float b, out float x0, out float y0)
{
    float height = abs(c.z);
    a = height * height / (hx * hx);
    b = height * height / (hy * hy);
    x0 = c.x / height;
    y0 = c.y / height;
}

// (c0, c1, c2) of e^3 + c2 e^2 + c1 e + c0, whose roots are the quadric's eigenvalues.
vec3 cone_polynomial(float a, float b, float x0, float y0)
{
    float ab = a * b;
    return vec3(
        ab,
        ab * (1.0 + x0 * x0 + y0 * y0) - a - b,
        1.0 - a * (1.0 + x0 * x0) - b * (1.0 + y0 * y0));
}

// The same for t = e/b, with ratio = a/b and 1/b: a far light's b is large, its t is not.
vec3 cone_polynomial_over_b(float ratio, float inverse_b, float x0, float y0)
{
    return vec3(
        ratio * inverse_b,
        ratio * (1.0 + x0 * x0 + y0 * y0) - (ratio + 1.0) * inverse_b,
        inverse_b - ratio * (1.0 + x0 * x0) - (1.0 + y0 * y0));
}

// The mean direction for the negative root e, in the ellipse's frame; `side` is the sign of the centre's z.
vec3 cone_direction(float a, float b, float x0, float y0, float e, float side)
{
#ifdef FLOOR
    vec3 direction = vec3(a * x0 / max(a - e, FLOOR), b * y0 / max(b - e, FLOOR), 1.0);
#else
    vec3 direction = vec3(a * x0 / (a - e), b * y0 / (b - e), 1.0);
#endif
    direction = normalize(direction);
    direction.z *= side;
    return direction;
}

// Tangents, the larger first, from the negative root e and the positive roots.
vec2 cone_root_tangents(float e, float positive1, float positive2)
{
#ifdef FLOOR
    positive1 = max(positive1, FLOOR);
    positive2 = max(positive2, FLOOR);
#endif
    float square1 = -e / positive1;
    float square2 = -e / positive2;
#ifdef CLAMP_TANGENTS
    square1 = max(square1, 0.0);
    square2 = max(square2, 0.0);
#endif
    float tan1 = sqrt(square1);
    float tan2 = sqrt(square2);
    return vec2(max(tan1, tan2), min(tan1, tan2));
}

#endif
