/*---
summary = "2 pi R^2/(h (h + d)), h = hypot(R, d): a quotient of sums of positive terms"
source  = "ours: 1 - d/h = (h^2 - d^2)/(h (h + d))"

[[variant]]
name = "stable"

[[variant]]
name = "stable_precise"
precise = true

[[variant]]
name = "stable_scaled"
summary = "stable, both lengths first scaled exactly by a power of two: any size"
defines = { SCALED = 1 }
---*/

// Domain: lengths within 2^-60..2^60 of 1; SCALED: any, where the shorter counts as zero below 2^-60 of the longer and
// denormals count as zero where the device flushes them. A zero radius gives 0, also from the disk's centre; signs do
// not count.
// Source: ours.
// Bound: 9 u, u = 2^-24, for division within 2.5 ULP and a root within 3.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     scene       far      near          scale        edge
//   stable         0 3.6e-7  0 3.5e-7  0 3.6e-7  0.22 % 1.0e+0  15.7 % inf
//   stable_scaled  0 3.6e-7  0 3.5e-7  0 3.6e-7       0 3.6e-7    0 3.3e-7

#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

float disk_solid_angle(float radius, float distance)
{
    radius = abs(radius);
    distance = abs(distance);
    if (!(radius > 0.0)) {
        return 0.0;
    }
#ifdef SCALED
    float scale = scale_to_one(max(radius, distance));
    radius *= scale;
    distance *= scale;
#endif
    float h = sqrt(radius * radius + distance * distance);
    float sine = radius / h;
    return 6.28318530717958648 * sine * (radius / (h + distance));
}
