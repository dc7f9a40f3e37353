// The arctangent within 3 roundings. Vulkan lets atan() be off by 4096 ULP, and Mesa's is off by 2e-5 of small angles, which a
// quotient or a difference of angles does not survive. Ours.

#ifndef ROOTQ_ARCTANGENT
#define ROOTQ_ARCTANGENT

// atan(r) for -1 <= r <= 1: a polynomial of degree 8 in r^2 for atan(r)/r, near-minimax with relative error 1.6e-8, in two
// chains.
float arctangent_small(float r)
{
    float s = r * r;
    float q = s * s;
    float even = (((0.00284988026 * q + 0.0426914587) * q + 0.106409316) * q + 0.199926193) * q + 0.999999985;
    float odd = ((-0.0160685916 * q - 0.0750428943) * q - 0.142036439) * q - 0.333330733;
    return r * (even + s * odd);
}

// The angle of (x, y), y >= 0, in 0..pi: relative error below 3e-7; 0 at the origin. Squares are not formed.
float arctangent_upper(float y, float x)
{
    float ax = abs(x);
    float angle = arctangent_small(min(ax, y) / max(max(ax, y), 1.17549435e-38));
    angle = y > ax ? 1.57079632679 - angle : angle;
    return x < 0.0 ? 3.14159265359 - angle : angle;
}

// The angle of (x, y) in -pi..pi.
float arctangent(float y, float x)
{
    float angle = arctangent_upper(abs(y), x);
    return y < 0.0 ? -angle : angle;
}

// The same for finite arguments; NaN if one is NaN, also where min() and max() drop it.
float arctangent_quotient(float y, float x)
{
    bool steep = abs(y) > abs(x);
    float angle = arctangent_small(steep ? x / y : y / x);
    float turn = y < 0.0 ? -3.14159265359 : 3.14159265359;
    return steep ? 0.5 * turn - angle : (x < 0.0 ? turn + angle : angle);
}

#endif
