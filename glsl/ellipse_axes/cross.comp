/*---
summary = "Minor length from the area |V1 x V2|: no cancellation in det Q, minor axis orthogonal by construction"
source  = "ours, from det Q = |V1 x V2|^2 and the angle of Jacobi's method; error-free products by Dekker 1971 and Kahan"
tried   = "cross_split was thought safe without precise, since its products are exact: the audit shows lavapipe reassociating them; l_min as |W x major| saves a root but costs accuracy (99th percentile 3.6 u for 2.4 u, emulated); low halves multiplied by low halves apart from the rest gain nothing over al x b"

[[variant]]
name = "cross"

[[variant]]
name = "cross_precise"
precise = true

[[variant]]
name = "cross_fma"
summary = "cross, with V1 x V2 by Kahan's difference of products: as good as the device's fma() is fused"
defines = { FMA_AREA = 1 }

[[variant]]
name = "cross_fma_precise"
summary = "cross, with V1 x V2 by Kahan's difference of products: as good as the device's fma() is fused"
defines = { FMA_AREA = 1 }
precise = true

[[variant]]
name = "cross_dekker"
summary = "cross, with V1 x V2 by error-free products (Dekker's splitting): needs no fused fma()"
defines = { DEKKER_AREA = 1 }

[[variant]]
name = "cross_mask"
summary = "cross_dekker with the splitting done by masking bits: one operation in seven fewer, the same accuracy"
defines = { MASK_AREA = 1 }

[[variant]]
name = "cross_split"
summary = "cross, with V1 x V2 from exact partial products: half of cross_dekker's operations, but lavapipe adds the parts up again"
defines = { SPLIT_AREA = 1 }

[[variant]]
name = "cross_split_precise"
summary = "cross_split with every operation NoContraction: the partial products stay apart, and the area is good to 2^-34 aspect"
defines = { SPLIT_AREA = 1 }
precise = true

[[variant]]
name = "cross_scaled"
summary = "cross, the vectors first scaled exactly by powers of two: any size"
defines = { SCALED = 1 }

[[variant]]
name = "cross_scaled_precise"
summary = "cross, the vectors first scaled exactly by powers of two: any size"
defines = { SCALED = 1 }
precise = true

[[variant]]
name = "cross_fma_scaled"
summary = "cross_fma, the vectors first scaled exactly by powers of two: any size"
defines = { FMA_AREA = 1, SCALED = 1 }

[[variant]]
name = "cross_fma_scaled_precise"
summary = "cross_fma, the vectors first scaled exactly by powers of two: any size"
defines = { FMA_AREA = 1, SCALED = 1 }
precise = true

[[variant]]
name = "cross_dekker_scaled"
summary = "cross_dekker, the vectors first scaled exactly by powers of two: any size"
defines = { DEKKER_AREA = 1, SCALED = 1 }
---*/

