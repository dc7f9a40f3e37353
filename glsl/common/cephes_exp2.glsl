// 2^x: the nearest whole power from bits, the rest in -1/2..1/2 by a polynomial.
//
// The power is the product of two, each an f32, so that subnormal results and the last octave come out; x is clamped to
// where the result is zero or infinite.
// Source of the polynomial: S. L. Moshier, Cephes Mathematical Library, 1989, single precision exp2.

#ifndef ROOTQ_CEPHES_EXP2
#define ROOTQ_CEPHES_EXP2

// value 2^whole for whole in -252..254.
float times_power(float value, float whole)
{
    int exponent = int(whole);
    int part = exponent >> 1;
    return value * uintBitsToFloat(uint(part + 127) << 23) * uintBitsToFloat(uint(exponent - part + 127) << 23);
}

float cephes_exp2(float x)
{
    x = clamp(x, -152.0, 129.0);
    float whole = roundEven(x);
    float r = x - whole;
    float p = 1.535336188319500e-4 * r + 1.339887440266574e-3;
    p = p * r + 9.618437357674640e-3;
    p = p * r + 5.550332471162809e-2;
    p = p * r + 2.402264791363012e-1;
    p = p * r + 6.931472028550421e-1;
    return times_power(p * r + 1.0, whole);
}

#endif
