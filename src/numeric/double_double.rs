//! Numbers of twice f64's precision, and the trait that lets one text work in either.
//!
//! A number is the unevaluated sum of two f64, the second at most half a spacing of the first. Every operation here is
//! good to a relative 2^-102 as long as no part leaves f64's normal range: sums as in Li et al., "Design, implementation
//! and testing of extended and mixed precision BLAS", 2002 (relative to the result, whatever cancels); products and
//! quotients as in Hida, Li & Bailey, "Quad-double arithmetic", 2001; the error of a product by a fused multiply-add.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

use super::exact::two_sum;
use super::spacing::EPS;
use super::twofold::two_product;

/// What f64 and [`DoubleDouble`] both do.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + From<f64>
{
    /// The most by which one operation is off, relative to its exact result.
    const ROUNDOFF: f64;
    /// 2 pi.
    const TAU: Self;

    /// The nearest f64.
    fn to_f64(self) -> f64;

    /// The root of a number >= 0.
    fn sqrt(self) -> Self;

    /// The angle of the point (`x`, self), in -pi..=pi; 0 at the origin. Off by at most two roundings.
    fn atan2(self, x: Self) -> Self;

    /// The inverse hyperbolic sine of |self| <= 1e15: of f64 off by two roundings at most, of [`DoubleDouble`] by 4096, as far
    /// as was seen.
    fn asinh(self) -> Self;
}

impl Real for f64 {
    const ROUNDOFF: f64 = EPS;
    const TAU: f64 = core::f64::consts::TAU;

    fn to_f64(self) -> f64 {
        self
    }

    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    fn atan2(self, x: f64) -> f64 {
        f64::atan2(self, x)
    }

    fn asinh(self) -> f64 {
        libm::asinh(self)
    }
}

/// high + low.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The sum of two f64, the second at most half a spacing of the first.
    pub const fn new(high: f64, low: f64) -> Self {
        DoubleDouble { high, low }
    }

    /// The product of two f64, exactly.
    pub fn product(a: f64, b: f64) -> Self {
        let (high, low) = two_product(a, b);
        DoubleDouble { high, low }
    }

    /// This times a power of two, exactly.
    pub fn scaled(self, power: f64) -> Self {
        DoubleDouble { high: self.high * power, low: self.low * power }
    }

    /// The exponential of |x| <= 40.
    fn exp(x: f64) -> Self {
        // 2^-10 of it by the series, whose first term left out is 2^-105 (0.04)^14/14! and less; then ten squarings.
        let part = DoubleDouble::from(x / 1024.0);
        let mut value = FACTORIALS.iter().rev().fold(DoubleDouble::from(0.0), |sum, term| sum * part + *term);
        for _ in 0..10 {
            value = value * value;
        }
        value
    }

    fn renormalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        DoubleDouble { high: sum, low: low - (sum - high) }
    }

    fn times(self, factor: f64) -> Self {
        let product = Self::product(self.high, factor);
        Self::renormalised(product.high, product.low + self.low * factor)
    }

    /// The arc tangent of |self| <= 1/64 by its series; the first term left out is below 2^-112 of the result.
    fn atan_series(self) -> Self {
        let square = self * self;
        // From the eleventh power on f64 does: those terms are 2^-60 of the first.
        let w = square.high;
        let tail = -1.0 / 11.0 + w * (1.0 / 13.0 + w * (-1.0 / 15.0 + w / 17.0));
        let mut sum = DoubleDouble::from(tail);
        for reciprocal in ODD_RECIPROCALS.iter().rev() {
            sum = sum * square + *reciprocal;
        }
        self * sum
    }

    /// The arc tangent of 0 <= self <= 1.
    fn atan_unit(self) -> Self {
        let step = (64.0 * self.high).round();
        let node = DoubleDouble::from(step / 64.0);
        let rest = (self - node) / (DoubleDouble::from(1.0) + self * node);
        ARC_TANGENTS[step as usize] + rest.atan_series()
    }
}

/// (-1)^n (2n)!/(4^n n!^2 (2n + 1)), the coefficients of asinh x = x - x^3/6 + ...
static ASINH_SERIES: LazyLock<[DoubleDouble; 18]> = LazyLock::new(|| {
    let mut ratio = DoubleDouble::from(1.0);
    core::array::from_fn(|n| {
        let n = n as f64;
        if n > 0.0 {
            ratio = -ratio * DoubleDouble::from(2.0 * n - 1.0) / DoubleDouble::from(2.0 * n);
        }
        ratio / DoubleDouble::from(2.0 * n + 1.0)
    })
});

/// 1/n! from n = 0.
static FACTORIALS: LazyLock<[DoubleDouble; 14]> = LazyLock::new(|| {
    let mut inverse = DoubleDouble::from(1.0);
    core::array::from_fn(|n| {
        if n > 0 {
            inverse = inverse / DoubleDouble::from(n as f64);
        }
        inverse
    })
});

const PI: DoubleDouble = DoubleDouble::new(core::f64::consts::PI, 1.224_646_799_147_353_2e-16);

/// 1, -1/3, 1/5, -1/7, 1/9.
static ODD_RECIPROCALS: LazyLock<[DoubleDouble; 5]> = LazyLock::new(|| {
    [1.0, -3.0, 5.0, -7.0, 9.0].map(|odd| DoubleDouble::from(1.0) / DoubleDouble::from(odd))
});

/// The arc tangents of k/64: each is the one before and that of the tangents' difference, (1/64)/(1 + k(k - 1)/64^2).
static ARC_TANGENTS: LazyLock<[DoubleDouble; 65]> = LazyLock::new(|| {
    let mut table = [DoubleDouble::from(0.0); 65];
    for k in 1..65 {
        let number = k as f64;
        let difference = DoubleDouble::from(64.0) / DoubleDouble::from(4096.0 + number * (number - 1.0));
        table[k] = table[k - 1] + difference.atan_series();
    }
    table
});

