//! The clamped cosine along a straight line: moments of 1/|q|^4 in which no term cancels.
//!
//! Along q(s) = (1-s) a + s b the polar angle phi in the plane of a, b has dphi = |a x b| ds / |q|^2, and s/|q| and
//! (1-s)/|q| are sines of it. With theta the angle between a and b this gives (ours)
//!
//! ```text
//! integral of (1-s)^2/|q|^4 = f2/(2 |a|^3 |b|)     f1 = (sin theta - theta cos theta)/sin^3 theta
//! integral of (1-s) s/|q|^4 = f1/(2 |a|^2 |b|^2)   f2 = (theta - sin theta cos theta)/sin^3 theta
//! integral of s^2/|q|^4     = f2/(2 |a| |b|^3)
//! ```
//!
//! f1 and f2 are positive, and grow from 1/3 and 2/3 at theta = 0 without bound towards theta = pi.

use glam::{DMat3, DVec3};

use super::gauss_legendre;
use super::products::{Pairs, cofactors_times, norm};

/// Ratios of one term to the one before in the series of f1 and f2, from the first power of sin^2 on.
const SERIES: [(f64, f64); 16] = {
    let mut ratios = [(0.0, 0.0); 16];
    let mut term = 0;
    while term < 16 {
        let k = (term + 1) as f64;
        ratios[term] = (2.0 * k / (2.0 * k + 3.0), (k - 0.5) * (k + 0.5) / ((k + 1.5) * k));
        term += 1;
    }
    ratios
};

/// f1 and f2 of the module's head from sine, cosine and the angle itself, in 0..pi.
///
/// Relative error at most 128 EPS more than three times the sine's own (EPS = 2^-53). Below sin^2 = 0.1 both are
/// hypergeometric series, f1 = F(1, 1; 5/2; sin^2)/3 and f2 = 2 F(1/2, 3/2; 5/2; sin^2)/3, whose terms are positive;
/// above, terms that are each a few EPS off cancel to 1/30 of themselves at the worst.
pub fn angle_factors(sin: f64, cos: f64, angle: f64) -> (f64, f64) {
    let x = sin * sin;
    if cos > 0.0 && x < 0.1 {
        let (mut first, mut second) = (1.0, 1.0);
        // 0.1^16 and 0.003^6 are below EPS/2; Horner from the smallest term on.
        let terms = if x < 0.003 { 6 } else { SERIES.len() };
        for (of_first, of_second) in SERIES[..terms].iter().rev() {
            first = 1.0 + first * (x * of_first);
            second = 1.0 + second * (x * of_second);
        }
        return (first / 3.0, second * (2.0 / 3.0));
    }
    // What cancels must belong to one and the same angle; from pi/2 on nothing does, and the sine is the better known.
    let (sin, cos) = if cos > 0.0 { angle.sin_cos() } else { (sin, cos) };
    let cube = sin * sin * sin;
    ((sin - angle * cos) / cube, (angle - sin * cos) / cube)
}

/// The part of a segment a..b above the horizon z = 0, seen from the origin.
#[derive(Clone, Copy, Debug)]
pub struct Visible {
    /// Ends of the visible part, z >= 0.
    pub ends: [DVec3; 2],
    /// Their places s on the whole segment.
    pub places: [f64; 2],
    /// The difference of the places, not by subtraction.
    share: f64,
    lengths: [f64; 2],
    /// Unit normal of the plane, along a x b.
    normal: DVec3,
    /// |a x b| of the whole segment.
    area: f64,
    angle: f64,
    factors: (f64, f64),
}

impl Visible {
    /// From both ends and `area` = a x b, every component of each accurate to a few EPS of itself; `None` if nothing is
    /// above the horizon.
    ///
    /// A clipped end is (-area.y, area.x, 0)/(b.z - a.z) up to sign: it cancels no more than `area` does.
    pub fn new(a: DVec3, b: DVec3, area: DVec3) -> Option<Visible> {
        if a.z.max(b.z) <= 0.0 {
            return None;
        }
        let rise = b.z - a.z;
        let crossing = DVec3::new(-area.y, area.x, 0.0) / rise;
        let (mut ends, mut places) = ([a, b], [0.0, 1.0]);
        let mut share = 1.0;
        if a.z < 0.0 {
            (ends[0], places[0], share) = (crossing, -a.z / rise, b.z / rise);
        } else if b.z < 0.0 {
            (ends[1], places[1], share) = (crossing, a.z / -rise, a.z / -rise);
        }
        let size = norm(area);
        let lengths = ends.map(norm);
        let product = lengths[0] * lengths[1];
        let sin = (size * share / product).min(1.0);
        let cos = (ends[0] / lengths[0]).dot(ends[1] / lengths[1]);
        let angle = libm::atan2(sin, cos);
        let factors = angle_factors(sin, cos, angle);
        let normal = if size > 0.0 { area / size } else { DVec3::ZERO };
        Some(Visible { ends, places, share, lengths, normal, area: size, angle, factors })
    }

