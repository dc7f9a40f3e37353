//! Floating point of any precision and any exponent, and the elementary functions that cones need of it.
//!
//! Integers of any size are dashu-int's; a number is one of them times a power of two. Exact numbers give exact sums and
//! products, and what is made of numbers of some precision has the larger of theirs. Nothing is rounded to a digit: results
//! are cut off a few units of the last place away, for callers who find out by another precision what that leaves.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Shl, Shr, Sub};
use std::sync::LazyLock;

use dashu_int::IBig;
use dashu_int::ops::{BitTest, SquareRoot, UnsignedAbs};

/// `mantissa` times 2^`exponent`.
#[derive(Clone, Debug)]
pub struct Big {
    mantissa: IBig,
    exponent: isize,
    /// How many bits are kept, at least; 0 for all.
    precision: usize,
}

/// A vector.
pub type Vector = [Big; 3];

/// The upper triangle xx, yy, zz, xy, xz, yz of a symmetric matrix.
pub type Symmetric = [Big; 6];

/// So many bits beyond the precision may stay before they are cut off.
const SLACK: usize = 64;

/// The most bits that pi is asked for.
pub const PI_BITS: usize = 16384;

/// Halvings of an argument before its series, which then has 2^-5 or less.
const HALVINGS: usize = 5;

impl Big {
    pub const ZERO: Big = Big { mantissa: IBig::ZERO, exponent: 0, precision: 0 };
    pub const ONE: Big = Big { mantissa: IBig::ONE, exponent: 0, precision: 0 };

    fn cut(mut mantissa: IBig, mut exponent: isize, precision: usize) -> Self {
        if precision > 0 {
            let bits = mantissa.bit_len();
            if bits > precision + SLACK {
                let off = bits - precision;
                mantissa >>= off;
                exponent += off as isize;
            }
        }
        Big { mantissa, exponent, precision }
    }

    /// The least power of two that is beyond.
    fn top(&self) -> isize {
        self.mantissa.bit_len() as isize + self.exponent
    }

    fn sum(&self, other: &Big, negative: bool) -> Big {
        let precision = self.precision.max(other.precision);
        let beneath = |small: &Big, large: &Big| {
            small.mantissa.is_zero()
                || precision > 0
                    && !large.mantissa.is_zero()
                    && small.top() + ((precision + SLACK) as isize) < large.top()
        };
        if beneath(other, self) {
            return Big::cut(self.mantissa.clone(), self.exponent, precision);
        }
        if beneath(self, other) {
            let mantissa = if negative { -&other.mantissa } else { other.mantissa.clone() };
            return Big::cut(mantissa, other.exponent, precision);
        }
        let apart = self.exponent - other.exponent;
        let mantissa = if apart >= 0 {
            let high = &self.mantissa << apart as usize;
            if negative { high - &other.mantissa } else { high + &other.mantissa }
        } else {
            let high = &other.mantissa << apart.unsigned_abs();
            if negative { &self.mantissa - high } else { &self.mantissa + high }
        };
        Big::cut(mantissa, self.exponent.min(other.exponent), precision)
    }

    fn product(&self, other: &Big) -> Big {
        let mantissa = &self.mantissa * &other.mantissa;
        Big::cut(mantissa, self.exponent + other.exponent, self.precision.max(other.precision))
    }

    /// Of numbers that are not both exact, by what is not 0.
    fn quotient(&self, other: &Big) -> Big {
        let precision = self.precision.max(other.precision);
        let wanted = precision + 2 + other.mantissa.bit_len();
        let up = wanted.saturating_sub(self.mantissa.bit_len());
        let mantissa = (&self.mantissa << up) / &other.mantissa;
        Big::cut(mantissa, self.exponent - other.exponent - up as isize, precision)
    }