impl Real for DoubleDouble {
    const ROUNDOFF: f64 = 1.0 / (1u128 << 102) as f64;
    const TAU: Self = DoubleDouble::new(2.0 * PI.high, 2.0 * PI.low);

    fn to_f64(self) -> f64 {
        self.high
    }

    fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return DoubleDouble::from(0.0);
        }
        let root = self.high.sqrt();
        let rest = self - DoubleDouble::product(root, root);
        Self::renormalised(root, rest.high / (2.0 * root))
    }

    fn atan2(self, x: Self) -> Self {
        let magnitude = |v: Self| if v.high < 0.0 { -v } else { v };
        let (up, right) = (magnitude(self), magnitude(x));
        if up.high == 0.0 && right.high == 0.0 {
            return DoubleDouble::from(0.0);
        }
        let half = DoubleDouble::new(0.5 * PI.high, 0.5 * PI.low);
        let quadrant =
            if up.high > right.high { half - (right / up).atan_unit() } else { (up / right).atan_unit() };
        let upper = if x.high < 0.0 { PI - quadrant } else { quadrant };
        if self.high < 0.0 { -upper } else { upper }
    }

    fn asinh(self) -> Self {
        let one = DoubleDouble::from(1.0);
        if self.high.abs() < 0.125 {
            // The first power left out is 2^-108 of the first.
            let square = self * self;
            let series = ASINH_SERIES.iter().rev();
            return self * series.fold(DoubleDouble::from(0.0), |sum, term| sum * square + *term);
        }
        if self.high < 0.0 {
            return -(-self).asinh();
        }
        // The logarithm of an argument above 1.13, by one step of Newton's that squares f64's error.
        let argument = self + (self * self + one).sqrt();
        let guess = libm::log(argument.high);
        DoubleDouble::from(guess) + (argument * Self::exp(-guess) - one)
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        DoubleDouble { high: value, low: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, high_error) = two_sum(self.high, other.high);
        let (low, low_error) = two_sum(self.low, other.low);
        let first = Self::renormalised(high, high_error + low);
        Self::renormalised(first.high, first.low + low_error)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::renormalised(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        // One correction of f64's quotient: 15 2^-106 (Joldes, Muller & Popescu, "Tight and rigorous error bounds for
        // basic building blocks of double-word arithmetic", 2017). The difference of the leading parts is exact.
        let first = self.high / other.high;
        let product = other.times(first);
        let rest = (self.high - product.high) + (self.low - product.low);
        Self::renormalised(first, rest / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Differences in units of 2^-102 of the result.
    fn roundings(a: DoubleDouble, b: DoubleDouble) -> f64 {
        ((a - b).high / b.high / DoubleDouble::ROUNDOFF).abs()
    }

    #[test]
    fn angles_of_known_sums() {
        // Machin: pi/4 = 4 atan(1/5) - atan(1/239). A dozen roundings add up.
        let one = DoubleDouble::from(1.0);
        let (a, b) = (one.atan2(DoubleDouble::from(5.0)), one.atan2(DoubleDouble::from(239.0)));
        let quarter = DoubleDouble::from(4.0) * a - b;
        assert!(roundings(quarter, DoubleDouble::TAU / DoubleDouble::from(8.0)) < 8.0);
        assert!(
            roundings(one.atan2(-one), DoubleDouble::from(3.0) * DoubleDouble::TAU / DoubleDouble::from(8.0))
                < 2.0
        );
        assert_eq!(
            DoubleDouble::from(-1.0).atan2(DoubleDouble::from(0.0)).high,
            -core::f64::consts::FRAC_PI_2
        );
    }

    proptest! {
        #[test]
        fn quotients_and_roots_invert(a in -1e6..1e6f64, b in 0.001..1e6f64, c in 0.5..1.0f64) {
            let x = DoubleDouble::product(a, c) + DoubleDouble::from(1e-20);
            let y = DoubleDouble::product(b, c);
            prop_assume!(x.high != 0.0);
            prop_assert!(roundings(x / y * y, x) <= 3.0);
            prop_assert!(roundings(y.sqrt() * y.sqrt(), y) <= 3.0);
        }

        /// tan(s + t) = (tan s + tan t)/(1 - tan s tan t), turned round; and atan2 agrees with f64's.
        #[test]
        fn angles_add(x in 0.01..1.0f64, y in 0.01..1.0f64) {
            let one = DoubleDouble::from(1.0);
            let (s, t) = (DoubleDouble::from(x), DoubleDouble::from(y));
            let sum = (s + t).atan2(one - s * t);
            prop_assert!(roundings(s.atan2(one) + t.atan2(one), sum) <= 8.0);
            // asinh x + asinh y = asinh(x sqrt(1 + y^2) + y sqrt(1 + x^2)), over all ways to compute one.
            let (a, b) = (DoubleDouble::from(x), DoubleDouble::from(30.0 * y));
            let whole = (a * (b * b + one).sqrt() + b * (a * a + one).sqrt()).asinh();
            // Ten squarings multiply an error of the exponential by 2^10, which the logarithm keeps.
            prop_assert!(((a.asinh() + b.asinh() - whole).high / whole.high).abs() <= 1e-26);
            prop_assert!((a.asinh().high - x.asinh()).abs() <= 4.0 * f64::EPSILON * x);
            prop_assert!((s.atan2(one).high - x.atan()).abs() <= f64::EPSILON);
            prop_assert!(((-s).atan2(-one).high - (-x).atan2(-1.0)).abs() <= 4.0 * f64::EPSILON);
        }
    }
}