    /// J |a'| |b'| with J the integral of q.z/|q|^4 over the *whole* segment's parameter s, of the visible part, and
    /// a', b' the visible ends: the product keeps its range where J does not. Relative error at most 200 EPS.
    pub fn cosine_integral(&self) -> f64 {
        let [ra, rb] = self.lengths;
        let (f1, f2) = self.factors;
        0.5 * self.share
            * ((self.ends[0].z / ra) * (f1 / rb + f2 / ra) + (self.ends[1].z / rb) * (f1 / ra + f2 / rb))
    }

    /// |a'| |b'|.
    pub fn length_product(&self) -> f64 {
        self.lengths[0] * self.lengths[1]
    }

    /// The derivatives, by the ends a and b of the whole segment, of the irradiance of a contour that this is a piece
    /// of: -(1/pi) times the integral of q.z/|q|^4 (q x dq), shared out by place. A few EPS of itself.
    pub fn contour_gradient(&self) -> [DVec3; 2] {
        let [ra, rb] = self.lengths;
        let (f1, f2) = self.factors;
        let (za, zb) = (self.ends[0].z / ra, self.ends[1].z / rb);
        // (a x b) over |a| |b| is the normal times the sine.
        let sine = self.area * self.share / self.length_product();
        let normal = self.normal * (-0.5 * core::f64::consts::FRAC_1_PI * sine);
        let at_a = (za * f2 + zb * f1) / ra * normal;
        let at_b = (za * f1 + zb * f2) / rb * normal;
        let [from, to] = self.places;
        [(1.0 - from) * at_a + (1.0 - to) * at_b, from * at_a + to * at_b]
    }

    /// The derivatives of J by the ends a and b of the whole segment, to a few digits; all zero where a x b = 0.
    ///
    /// By 8 Gauss points in the angle, where the integrand is a trigonometric polynomial of degree 4; the crossing's
    /// own motion does not count, since the integrand is zero there.
    pub fn gradient(&self) -> [DVec3; 2] {
        let mut gradient = [DVec3::ZERO; 2];
        if !(self.area > 0.0) {
            return gradient;
        }
        let along = self.ends[0] / self.lengths[0];
        let across = self.normal.cross(along);
        let [ra, rb] = self.lengths;
        let share = self.share;
        let sin = (self.area * share / ra) / rb;
        gauss_legendre::visit(&gauss_legendre::POINTS_8, 0.0, self.angle, |angle, weight| {
            let (sin_angle, cos_angle) = angle.sin_cos();
            let q = cos_angle * along + sin_angle * across;
            let (from_a, from_b) = ((self.angle - angle).sin() / sin / ra, sin_angle / sin / rb);
            let inverse_length = from_a + from_b;
            let place = self.places[0] + share * (from_b / inverse_length);
            let change = (DVec3::Z - 4.0 * q.z * q) * (weight * inverse_length * inverse_length / self.area);
            gradient[0] += (1.0 - place) * change;
            gradient[1] += place * change;
        });
        gradient
    }
}

/// The visible part of the segment m p1 .. m p2 from what is known exactly: its ends, the cofactors of m, and p1 x p2.
pub fn visible(ends: [DVec3; 2], cofactors: &[Pairs; 3], normal: &Pairs) -> Option<Visible> {
    Visible::new(ends[0], ends[1], cofactors_times(cofactors, normal))
}

/// The columns of a column-major matrix of f32.
pub fn matrix(columns: &[f32]) -> DMat3 {
    DMat3::from_cols(vector(&columns[..3]), vector(&columns[3..6]), vector(&columns[6..9]))
}

