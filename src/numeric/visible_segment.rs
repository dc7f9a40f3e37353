//! The irradiance of the part of an elliptic cone above the horizon as an integral of what is positive.
//!
//! It takes the place of the closed form of [`super::clipped_ellipse`] where that cancels: far lights and slivers.

use std::f64::consts::PI;

use super::clipped_ellipse::Principal;
use super::gauss_legendre::{POINTS_16, visit};

impl Principal {
    /// The integral over the ellipse's visible segment: lines parallel to the horizon in closed form, across
    /// them by Gauss's rule. The integrand is positive, so nothing cancels.
    ///
    /// It is singular where a line or the rim passes through the apex, at complex angles that are known: panels are
    /// halved until they are far from them, and the answer says whether all are.
    pub(super) fn area(
        &self,
        swing: f64,
        (cos0, sin0): (f64, f64),
        (cos_d, sin_d): (f64, f64),
    ) -> (f64, bool) {
        let &Principal { e1, e3, l, .. } = self;
        let along = e1 * sin0 * sin0 + e3 * cos0 * cos0;
        let skew = sin0 * cos0 * (e3 - e1);
        let d = libm::atan2(sin_d, cos_d);
        let line = |sin: f64, cos: f64, height: f64| {
            // |p|^2 = (s^2 + delta)/along with s linear along the line.
            let delta = l * along + cos * cos * e1 * e3;
            let (s1, s2) = (skew * cos - along * sin, skew * cos + along * sin);
            let root = libm::sqrt(delta);
            let width = 2.0 * along * sin;
            let (q1, q2) = (s1 * s1 + delta, s2 * s2 + delta);
            // With the angles phi1, phi2 of its ends from its foot, and theta between them, the line has
            // (theta + sin theta cos(phi1 + phi2))/(2 delta^(3/2)); a cosine below 0 is -1 and a square.
            let theta = libm::atan2(root * width, delta + s1 * s2);
            let sum = if s1 * s2 <= delta {
                theta + root * width / q1 * ((delta - s1 * s2) / q2)
            } else {
                let cosines = libm::sqrt(delta / q1) + libm::sqrt(delta / q2);
                arc_over_chord(theta) + libm::tan(0.5 * theta) * cosines * cosines
            };
            height * sin * along / (2.0 * delta * root) * sum
        };
        let rim = libm::asinh(libm::sqrt((l + e3) / (e1 - e3)));
        let lines = libm::asinh(libm::sqrt(l * along / (e1 * e3)));
        let mut halvings = HALVINGS;
        // From both ends, so that what is close to either is told from it.
        let poles = [(half_turn(cos0, sin0), rim), (half_turn(cos0, -sin0), rim), (0.5 * PI, lines)];
        let top = graded(0.0, 0.5 * d, &poles, &mut halvings, &|angle| {
            let (sin, cos) = libm::sincos(angle);
            line(sin, cos, 2.0 * libm::sin(0.5 * (d + angle)) * libm::sin(0.5 * (d - angle)))
        });
        let (cos1, sin1) = (cos0 * cos_d + sin0 * sin_d, cos0 * sin_d - sin0 * cos_d);
        let (cos2, sin2) = (cos0 * cos_d - sin0 * sin_d, sin0 * cos_d + cos0 * sin_d);
        let poles =
            [(half_turn(-cos2, sin2), rim), (half_turn(-cos1, sin1), rim), (half_turn(-cos_d, sin_d), lines)];
        let bottom = graded(0.0, 0.5 * d, &poles, &mut halvings, &|rest| {
            let (sin, cos) = libm::sincos(rest);
            let height = 2.0 * libm::sin(d - 0.5 * rest) * libm::sin(0.5 * rest);
            line(sin_d * cos - cos_d * sin, cos_d * cos + sin_d * sin, height)
        });
        let sum = top + bottom;
        (libm::sqrt(e1 * e3 * l) * swing / PI * sum, halvings > 0)
    }
}

/// x - sin x for x in 0..pi/2, to a few roundings: below 1/2 by its series, whose next term is 2^-58 of the sum.
fn arc_over_chord(x: f64) -> f64 {
    if x > 0.5 {
        return x - libm::sin(x);
    }
    let square = x * x;
    let mut sum = 1.0;
    for k in (2..=7).rev() {
        let k = f64::from(k);
        sum = 1.0 - sum * square / (2.0 * k * (2.0 * k + 1.0));
    }
    x * square / 6.0 * sum
}

/// Halvings for an integral: three poles at 2^-30 off the real axis take as many, and more are for the arithmetic that does
/// not know f64's angles.
const HALVINGS: u32 = 3 * 4 * 30;

/// The angle of (x, y) or of (-x, -y), in -pi/2..pi/2.
fn half_turn(y: f64, x: f64) -> f64 {
    if x < 0.0 { libm::atan2(-y, -x) } else { libm::atan2(y, x) }
}

/// The integral of `f` over low..high within 0..pi, which is singular at the poles (x + k pi) + i y only, |x| <= pi/2.
///
/// A panel whose middle is 1.8 half lengths away from every pole has none within the ellipse of semi-axes' sum 3.3, and
/// 16 points are good to 3.3^-32 = 3e-17 of what is largest in that.
///
/// Takes no more than `halvings`, and leaves how many are left: none, if they did not do.
fn graded(low: f64, high: f64, poles: &[(f64, f64)], halvings: &mut u32, f: &impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let near = |&(x, y): &(f64, f64)| {
        let off = if middle - x > 0.5 * PI { middle - x - PI } else { middle - x };
        off * off + y * y < 3.24 * half * half
    };
    if *halvings == 0 || !poles.iter().any(near) {
        let mut sum = 0.0;
        visit(&POINTS_16, low, high, |x, weight| sum += weight * f(x));
        return sum;
    }
    *halvings -= 1;
    graded(low, middle, poles, halvings, f) + graded(middle, high, poles, halvings, f)
}
