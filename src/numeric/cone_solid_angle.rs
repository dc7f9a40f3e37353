//! The solid angle of an elliptic cone, by a complete elliptic integral in which nothing cancels.
//!
//! With half angles' tangents a, b the solid angle is 2 pi - 4 b/(a sqrt(1 + a^2)) Pi(n, m)-like integrals in the literature,
//! a difference that leaves nothing of a small cone. Exchanging the characteristic n for m/n (DLMF 19.7.9) takes the 2 pi
//! out, and Pi - K is a Carlson integral (DLMF 19.25.2):
//!
//! ```text
//! Omega = (4/3) a b R_J(0, 1 + a^2, 1 + b^2, 1) = (4/3) sqrt(-det S) R_J(0, l + e1, l + e3, l)
//! ```
//!
//! for the dual quadric S with eigenvalues e1 >= e3 > 0 > -l of [`Cone`]. R_J is symmetric in its second and third argument,
//! so only l, the sum and the product of l + e1 and l + e3 are needed. Bulirsch's transformation ("Numerical calculation
//! of elliptic integrals and elliptic functions III", Numer. Math. 13, 1969) adds positive numbers only.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DMat3, DVec3};

use super::big::{self, Big};
use super::clipped_ellipse::Cone;
use super::gauss_legendre::{POINTS_16, visit};
use super::graded_cone;
use super::spacing::EPS;

/// The relative error of [`Cone::solid_angle`]: 6 steps of 4 roundings, and those of l, the sum and the product.
pub const BOUND: f64 = 64.0 * EPS;

/// A solid angle in steradians.
#[derive(Clone, Copy, Debug)]
pub struct SolidAngle {
    /// Relative error [`BOUND`].
    pub value: f64,
    /// G with dOmega = sum of G_ij dS_ij, to a percent.
    pub gradient: DMat3,
}

impl Cone {
    /// The solid angle; `minus_det` is positive.
    pub fn solid_angle(&self) -> SolidAngle {
        let principal = self.principal(self.minors());
        let (e1, e3, l) = (principal.e1, principal.e3, principal.l);
        let value = complete(libm::sqrt(self.minus_det), l, (l + e1) + (l + e3), principal.gap);
        let [m1, m2, m3] = moments(e1, e3, l);
        let axes = principal.axes;
        let gradient = axes * DMat3::from_diagonal(DVec3::new(m1, m2, m3)) * axes.transpose();
        SolidAngle { value, gradient }
    }
}

/// What twofold arithmetic may be off by, relative to the larger of what is subtracted, in a few steps.
const TWOFOLD: f64 = 1.0 / (1u128 << 97) as f64;

impl Cone {
    /// The relative error that twofold arithmetic leaves of the solid angle, beside [`BOUND`], where the dual quadric is a
    /// difference of squares of vectors: `sizes` has the sums of their components' squares. A solid angle changes by at most
    /// as much as the sum of the principal minors, and twice. Infinite where the determinant has no digits.
    pub fn doubt(&self, sizes: DVec3) -> f64 {
        let [x, y, z, ..] = self.minors();
        let products = sizes.x * (sizes.y + sizes.z) + sizes.y * sizes.z;
        if self.minus_det < 1e-280 {
            f64::INFINITY
        } else {
            2.0 * TWOFOLD * products / (x + y + z).value().abs()
        }
    }
}

