// acos for 0 <= x <= 1 as sqrt(1 - x) p(x): the root takes the singularity at 1, so that a short polynomial does.
//
// Sources: M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 1964, 4.4.45 (three terms, 6.8e-5; the one that
// NVIDIA's Cg library documents as acos) and 4.4.46 (seven, 2e-8); D. Eberly, GPGPU Programming for Games and Science,
// 2014 (degrees 1 to 3, exact at both ends; 9.0e-3, 8.2e-4, 8.8e-5). S. Lagarde, "Inverse trigonometric functions GPU
// optimization for AMD GCN architecture", 2014, has the first degree with fewer digits.

#ifndef ROOTQ_FAST_ACOS
#define ROOTQ_FAST_ACOS

const float FAST_ACOS_PI = 3.14159265358979;
const float FAST_ACOS_HALF_PI = 1.57079632679490;

float fast_acos_eberly1(float x)
{
    return sqrt(1.0 - x) * (-0.15658276442180141 * x + FAST_ACOS_HALF_PI);
}

float fast_acos_eberly2(float x)
{
    return sqrt(1.0 - x) * ((0.046887774236182234 * x - 0.20347053865798365) * x + FAST_ACOS_HALF_PI);
}

float fast_acos_eberly3(float x)
{
    float p = -0.018823635069382449 * x + 0.074773789639484223;
    p = p * x - 0.21253291899190285;
    return sqrt(1.0 - x) * (p * x + FAST_ACOS_HALF_PI);
}

float fast_acos_abramowitz3(float x)
{
    float p = -0.0187293 * x + 0.0742610;
    p = p * x - 0.2121144;
    return sqrt(1.0 - x) * (p * x + 1.5707288);
}

float fast_acos_abramowitz7(float x)
{
    float p = -0.0012624911 * x + 0.0066700901;
    p = p * x - 0.0170881256;
    p = p * x + 0.0308918810;
    p = p * x - 0.0501743046;
    p = p * x + 0.0889789874;
    p = p * x - 0.2145988016;
    return sqrt(1.0 - x) * (p * x + 1.5707963050);
}

#endif
