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
// Measured: 300K a scenario, lavapipe (Mesa 22.3), inaccurate: atan2 4.4 % of tubes over a floor, 4.9 % far, 11 %
// long; atan_difference 3.6, 8.4, 11 %; acos 18, 71, 11 %. Median relative error of a half-length 0.25 at distance 10 /
// 100 / 1000: atan2 1e-5 (the driver's atan) / 1.3e-5 / 3e-5; atan_difference 1e-5 / 1.3e-5 / 6e-5; acos 1.3e-4 / 1.3e-3 / 0.12.

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
