/*---
summary = "The published line light: antiderivatives Fpo and Fwt at both ends, width factor from the inverse matrix"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course"

[[variant]]
name = "heitz2017"

[[variant]]
name = "heitz2017_precise"
precise = true

[[variant]]
name = "no_width_factor"
summary = "Control: the line's integral in the cosine's space as it stands, which the talk shows to be wrong"
defines = { NO_WIDTH_FACTOR = 1 }

[[variant]]
name = "atan_of_inverse"
summary = "Control: a port's slip, atan(1/d) for atan(l/d), so that the angle's term vanishes"
defines = { ATAN_OF_INVERSE = 1 }
---*/

// The cosine along the line Minv p1 .. Minv p2 above the horizon, from antiderivatives in the distance l along it:
//
//     I = (1/|M^T w|) (1/pi) [ po.z (Fpo(l2) - Fpo(l1)) + wt.z (Fwt(l2) - Fwt(l1)) ]
//     Fpo(l) = l/(d (d^2 + l^2)) + atan(l/d)/d^2        Fwt(l) = l^2/(d (d^2 + l^2))
//
// with wt the line's direction, po its foot, d = |po|, and w the unit normal of the plane through the origin and the
// light before Minv. The factor is what Minv does to an infinitesimal width.
//
// Domain: ends apart and not in line with the point. No guard is added to the published formulas: equal ends and lines
// seen end-on give 0/0 wherever rounding lets them.
// Source: Heitz & Hill 2017.
// Bound: the differences lose l/(l2 - l1) of their digits, as does d: a relative error of about 2^-24 times distance
// over length, plus the same for the normal p1 x p2.
// By distance over length, all scenarios below but edge, heitz2017 fails for 3.8 % at 1 to 100, 7 % at 100 to 1e3, 14 % at 1e3 to
// 1e4 and 16 % beyond: what fails nearer is at the horizon or closer to the infinite line than 1e-4 of the length (9 to 14 %).
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                            ggx      far   grazing      near   horizon      long      edge
//   heitz2017           3.6% 5e4  10% 3e6  2.2% 3e6  2.6% 2e5  2.3% 6e5   11% 1e6  52% n46%
//   heitz2017_precise   3.6% 3e4  10% 3e6  2.2% 3e6  2.6% 2e5  2.3% 6e5   11% 1e6  52% n46%
//   no_width_factor      96% 1e5  48% 2e7   51% 4e6   49% 1e6   99% 7e5   54% 5e7  44% n16%
//   atan_of_inverse      96% 8e6  97% 3e7  100% 2e8   99% 2e8  100% 3e6  100% 6e8  72% n46%

float fpo(float d, float l)
{
#ifdef ATAN_OF_INVERSE
    return l / (d * (d * d + l * l)) + atan(1.0 / d) / (d * d);
#else
    return l / (d * (d * d + l * l)) + atan(l / d) / (d * d);
#endif
}

float fwt(float d, float l)
{
    return l * l / (d * (d * d + l * l));
}

float ltc_line(mat3 minv, vec3 p1, vec3 p2)
{
    vec3 q1 = minv * p1;
    vec3 q2 = minv * p2;
    if (q1.z <= 0.0 && q2.z <= 0.0) {
        return 0.0;
    }
    vec3 direction = normalize(q2 - q1);
    if (q1.z < 0.0) {
        q1 = (q1 * q2.z - q2 * q1.z) / (q2.z - q1.z);
    }
    if (q2.z < 0.0) {
        q2 = (q2 * q1.z - q1 * q2.z) / (q1.z - q2.z);
    }

    float l1 = dot(q1, direction);
    float l2 = dot(q2, direction);
    vec3 foot = q1 - l1 * direction;
    float d = length(foot);
    float integral =
        foot.z * (fpo(d, l2) - fpo(d, l1)) + direction.z * (fwt(d, l2) - fwt(d, l1));

#ifdef NO_WIDTH_FACTOR
    float width = 1.0;
#else
    vec3 normal = normalize(cross(p1, p2));
    float width = 1.0 / length(inverse(transpose(minv)) * normal);
#endif
    return width * integral * 0.318309886183790672;
}
