//! The contour integral of (q x dq).z/|q|^2 around something thin or distant, without what cancels.
//!
//! The integrals along the two generators of such a cylinder are nearly opposite. Both have the same chord, and their
//! ends differ by a vector that is known to all its digits, so the difference of the two angles and of the normals' heights
//! is had from that vector: every term is as small as the contour is narrow. A small rim's integrand is nearly a trigonometric
//! polynomial, which Gauss's rule integrates to all digits of f64. Source: ours.

use core::f64::consts::FRAC_1_PI;

use glam::DVec3;

use super::gauss_legendre::{POINTS_8, POINTS_16, POINTS_24};
use super::half_turn::sin_cos;

/// An integral, and what its error is a few roundings of.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    pub value: f64,
    pub size: f64,
}

/// A pair of points middle + half and middle - half.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    pub middle: DVec3,
    pub half: DVec3,
}

impl Pair {
    pub fn ends(self) -> [DVec3; 2] {
        [self.middle + self.half, self.middle - self.half]
    }
}

/// An arc of the ellipse center + cos t X + sin t Y, |t| <= half.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    pub center: DVec3,
    pub cos: DVec3,
    pub sin: DVec3,
    pub half: f64,
    rule: &'static [(f64, f64)],
    /// What the rule is off by at the most.
    pub truncation: f64,
}

impl Arc {
    /// `None` if Gauss's rule on 24 points could be off by more than 2^-40 of the ellipse's size over its distance.
    ///
    /// For t = s + iy the offset cos t X + sin t Y is at most R e^|y|, R^2 = |X|^2 + |Y|^2. Where that is a third of |C|
    /// the integrand is at most (1/3 + 1/9)/(1 - 2/3 - 1/9) = 2, and n points are off by at most (64/15) 2 half
    /// rho^-2n/(1 - rho^-2), rho - 1/rho = 2 y/half (Trefethen, "Approximation theory and approximation practice", 2013,
    /// theorem 19.3).
    pub fn new(center: DVec3, cos: DVec3, sin: DVec3, half: f64) -> Option<Arc> {
        let distance2 = center.length_squared();
        let size2 = (cos.length_squared() + sin.length_squared()) / distance2;
        // At 1/16 rho is 1.66 at the least.
        if !(size2 < 1.0 / 256.0) {
            return None;
        }
        let slope = -0.5 * libm::log(9.0 * size2) / half;
        let inverse = (slope * slope + 1.0).sqrt() - slope;
        let square = inverse * inverse;
        let fourth = square * square;
        let of_8 = fourth * fourth * fourth * fourth;
        let whole = 8.54 * half / (1.0 - square);
        let allowed = size2.sqrt() / (1u64 << 40) as f64;
        // What lies low is dim, and bears less.
        let lift = (center.z * center.z / distance2).sqrt();
        let (rule, truncation) = if whole * of_8 <= allowed * lift {
            (&POINTS_8[..], whole * of_8)
        } else if whole * of_8 * of_8 <= allowed * lift {
            (&POINTS_16[..], whole * of_8 * of_8)
        } else if whole * of_8 * of_8 * of_8 <= allowed {
            (&POINTS_24[..], whole * of_8 * of_8 * of_8)
        } else {
            return None;
        };
        Some(Arc { center, cos, sin, half, rule, truncation })
    }

    /// The integral, t growing, and the integrals of D, D cos t and D sin t: D = -(1/pi) q.z/|q|^4 (q x dq) is the derivative
    /// of the irradiance by the contour's point.
    pub fn integrate(&self) -> (Part, [DVec3; 3]) {
        let &Arc { center, cos, sin, half, rule, .. } = self;
        // q x dq/dt = cos t C x Y - sin t C x X + X x Y.
        let (of_cos, of_sin, of_one) = (center.cross(sin), -center.cross(cos), cos.cross(sin));
        let mut value = 0.0;
        // The sums of weight q.z/|q|^4 times products of (1, cos t, sin t).
        let (mut one, mut c1, mut s1, mut cc, mut cs, mut ss) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for &(abscissa, weight) in rule {
            let (s, c) = sin_cos(abscissa * half);
            let (even, odd) = (center + c * cos, s * sin);
            let (height, slope) = (c * of_cos.z + of_one.z, s * of_sin.z);
            let mut add = |q: DVec3, normal_z: f64, s: f64| {
                let inverse = 1.0 / q.length_squared();
                let share = weight * inverse;
                value += share * normal_z;
                let by = share * inverse * q.z;
                let (by_c, by_s) = (by * c, by * s);
                one += by;
                c1 += by_c;
                s1 += by_s;
                cc += by_c * c;
                cs += by_c * s;
                ss += by_s * s;
            };
            add(even + odd, height + slope, s);
            add(even - odd, height - slope, -s);
        }
        let moments = [(one, c1, s1), (c1, cc, cs), (s1, cs, ss)]
            .map(|(by_one, by_cos, by_sin)| by_one * of_one + by_cos * of_cos + by_sin * of_sin);
        // |q| is 15/16 of |C| at the least, |dq| at most the axes' root of squares.
        let extent = ((cos.length_squared() + sin.length_squared()) / center.length_squared()).sqrt();
        let part = Part { value: half * value, size: 2.2 * half * extent };
        (part, moments.map(|by| -FRAC_1_PI * half * by))
    }
}

/// Two parallel generators, or what is visible of them.
#[derive(Clone, Copy, Debug)]
pub struct Generators {
    pub start: Pair,
    pub end: Pair,
    /// The normals (a point of each) x chord.
    pub normal: Pair,
    /// (end - start)/chord.
    pub part: [f64; 2],
    /// The difference of the two, known by itself.
    pub part_difference: f64,
    /// What the middle normal is a rounding of, over its length.
    pub cancelled: f64,
}