    /// The root of what is not exact and not negative.
    pub fn sqrt(&self) -> Big {
        let up = (2 * self.precision + 2).saturating_sub(self.mantissa.bit_len());
        let up = up + (self.exponent - up as isize).rem_euclid(2) as usize;
        let root = (self.mantissa.clone() << up).unsigned_abs().sqrt();
        Big::cut(root.into(), (self.exponent - up as isize) / 2, self.precision)
    }

    /// How many bits are kept, 0 for all.
    pub fn precision(&self) -> usize {
        self.precision
    }

    /// pi to `bits`, at most [`PI_BITS`].
    pub fn pi(bits: usize) -> Big {
        static PI: LazyLock<Big> = LazyLock::new(machin);
        rounded(&PI, bits)
    }
}

/// pi by Machin's formula.
fn machin() -> Big {
    let bits = PI_BITS + SLACK;
    // atan(1/n) in 2^-bits.
    let arc = |n: u32| {
        let mut power = (IBig::ONE << bits) / n;
        let (mut sum, mut k) = (IBig::ZERO, 1u32);
        while !power.is_zero() {
            let term = &power / k;
            sum = if k % 4 == 1 { sum + term } else { sum - term };
            power /= n * n;
            k += 2;
        }
        sum
    };
    Big::cut((arc(5) << 4) - (arc(239) << 2), -(bits as isize), PI_BITS)
}

impl From<i32> for Big {
    fn from(value: i32) -> Self {
        Big { mantissa: value.into(), exponent: 0, precision: 0 }
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $by:expr;)*) => {$(
        impl $trait<&Big> for &Big {
            type Output = Big;
            fn $method(self, other: &Big) -> Big {
                $by(self, other)
            }
        }
        impl $trait<Big> for &Big {
            type Output = Big;
            fn $method(self, other: Big) -> Big {
                $by(self, &other)
            }
        }
        impl $trait<&Big> for Big {
            type Output = Big;
            fn $method(self, other: &Big) -> Big {
                $by(&self, other)
            }
        }
        impl $trait<Big> for Big {
            type Output = Big;
            fn $method(self, other: Big) -> Big {
                $by(&self, &other)
            }
        }
    )*};
}

operators! {
    Add add |a: &Big, b| a.sum(b, false);
    Sub sub |a: &Big, b| a.sum(b, true);
    Mul mul Big::product;
    Div div Big::quotient;
}

impl AddAssign<Big> for Big {
    fn add_assign(&mut self, other: Big) {
        *self = self.sum(&other, false);
    }
}

impl AddAssign<&Big> for Big {
    fn add_assign(&mut self, other: &Big) {
        *self = self.sum(other, false);
    }
}

impl Neg for Big {
    type Output = Big;

    fn neg(self) -> Big {
        Big { mantissa: -self.mantissa, ..self }
    }
}

impl Neg for &Big {
    type Output = Big;

    fn neg(self) -> Big {
        Big { mantissa: -&self.mantissa, ..*self }
    }
}

impl Shl<isize> for Big {
    type Output = Big;

    fn shl(self, by: isize) -> Big {
        Big { exponent: self.exponent + by, ..self }
    }
}

impl Shr<isize> for Big {
    type Output = Big;

    fn shr(self, by: isize) -> Big {
        self << -by
    }
}

impl PartialEq for Big {
    fn eq(&self, other: &Big) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Big) -> Option<Ordering> {
        let side = |x: &Big| x.mantissa.cmp(&IBig::ZERO);
        let (a, b) = (side(self), side(other));
        if a != b || a == Ordering::Equal {
            return Some(a.cmp(&b));
        }
        Some(side(&self.sum(other, true)))
    }
}

/// This very number.
pub fn exact(x: f64) -> Big {
    let (fraction, exponent) = libm::frexp(x);
    let mantissa = libm::ldexp(fraction, 53) as i64;
    let even = if mantissa == 0 { 0 } else { mantissa.trailing_zeros() };
    let exponent = exponent as isize - 53 + even as isize;
    Big { mantissa: (mantissa >> even).into(), exponent, precision: 0 }
}

