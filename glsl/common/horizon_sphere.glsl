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

#if defined(SPHERE_LUT_BUFFER)
// Bilinear, in f32, of the four texels around; `at` counts texels from the centre of the first.
float sphere_lut_at(vec2 at)
{
    at = clamp(at, vec2(0.0), vec2(sphere_lut_size - 1));
    vec2 corner = floor(at);
    vec2 weight = at - corner;
    ivec2 texel = ivec2(corner);
    float below = mix(sphere_lut_texel(texel), sphere_lut_texel(texel + ivec2(1, 0)), weight.x);
    float above = mix(sphere_lut_texel(texel + ivec2(0, 1)), sphere_lut_texel(texel + ivec2(1, 1)), weight.x);
    return mix(below, above, weight.y);
}
#elif defined(SPHERE_LUT_IMAGE)
// By the sampler: the centre of the first texel is at half a texel.
float sphere_lut_at(vec2 at)
{
    return textureLod(sphere_lut, (at + 0.5) / vec2(sphere_lut_size), 0.0).x;
}
#endif

#if defined(SPHERE_LUT_BUFFER) || defined(SPHERE_LUT_IMAGE)
// From the table `sphere_lut`, which holds the irradiance over s.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", 2017.
float horizon_lut(float c, float s)
{
    return s * sphere_lut_at(vec2(0.5 * c + 0.5, s) * vec2(sphere_lut_size - 1));
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

// Q of V(x) = x^2 Q(x^2) = 2/3 + 1/x^2 - (1 + x^2)/x^3 atan x, for x^2 in 0..1: relative error 8e-8, Remez.
float horizon_poly(float z)
{
    float q = 0.00277991409 - z * 0.000522755062;
    q = -0.00713750886 + z * q;
    q = 0.0127717477 + z * q;
    q = -0.0199272698 + z * q;
    q = 0.0317143102 + z * q;
    q = -0.0571414287 + z * q;
    return 0.133333323 + z * q;
}

// Y(u) = (2/3 - V(1/u))/u = (1 + u^2) acot u - u, for u in 0..1.
float horizon_far(float u)
{
    float z = u * u;
    return HORIZON_HALF_PI * (1.0 + z) - u * (2.0 + z * (0.666666687 - z * horizon_poly(z)));
}

// The closed form without cancellation: the whole sphere's irradiance, if its centre is above the horizon, plus what
// lies beyond the horizon as seen from the centre's side,
//
//     pi G = r^2/q^2 t (V(p) - V(t)) = r^2/q^2 (Y(1/t) - |c| Y(1/p))
//     r^2 = s - c^2, q^2 = 1 - c^2, t = r/C, p = t/|c|, C^2 = 1 - s
//
// in which both differences are of quantities that differ, unless |c| -> 1 while the horizon cuts the sphere, where G
// itself vanishes with 1 - |c|. No trigonometric function and no table.
// Source: ours, from Snyder, "Area Light Sources for Real-Time Graphics", 1996.
float horizon_stable(float c, float s)
{
    // Beyond 1 by a rounding, s would leave r^2 > 0 where q^2 = 0.
    s = clamp(s, 0.0, 1.0);
    float a = min(abs(c), 1.0);
    float whole = c > 0.0 ? s * a : 0.0;
    // c^2 from exact partial products: s - c^2 good to 2^-35 c^2.
    float high = uintBitsToFloat(floatBitsToUint(a) & 0xfffff000u);
    float r2 = (s - high * high) - (a - high) * (a + high);
    if (!(r2 > 0.0)) {
        return whole;
    }
    float r = sqrt(r2);
    float cos_sigma = sqrt(1.0 - s);
    float ac = a * cos_sigma;
    float share = r2 / ((1.0 - a) * (1.0 + a));
    float beyond;
    if (r < cos_sigma) {
        float t = r / cos_sigma;
        float v_t = t * t * horizon_poly(t * t);
        float v_p;
        if (r < ac) {
            float p = r / ac;
            v_p = p * p * horizon_poly(p * p);
        } else {
            float u = ac / r;
            v_p = 0.666666687 - u * horizon_far(u);
        }
        beyond = t * (v_p - v_t);
    } else {
        float u = cos_sigma / r;
        beyond = horizon_far(u) - a * horizon_far(a * u);
    }
    return whole + HORIZON_INV_PI * share * beyond;
}

#endif
