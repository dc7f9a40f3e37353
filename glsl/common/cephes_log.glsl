// log(m) - (m - 1) for m in sqrt(1/2)..sqrt(2), and the split of x > 0 into 2^e m.
//
// Source: S. L. Moshier, Cephes Mathematical Library, 1989, single precision log.

#ifndef ROOTQ_CEPHES_LOG
#define ROOTQ_CEPHES_LOG

// The exponent, and the mantissa less 1, exactly; normal x only.
vec2 split_at_one(float x)
{
    // 0x3f3504f3 is sqrt(1/2): what is left of the bits above it are whole octaves from there.
    int bits = int(floatBitsToUint(x)) - 0x3f3504f3;
    int exponent = bits >> 23;
    float mantissa = uintBitsToFloat(uint((bits & 0x007fffff) + 0x3f3504f3));
    return vec2(float(exponent), mantissa - 1.0);
}

float cephes_log_rest(float r)
{
    float p = 7.0376836292e-2 * r - 1.1514610310e-1;
    p = p * r + 1.1676998740e-1;
    p = p * r - 1.2420140846e-1;
    p = p * r + 1.4249322787e-1;
    p = p * r - 1.6668057665e-1;
    p = p * r + 2.0000714765e-1;
    p = p * r - 2.4999993993e-1;
    p = p * r + 3.3333331174e-1;
    return p * r * r * r - 0.5 * r * r;
}

#endif