/// A vector of f32.
pub fn vector(components: &[f32]) -> DVec3 {
    DVec3::new(f64::from(components[0]), f64::from(components[1]), f64::from(components[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From mpmath with 50 digits; both sides of the change from series to closed form among them.
    #[test]
    fn factors_agree_with_golden_digits() {
        for (angle, f1, f2) in FACTORS {
            let (first, second) = angle_factors(libm::sin(angle), libm::cos(angle), angle);
            // 128 EPS.
            assert!((first / f1 - 1.0).abs() < 1.5e-14, "{angle}: {first} for {f1}");
            assert!((second / f2 - 1.0).abs() < 1.5e-14, "{angle}: {second} for {f2}");
        }
    }

    fn quadrature(a: DVec3, b: DVec3) -> f64 {
        let mut sum = 0.0;
        for panel in 0..64 {
            let from = f64::from(panel) / 64.0;
            gauss_legendre::visit(&gauss_legendre::POINTS_16, from, from + 1.0 / 64.0, |s, weight| {
                let q = a.lerp(b, s);
                sum += weight * q.z.max(0.0) / q.length_squared().powi(2);
            });
        }
        sum
    }

    #[test]
    fn integrals_and_gradients_agree_with_quadrature_and_differences() {
        let ends = [
            (DVec3::new(1.0, 2.0, 0.5), DVec3::new(-1.5, 0.3, 2.0)),
            (DVec3::new(3.0, -1.0, 1.0), DVec3::new(3.1, -1.05, 1.02)),
            (DVec3::new(-2.0, 0.3, 0.4), DVec3::new(2.0, 0.2, 0.1)),
        ];
        let integral = |a: DVec3, b: DVec3| {
            let visible = Visible::new(a, b, a.cross(b)).unwrap();
            visible.cosine_integral() / visible.length_product()
        };
        for (a, b) in ends {
            // Quadrature on 64 panels is good to rounding: the nearest singularity is 0.07 of the segment away.
            assert!((integral(a, b) / quadrature(a, b) - 1.0).abs() < 1e-13);
        }
        for (a, b) in ends.into_iter().chain([
            (DVec3::new(1.0, 0.3, -0.5), DVec3::new(-1.5, 0.4, 2.0)),
            (DVec3::new(1.0, 0.3, 0.5), DVec3::new(-1.5, 0.4, -0.2)),
        ]) {
            let visible = Visible::new(a, b, a.cross(b)).unwrap();
            let [by_a, by_b] = visible.gradient();
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                // Central differences: error about 1e-10 of the value, which is far below 1e-5 of the gradient's norm.
                let step = 1e-5;
                let of_a = (integral(a + step * axis, b) - integral(a - step * axis, b)) / (2.0 * step);
                let of_b = (integral(a, b + step * axis) - integral(a, b - step * axis)) / (2.0 * step);
                assert!(
                    (by_a.dot(axis) - of_a).abs() < 1e-5 * by_a.length(),
                    "{a} {b}: {by_a} {axis} {of_a}"
                );
                assert!(
                    (by_b.dot(axis) - of_b).abs() < 1e-5 * by_b.length(),
                    "{a} {b}: {by_b} {axis} {of_b}"
                );
            }
        }
    }

    #[test]
    fn clipping_leaves_what_quadrature_sees() {
        let (a, b) = (DVec3::new(1.0, 0.3, -0.5), DVec3::new(-1.5, 0.4, 2.0));
        let visible = Visible::new(a, b, a.cross(b)).unwrap();
        let integral = visible.cosine_integral() / visible.length_product();
        let upper = a.lerp(b, 0.2);
        // s = 0.2 is the crossing; the part above is 0.8 of the parameter.
        assert!((integral / (0.8 * quadrature(upper, b)) - 1.0).abs() < 1e-13);
        assert!(Visible::new(-a, DVec3::new(0.0, 1.0, -0.5), DVec3::X).is_some());
        assert!(Visible::new(a, DVec3::new(0.0, 1.0, -0.5), DVec3::X).is_none());
    }

    const FACTORS: [(f64, f64, f64); 9] = [
        (9.313225746154785e-10, 0.333_333_333_333_333_3, 0.666_666_666_666_666_6),
        (0.0625, 0.333_854_651_426_105_5, 0.667_448_534_696_123_2),
        (0.3125, 0.346_662_528_146_278_6, 0.686_590_456_513_197_7),
        (0.3203125, 0.347_354_038_385_862_7, 0.6876203474289619),
        (0.328125, 0.34806432844506198, 0.688_677_831_557_766_5),
        (1.0, 0.505_466_488_119_722_4, 0.915_290_396_707_964_5),
        (1.5, 0.898_121_711_586_981_5, 1.4402363397354165),
        (2.0, 2.3164786953555352, 3.1634956215902905),
        (3.0, 1107.0005681829087, 1117.180758420721),
    ];
}
