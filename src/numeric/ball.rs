//! Numbers that know how far off they may be: f64 or twice its digits, with a radius.
//!
//! A ball stands for every number within its radius of its middle, and every operation's ball for all results of numbers
//! of its operands' balls: the roundings of the operation itself are in the radius. So a long computation needs no error
//! analysis; it is good where its last ball is small, and a comparison that its balls cannot decide is neither true nor
//! false (Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", 2017).
//!
//! f64's keep f64's range, which is what makes them fast: what leaves it is unknown. Those of twice its digits have exponents that
//! no light leaves.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Shl, Shr, Sub};

use super::clipped_cone::{Number, Operand};
use super::double_double::{DoubleDouble, Real};
use super::exact;
use super::spacing::EPS;

/// Exponents are kept in steps of so many.
const STEP: isize = 256;
const UP: f64 = power(STEP);
const DOWN: f64 = power(-STEP);
/// Middles that are not within the radius are within 2^-128 and 2^128, where products and quotients stay in range.
const LARGEST: f64 = power(STEP / 2);
const LEAST: f64 = power(-STEP / 2);

/// Of LEAST, as f64 has it.
const SMALLEST_EXPONENT: u64 = (1023 - STEP / 2) as u64;

/// The radius is computed in a few operations, each of which may be off by a rounding.
const OUTWARD: f64 = 1.0 + 8.0 * f64::EPSILON;
/// More than a product or quotient loses below f64's range.
const TINY: f64 = f64::MIN_POSITIVE;
/// What sums in two parts lose of twelve terms, which may be off by 2^-103 themselves.
const SUMS: f64 = 1.0 / (1u128 << 98) as f64;
/// Below this square 1 is asinh(z)/z and atan(z)/z to all digits.
const SERIES: f64 = 1e-32;

/// 2^exponent of a normal f64.
const fn power(exponent: isize) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// What a ball's middle is.
pub trait Middle: Real + std::fmt::Debug {
    const ZERO: Self;
    const ONE: Self;

    /// Whether exponents are unlimited, in steps.
    const IS_WIDE: bool;
    /// Angles and logarithms are off by so many roundings at most.
    const ELEMENTARY: f64;

    /// The nearest of these to a sum whose second part is within half a spacing of the first, and what of it is left.
    fn of(pair: (f64, f64)) -> (Self, f64);

    /// The sum of at most 63 terms, rounded once.
    fn sum(terms: &[f64]) -> Self;

    /// Times a power of two.
    fn scaled(self, power: f64) -> Self;
}

impl Middle for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    const IS_WIDE: bool = false;
    /// An ulp or less, and as many for other machines.
    const ELEMENTARY: f64 = 4.0;

    #[inline(always)]
    fn of((high, low): (f64, f64)) -> (f64, f64) {
        (high, low.abs())
    }

    fn sum(terms: &[f64]) -> f64 {
        exact::sum(terms)
    }

    #[inline(always)]
    fn scaled(self, power: f64) -> f64 {
        self * power
    }
}

impl Middle for DoubleDouble {
    const ZERO: Self = DoubleDouble::new(0.0, 0.0);
    const ONE: Self = DoubleDouble::new(1.0, 0.0);
    const IS_WIDE: bool = true;
    /// Of the logarithm, whose exponential is squared ten times.
    const ELEMENTARY: f64 = 4096.0;

    fn of((high, low): (f64, f64)) -> (Self, f64) {
        (DoubleDouble::new(high, low), 0.0)
    }

    fn sum(terms: &[f64]) -> Self {
        let (high, low) = exact::pair(terms);
        DoubleDouble::new(high, low)
    }

    fn scaled(self, power: f64) -> Self {
        DoubleDouble::scaled(self, power)
    }
}

/// All numbers from (middle - radius) 2^(256 steps) to (middle + radius) 2^(256 steps).
#[derive(Clone, Copy, Debug)]
pub struct Ball<M> {
    middle: M,
    radius: f64,
    steps: i64,
}

impl<M: Middle> Ball<M> {
    pub const ZERO: Self = Ball { middle: M::ZERO, radius: 0.0, steps: 0 };
    /// Any number.
    const UNKNOWN: Self = Ball { middle: M::ZERO, radius: f64::INFINITY, steps: 0 };
    pub const ONE: Self = Ball { middle: M::ONE, radius: 0.0, steps: 0 };