impl Generators {
    /// The integral along the first less that along the second.
    pub fn integrate(&self) -> Part {
        let Generators { start, end, normal, part, part_difference, cancelled } = self;
        let normals = normal.ends();
        let lengths = normals.map(DVec3::length);
        let [starts, ends] = [start.ends(), end.ends()];
        let length_difference = 4.0 * normal.middle.dot(normal.half) / (lengths[0] + lengths[1]);
        let sines = [part[0] * lengths[0], part[1] * lengths[1]];
        let sine_difference = part_difference * lengths[0] + part[1] * length_difference;
        let cosines = [starts[0].dot(ends[0]), starts[1].dot(ends[1])];
        let cosine_difference = 2.0 * (start.middle.dot(end.half) + start.half.dot(end.middle));

        let scale = cosines[0] * cosines[1] + sines[0] * sines[1];
        let turn = (sine_difference * cosines[0] - sines[0] * cosine_difference).atan2(scale);
        let angle = sines[0].atan2(cosines[0]) - 0.5 * turn;
        let heights = [normals[0].z / lengths[0], normals[1].z / lengths[1]];
        let height = 0.5 * (heights[0] + heights[1]);
        let rise = (2.0 * normal.half.z - heights[1] * length_difference) / lengths[0];

        // The same with magnitudes in place of what could cancel.
        let width = 2.0 * normal.half.length();
        let of_sine = part_difference.abs() * lengths[0] + part[1] * width;
        let of_cosine =
            2.0 * (start.middle.length() * end.half.length() + start.half.length() * end.middle.length());
        let of_turn = (of_sine * cosines[0].abs() + sines[0] * of_cosine) / scale.abs();
        let lost = 1.0 + cancelled;
        let size =
            lost * (of_turn * height.abs() + angle.abs() * width / lengths[0]) + cancelled * turn.abs();
        Part { value: turn * height + angle * rise, size }
    }
}

/// The integral along the horizon from the first of the pair to the second.
pub fn along_horizon(pair: Pair) -> Part {
    let ([from, to], way) = (pair.ends().map(DVec3::truncate), -2.0 * pair.half.truncate());
    let (sine, cosine) = (from.perp_dot(way), from.dot(to));
    let value = sine.atan2(cosine);
    Part { value, size: way.length() / from.length() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::double_double::{DoubleDouble, Real};
    use crate::numeric::elliptic_arc::{Vector, cross, dot};
    use crate::numeric::gauss_legendre::visit;
    use crate::sample::Stream;

    /// The same rule on eight panels, and the bound on one panel is no empty one.
    #[test]
    fn one_panel_is_enough_for_a_small_rim() {
        let (mut compared, mut coarse) = (0, 0);
        Stream::new(3, "slim arcs").visit(0, 1_000, |_, draw| {
            let center = draw.direction();
            let (x, y) = (
                draw.log_uniform(1e-4, 0.1) * draw.direction(),
                draw.log_uniform(1e-4, 0.1) * draw.direction(),
            );
            let half = draw.uniform(0.1, 3.1);
            let Some(arc) = Arc::new(center, x, y, half) else {
                coarse += 1;
                return;
            };
            let mut expected = 0.0;
            for panel in 0..8 {
                let at = |k: i32| half * (f64::from(k) / 4.0 - 1.0);
                visit(&POINTS_16, at(panel), at(panel + 1), |t, weight| {
                    let q = center + t.cos() * x + t.sin() * y;
                    expected += weight * q.cross(t.cos() * y - t.sin() * x).z / q.length_squared();
                });
            }
            let (part, _) = arc.integrate();
            // A few roundings in either.
            let allowed = arc.truncation + 3.0 * f64::EPSILON * part.size;
            assert!((part.value - expected).abs() <= allowed, "{arc:?}: {part:?} for {expected}");
            compared += 1;
        });
        assert!(compared > 300 && coarse > 10, "{compared} {coarse}");
    }

    #[test]
    fn generators_differ_by_what_double_double_says() {
        let lift = |v: DVec3| -> Vector<DoubleDouble> { v.to_array().map(DoubleDouble::from) };
        let integral = |a: Vector<DoubleDouble>, chord: Vector<DoubleDouble>| {
            let b = [0, 1, 2].map(|k| a[k] + chord[k]);
            let normal = cross(a, chord);
            let length = dot(normal, normal).sqrt();
            length.atan2(dot(a, b)) * normal[2] / length
        };
        Stream::new(4, "slim generators").visit(0, 2_000, |_, draw| {
            // Coordinates of few bits, so that the points' sums are exact.
            let short = |v: DVec3| (v * 1_048_576.0).round() / 1_048_576.0;
            let (middle, chord) =
                (short(draw.direction()), short(draw.log_uniform(0.1, 3.0) * draw.direction()));
            let half = short(draw.log_uniform(1e-4, 0.05) * draw.direction());
            let [start, end] = [middle, middle + chord].map(|middle| Pair { middle, half });
            let normal = Pair { middle: middle.cross(chord), half: half.cross(chord) };
            let cancelled = chord.length() / normal.middle.length();
            if cancelled > 100.0 || normal.middle.length() < 2.0 * normal.half.length() {
                return;
            }
            let part = Generators { start, end, normal, part: [1.0; 2], part_difference: 0.0, cancelled }
                .integrate();
            let [first, second] = start.ends().map(|a| integral(lift(a), lift(chord)));
            let error = (DoubleDouble::from(part.value) - (first - second)).to_f64().abs();
            assert!(error <= 3.0 * f64::ROUNDOFF * part.size, "{start:?} {chord}: {part:?} off by {error:e}");
        });
    }
}
