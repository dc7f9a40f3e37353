// The positive root of p/(h1 + l) + q/(h2 + l) + z/l = 1, h1 >= h2: the confocal coordinate of a point over an ellipse. Ours.

#ifndef ROOTQ_CONFOCAL
#define ROOTQ_CONFOCAL

#include "common/elliptic_cone.glsl"

// The positive root x of weight/(pole + x) + z/x = 1, weight, pole, z >= 0, without cancellation.
float confocal_root(float weight, float pole, float z)
{
    float m = 0.5 * (weight + z - pole);
    float zp = z * pole;
    float d = sqrt(m * m + zp);
    return m > 0.0 ? m + d : zp / max(d - m, DISK_SMALLEST);
}

// A lower bound of l: first with h2 = 0, an upper bound u; then, with p/(h1 + u) in the place
// of p/(h1 + l), exactly for h2. The complement 1 - p/(h1 + u) is (q + z)/u.
//
// Good wherever l is far from h1 or from h2.
float confocal_start(float p, float h1, float q, float h2, float z)
{
    float m = 0.5 * (p + q + z - h1);
    float d = sqrt(m * m + (q + z) * h1);
    float share = (m > 0.0 ? m + d : h1) / max(m > 0.0 ? q + z : d - m, 1.0e-29);
    return confocal_root(q * share, h2, z * share);
}

#endif
