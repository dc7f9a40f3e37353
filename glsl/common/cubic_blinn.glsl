// Three real roots of a monic cubic by trigonometry. Pure functions, without guards but those that the including
// text defines:
//
//     CLAMP_DISCRIMINANT   the discriminant is at least 0
//     CLAMP_RADICANDS      so are the radicands -C of the depressed cubics
//     PASS_NAN             an arctangent that hands a NaN on, as IEEE arithmetic would: Vulkan's atan() need not, and
//                          Mesa's takes min(abs(y/x), 1), which is 1
//
// The cubic is x^3 + 3 B x^2 + 3 C x + D; the Hessian's coefficients are d1 = C - B^2, d2 = D - B C, d3 = B D - C^2, and
// 4 d1 d3 - d2^2 is positive for three distinct roots.

#ifndef ROOTQ_CUBIC_BLINN
#define ROOTQ_CUBIC_BLINN

#ifdef PASS_NAN
#include "common/arctangent.glsl"
#endif

const float CUBIC_THIRD_TURN = 2.09439510239;

vec3 cubic_hessian(float B, float C, float D)
{
    return vec3(C - B * B, D - B * C, B * D - C * C);
}

float cubic_discriminant(vec3 d)
{
    float discriminant = 4.0 * d.x * d.z - d.y * d.y;
#ifdef CLAMP_DISCRIMINANT
    discriminant = max(discriminant, 0.0);
#endif
    return discriminant;
}

float cubic_radius(float depressed)
{
#ifdef CLAMP_RADICANDS
    return 2.0 * sqrt(max(-depressed, 0.0));
#else
    return 2.0 * sqrt(-depressed);
#endif
}

float cubic_angle(float y, float x)
{
#ifdef PASS_NAN
    return arctangent_quotient(y, x);
#else
    return atan(y, x);
#endif
}

// The roots of x^3 + c.z x^2 + c.y x + c.x, the smallest in .y, the others in no order. One extreme root comes from the
// cubic (algorithm A), the other from the cubic of the reciprocals (algorithm D), the middle one from the quotient.
// Source: Blinn, "How to Solve a Cubic Equation", parts 1 to 5, IEEE CG&A 2006-2007; in the shape that Heitz & Hill's
// sample code of 2017 gives it.
vec3 cubic_blinn(vec3 c)
{
    float B = c.z / 3.0;
    float C = c.y / 3.0;
    float D = c.x;
    vec3 d = cubic_hessian(B, C, D);
    float root = sqrt(cubic_discriminant(d));

    // Algorithm A: of the depressed cubic's largest and smallest root, the one farther from the mean.
    float theta = cubic_angle(root, 2.0 * B * d.x - d.y) / 3.0;
    float radius = cubic_radius(d.x);
    float first = radius * cos(theta);
    float last = radius * cos(theta + CUBIC_THIRD_TURN);
    float large = (first + last > 2.0 * B ? first : last) - B;

    // Algorithm D: the same for the reciprocals; the root is -D/small.
    theta = cubic_angle(D * root, D * d.y - 2.0 * C * d.z) / 3.0;
    radius = cubic_radius(d.z);
    first = radius * cos(theta);
    last = radius * cos(theta + CUBIC_THIRD_TURN);
    float small = (first + last < 2.0 * C ? first : last) + C;

    // What is left of the cubic, as a homogeneous linear factor.
    float f = D - large * small;
    float g = -large * D;
    vec3 roots = vec3(-D / small, (C * f - B * g) / (C * small - B * f), large);
    if (roots.x < roots.y && roots.x < roots.z) {
        return roots.yxz;
    }
    if (roots.z < roots.x && roots.z < roots.y) {
        return roots.xzy;
    }
    return roots;
}

// The same roots from algorithm A alone: one angle, and its three thirds. The smallest is in .y.
// Source: Peters, "How to solve a cubic equation, revisited", Moments in Graphics, 2016, after Blinn.
vec3 cubic_single(vec3 c)
{
    float B = c.z / 3.0;
    float C = c.y / 3.0;
    vec3 d = cubic_hessian(B, C, c.x);
    float theta = cubic_angle(sqrt(cubic_discriminant(d)), 2.0 * B * d.x - d.y) / 3.0;
    float radius = cubic_radius(d.x);
    // cos(theta + third turn) is the least of the three for theta in 0..60 degrees.
    vec3 angles = vec3(theta, theta + CUBIC_THIRD_TURN, theta - CUBIC_THIRD_TURN);
    return radius * cos(angles) - B;
}

#endif