/// The solid angle of the ellipse c + cos t `v1` + sin t `v2`, not in a plane with the origin, however its cone is graded;
/// components of at most 1. Relative error [`BOUND`].
///
/// The invariants of the dual quadric are exact: with N = v1 x v2 its principal minors' sum is |N|^2 - |c x v1|^2 -
/// |c x v2|^2. l is the one positive root of the cubic that they make, and (l + e1) + (l + e3) and (l + e1)(l + e3) follow.
pub fn graded(c: DVec3, v1: DVec3, v2: DVec3) -> f64 {
    /// Of invariants that are exact a few guard bits do.
    const BITS: usize = 128;
    let [c, v1, v2] = [c, v1, v2].map(big::vector);
    let square = |v: &big::Vector| big::dot(v, v);
    let n = big::cross(&v1, &v2);
    let (volume, c2) = (big::abs(big::dot(&c, &n)), square(&v1) + square(&v2) - square(&c));
    let c1 = square(&n) - square(&big::cross(&c, &v1)) - square(&big::cross(&c, &v2));
    let c0 = &volume * &volume;
    let [volume, c2, c1, c0] = [volume, c2, c1, c0].map(|x| big::rounded(&x, BITS));
    let l = graded_cone::positive_root(&c2, &c1, &c0, BITS).expect("a cubic of three real roots");
    let (two, three) = (Big::from(2), Big::from(3));
    let (sum, product) = (&c2 + &three * &l, (&two * &l + &c2) * &l + &c0 / &l);
    // The largest eigenvalue near 2^500, so that the least one keeps its digits.
    let scaled = |x: Big, powers: isize| big::nearest(&(x << (250 * powers)));
    complete(scaled(volume, 3), scaled(l, 2), scaled(sum, 2), scaled(product, 4))
}

/// (4/3) `root` R_J(0, p, q, `l`) from p + q and p q, p, q >= l > 0: relative error 32 EPS beside those of the arguments.
pub fn complete(root: f64, l: f64, sum: f64, product: f64) -> f64 {
    let (root_l, w) = (libm::sqrt(l), libm::sqrt(product));
    let (mut a, mut b) = (1.0 / l, 2.0 / root_l);
    let mut p = root_l + w / root_l;
    let mut m = libm::sqrt(sum + 2.0 * w);
    let mut k = 2.0 * libm::sqrt(w);
    let mut e = k * m;
    // Quadratic convergence of arithmetic and geometric mean, from any ratio of 64-bit floats.
    for _ in 0..12 {
        let f = a;
        a += b / p;
        let g = e / p;
        b = 2.0 * (b + f * g);
        p += g;
        let arithmetic = m;
        m += k;
        if (arithmetic - k).abs() <= 1e-8 * arithmetic {
            break;
        }
        k = 2.0 * libm::sqrt(e);
        e = k * m;
    }
    (TAU * root * (b / m + a) / (m + p)).min(TAU)
}

