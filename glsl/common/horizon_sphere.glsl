// Irradiance of a sphere that the horizon cuts, from the cosine c of its direction with the normal and s, the squared
// sine of its half angle; the full hemisphere has 1. One function for each way that is in use.
//
// Domain: -1 <= c <= 1, 0 <= s <= 1. s is also the length of the sphere's vector irradiance, so an unclipped light of
// vector irradiance F is treated as a sphere by c = F.z/|F|, s = |F|.

#ifndef ROOTQ_HORIZON_SPHERE
#define ROOTQ_HORIZON_SPHERE

const float HORIZON_PI = 3.14159274;
const float HORIZON_HALF_PI = 1.57079637;
const float HORIZON_INV_PI = 0.318309873;

#if defined(SPHERE_LUT_BUFFER) || defined(SPHERE_LUT_IMAGE)
// From the table `sphere_lut`, which holds the irradiance over s, by c and s.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", 2017.
float horizon_lut(float c, float s)
{
    return s * sphere_lut_at(vec2(0.5 * c + 0.5, s) * vec2(sphere_lut_size - 1));
}
#endif

#if defined(SPHERE_LUT_SOLID_ANGLE_BUFFER) || defined(SPHERE_LUT_SOLID_ANGLE_IMAGE)
// From the table `sphere_lut_solid_angle`, which holds the same by c and 1 - cos sigma: the irradiance has a root of
// 1 - s in it, which no table in s follows near s = 1. Source: ours.
float horizon_lut_solid_angle(float c, float s)
{
    float v = 1.0 - sqrt(clamp(1.0 - s, 0.0, 1.0));
    return s * sphere_lut_solid_angle_at(vec2(0.5 * c + 0.5, v) * vec2(sphere_lut_solid_angle_size - 1));
}
#endif

// The closed form, as published: three terms that cancel for small spheres, and 1/0 at c = 1 and at s = 0.
// Source: Lagarde & de Rousiers, "Moving Frostbite to Physically Based Rendering", 2014.
float horizon_sphere_analytic(float c, float s)
{
    if (c * c > s) {
        return s * clamp(c, 0.0, 1.0);
    }
    float sin_theta = sqrt(1.0 - c * c);
    float x = sqrt(1.0 / s - 1.0);
    float y = -x * (c / sin_theta);
    float z = sin_theta * sqrt(1.0 - y * y);
    return max(0.0, HORIZON_INV_PI * ((c * acos(y) - x * z) * s + atan(z / x)));
}

// (F.z + |F|^2)/(|F| + 1): exact for a hemisphere, and no branch.
// Source: Hill & Heitz, "Real-Time Area Lighting: a Journey from Research to Production", 2016.
float horizon_rational(float c, float s)
{
    return max(0.0, s * (c + s) / (s + 1.0));
}

#define HORIZON_HORNER(q) slope = value + x * slope; value = (q) + y * value;

// (Q(y), Q[x, y]) of V(x) = x^2 Q(x^2) = 2/3 + 1/x^2 - (1 + x^2)/x^3 atan x: value and divided difference
// (Q(x) - Q(y))/(x - y), which has nothing to cancel. x, y in 0..1.235; relative error of Q there: 4.5e-8, Remez.
vec2 horizon_poly(float x, float y)
{
    float value = 0.000178524911;
    float slope = 0.0;
    HORIZON_HORNER(-0.00122048847)
    HORIZON_HORNER(0.00388683847)
    HORIZON_HORNER(-0.00805165051)
    HORIZON_HORNER(0.0131901789)
    HORIZON_HORNER(-0.020031455)
    HORIZON_HORNER(0.0317270932)
    HORIZON_HORNER(-0.0571420297)
    HORIZON_HORNER(0.133333327)
    return vec2(value, slope);
}

// The closed form without cancellation: the whole sphere's irradiance, if its centre is above the horizon, plus what
// lies beyond the horizon as seen from the centre's side,
//
//     pi G = r^2/q^2 t (V(p) - V(t)) = r^2/q^2 (Y(1/t) - a Y(1/p))       Y(u) = (2/3 - V(1/u))/u = (1 + u^2) acot u - u
//     r^2 = s - c^2, a = |c|, q^2 = 1 - a^2, t = r/C, p = t/a, C^2 = 1 - s
//
// in which both differences have the factor 1 - a, taken out by divided differences unless t < 0.9 and p > 1: there a
// is below 0.9. No trigonometric function and no table.
// Source: ours, from Snyder, "Area Light Sources for Real-Time Graphics", 1996.
float horizon_stable(float c, float s)
{
    // Beyond 1 by a rounding, s would leave r^2 > 0 where q^2 = 0.
    s = clamp(s, 0.0, 1.0);
    float a = min(abs(c), 1.0);
    float whole = c > 0.0 ? s * a : 0.0;
    // c^2 from exact partial products: where s - c^2 cancels each difference but the last is exact, and r^2 is good to a
    // rounding of itself.
    float high = uintBitsToFloat(floatBitsToUint(a) & 0xfffff000u);
    float low = a - high;
    precise float r2 = s - high * high;
    r2 = r2 - 2.0 * high * low;
    r2 = r2 - low * low;
    if (!(r2 > 0.0)) {
        return whole;
    }
    float r = sqrt(r2);
    float cos_sigma = sqrt(1.0 - s);
    float a2 = a * a;
    float beyond;
    if (r < a * cos_sigma) {
        float t = r / cos_sigma;
        float p2 = (t / a) * (t / a);
        vec2 q = horizon_poly(p2, t * t);
        beyond = t * p2 * (q.x + p2 * q.y);
    } else if (r > 0.9 * cos_sigma) {
        float u = cos_sigma / r;
        float z = u * u;
        float w = a2 * z;
        vec2 q = horizon_poly(z, w);
        // x^3 Q(x) by the product rule, thrice.
        float cubed = w * w * q.x + z * (w * q.x + z * (q.x + z * q.y));
        float slope = 2.0 + 0.666666687 * (z + w) - cubed;
        beyond = HORIZON_HALF_PI * (1.0 + z * (1.0 + a + a2)) / (1.0 + a) - u * slope;
    } else {
        float t = r / cos_sigma;
        float u = a * cos_sigma / r;
        float z = u * u;
        float v_t = t * t * horizon_poly(0.0, t * t).x;
        float y = HORIZON_HALF_PI * (1.0 + z) - u * (2.0 + z * (0.666666687 - z * horizon_poly(0.0, z).x));
        beyond = t * (0.666666687 - u * y - v_t) / ((1.0 - a) * (1.0 + a));
    }
    return whole + HORIZON_INV_PI * r2 * beyond;
}

#endif
