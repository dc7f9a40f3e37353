/*---
summary = "Differences of the antiderivatives in closed form, width factor from cofactors"
source  = "Heitz & Hill 2017 for the integral; the closed differences and the factor |det Minv| |p1 x p2|/|q1 x q2| ours"

[[variant]]
name = "atan2"

[[variant]]
name = "atan2_precise"
precise = true

[[variant]]
name = "atan_difference"
summary = "Closed differences of the rational terms, the angle as atan(l2/d) - atan(l1/d)"
defines = { ATAN_DIFFERENCE = 1 }

[[variant]]
name = "acos"
summary = "Closed differences of the rational terms, the angle by acos of the normalised ends: nothing left at a distance"
defines = { ACOS = 1 }
---*/

// The published integral with the differences of its antiderivatives taken in closed form:
//
//     po.z term: (l2 - l1)(d^2 - l1 l2)/(d r1^2 r2^2) + angle/d^2        r_i = |q_i|
//     wt.z term: d (l2 - l1)(l2 + l1)/(r1^2 r2^2)
//
// angle is that between the ends: atan2(|q1 x q2|, q1.q2), or one of two ways found in production. The width factor
// 1/|M^T w| is |det Minv| |p1 x p2|/|q1 x q2|, from cofactors alone.
//
// Domain: as heitz2017. Equal ends and lines seen end-on have a zero normal and are answered 0.
// Source: Heitz & Hill 2017; the differences ours.
// Bound: rational terms within a few roundings; p1 x p2 and q1 x q2 lose distance over length, 2^-24 each. acos: the
// angle's absolute error is 2^-12, so all of a light that subtends less is noise.
// By distance over length, all scenarios below but edge, they fail at 1 to 10, to 100, to 1e3, to 1e4 and to 1e5 for
//   atan2 4.9, 3.7, 3, 6.4, 7.5 %     atan_difference 3.7, 3.6, 6, 11, 13 %     acos 19, 19, 72, 96, 96 %
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                          ggx       far   grazing      near   horizon     long       edge
//   atan2             4.4% 2e4  4.8% 4e4  2.7% 2e5  2.8% 1e4  2.5% 9e3  11% 5e4  11% n3.5%
//   atan_difference   3.5% 1e4  8.3% 3e6  2.2% 8e5  2.7% 2e5  2.3% 2e5  11% 2e6  11% n3.5%
//   acos               18% 1e8   71% 8e9  7.8% 6e8  3.1% 6e8   12% 7e8  11% 6e8  11% n3.5%

float ltc_line(mat3 minv, vec3 p1, vec3 p2)
{
    vec3 q1 = minv * p1;
    vec3 q2 = minv * p2;
    if (max(q1.z, q2.z) <= 0.0) {
        return 0.0;
    }
    float cofactor_width = abs(determinant(minv)) * length(cross(p1, p2));
    float mapped_area = length(cross(q1, q2));
    if (!(cofactor_width > 0.0) || !(mapped_area > 0.0)) {
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
    float d2 = dot(foot, foot);
    float d = sqrt(d2);
    float r1 = dot(q1, q1);
    float r2 = dot(q2, q2);
#if defined(ACOS)
    float angle = acos(clamp(dot(normalize(q1), normalize(q2)), -1.0, 1.0));
#elif defined(ATAN_DIFFERENCE)
    float angle = atan(l2 / d) - atan(l1 / d);
#else
    float angle = atan(length(cross(q1, q2)), dot(q1, q2));
#endif

    float span = (l2 - l1) / (r1 * r2);
    float integral =
        foot.z * (span * (d2 - l1 * l2) / d + angle / d2) + direction.z * d * span * (l2 + l1);
    return cofactor_width / mapped_area * integral * 0.318309886183790672;
}
