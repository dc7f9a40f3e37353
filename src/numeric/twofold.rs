//! Arithmetic on unevaluated sums of two f64: about 106 bits.
//!
//! Every operation is within 2^-102 of the exact result, relative to the result for products and quotients, and to the
//! larger operand for sums (Dekker 1971; Joldes, Muller & Popescu, "Tight and rigorous error bounds for basic building
//! blocks of double-word arithmetic", 2017). Values beyond 2^995 in magnitude overflow the splitting, partial products
//! below 2^-1022 are lost: callers scale. Products are split by Dekker's method, not fused, so that results are the
//! same bits on every machine.

use core::ops::{Add, Mul, Neg, Sub};

use super::exact::two_sum;

/// hi + lo, |lo| at most half the spacing of f64 at hi.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twofold {
    pub hi: f64,
    pub lo: f64,
}

impl Twofold {
    pub const ZERO: Twofold = Twofold { hi: 0.0, lo: 0.0 };

    /// The exact product of two f64.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let (hi, lo) = two_product(a, b);
        Twofold { hi, lo }
    }

    /// The sum of three f64.
    #[inline]
    pub fn sum3(a: f64, b: f64, c: f64) -> Self {
        let (sum, error) = two_sum(a, b);
        let (sum, further) = two_sum(sum, c);
        Twofold::normalized(sum, error + further)
    }

    /// This times a power of two, exactly.
    #[inline]
    pub fn scaled(self, power: f64) -> Self {
        Twofold { hi: self.hi * power, lo: self.lo * power }
    }

    /// The nearest f64.
    #[inline]
    pub fn value(self) -> f64 {
        self.hi
    }

    /// One over this.
    #[inline]
    pub fn recip(self) -> Self {
        let first = 1.0 / self.hi;
        let residual = Twofold::from(1.0) - self * first;
        Twofold::from(first) + residual * first
    }

    #[inline]
    fn normalized(hi: f64, lo: f64) -> Self {
        let sum = hi + lo;
        Twofold { hi: sum, lo: lo - (sum - hi) }
    }
}

impl From<f64> for Twofold {
    #[inline]
    fn from(hi: f64) -> Self {
        Twofold { hi, lo: 0.0 }
    }
}

impl Add for Twofold {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.hi, other.hi);
        let (low, lowest) = two_sum(self.lo, other.lo);
        let partial = Twofold::normalized(sum, error + low);
        Twofold::normalized(partial.hi, partial.lo + lowest)
    }
}

impl Neg for Twofold {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Twofold { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Twofold {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let (hi, lo) = two_product(self.hi, other.hi);
        Twofold::normalized(hi, lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Mul<f64> for Twofold {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        let (hi, lo) = two_product(self.hi, factor);
        Twofold::normalized(hi, lo + self.lo * factor)
    }
}

/// a b as an exact pair: the rounded product and its rounding error (Dekker).
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    /// 2^27 + 1 splits 53 bits into 26 and 26 with a sign.
    const SPLIT: f64 = 134_217_729.0;
    let halves = |x: f64| {
        let scaled = SPLIT * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::exact;
    use proptest::prelude::*;

    proptest! {
        /// The fused operation of the machine or of libm is the independent arithmetic here.
        #[test]
        fn products_are_exact(a in -1e100..1e100f64, b in -1e100..1e100f64) {
            let (product, error) = two_product(a, b);
            prop_assert_eq!(error, f64::mul_add(a, b, -product));
        }

        #[test]
        fn operations_keep_102_bits(a in -1e3..1e3f64, b in -1e3..1e3f64, c in -1e3..1e3f64, shift in 0i32..120) {
            let small = c * 2f64.powi(-shift);
            let x = Twofold::from(a) + Twofold::from(small);
            prop_assert_eq!(exact::sum(&[a, small, -x.hi, -x.lo]).abs() <= 2f64.powi(-102) * a.abs().max(small.abs()), true);
            let y = x * b;
            let parts = [two_product(x.hi, b), two_product(x.lo, b)];
            let rest = exact::sum(&[parts[0].0, parts[0].1, parts[1].0, parts[1].1, -y.hi, -y.lo]);
            prop_assert!(rest.abs() <= 2f64.powi(-102) * y.hi.abs());
            let one = x * x.recip();
            prop_assert!(x.hi == 0.0 || exact::sum(&[one.hi, one.lo, -1.0]).abs() <= 2f64.powi(-100));
        }
    }

    #[test]
    fn three_terms_that_cancel_leave_exactly_nothing() {
        let (a, b) = (1.0, 2f64.powi(-60));
        assert_eq!(Twofold::sum3(a, b, -a).value(), b);
        assert_eq!(Twofold::sum3(0.1, -0.3, 0.1 + 0.1).value(), 0.1 - 0.3 + 0.2);
    }
}