    /// This very number; anything at all for what is not finite.
    pub fn exact(x: f64) -> Self {
        Ball::within(x, 0.0)
    }

    /// All numbers at most `radius` from `middle`.
    pub fn within(middle: f64, radius: f64) -> Self {
        Ball::near((middle, 0.0), radius)
    }

    /// All numbers at most `radius` from a sum, whose second part is within half a spacing of the first.
    pub fn near(pair: (f64, f64), radius: f64) -> Self {
        let (middle, lost) = M::of(pair);
        if middle.to_f64().is_finite() {
            Ball { middle, radius: (radius + lost) * OUTWARD, steps: 0 }.normalized()
        } else {
            Ball::UNKNOWN
        }
    }

    /// The sum of at most 63 terms, which may be off by `radius`.
    pub fn sum(terms: &[f64], radius: f64) -> Self {
        let middle = M::sum(terms);
        Ball { middle, radius: (radius + M::ROUNDOFF * middle.to_f64().abs()) * OUTWARD, steps: 0 }
            .normalized()
    }

    /// The sum of at most twelve terms, up to 2^-98 of what they add up to in absolute value.
    pub fn short_sum(terms: &[f64]) -> Self {
        let (sum, rest, size) = exact::parts(terms);
        let high = sum + rest;
        Ball::near((high, rest - (high - sum)), SUMS * size)
    }

    /// The middle as f64.
    #[inline(always)]
    fn high(self) -> f64 {
        self.middle.to_f64()
    }

    /// The middle as f64, which may underflow or overflow.
    pub fn value(self) -> f64 {
        self.scaled(self.high())
    }

    /// How far off [`value`](Self::value) may be, absolutely.
    pub fn error(self) -> f64 {
        let value = self.value().abs();
        // What the conversion may round away, and of a subnormal.
        let lost = if value < f64::MIN_POSITIVE { f64::MIN_POSITIVE } else { 0.0 };
        let rounding = if M::IS_WIDE { EPS * value } else { 0.0 };
        (self.scaled(self.radius) + rounding) * OUTWARD + lost
    }

    fn scaled(self, x: f64) -> f64 {
        if self.steps == 0 { x } else { libm::ldexp(x, (self.steps.clamp(-16, 16) * STEP as i64) as i32) }
    }

    /// The radius over the least absolute value there may be; infinite where that is 0.
    pub fn relative(self) -> f64 {
        let least = self.high().abs() / OUTWARD - self.radius;
        if self.radius == 0.0 {
            0.0
        } else if least > 0.0 {
            self.radius / least * OUTWARD
        } else {
            f64::INFINITY
        }
    }

    /// The middle alone, as if it were exact.
    pub fn middle(self) -> Self {
        Ball { radius: 0.0, ..self }
    }

    /// The largest absolute value there may be, exactly; of an unbounded one anything.
    pub fn largest(self) -> Self {
        let middle = M::from((self.high().abs() + self.radius) * OUTWARD);
        Ball { middle, radius: 0.0, steps: self.steps }.normalized()
    }

    /// This, where it is only known relatively to what `relative` is at most.
    pub fn widened(self, relative: Self) -> Self {
        self + Ball::up_to(self * relative)
    }

    /// Anything whose absolute value is one that `size` may have.
    pub fn up_to(size: Self) -> Self {
        let largest = size.largest();
        if largest.radius == 0.0 {
            Ball { middle: M::ZERO, radius: largest.high(), ..largest }
        } else {
            Ball::UNKNOWN
        }
    }

    /// The radius, exactly; of an unbounded one anything.
    pub fn radius(self) -> Self {
        Ball { middle: M::from(self.radius), radius: 0.0, steps: self.steps }.normalized()
    }

    /// Whether the middle is, for choices that are right either way.
    pub fn is_above(self, other: Self) -> bool {
        self.middle() > other.middle()
    }

    /// Whether this is 0 and nothing else.
    pub fn is_zero(self) -> bool {
        self.high() == 0.0 && self.radius == 0.0
    }

    /// What is known of a number by two ways: the better.
    pub fn or(self, other: Self) -> Self {
        let (a, b, _) = aligned(self, other);
        // Of what left the range, nothing is known.
        if b.1 < a.1 || a.1.is_nan() { other } else { self }
    }

