// The irradiance of an elliptic cone's part above the horizon, in closed form: no table, no equal-area sphere.
//
// The cone has the principal axes W1, W2, W3 (mean direction) and the tangents sqrt(e1/l) >= sqrt(e3/l) of its half
// angles, so its rim is p(u) = (sqrt(e1) cos u, sqrt(e3) sin u, sqrt(l)) there. With A = l + e1, B = l + e3, k = e1 - e3 and
// q = |p|^2, Stokes' theorem over the arc u0 - d .. u0 + d above the horizon, closed along the horizon, gives
//
//     2 pi E = W1.z Ix + W2.z Iy + W3.z Iz + dphi
//     Ix = -sqrt(e3 l) D asinh(z)/z      D = 2 cos u0 sin d / sqrt(q1 q2), z = D sqrt(k A)
//     Iy = -sqrt(e1 l) G atan(y, x)/y    G = 2 sin u0 sin d / B, y = G sqrt(k B), x = 1 + (k/B)(cos^2 u0 - sin^2 d)
//     Iz = sqrt(e1 e3/(A B)) atan(sqrt(A B) sin 2d, A cos u1 cos u2 + B sin u1 sin u2)
//
// The differences of antiderivatives are single functions by the addition theorems, so that small, far and circular
// lights (k -> 0) cancel nothing: each term is within a few roundings of itself, and a light that subtends an angle w
// is off by about 2^-23 w. Pure functions. Source: ours.

#ifndef ROOTQ_CLIPPED_ELLIPSE
#define ROOTQ_CLIPPED_ELLIPSE

#include "common/arctangent.glsl"

const float CLIPPED_PI = 3.14159265358979;

// asinh(z)/z: within 1e-7. Below 1/2 by its series, whose next term is 0.0139 z^12.
float asinh_ratio(float z)
{
    float s = z * z;
    float series =
        1.0 + s * (-0.166666667 + s * (0.075 + s * (-0.0446428571 + s * (0.0303819444 + s * -0.0223721591))));
    float r = abs(z);
    return s < 0.25 ? series : log(r + sqrt(1.0 + s)) / r;
}

// E for the heights of W1, W2, W3, (e1, e3), l, and szz = e1 W1.z^2 + e3 W2.z^2 - l W3.z^2 > 0, which says that the
// horizon cuts the cone. e1 >= e3 > 0 and l > 0 up to about 2^40.
float clipped_ellipse(vec3 heights, vec2 e, float l, float szz)
{
    vec2 root = sqrt(e);
    vec2 sides = heights.xy * root;
    float middle = heights.z * sqrt(l);
    float inverse_swing = inversesqrt(middle * middle + szz);
    float cos_d = -middle * inverse_swing;
    float sin_d = sqrt(szz) * inverse_swing;
    vec2 top = dot(sides, sides) > 1.0e-30 ? normalize(sides) : vec2(1.0, 0.0);

    float A = l + e.x;
    float B = l + e.y;
    float k = max(e.x - e.y, 0.0);
    vec2 even = top * cos_d;
    vec2 odd = vec2(-top.y, top.x) * sin_d;
    vec2 u1 = even - odd;
    vec2 u2 = even + odd;
    vec2 AB = vec2(A, B);
    float inverse_q = inversesqrt(dot(AB, u1 * u1)) * inversesqrt(dot(AB, u2 * u2));

    float root_l = sqrt(l);
    float D = 2.0 * top.x * sin_d * inverse_q;
    float Ix = -root.y * root_l * D * asinh_ratio(D * sqrt(k * A));

    float G = 2.0 * top.y * sin_d / B;
    float y = G * sqrt(k * B);
    float x = 1.0 + k / B * (top.x * top.x - sin_d * sin_d);
    float Iy = -root.x * root_l * G * (abs(y) > 1.0e-4 * x ? arctangent(y, x) / y : 1.0 / x);

    float root_AB = sqrt(A) * sqrt(B);
    float turn = arctangent(2.0 * root_AB * sin_d * cos_d, dot(AB, u1 * u2));
    turn = cos_d < 0.0 ? turn + 2.0 * CLIPPED_PI : turn;
    float Iz = root.x * root.y / root_AB * turn;

    // The crossings are m -+ s; their azimuths differ by the angle between them.
    vec2 m = root * even;
    vec2 s = root * odd;
    float area = length(vec3(root_l * s, m.x * s.y - m.y * s.x));
    float dphi = arctangent(2.0 * area, dot(m, m) + l - dot(s, s));

    float sum = dot(heights, vec3(Ix, Iy, Iz)) + dphi;
    return clamp(sum * (0.5 / CLIPPED_PI), 0.0, 1.0);
}

#endif
