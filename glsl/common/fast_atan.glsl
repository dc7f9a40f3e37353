// atan for -1 <= x <= 1, odd polynomials of degrees 5 to 11 that are exact at 0 and 1.
//
// Source: D. Eberly, GPGPU Programming for Games and Science, 2014: minimax with both ends kept; errors 1.4e-3, 1.5e-4,
// 1.9e-5 and 2.6e-6.

#ifndef ROOTQ_FAST_ATAN
#define ROOTQ_FAST_ATAN

float fast_atan_5(float x)
{
    float z = x * x;
    return x * ((0.08729294651854674 * z - 0.30189478312144946) * z + 1.0);
}

float fast_atan_7(float x)
{
    float z = x * x;
    float p = -0.042330209451053591 * z + 0.15342994884206673;
    p = p * z - 0.32570157599356531;
    return x * (p * z + 1.0);
}

float fast_atan_9(float x)
{
    float z = x * x;
    float p = 0.022399635968909593 * z - 0.089253037587244677;
    p = p * z + 0.18383034738018011;
    p = p * z - 0.33157878236439586;
    return x * (p * z + 1.0);
}

float fast_atan_11(float x)
{
    float z = x * x;
    float p = -0.012490720064867844 * z + 0.05506335136696805;
    p = p * z - 0.11921576270475498;
    p = p * z + 0.19498657165383548;
    p = p * z - 0.33294527685374087;
    return x * (p * z + 1.0);
}

#endif
