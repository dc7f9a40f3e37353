// One edge of a polygon's vector irradiance with a fit of theta/sin(theta) in the cosine: no acos, no division by the
// sine.
//
// a and b are unit vectors, x = a.b, y = |x|. For x < 0 the fit serves the supplement, pi - theta, whose sine is the
// same: theta/sin(theta) = pi/sin(theta) - FIT(y), and 1/sin(theta) = inversesqrt(GUARD(1 - x^2)). 1 - x^2 is noise of
// 2^-23 once pi - theta is below 3e-3, whatever the guard; the guards keep it away from zero, and the sine from its
// true value.
//
// FIT and GUARD are the names of functions below. CLAMP_DOT keeps x within +-0.9999 as well.
// Source: Hill & Heitz, "Real-Time Area Lighting: a Journey from Research to Production", SIGGRAPH 2016, and public
// ports of it; the fits marked "ours" are minimax fits of the degrees that production uses.

#ifndef ROOTQ_EDGE_FIT
#define ROOTQ_EDGE_FIT

// theta/(2 pi sin theta) for y in 0..1, and half a turn in the same units: max error 1.4e-6/(2 pi).
float fit_rational(float y)
{
    return (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y);
}

// theta/sin(theta) for y in 0..1. Max error 1.6e-6.
float fit_rational_542(float y)
{
    return (5.42031 + (3.12829 + 0.0902326 * y) * y) / (3.45068 + (4.18814 + y) * y);
}

// Max error 9.6e-3, at y = 0.55.
float fit_quadratic(float y)
{
    return 1.5708 + (-0.879406 + 0.308609 * y) * y;
}

// Ours: max error 8.7e-4.
float fit_cubic(float y)
{
    return 1.56992739 + (-0.966792054 + (0.578727266 - 0.182731539 * y) * y) * y;
}

// Ours: max error 5.6e-7.
float fit_poly7(float y)
{
    float high = 0.513926011 + (-0.331016076 + (0.141067664 - 0.0280905651 * y) * y) * y;
    return 1.57079577 + (-0.999922118 + (0.783589152 + (-0.650350395 + high * y) * y) * y) * y;
}

float guard_none(float s)
{
    return s;
}

float guard_1e7(float s)
{
    return max(s, 1e-7);
}

// The smallest normal number: turns away 0, not the noise.
float guard_flt_min(float s)
{
    return max(s, 1.175494351e-38);
}

// 2^-24, the roundoff of the 1 in 1 - x^2.
float guard_epsilon(float s)
{
    return max(s, 5.960464478e-8);
}

// As some ports write it: NaN turns to infinity at 0.
float guard_saturate(float s)
{
    return clamp(s, 0.0, 1.0);
}

#if defined(FIT) && defined(GUARD)

// Units of the fit: a half turn and the final factor.
#ifdef FIT_SCALED
#define EDGE_HALF_TURN 0.5
#define EDGE_UNIT 1.0
#else
#define EDGE_HALF_TURN 3.14159265358979
#define EDGE_UNIT 0.15915494309189535
#endif

vec3 edge_fit(vec3 a, vec3 b)
{
    float x = dot(a, b);
#ifdef CLAMP_DOT
    x = clamp(x, -0.9999, 0.9999);
#endif
    float v = FIT(abs(x));
#ifdef AS_PORTED_SQRT
    float factor = x > 0.0 ? v : EDGE_HALF_TURN * sqrt(1.0 - x * x) - v;
#else
    float factor = x > 0.0 ? v : EDGE_HALF_TURN * inversesqrt(GUARD(1.0 - x * x)) - v;
#endif
    return cross(a, b) * (factor * EDGE_UNIT);
}

#endif

// acos(x) ~ (1.5708 - 0.175 x) sqrt(1 - x), a fit for x >= 0, used for all angles alike as a port does: theta is off by
// up to 0.02 below pi/2 and by up to 0.7 above it.
vec3 edge_sqrt_linear(vec3 a, vec3 b)
{
    float x = dot(a, b);
    return cross(a, b) * ((1.5708 - 0.175 * x) * inversesqrt(x + 1.0) * 0.15915494309189535);
}

#endif