    pub fn abs(self) -> Self {
        if self.high() < 0.0 { -self } else { self }
    }

    /// The root of what is not negative but for its error.
    pub fn sqrt(self) -> Self {
        if self.is_zero() {
            return self;
        }
        // Unknown, or negative.
        if !(self.radius < f64::INFINITY && self.high() + self.radius >= 0.0) {
            return Ball::UNKNOWN;
        }
        let (up, steps) = if self.steps & 1 == 0 { (1.0, self.steps) } else { (UP, self.steps - 1) };
        let (middle, radius, steps) = (self.middle.scaled(up), self.radius * up, steps / 2);
        let high = middle.to_f64();
        let ball = if high > radius {
            let root = middle.sqrt();
            let (size, least) = (root.to_f64(), libm::sqrt((high / OUTWARD - radius).max(0.0)));
            let radius = radius / (size + least) + 2.0 * M::ROUNDOFF * size;
            Ball { middle: root, radius: radius * OUTWARD, steps }
        } else {
            let half = 0.5 * libm::sqrt(high + radius) * OUTWARD;
            Ball { middle: M::from(half), radius: half * OUTWARD, steps }
        };
        ball.normalized()
    }

    /// The length of (self, other).
    pub fn hypot(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other.abs() } else { self.abs() };
        }
        let (a, b, steps) = aligned(self, other);
        let middle = (a.0 * a.0 + b.0 * b.0).sqrt();
        let size = middle.to_f64();
        // What the squares lose below f64's range, of their root.
        let lost = 4.0 * TINY / (size + libm::sqrt(4.0 * TINY)) + 3.0 * M::ROUNDOFF * size;
        Ball { middle, radius: (a.1 + b.1 + lost) * OUTWARD, steps }.normalized()
    }

    /// The angle of the point (x, self) in 0..2pi: of one with y >= 0 but for its error in 0..=pi, and of one with x < 0 that
    /// is as close to pi as it may be from either side.
    pub fn angle(self, x: Self) -> Self {
        let (y, x, _) = aligned(self, x);
        let (high_x, high_y) = (x.0.to_f64().abs(), y.0.to_f64().abs());
        let length = libm::hypot(high_x, high_y);
        let near = libm::hypot(x.1, y.1);
        if !(near <= 0.25 * length) {
            return Ball::UNKNOWN;
        }
        let angle = y.0.atan2(x.0);
        let middle = if angle.to_f64() < 0.0 && x.0.to_f64() < 0.0 { angle + M::TAU } else { angle };
        // The sine of the angle between both points is the cross product over the lengths, and the arc at most 1.1 times it
        // where it is at most 1/2.
        let rest = length - near;
        let sine = high_x / length * (y.1 / rest) + high_y / length * (x.1 / rest);
        let lost = M::ELEMENTARY * M::ROUNDOFF * middle.to_f64().abs();
        Ball { middle, radius: (1.1 * sine + lost) * OUTWARD, steps: 0 }.normalized()
    }

    /// The value of a function f of x >= 0 that decreases from f(0), f(0) = 1, nowhere steeper than `steepest` nor than
    /// f/(2 x): at self, if that is known well enough.
    fn falling(self, f: impl Fn(M) -> M, steepest: f64) -> Option<Self> {
        let (x, error) = (self.value().max(0.0), self.scaled(self.radius) * OUTWARD + f64::MIN_POSITIVE);
        if !(x < 1e29 && error <= 0.5 * x.max(1e-3)) {
            return None;
        }
        let (middle, error) = if x < SERIES { (M::ONE, x + error) } else { (f(self.middle), error) };
        let size = middle.to_f64();
        let radius =
            steepest.min(size / (x - error).max(0.0)) * error + 4.0 * M::ELEMENTARY * M::ROUNDOFF * size;
        Some(Ball { middle, radius: radius * OUTWARD, steps: 0 }.normalized())
    }

    /// asinh(z)/z by z^2 = self.
    fn asinh_over_root(self) -> Self {
        let asinh = |x: M| {
            let root = x.sqrt();
            root.asinh() / root
        };
        self.falling(asinh, 1.0 / 6.0).unwrap_or_else(|| {
            // log(2 z)/z, with what 1/(4 z^2) adds to the logarithm, to f64's digits.
            if !(self.relative() < 0.25 && Ball::exact(1e20) < self) {
                return Ball::UNKNOWN;
            }
            let root = self.sqrt();
            let log =
                libm::log(2.0 * root.high()) + root.steps as f64 * (STEP as f64 * std::f64::consts::LN_2);
            Ball::within(log, root.relative() + 4.0 * EPS * (log + 1.0)) / root
        })
    }

    /// The angle of the point (x, y) over y, by y^2 = self.
    fn angle_over_root(self, x: Self) -> Self {
        let near = if x > Ball::ZERO {
            let angle = |s: M| {
                let root = s.sqrt();
                root.atan2(M::ONE) / root
            };
            let slope = (self / (x * x)).falling(angle, 1.0 / 3.0);
            slope.map(|ratio| ratio / x)
        } else {
            None
        };
        near.unwrap_or_else(|| {
            let y = self.sqrt();
            y.angle(x) / y
        })
    }

    #[inline(always)]
    fn normalized(self) -> Self {
        let exponent = (self.high().to_bits() >> 52) & 0x7ff;
        let is_in_range = exponent.wrapping_sub(SMALLEST_EXPONENT) < STEP as u64;
        if !M::IS_WIDE || is_in_range { self } else { self.stepped() }
    }

    #[cold]
    fn stepped(self) -> Self {
        let Ball { mut middle, mut radius, mut steps } = self;
        if !(middle.to_f64().is_finite() && radius < f64::INFINITY) {
            return Ball::UNKNOWN;
        }
        // An operation leaves the range by one step or two.
        for _ in 0..4 {
            let size = middle.to_f64().abs().max(radius);
            if size >= LARGEST && size.is_finite() {
                (middle, radius, steps) = (middle.scaled(DOWN), radius * DOWN, steps + 1);
            } else if size < LEAST && size > 0.0 {
                (middle, radius, steps) = (middle.scaled(UP), radius * UP, steps - 1);
            } else {
                break;
            }
        }
        Ball { middle, radius, steps }
    }
}

