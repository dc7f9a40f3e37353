//! Roots of cubics whose coefficients change sign once.

use super::spacing::EPS;

/// The relative error of [`positive_root`] against the root of the given coefficients, each taken to be rounded once.
pub const POSITIVE_ROOT_BOUND: f64 = 16.0 * EPS;

/// The one positive root of x^3 + c2 x^2 + c1 x - c0 = (x - root)(x + s1)(x + s2), s1, s2 >= 0; 0 if there is none.
///
/// Domain: c0 >= 0, s1 and s2 real (a characteristic polynomial's are), and all terms within 2^-1000..2^1000. Then c2 < 0
/// implies c1 < 0, so the coefficients change sign once. The sum of the terms' sizes at the root is at most twice root
/// times slope: rounding each coefficient moves the root by at most 2 EPS of itself, and Horner's rule by at most 8.
/// The start is an upper bound (Hong, "Bounds for absolute positiveness of multivariate
/// polynomials", 1998) within a factor of 6 of the root; the cubic is convex from the root up, so Newton's iteration
/// descends.
pub fn positive_root(c2: f64, c1: f64, c0: f64) -> f64 {
    let of_c2 = (-c2).max(0.0);
    let of_c1 =
        if c1 < 0.0 { libm::sqrt(-c1).min(if c2 > 0.0 { -c1 / c2 } else { f64::INFINITY }) } else { 0.0 };
    let mut of_c0 = libm::cbrt(c0);
    if c2 > 0.0 {
        of_c0 = of_c0.min(libm::sqrt(c0 / c2));
    }
    if c1 > 0.0 {
        of_c0 = of_c0.min(c0 / c1);
    }
    let negative_terms = 1.0 + f64::from(u8::from(c2 < 0.0)) + f64::from(u8::from(c1 < 0.0));
    // A little more, so that rounding leaves it a bound.
    let mut x = (1.0 + 16.0 * EPS) * negative_terms * of_c2.max(of_c1).max(of_c0);
    for _ in 0..STEPS {
        let value = ((x + c2) * x + c1) * x - c0;
        let slope = (3.0 * x + 2.0 * c2) * x + c1;
        let step = value / slope;
        if !(step > 2.0 * EPS * x) {
            break;
        }
        x -= step;
    }
    x
}

/// From six times the root: five steps that shrink the distance by a third each, and five that square it.
const STEPS: usize = 24;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_cases() {
        // (x - 2)(x + 1)(x + 3) and (x - 1)(x + 1)^2; a cube root.
        assert_eq!(positive_root(2.0, -5.0, 6.0), 2.0);
        assert_eq!(positive_root(1.0, -1.0, 1.0), 1.0);
        assert!((positive_root(0.0, 0.0, 27.0) - 3.0).abs() <= 3.0 * POSITIVE_ROOT_BOUND);
    }

    proptest! {
        /// From chosen roots root > 0 and -s1, -s2 <= 0, over sixty orders of magnitude.
        #[test]
        fn finds_the_root_it_was_built_from(root in -30.0f64..30.0, s1 in -30.0f64..30.0, s2 in -30.0f64..30.0) {
            let [root, s1, s2] = [root, s1, s2].map(|exponent| 10f64.powf(exponent));
            // Coefficients as sums of exact terms would be: cancellation in them is not the solver's.
            let product = |a: f64, b: f64| [a * b, a.mul_add(b, -(a * b))];
            let c2 = crate::numeric::exact::sum(&[s1, s2, -root]);
            let ([a, b], [c, d], [e, f]) = (product(s1, s2), product(root, s1), product(root, s2));
            let c1 = crate::numeric::exact::sum(&[a, b, -c, -d, -e, -f]);
            let found = positive_root(c2, c1, s1 * s2 * root);
            // c0 is rounded twice.
            prop_assert!((found / root - 1.0).abs() <= POSITIVE_ROOT_BOUND + 2.0 * EPS, "{} {}", found, root);
        }
    }
}