/// The diagonal of G in the principal frame: with rim p = (sqrt(e1) cos u, sqrt(e3) sin u, sqrt(l)) and the tangent planes'
/// normals n = (cos u/sqrt(e1), sin u/sqrt(e3), -1/sqrt(l)), G is sqrt(e1 e3 l)/2 times the integral of n n^T/|p|^3 over u.
fn moments(e1: f64, e3: f64, l: f64) -> [f64; 3] {
    let (big, small) = (l + e1, l + e3);
    let ratio = libm::sqrt(small / big);
    let mut sums = [0.0; 3];
    // In w, tan w = ratio tan u; the integrand bends at w = ratio.
    let (mut from, mut to) = (0.0, FRAC_PI_2.min(4.0 * ratio));
    loop {
        visit(&POINTS_16, from, to, |w, weight| {
            let (sin, cos) = libm::sincos(w);
            let (x2, y2) = (cos * cos / big, sin * sin / small);
            let inverse = libm::sqrt(x2 + y2);
            for (sum, term) in sums.iter_mut().zip([x2 / e1, y2 / e3, inverse * inverse / l]) {
                *sum += weight * term / inverse;
            }
        });
        if to >= FRAC_PI_2 {
            break;
        }
        (from, to) = (to, FRAC_PI_2.min(8.0 * to));
    }
    // Four quarters.
    let scale = 2.0 * libm::sqrt(e1) * libm::sqrt(e3) * libm::sqrt(l) / (libm::sqrt(big) * libm::sqrt(small));
    sums.map(|sum| scale * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::twofold::Twofold;
    use proptest::prelude::*;

    fn cone(e1: f64, e3: f64, l: f64) -> Cone {
        let dual = [e1, e3, -l, 0.0, 0.0, 0.0].map(Twofold::from);
        Cone { dual, minus_det: e1 * e3 * l, towards: DVec3::Z }
    }

    /// The definition: the cone's radius in every azimuth.
    fn by_quadrature(e1: f64, e3: f64, l: f64) -> f64 {
        let mut sum = 0.0;
        let panels = 64;
        for panel in 0..panels {
            let at = |k: i32| FRAC_PI_2 * f64::from(k) / f64::from(panels);
            visit(&POINTS_16, at(panel), at(panel + 1), |phi, weight| {
                let (sin, cos) = libm::sincos(phi);
                let rho2 = 1.0 / (cos * cos * l / e1 + sin * sin * l / e3);
                let h = libm::sqrt(1.0 + rho2);
                sum += weight * rho2 / (h * (h + 1.0));
            });
        }
        4.0 * sum
    }

    #[test]
    fn circles_are_caps() {
        for tangent in [1e-12f64, 1e-3, 0.5, 1.0, 30.0, 1e6] {
            let square = tangent * tangent;
            let h = libm::sqrt(1.0 + square);
            let expected = TAU * square / (h * (h + 1.0));
            let value = cone(square, square, 1.0).solid_angle().value;
            assert!((value / expected - 1.0).abs() <= BOUND, "{tangent}: {value} {expected}");
        }
    }

    proptest! {
        #[test]
        fn agrees_with_quadrature(a in -3.0..3.0f64, b in -3.0..3.0f64, l in -3.0..3.0f64) {
            let [e1, e3, l] = [a.max(b), a.min(b), l].map(f64::exp2);
            let value = cone(e1, e3, l).solid_angle().value;
            prop_assert!((value / by_quadrature(e1, e3, l) - 1.0).abs() <= 2.0 * BOUND);
        }

        /// Needles and cones up to a half space: symmetric in its arguments, and scale is free.
        #[test]
        fn scale_is_free(a in -40.0..40.0f64, b in -40.0..40.0f64, l in -40.0..40.0f64) {
            let [p, q, l] = [a, b, l].map(f64::exp2);
            let value = |s: f64| {
                let (x, y) = (s * (l + p), s * (l + q));
                complete(libm::sqrt(p * q * l * s * s * s), l * s, x + y, x * y)
            };
            prop_assert!((value(1.0) / value(3.0) - 1.0).abs() <= BOUND);
            prop_assert!(value(1.0) > 0.0 && value(1.0) <= TAU);
        }

        #[test]
        fn gradients_are_slopes(a in -8.0..8.0f64, b in -8.0..8.0f64) {
            let (e1, e3) = (a.max(b).exp2(), a.min(b).exp2());
            let step = 1e-6;
            let found = moments(e1, e3, 1.0);
            let value = |e1: f64, e3: f64, l: f64| {
                complete(libm::sqrt(e1 * e3 * l), l, (l + e1) + (l + e3), (l + e1) * (l + e3))
            };
            let slope = |up: f64, down: f64, at: f64| (up - down) / (2.0 * step * at);
            let expected = [
                slope(value(e1 * (1.0 + step), e3, 1.0), value(e1 * (1.0 - step), e3, 1.0), e1),
                slope(value(e1, e3 * (1.0 + step), 1.0), value(e1, e3 * (1.0 - step), 1.0), e3),
                // S's third eigenvalue is -l.
                slope(value(e1, e3, 1.0 - step), value(e1, e3, 1.0 + step), 1.0),
            ];
            let largest = value(e1, e3, 1.0);
            for ((found, expected), size) in found.into_iter().zip(expected).zip([e1, e3, 1.0]) {
                // Rounding over the step.
                prop_assert!((found - expected).abs() * size <= 1e-2 * found * size + 1e-8 * largest, "{found} {expected}");
            }
        }
    }
}