/// These very numbers.
pub fn vector(v: glam::DVec3) -> Vector {
    v.to_array().map(exact)
}

/// This number to `bits`.
pub fn rounded(x: &Big, bits: usize) -> Big {
    Big::cut(x.mantissa.clone(), x.exponent, bits)
}

/// This number as an f64, which may be 0 or infinite: one rounding off.
pub fn nearest(x: &Big) -> f64 {
    let off = x.mantissa.bit_len().saturating_sub(100);
    let leading = i128::try_from(&x.mantissa >> off).expect("a hundred bits") as f64;
    let exponent = (x.exponent + off as isize).clamp(-4000, 4000);
    libm::ldexp(leading, exponent as i32)
}

/// |x|.
pub fn abs(x: Big) -> Big {
    if x.mantissa < IBig::ZERO { -x } else { x }
}

/// The root of what is positive but for roundings.
pub fn root(x: &Big) -> Big {
    if *x > Big::ZERO { x.sqrt() } else { Big::ZERO }
}

pub fn dot(a: &Vector, b: &Vector) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub fn cross(a: &Vector, b: &Vector) -> Vector {
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// v v^T.
pub fn square([x, y, z]: &Vector) -> Symmetric {
    [x * x, y * y, z * z, x * y, x * z, y * z]
}

/// S v.
pub fn times([xx, yy, zz, xy, xz, yz]: &Symmetric, [x, y, z]: &Vector) -> Vector {
    [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
}

/// The sum of S_ij v_i v_j's terms in absolute value along each component: how far 2 S v moves for v by itself.
pub fn moved(s: &Symmetric, v: &Vector) -> Big {
    let along = times(s, v);
    let sum = (0..3).fold(Big::ZERO, |sum, k| sum + abs(&along[k] * &v[k]));
    sum * Big::from(2)
}

/// The angle of the point (x, y), y >= 0, in 0..=pi; `pi` has its precision.
pub fn angle(y: &Big, x: &Big, pi: &Big) -> Big {
    let one = Big::ONE;
    if *x < Big::ZERO {
        return pi - angle(y, &-x, pi);
    }
    if y > x {
        return pi / Big::from(2) - angle(x, y, pi);
    }
    if *y == Big::ZERO {
        return Big::ZERO;
    }
    let mut t = y / x;
    for _ in 0..HALVINGS {
        let next = &t / (&one + (&one + &t * &t).sqrt());
        t = next;
    }
    let ratio = series(&(-(&t * &t)), pi.precision());
    (t * ratio) << HALVINGS as isize
}

/// asinh(z)/z by z^2 >= 0, to `bits`.
pub fn asinh_over(square: &Big, bits: usize) -> Big {
    let one = rounded(&Big::ONE, bits);
    if *square == Big::ZERO {
        return one;
    }
    let s = square.sqrt();
    let (mut half, mut halvings) = (s.clone(), 0);
    // sinh(x/2) = sinh x/sqrt(2 (1 + cosh x)); 2^20 bits of exponent are gone after 20.
    while half.clone() << 5 > one && halvings < 64 {
        let cosh = (&one + &half * &half).sqrt();
        half = half / ((one.clone() + cosh) << 1).sqrt();
        halvings += 1;
    }
    let t2 = &half * &half / (&one + &half * &half);
    let t = t2.sqrt();
    (t * series(&t2, bits) << halvings) / s
}

/// 1 + x/3 + x^2/5 + ... for |x| <= 2^-9, to `bits`: atanh(t)/t of t^2, atan(t)/t of -t^2.
fn series(x: &Big, bits: usize) -> Big {
    // In 2^-bits.
    let shift = x.exponent + bits as isize;
    let step = if shift < 0 { &x.mantissa >> shift.unsigned_abs() } else { &x.mantissa << shift as usize };
    let mut power = IBig::ONE << bits;
    let (mut sum, mut k) = (power.clone(), 1u32);
    // Every term is 9 bits smaller.
    for _ in 0..=bits / 9 + 1 {
        power = (power * &step) >> bits;
        k += 2;
        sum += &power / k;
    }
    Big::cut(sum, -(bits as isize), bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Float = dashu_float::FBig;

    /// The crate's own floating point, whose functions are correctly rounded, is the independent arithmetic.
    fn reference(x: &Big) -> Float {
        Float::from_parts(x.mantissa.clone(), x.exponent).with_precision(x.precision).value()
    }

    fn close(found: &Big, expected: Float, bits: isize) {
        let off = reference(found) - &expected;
        let size = |x: Float| if x < Float::ZERO { -x } else { x };
        assert!(size(off) << bits <= size(expected.clone()), "{found:?} for {expected}");
    }

    #[test]
    fn functions_agree_with_correctly_rounded_ones() {
        for bits in [128, 512] {
            let pi = Big::pi(bits);
            close(&pi, Float::pi(bits), bits as isize - 2);
            for (y, x) in [(1.0, 1.0), (1e-30, 1.0), (0.3, -2.0), (5.0, 1e-3), (5.0, -1e-20), (2.0, 0.0)] {
                let (y, x) = (rounded(&exact(y), bits), rounded(&exact(x), bits));
                close(&angle(&y, &x, &pi), reference(&y).atan2(&reference(&x)), bits as isize - 8);
            }
            for z in [1e-200, 1e-3, 0.5, 3.0, 1e100] {
                let z = rounded(&exact(z), bits);
                close(
                    &asinh_over(&(&z * &z), bits),
                    reference(&z).asinh() / reference(&z),
                    bits as isize - 8,
                );
            }
            assert_eq!(asinh_over(&Big::ZERO, bits), Big::ONE);
        }
    }

    proptest! {
        #[test]
        fn operations_keep_their_precision(a in -1e3..1e3f64, b in 1e-3..1e3f64, c in -1e3..1e3f64, apart in 0isize..300) {
            let bits = 192;
            let x = rounded(&exact(a), bits) / exact(b) + (exact(c) >> apart);
            let of = |x: f64| Float::try_from(x).unwrap().with_precision(400).value();
            let expected = of(a) / of(b) + (of(c) >> apart);
            close(&x, expected.clone(), bits as isize - 30);
            close(&(&x * &x).sqrt(), if expected < Float::ZERO { -expected.clone() } else { expected.clone() }, bits as isize - 30);
            close(&(&x * &exact(b) - &x), &expected * of(b) - &expected, bits as isize - 60);
            prop_assert_eq!(nearest(&exact(a)), a);
            prop_assert_eq!(exact(a) < exact(c) , a < c);
            prop_assert!((nearest(&x) / expected.to_f64().value() - 1.0).abs() < 2.3e-16);
        }

        #[test]
        fn exact_numbers_stay_exact(a in -1i64 << 40..1i64 << 40, b in -1i64 << 40..1i64 << 40, apart in 0isize..40) {
            let (x, y) = (exact(a as f64) << apart, exact(b as f64));
            let (p, q) = (i128::from(a) << apart, i128::from(b));
            prop_assert_eq!(&x * &y - &x, exact(1.0) * (Big { mantissa: (p * q - p).into(), exponent: 0, precision: 0 }));
            prop_assert!(x.clone() - &x == Big::ZERO && abs(x.clone()) >= Big::ZERO);
        }
    }

    #[test]
    fn the_ends_of_f64_are_met() {
        assert_eq!(nearest(&(exact(1.0) >> 5000)), 0.0);
        assert_eq!(nearest(&(exact(-1.0) << 5000)), f64::NEG_INFINITY);
        assert_eq!(nearest(&exact(5e-324)), 5e-324);
        assert_eq!(nearest(&exact(f64::MAX)), f64::MAX);
        assert_eq!(exact(-0.0), Big::ZERO);
    }
}
