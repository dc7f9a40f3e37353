// The arctangent within 3 roundings. Vulkan lets atan() be off by 4096 ULP, and Mesa's is off by 2e-5 of small angles, which a
// quotient or a difference of angles does not survive. Ours.

#ifndef ROOTQ_ARCTANGENT
#define ROOTQ_ARCTANGENT

// The angle of (x, y), y >= 0, in 0..pi: relative error below 3e-7; 0 at the origin. Squares are not formed.
//
// atan(r)/r on 0..1 is a polynomial of degree 8 in r^2, near-minimax with relative error 1.6e-8.
float arctangent_upper(float y, float x)
{
    float ax = abs(x);
    float r = min(ax, y) / max(max(ax, y), 1.17549435e-38);
    float s = r * r;
    float p = 0.00284988026;
    p = p * s - 0.0160685916;
    p = p * s + 0.0426914587;
    p = p * s - 0.0750428943;
    p = p * s + 0.106409316;
    p = p * s - 0.142036439;
    p = p * s + 0.199926193;
    p = p * s - 0.333330733;
    p = p * s + 0.999999985;
    float angle = r * p;
    angle = y > ax ? 1.57079632679 - angle : angle;
    return x < 0.0 ? 3.14159265359 - angle : angle;
}

// The angle of (x, y) in -pi..pi.
float arctangent(float y, float x)
{
    float angle = arctangent_upper(abs(y), x);
    return y < 0.0 ? -angle : angle;
}

#endif