// Axes of the ellipse V1 cos t + V2 sin t, the minor ones through the area: det Q = |V1 x V2|^2, so the smaller
// length needs neither det Q nor a difference of eigenvalues.
//
//     tau = |d11 - d22|/2, h = hypot(tau, d12), k = d12 / (tau + h)      |k| <= 1
//     e_max = d_long + k d12 = (d11 + d22)/2 + h                         every term >= 0
//     major ~ V_long + k V_short
//     W     = (V1 x V2) / l_max,  l_min = |W|
//     minor = (W x major) / |W x major|
//
// Dividing the area vector before taking its length keeps the squares within range; normalising W x major (rather
// than dividing it by |W|) keeps the minor axis a unit vector even where V1 x V2 is nothing but rounding error.
//
// SCALED brings both vectors to one common power of two for the major axis, each to its own for the area, and the
// area to one again before its length is taken.
//
// Domain: lengths between 2^-30 and 2^30, the minor one above 2^-60 (below it counts as zero); SCALED: any finite
// vectors, denormals counting as zero where the device flushes them, and DEKKER_AREA exact only down to components
// 2^-78 as large as their vector's largest. Parallel, equal and zero vectors and circles are included: always finite
// unit axes.
// Source: ours; the angle as in Jacobi's method; DEKKER_AREA: Dekker, "A floating-point technique for extending the
// available precision", 1971; FMA_AREA: Kahan's difference of products; MASK_AREA, SPLIT_AREA: ours, after Dekker.
// Bound, with u = 2^-24 and correctly rounded division and square root: l_max within 4 u; l_min within 10 u, plus
// what the area adds for skewed vectors: u aspect plainly, and with FMA_AREA where fma() is not fused; 2^-34 aspect
// with SPLIT_AREA; nothing below aspect 2^22 with DEKKER_AREA, MASK_AREA and a fused FMA_AREA.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                  scene           aspect      near_circle            scale             edge
//   cross                            0 4          0 3e+05           8x 3.5             0 27     12.5 % 2e+09
//   cross_fma                        0 4          0 3e+05           8x 3.5             0 27     12.5 % 2e+09
//   cross_dekker                     0 4            0 3.6           8x 3.5            0 3.5     12.4 % 2e+07
//   cross_mask                       0 4            0 3.6           8x 3.5            0 3.5     12.4 % 2e+07
//   cross_split                    0 3.8          0 2e+05           8x 3.5             0 19     12.5 % 2e+07
//   cross_split_precise              0 4             0 98           8x 3.9            0 3.5       12.4 % inf
//   cross_scaled                     0 4          0 3e+05           8x 3.5             0 27   0.0398 % 2e+09
//   cross_fma_scaled                 0 4          0 3e+05           8x 3.5             0 27   0.0398 % 2e+09
//   cross_dekker_scaled              0 4            0 3.6           8x 3.5            0 3.5         4x 8e+06

#include "common/eigen_angle.glsl"
#include "common/orthogonal.glsl"
#if defined(FMA_AREA) || defined(DEKKER_AREA) || defined(MASK_AREA) || defined(SPLIT_AREA)
#include "common/error_free.glsl"
#endif
#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

const float SMALLEST_NORMAL = 1.17549435e-38;

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    vec3 a1 = v1;
    vec3 a2 = v2;
#ifdef SCALED
    float scale1 = scale_to_one(largest_component(v1));
    float scale2 = scale_to_one(largest_component(v2));
    float scale = min(scale1, scale2);
    a1 *= scale1;
    a2 *= scale2;
    v1 *= scale;
    v2 *= scale;
#endif

    float d11 = dot(v1, v1);
    float d22 = dot(v2, v2);
    float d12 = dot(v1, v2);

    bool first_is_longer = d11 >= d22;
    float d_long = first_is_longer ? d11 : d22;
    float d_short = first_is_longer ? d22 : d11;
    if (!(d_long > 0.0)) {
        return EllipseAxes(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), 0.0, 0.0);
    }
    float k = eigen_tangent(d_long, d_short, d12);
    float l_max = sqrt(d_long + k * d12);

    vec3 major = first_is_longer ? v1 + k * v2 : v2 + k * v1;
    major *= inversesqrt(dot(major, major));

#if defined(DEKKER_AREA)
    vec3 area = cross_dekker(a1, a2);
#elif defined(FMA_AREA)
    vec3 area = cross_fma(a1, a2);
#elif defined(MASK_AREA)
    vec3 area = cross_mask(a1, a2);
#elif defined(SPLIT_AREA)
    vec3 area = cross_split(a1, a2);
#else
    vec3 area = a1.yzx * a2.zxy - a1.zxy * a2.yzx;
#endif
    area /= l_max;
#ifdef SCALED
    float area_scale = scale_to_one(largest_component(area));
    area *= area_scale;
#endif
    float l_min = length(area);

    vec3 minor = cross(area, major);
    float squared = dot(minor, minor);
    minor = squared >= SMALLEST_NORMAL ? minor * inversesqrt(squared) : any_orthogonal(major);

#ifdef SCALED
    l_max *= reciprocal_power_of_two(scale);
    l_min *= reciprocal_power_of_two(area_scale);
    l_min *= reciprocal_power_of_two(max(scale1, scale2));
#endif
    return EllipseAxes(major, minor, l_max, min(l_min, l_max));
}
