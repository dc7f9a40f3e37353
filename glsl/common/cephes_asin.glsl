// asin for 0 <= x <= 1/2, to f32's last bits: x + x^3 p(x^2).
//
// Source: S. L. Moshier, Cephes Mathematical Library, 1989, single precision asin.

#ifndef ROOTQ_CEPHES_ASIN
#define ROOTQ_CEPHES_ASIN

float cephes_asin(float x)
{
    float z = x * x;
    float p = 4.2163199048e-2 * z + 2.4181311049e-2;
    p = p * z + 4.5470025998e-2;
    p = p * z + 7.4953002686e-2;
    p = p * z + 1.6666752422e-1;
    return p * z * x + x;
}

#endif
