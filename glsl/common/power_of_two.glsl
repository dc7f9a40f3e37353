// Exact scaling by powers of two, built from bits: no frexp or ldexp, whose handling of extremes differs between
// drivers. Ours.

#ifndef ROOTQ_POWER_OF_TWO
#define ROOTQ_POWER_OF_TWO

float largest_component(vec3 v)
{
    vec3 a = abs(v);
    return max(a.x, max(a.y, a.z));
}

// The power of two that brings a finite m >= 0 into [1, 2), kept within 2^-126..2^126 so that its reciprocal is a
// normal number too: from 2^127 on the result lies in [2, 4), zero and denormals are multiplied by 2^126.
float scale_to_one(float m)
{
    int exponent = int(floatBitsToUint(m) >> 23) & 255;
    return uintBitsToFloat(uint(clamp(254 - exponent, 1, 253)) << 23);
}

// The same for [2^k, 2^(k + 1)).
float scale_to_power(float m, int k)
{
    int exponent = int(floatBitsToUint(m) >> 23) & 255;
    return uintBitsToFloat(uint(clamp(254 + k - exponent, 1, 253)) << 23);
}

// The exact reciprocal of a power of two in 2^-126..2^126.
float reciprocal_power_of_two(float s)
{
    return uintBitsToFloat((254u << 23) - floatBitsToUint(s));
}

// x times a over b, two powers of two in 2^-126..2^126, rounded only if the result is denormal.
float times_ratio(float x, float a, float b)
{
    int exponent = int(floatBitsToUint(a) >> 23) - int(floatBitsToUint(b) >> 23);
    int half_way = exponent / 2;
    float first = uintBitsToFloat(uint(half_way + 127) << 23);
    float second = uintBitsToFloat(uint(exponent - half_way + 127) << 23);
    return x * first * second;
}

#endif