/// Middles and radii of both at the larger's steps.
#[inline(always)]
fn aligned<M: Middle>(a: Ball<M>, b: Ball<M>) -> ((M, f64), (M, f64), i64) {
    if !M::IS_WIDE || a.steps == b.steps {
        ((a.middle, a.radius), (b.middle, b.radius), a.steps)
    } else {
        shifted(a, b)
    }
}

#[cold]
fn shifted<M: Middle>(a: Ball<M>, b: Ball<M>) -> ((M, f64), (M, f64), i64) {
    let (whole_a, whole_b) = ((a.middle, a.radius), (b.middle, b.radius));
    if b.is_zero() {
        return (whole_a, whole_b, a.steps);
    }
    if a.is_zero() {
        return (whole_a, whole_b, b.steps);
    }
    let down = |ball: Ball<M>, by: i64| {
        if by < 4 {
            let power = power(-STEP * by as isize);
            (ball.middle.scaled(power), ball.radius * power)
        } else if ball.radius <= LARGEST {
            // More than it is, and far below any rounding of the other.
            (M::ZERO, power(-3 * STEP))
        } else {
            (M::ZERO, f64::INFINITY)
        }
    };
    if a.steps > b.steps {
        (whole_a, down(b, a.steps - b.steps), a.steps)
    } else {
        (down(a, b.steps - a.steps), whole_b, b.steps)
    }
}

impl<M: Middle> Neg for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn neg(self) -> Ball<M> {
        Ball { middle: -self.middle, ..self }
    }
}

impl<M: Middle> Add for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn add(self, other: Ball<M>) -> Ball<M> {
        let (a, b, steps) = aligned(self, other);
        let middle = a.0 + b.0;
        let size = middle.to_f64().abs();
        Ball { middle, radius: (a.1 + b.1 + M::ROUNDOFF * size) * OUTWARD, steps }.normalized()
    }
}

impl<M: Middle> Sub for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn sub(self, other: Ball<M>) -> Ball<M> {
        self + -other
    }
}

impl<M: Middle> Mul for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn mul(self, other: Ball<M>) -> Ball<M> {
        if self.is_zero() || other.is_zero() {
            return Ball::ZERO;
        }
        let middle = self.middle * other.middle;
        let radius = self.high().abs() * other.radius
            + self.radius * (other.high().abs() + other.radius)
            + M::ROUNDOFF * middle.to_f64().abs()
            + TINY;
        Ball { middle, radius: radius * OUTWARD, steps: self.steps + other.steps }.normalized()
    }
}

