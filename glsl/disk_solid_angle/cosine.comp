/*---
summary = "2 pi (1 - cos theta) with theta = atan(R/d): cancels where the disk is far"
source  = "Bourke, Solid angle of a pixel, 2017 (test case)"

[[variant]]
name = "cos_atan"

[[variant]]
name = "ratio"
summary = "2 pi (1 - d/sqrt(R^2 + d^2)): the same without trigonometry, and the same cancellation"
defines = { RATIO = 1 }

[[variant]]
name = "sine"
summary = "2 pi (1 - sqrt(1 - sin^2 theta)), the form at hand where a light's squared sine is stored"
defines = { SINE = 1 }
---*/

// The cap's height 1 - cos theta as a difference from 1, in three spellings.
//
// Domain: R/d above about 1e-2; d > 0 and lengths within 2^-60..2^60 of 1. No guard is added.
// Source: Bourke, "Solid angle of a pixel", 2017: "2 pi (1 - cos(theta)) where theta is atan(R)" for d = 1.
// Bound: 2^-24 of 2 pi absolutely, so (2d/R)^2 2^-24 relatively: 0.1 % at 65 radii, nothing left at 4000.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                     scene            far      near          scale           edge
//   cos_atan  1.21 % 9.1e-3  61.2 % 1.0e+0  0 8.2e-6       0 6.3e-4  11.9 % 1.0e+0
//   ratio     2.25 % 2.6e-2  63.2 % 6.0e+0  0 3.2e-7  0.43 % 2.0e+4     40.1 % inf
//   sine      1.47 % 1.3e-2  61.7 % 3.0e+0  0 2.4e-4  0.22 % 1.0e+0     33.2 % inf

float disk_solid_angle(float radius, float distance)
{
    const float TAU = 6.28318530717958648;
#if defined(RATIO)
    float cosine = distance / sqrt(radius * radius + distance * distance);
#elif defined(SINE)
    float cosine = sqrt(1.0 - radius * radius / (radius * radius + distance * distance));
#else
    float cosine = cos(atan(radius / distance));
#endif
    return TAU * (1.0 - cosine);
}
