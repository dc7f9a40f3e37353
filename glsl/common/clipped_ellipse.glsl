// The irradiance of an elliptic cone's part above the horizon, in closed form: no table, no equal-area sphere. Ours.
//
// With the dual quadric's eigenvalues e1 >= e3 > 0 > -l, heights W1, W2, W3 of its unit axes, A = l + e1, B = l + e3, k = e1 - e3, and
//
//     szz = e1 W1^2 + e3 W2^2 - l W3^2 > 0, which says that the horizon cuts the cone      m = szz + l W3^2
//
// Stokes' theorem along the rim between the crossings, closed along the horizon, gives
//
//     2 pi E = F turn + dphi - 2 v sqrt(szz) (W1^2 atanh(x, z)/z + W2^2 atan(y, c)/y)      v = |[C, V1, V2]| = sqrt(e1 e3 l)
//
//     F     the whole cone's irradiance, signed: v W3/sqrt(l A B)
//     turn  = angle(-2 sqrt(l A B szz) W3, t - l szz) in 0..2 pi           t = l (A + B - l) W3^2 - e1 e3 (1 - W3^2)
//     dphi  = angle(2 v sqrt(szz), t + l szz), between the crossings' azimuths
//     z, x  = 2 sqrt(szz A e1 k W1^2), x^2 = z^2 + the square of turn's arguments
//     y, c  = 2 sqrt(szz B e3 k W2^2), t + (B + e3) szz
//
// All three angles come from one t: where the horizon touches a needle, t is what is left of its terms, and the angles are off
// together, which their sum does not see. Of sums of positive terms, x = l m + k szz + e1^2 W1^2 + e3^2 W2^2 and
// c = l (m + k W3^2) + e3 (m - k W2^2), each would be off on its own, half of what fails for rounding.
//
// in which the axes occur by k W1^2 = m - e3 (1 - W3^2) and k W2^2 alone: no eigenvector but the mean direction is needed.
// The differences of antiderivatives are single functions by the addition theorems, so that small, far and circular lights
// (k -> 0) cancel nothing: each term is within a few roundings of itself, and a light that subtends an angle w is off by about
// 2^-22 w.

#ifndef ROOTQ_CLIPPED_ELLIPSE
#define ROOTQ_CLIPPED_ELLIPSE

#include "common/arctangent.glsl"
#include "common/elliptic_cone.glsl"

const float CLIPPED_TURN = 6.28318530718;

// No z is less: x divides, and its square has to be in f32's range.
const float CLIPPED_TINY = 1.0e-18;

// atanh(z/x)/z = log(sum^2/square)/(2 z) for sum = x + z, square = x^2 - z^2 >= 0, z >= CLIPPED_TINY: within 6e-7. The logarithm is split into
// a power of two 2^n and atanh(r), |r| <= 0.2; for n = 0 it is r = z/x itself.
float clipped_log_ratio(float x, float z, float square)
{
    float sum = max((x + z) * (x + z), DISK_SMALLEST);
    square = max(square, DISK_SMALLEST);
    // The difference of the bits is the difference of the logarithms to base 2, up to 0.09.
    int n = (floatBitsToInt(sum) - floatBitsToInt(square) + (1 << 22)) >> 23;
    bool small = n == 0;
    float scaled = uintBitsToFloat(uint(clamp(127 + n, 1, 254)) << 23) * square;
    float r = (small ? z : sum - scaled) / (small ? x : sum + scaled);
    float s = r * r;
    float p = 1.0 + s * (0.33333334 + s * (0.19998 + s * 0.1463));
    return (small ? p : 0.34657359 * float(n) + r * p) / (small ? x : z);
}

float clipped_ellipse(DiskCone cone, float szz)
{
    float l = cone.l;
    float root2 = 2.0 * sqrt(szz);
    float w3 = cone.height2;
    float rest = cone.level2;
    float k = sqrt(max(cone.sum * cone.sum - 4.0 * cone.product, 0.0));
    float e1 = 0.5 * (cone.sum + k);
    float e3 = cone.product / max(e1, DISK_SMALLEST);
    float A = l + e1;
    float B = l + e3;
    float m = l * w3 + szz;
    float k1 = clamp(m - e3 * rest, 0.0, k * rest);
    float k2 = k * rest - k1;
    float w1 = k1 / max(k, DISK_SMALLEST);
    float w2 = rest - w1;

    float sine = root2 * cone.slant;
    float swing = l * (l + cone.sum) * w3 - cone.product * rest;
    float cosine = swing - l * szz;
    float turn = arctangent_upper(abs(sine), cosine);
    turn = sine > 0.0 ? CLIPPED_TURN - turn : turn;

    float z = max(root2 * sqrt(A * (e1 * k1)), CLIPPED_TINY);
    float square = sine * sine + cosine * cosine;
    float first = clipped_log_ratio(sqrt(square + z * z), z, square);

    float y = root2 * sqrt(B * (e3 * k2));
    float c = swing + (B + e3) * szz;
    bool narrow = y <= 1.0e-4 * c;
    float second = (narrow ? 1.0 : arctangent_upper(y, c)) / (narrow ? c : max(y, DISK_SMALLEST));

    float scale = cone.volume * root2;
    float dphi = arctangent_upper(scale, swing + l * szz);
    float sum = cone.whole * turn + dphi - scale * (w1 * first + w2 * second);
    // No part gives more than all of the cone does from straight above. Where the horizon only touches a light that looks
    // like nothing, the angles are rounding.
    float most = sqrt(cone.product / max(l * (l + cone.sum) + cone.product, DISK_SMALLEST));
    return clamp(sum * (1.0 / CLIPPED_TURN), 0.0, most);
}

#endif