impl<M: Middle> Div for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn div(self, other: Ball<M>) -> Ball<M> {
        let least = other.high().abs() / OUTWARD - other.radius;
        if !(least > 0.0 && least < f64::INFINITY) {
            return Ball::UNKNOWN;
        }
        if self.is_zero() {
            return self;
        }
        let middle = self.middle / other.middle;
        let size = middle.to_f64().abs();
        let radius = self.radius / least + size * (other.radius / least) + M::ROUNDOFF * size + TINY;
        Ball { middle, radius: radius * OUTWARD, steps: self.steps - other.steps }.normalized()
    }
}

impl<M: Middle> Shl<isize> for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn shl(self, bits: isize) -> Ball<M> {
        if !M::IS_WIDE {
            return self * Ball::exact(libm::ldexp(1.0, bits.clamp(-1100, 1100) as i32));
        }
        let (by, steps) = (power(bits % STEP), self.steps + (bits / STEP) as i64);
        Ball { middle: self.middle.scaled(by), radius: self.radius * by, steps }.normalized()
    }
}

impl<M: Middle> Shr<isize> for Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn shr(self, bits: isize) -> Ball<M> {
        self << -bits
    }
}

/// Decided only where all numbers of both balls agree.
impl<M: Middle> PartialOrd for Ball<M> {
    #[inline]
    fn partial_cmp(&self, other: &Ball<M>) -> Option<Ordering> {
        let (a, b, _) = aligned(*self, *other);
        let difference = (a.0 - b.0).to_f64();
        let radius = (a.1 + b.1) * OUTWARD;
        if difference.abs() > radius || radius == 0.0 { difference.partial_cmp(&0.0) } else { None }
    }
}

impl<M: Middle> PartialEq for Ball<M> {
    #[inline]
    fn eq(&self, other: &Ball<M>) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

macro_rules! by_reference {
    ($($operation:ident $method:ident),*) => { $(
        impl<M: Middle> $operation<&Ball<M>> for Ball<M> {
            type Output = Ball<M>;

            #[inline]
            fn $method(self, other: &Ball<M>) -> Ball<M> {
                $operation::$method(self, *other)
            }
        }

        impl<M: Middle> $operation<Ball<M>> for &Ball<M> {
            type Output = Ball<M>;

            #[inline]
            fn $method(self, other: Ball<M>) -> Ball<M> {
                $operation::$method(*self, other)
            }
        }

        impl<M: Middle> $operation<&Ball<M>> for &Ball<M> {
            type Output = Ball<M>;

            #[inline]
            fn $method(self, other: &Ball<M>) -> Ball<M> {
                $operation::$method(*self, *other)
            }
        }
    )* };
}

by_reference!(Add add, Sub sub, Mul mul, Div div);

impl<M: Middle> Neg for &Ball<M> {
    type Output = Ball<M>;

    #[inline]
    fn neg(self) -> Ball<M> {
        -*self
    }
}

impl<M: Middle> Operand<Ball<M>> for Ball<M> {}
impl<M: Middle> Operand<Ball<M>> for &Ball<M> {}

impl<M: Middle> Number for Ball<M> {
    fn whole(n: u8) -> Self {
        Ball::exact(n.into())
    }

    /// To its own.
    fn pi(_: usize) -> Self {
        let middle = M::TAU.scaled(0.5);
        Ball { middle, radius: 4.0 * M::ROUNDOFF, steps: 0 }
    }

    fn root(&self) -> Self {
        self.sqrt()
    }

    fn angle(&self, x: &Self, _: &Self) -> Self {
        Ball::angle(*self, *x)
    }

    fn angle_over(&self, x: &Self, _: &Self) -> Self {
        self.angle_over_root(*x)
    }

    fn better(self, other: Self) -> Self {
        self.or(other)
    }

    fn asinh_over(&self, _: usize) -> Self {
        self.asinh_over_root()
    }

    /// The radius tells.
    fn negligible(wanted: isize, _: usize) -> isize {
        wanted
    }

    fn without(self, share: &Self) -> Self {
        self.widened(*share)
    }
}

#[cfg(test)]
mod tests;
