//! Solid angle of an axis-aligned rectangle on the plane z = 1, seen from the origin.
//!
//! Cut along the axes, a rectangle is up to four of which each lies in one quadrant, and each of those is two triangles.
//! For a triangle with corners a, b, c (van Oosterom & Strackee, "The solid angle of a plane triangle", IEEE Trans. Biomed.
//! Eng. 30, 1983)
//!
//! ```text
//! tan(Omega/2) = [a, b, c] / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
//! ```
//!
//! where the determinant is dx dy exactly, and within a quadrant every product of corners is positive: nothing cancels.

use std::f64::consts::PI;

use super::spacing::EPS;

/// The relative error of [`solid_angle`]: two roundings a coordinate difference, nine of the denominator, one of the angle.
pub const BOUND: f64 = 16.0 * EPS;

/// The solid angle of the rectangle between (`x0`, `y0`) and (`x1`, `y1`) on z = 1, in steradians; the corners in any order.
/// Coordinates are f32 values, or within 1e-100..1e60 in size: relative error [`BOUND`].
pub fn solid_angle(x0: f64, y0: f64, x1: f64, y1: f64) -> f64 {
    let mut sum = 0.0;
    for [left, right] in halves(x0, x1) {
        for [low, high] in halves(y0, y1) {
            sum += in_quadrant(left, low, right, high);
        }
    }
    sum.min(2.0 * PI)
}

/// The parts of an interval on either side of zero, by distance from it, the nearer end first.
fn halves(a: f64, b: f64) -> [[f64; 2]; 2] {
    let (low, high) = (a.min(b), a.max(b));
    [[low.max(0.0), high.max(0.0)], [-high.min(0.0), -low.min(0.0)]]
}

fn in_quadrant(x0: f64, y0: f64, x1: f64, y1: f64) -> f64 {
    let area = (x1 - x0) * (y1 - y0);
    if area == 0.0 {
        return 0.0;
    }
    let size = |x: f64, y: f64| libm::sqrt(1.0 + (x * x + y * y));
    let (a, b, c, d) = (size(x0, y0), size(x1, y0), size(x1, y1), size(x0, y1));
    let diagonal = 1.0 + (x0 * x1 + y0 * y1);
    let (bottom, right) = (1.0 + (x0 * x1 + y0 * y0), 1.0 + (x1 * x1 + y0 * y1));
    let (top, left) = (1.0 + (x0 * x1 + y1 * y1), 1.0 + (x0 * x0 + y0 * y1));
    let lower = a * b * c + bottom * c + right * a + diagonal * b;
    let upper = a * c * d + diagonal * d + top * a + left * c;
    2.0 * (libm::atan2(area, lower) + libm::atan2(area, upper))
}

/// How fast the solid angle grows with `x1`: the integral of (1 + x^2 + y^2)^(-3/2) over the side at `x`, from `y0` to
/// `y1`, never negative. Relative error 1e-14.
pub fn side_density(x: f64, y0: f64, y1: f64) -> f64 {
    let size = |y: f64| libm::sqrt(1.0 + (x * x + y * y));
    let (r0, r1) = (size(y0), size(y1));
    if y0 * y1 > 0.0 {
        ((y1 - y0) * (y1 + y0) / (y1 * r0 + y0 * r1) / (r0 * r1)).abs()
    } else {
        ((y1 / r1 - y0 / r0) / (1.0 + x * x)).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::gauss_legendre::{POINTS_16, visit};
    use proptest::prelude::*;

    #[test]
    fn known_rectangles() {
        // A cube's face, a quarter of it, and the whole plane.
        assert!((solid_angle(-1.0, -1.0, 1.0, 1.0) / (4.0 * PI / 6.0) - 1.0).abs() <= BOUND);
        assert!((solid_angle(0.0, 0.0, -1.0, 1.0) / (PI / 6.0) - 1.0).abs() <= BOUND);
        assert!((solid_angle(-1e30, -1e30, 1e30, 1e30) / (2.0 * PI) - 1.0).abs() <= BOUND);
        // A strip across the whole plane is a lune of width atan.
        assert!((solid_angle(-1e30, 0.0, 1e30, 1e-9) / (2.0 * libm::atan(1e-9)) - 1.0).abs() <= BOUND);
        assert_eq!(solid_angle(0.25, 0.0, 0.25, 3.0), 0.0);
        // Subnormal in f32: as flat as a point's neighbourhood can be.
        let tiny = 2f64.powi(-149);
        assert!((solid_angle(0.0, 0.0, tiny, tiny) / (tiny * tiny) - 1.0).abs() <= BOUND);
    }

    proptest! {
        /// Sides of up to a fifth: Gauss's rule has converged, its integrand's poles being 1 away.
        #[test]
        fn agrees_with_quadrature(x in -2.0..2.0f64, y in -2.0..2.0f64, w in 1e-6..0.2f64, h in 1e-6..0.2f64) {
            let mut sum = 0.0;
            visit(&POINTS_16, x, x + w, |u, wu| {
                visit(&POINTS_16, y, y + h, |v, wv| sum += wu * wv / (1.0 + u * u + v * v).powf(1.5));
            });
            // The sides are x + w - x wide, rounded.
            let slack = 1e-14 + 8.0 * f64::EPSILON * (1.0 / w + 1.0 / h);
            prop_assert!((solid_angle(x, y, x + w, y + h) / sum - 1.0).abs() < slack);
        }

        #[test]
        fn parts_add_up(x in -1e3..1e3f64, y in -1e3..1e3f64, w in 1e-3..1e3f64, h in 1e-3..1e3f64) {
            let (middle, right, top) = (x + 0.375 * w, x + w, y + h);
            let whole = solid_angle(x, y, right, top);
            let parts = solid_angle(x, y, middle, top) + solid_angle(middle, top, right, y);
            prop_assert!((whole / parts - 1.0).abs() <= 2.0 * BOUND);
        }

        #[test]
        fn densities_are_slopes(x in -3.0..3.0f64, y0 in -3.0..3.0f64, y1 in -3.0..3.0f64) {
            let step = 1e-5;
            let slope = (solid_angle(x - step, y0, x + step, y1)) / (2.0 * step);
            // The next term is a third of step^2 times a second derivative of at most 12.
            prop_assert!((side_density(x, y0, y1) - slope).abs() <= 1e-8 * (y1 - y0).abs());
        }
    }
}
