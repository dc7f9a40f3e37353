//! Numbers that know how far off they may be: f64 with a radius, and exponents that no light leaves.
//!
//! A ball stands for every number within its radius of its middle, and every operation's ball for all results of numbers
//! of its operands' balls: the roundings of the operation itself are in the radius. So a long computation needs no error
//! analysis; it is good where its last ball is small, and a comparison that its balls cannot decide is neither true nor
//! false (Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", 2017).

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Shl, Shr, Sub};

use super::clipped_cone::{Number, Operand};
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
/// libm's elementary functions are within an ulp or less of the result; two are allowed.
const ELEMENTARY: f64 = 2.0 * f64::EPSILON;

/// 2^exponent of a normal f64.
const fn power(exponent: isize) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// All numbers from (middle - radius) 2^(256 steps) to (middle + radius) 2^(256 steps).
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    middle: f64,
    radius: f64,
    steps: i64,
}

impl Ball {
    pub const ZERO: Ball = Ball { middle: 0.0, radius: 0.0, steps: 0 };
    /// Any number.
    const UNKNOWN: Ball = Ball { middle: 0.0, radius: f64::INFINITY, steps: 0 };
    pub const ONE: Ball = Ball { middle: 1.0, radius: 0.0, steps: 0 };

    /// This very number; anything at all for what is not finite.
    pub fn exact(x: f64) -> Self {
        Ball::within(x, 0.0)
    }

    /// What was rounded to `x` at most a few times: within `roundings` of it.
    pub fn rounded(x: f64, roundings: f64) -> Self {
        Ball::within(x, roundings * EPS * x.abs())
    }

    /// All numbers at most `radius` from `middle`.
    pub fn within(middle: f64, radius: f64) -> Self {
        if middle.is_finite() {
            Ball { middle, radius: radius * OUTWARD, steps: 0 }.normalized()
        } else {
            Ball::UNKNOWN
        }
    }

    /// The middle as f64, which may underflow or overflow.
    pub fn value(self) -> f64 {
        self.scaled(self.middle)
    }

    /// How far off [`value`](Self::value) may be, absolutely.
    pub fn error(self) -> f64 {
        // What the conversion may round away of a subnormal.
        let lost = if self.value().abs() < f64::MIN_POSITIVE { f64::MIN_POSITIVE } else { 0.0 };
        self.scaled(self.radius) * OUTWARD + lost
    }

    fn scaled(self, x: f64) -> f64 {
        if self.steps == 0 { x } else { libm::ldexp(x, (self.steps.clamp(-16, 16) * STEP as i64) as i32) }
    }

    /// The radius over the least absolute value there may be; infinite where that is 0.
    pub fn relative(self) -> f64 {
        if self.is_zero() {
            0.0
        } else if self.middle.abs() > self.radius {
            self.radius / (self.middle.abs() - self.radius) * OUTWARD
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
        Ball { middle: (self.middle.abs() + self.radius) * OUTWARD, radius: 0.0, steps: self.steps }
            .normalized()
    }

    /// This, where it is only known relatively to what `relative` is at most.
    pub fn widened(self, relative: Self) -> Self {
        self + Ball::up_to(self * relative)
    }

    /// Anything whose absolute value is one that `size` may have.
    pub fn up_to(size: Self) -> Self {
        let largest = size.largest();
        if largest.radius == 0.0 {
            Ball { middle: 0.0, radius: largest.middle, ..largest }
        } else {
            Ball::UNKNOWN
        }
    }

    /// The radius, exactly; of an unbounded one anything.
    pub fn radius(self) -> Self {
        Ball { middle: self.radius, radius: 0.0, steps: self.steps }.normalized()
    }

    /// Whether the middle is, for choices that are right either way.
    pub fn is_above(self, other: Self) -> bool {
        self.middle() > other.middle()
    }

    /// Whether this is 0 and nothing else.
    pub fn is_zero(self) -> bool {
        self.middle == 0.0 && self.radius == 0.0
    }

    /// What is known of a number by two ways: the better.
    pub fn or(self, other: Self) -> Self {
        let (a, b, _) = aligned(self, other);
        if b.1 < a.1 { other } else { self }
    }

    pub fn abs(self) -> Self {
        if self.middle < 0.0 { -self } else { self }
    }

    /// The root of what is not negative but for its error.
    pub fn sqrt(self) -> Self {
        if self.is_zero() {
            return self;
        }
        if !(self.radius < f64::INFINITY) {
            return Ball::UNKNOWN;
        }
        let (up, steps) = if self.steps & 1 == 0 { (1.0, self.steps) } else { (UP, self.steps - 1) };
        let (middle, radius, steps) = (self.middle * up, self.radius * up, steps / 2);
        let ball = if middle > radius {
            let root = libm::sqrt(middle);
            let radius = radius / (root + libm::sqrt(middle - radius)) + EPS * root;
            Ball { middle: root, radius: radius * OUTWARD, steps }
        } else {
            let half = 0.5 * libm::sqrt((middle + radius).max(0.0)) * OUTWARD;
            Ball { middle: half, radius: half * OUTWARD, steps }
        };
        ball.normalized()
    }

    /// The length of (self, other).
    pub fn hypot(self, other: Self) -> Self {
        let (a, b, steps) = aligned(self, other);
        let middle = libm::hypot(a.0, b.0);
        Ball { middle, radius: (a.1 + b.1 + ELEMENTARY * middle) * OUTWARD, steps }.normalized()
    }

    /// The angle of the point (x, self) in 0..2pi: of one with y >= 0 but for its error in 0..=pi, and of one with x < 0 that
    /// is as close to pi as it may be from either side.
    pub fn angle(self, x: Self) -> Self {
        let (y, x, _) = aligned(self, x);
        let length = libm::hypot(x.0, y.0);
        let near = libm::hypot(x.1, y.1);
        if !(near <= 0.25 * length) {
            return Ball::UNKNOWN;
        }
        let angle = libm::atan2(y.0, x.0);
        let middle = if angle < 0.0 && x.0 < 0.0 { angle + std::f64::consts::TAU } else { angle };
        // The sine of the angle between both points is the cross product over the lengths, and the arc at most 1.1 times it
        // where it is at most 1/2.
        let sine = (x.0.abs() * y.1 + y.0.abs() * x.1) / length / (length - near);
        Ball { middle, radius: (1.1 * sine + ELEMENTARY * middle.abs()) * OUTWARD, steps: 0 }.normalized()
    }

    /// The value of a function f of x >= 0 that decreases from f(0), nowhere steeper than `steepest` nor than f/(2 x): at self, if
    /// that is known well enough.
    fn falling(self, f: impl Fn(f64) -> f64, steepest: f64) -> Option<Self> {
        let (x, error) = (self.value().max(0.0), self.error());
        if !(x < 1e100 && error <= 0.5 * x.max(1e-3)) {
            return None;
        }
        let middle = f(x);
        let radius = steepest.min(middle / (x - error).max(0.0)) * error + 4.0 * ELEMENTARY * middle;
        Some(Ball { middle, radius: radius * OUTWARD, steps: 0 }.normalized())
    }

    /// asinh(z)/z by z^2 = self.
    fn asinh_over_root(self) -> Self {
        let near = self
            .falling(|x| if x < 1e-18 { 1.0 } else { libm::asinh(libm::sqrt(x)) / libm::sqrt(x) }, 1.0 / 6.0);
        near.unwrap_or_else(|| {
            // log(2 z)/z, which is as good above 2^128 or so.
            if !(self.steps >= 1 && self.middle > 4.0 * self.radius) {
                return Ball::UNKNOWN;
            }
            let root = self.sqrt();
            let log =
                libm::log(2.0 * root.middle) + root.steps as f64 * (STEP as f64 * std::f64::consts::LN_2);
            Ball::within(log, root.relative() + 4.0 * ELEMENTARY * log) / root
        })
    }

    /// The angle of the point (x, y) over y, by y^2 = self.
    fn angle_over_root(self, x: Self) -> Self {
        let near = if x > Ball::ZERO {
            let slope = (self / (x * x)).falling(
                |s| if s < 1e-18 { 1.0 } else { libm::atan(libm::sqrt(s)) / libm::sqrt(s) },
                1.0 / 3.0,
            );
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
        let exponent = (self.middle.to_bits() >> 52) & 0x7ff;
        if exponent.wrapping_sub(SMALLEST_EXPONENT) < STEP as u64 { self } else { self.stepped() }
    }

    #[cold]
    fn stepped(self) -> Self {
        let Ball { mut middle, mut radius, mut steps } = self;
        if !(middle.is_finite() && radius < f64::INFINITY) {
            return Ball::UNKNOWN;
        }
        // An operation leaves the range by one step or two.
        for _ in 0..4 {
            let size = middle.abs().max(radius);
            if size >= LARGEST && size.is_finite() {
                (middle, radius, steps) = (middle * DOWN, radius * DOWN, steps + 1);
            } else if size < LEAST && size > 0.0 {
                (middle, radius, steps) = (middle * UP, radius * UP, steps - 1);
            } else {
                break;
            }
        }
        Ball { middle, radius, steps }
    }
}

/// Middles and radii of both at the larger's steps.
#[inline(always)]
fn aligned(a: Ball, b: Ball) -> ((f64, f64), (f64, f64), i64) {
    if a.steps == b.steps { ((a.middle, a.radius), (b.middle, b.radius), a.steps) } else { shifted(a, b) }
}

#[cold]
fn shifted(a: Ball, b: Ball) -> ((f64, f64), (f64, f64), i64) {
    let (whole_a, whole_b) = ((a.middle, a.radius), (b.middle, b.radius));
    if b.is_zero() {
        return (whole_a, whole_b, a.steps);
    }
    if a.is_zero() {
        return (whole_a, whole_b, b.steps);
    }
    let down = |ball: Ball, by: i64| {
        if by < 4 {
            let power = power(-STEP * by as isize);
            (ball.middle * power, ball.radius * power)
        } else if ball.radius <= LARGEST {
            // More than it is, and far below any rounding of the other.
            (0.0, power(-3 * STEP))
        } else {
            (0.0, f64::INFINITY)
        }
    };
    if a.steps > b.steps {
        (whole_a, down(b, a.steps - b.steps), a.steps)
    } else {
        (down(a, b.steps - a.steps), whole_b, b.steps)
    }
}

impl Neg for Ball {
    type Output = Ball;

    #[inline]
    fn neg(self) -> Ball {
        Ball { middle: -self.middle, ..self }
    }
}

impl Add for Ball {
    type Output = Ball;

    #[inline]
    fn add(self, other: Ball) -> Ball {
        let (a, b, steps) = aligned(self, other);
        let middle = a.0 + b.0;
        if a.1 == 0.0 && b.1 == 0.0 && (a.0 == 0.0 || b.0 == 0.0) {
            return Ball { middle, radius: 0.0, steps };
        }
        Ball { middle, radius: (a.1 + b.1 + EPS * middle.abs()) * OUTWARD, steps }.normalized()
    }
}

impl Sub for Ball {
    type Output = Ball;

    #[inline]
    fn sub(self, other: Ball) -> Ball {
        self + -other
    }
}

impl Mul for Ball {
    type Output = Ball;

    #[inline]
    fn mul(self, other: Ball) -> Ball {
        if self.is_zero() || other.is_zero() {
            return Ball::ZERO;
        }
        let middle = self.middle * other.middle;
        let radius = self.middle.abs() * other.radius
            + self.radius * (other.middle.abs() + other.radius)
            + EPS * middle.abs();
        Ball { middle, radius: radius * OUTWARD, steps: self.steps + other.steps }.normalized()
    }
}

impl Div for Ball {
    type Output = Ball;

    #[inline]
    fn div(self, other: Ball) -> Ball {
        let least = other.middle.abs() - other.radius;
        if !(least > 0.0 && least < f64::INFINITY) {
            return Ball::UNKNOWN;
        }
        if self.is_zero() {
            return self;
        }
        let middle = self.middle / other.middle;
        let radius = (self.radius + middle.abs() * other.radius) / least + EPS * middle.abs();
        Ball { middle, radius: radius * OUTWARD, steps: self.steps - other.steps }.normalized()
    }
}

impl Shl<isize> for Ball {
    type Output = Ball;

    #[inline]
    fn shl(self, bits: isize) -> Ball {
        let by = power(bits % STEP);
        let steps = self.steps + (bits / STEP) as i64;
        Ball { middle: self.middle * by, radius: self.radius * by, steps }.normalized()
    }
}

impl Shr<isize> for Ball {
    type Output = Ball;

    #[inline]
    fn shr(self, bits: isize) -> Ball {
        self << -bits
    }
}

/// Decided only where all numbers of both balls agree.
impl PartialOrd for Ball {
    #[inline]
    fn partial_cmp(&self, other: &Ball) -> Option<Ordering> {
        let (a, b, _) = aligned(*self, *other);
        let (difference, radius) = (a.0 - b.0, (a.1 + b.1) * OUTWARD);
        if difference.abs() > radius || radius == 0.0 { difference.partial_cmp(&0.0) } else { None }
    }
}

impl PartialEq for Ball {
    #[inline]
    fn eq(&self, other: &Ball) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

macro_rules! by_reference {
    ($($operation:ident $method:ident),*) => { $(
        impl $operation<&Ball> for Ball {
            type Output = Ball;

            #[inline]
            fn $method(self, other: &Ball) -> Ball {
                $operation::$method(self, *other)
            }
        }

        impl $operation<Ball> for &Ball {
            type Output = Ball;

            #[inline]
            fn $method(self, other: Ball) -> Ball {
                $operation::$method(*self, other)
            }
        }

        impl $operation<&Ball> for &Ball {
            type Output = Ball;

            #[inline]
            fn $method(self, other: &Ball) -> Ball {
                $operation::$method(*self, *other)
            }
        }
    )* };
}

by_reference!(Add add, Sub sub, Mul mul, Div div);

impl Neg for &Ball {
    type Output = Ball;

    #[inline]
    fn neg(self) -> Ball {
        -*self
    }
}

impl Operand<Ball> for Ball {}
impl Operand<Ball> for &Ball {}

impl Number for Ball {
    fn whole(n: u8) -> Self {
        Ball::exact(n.into())
    }

    /// To its own 53.
    fn pi(_: usize) -> Self {
        Ball::rounded(std::f64::consts::PI, 1.0)
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
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numeric::big::{self, Big};

    const BITS: usize = 256;

    /// Far beyond f64's exponents.
    fn any() -> impl Strategy<Value = (Ball, Big)> {
        (-1.0..1.0f64, -2000..2000i64).prop_map(|(x, shift)| {
            let shift = shift as isize;
            (Ball::exact(x) << shift, big::rounded(&big::exact(x), BITS) << shift)
        })
    }

    fn big(ball: Ball) -> (Big, Big) {
        let shift = STEP * ball.steps as isize;
        (big::rounded(&big::exact(ball.middle), BITS) << shift, big::exact(ball.radius) << shift)
    }

    fn holds(ball: Ball, exact: &Big) -> bool {
        ball.radius == f64::INFINITY || big::abs(big(ball).0 - exact) <= big(ball).1
    }

    proptest! {
        #[test]
        fn results_are_within_the_radius((a, x) in any(), (b, y) in any(), (c, z) in any()) {
            prop_assert!(holds(a + b, &(&x + &y)));
            prop_assert!(holds(a * b, &(&x * &y)));
            // Operands that are off themselves.
            let (sum, product) = (a + b, a * b);
            let (exact_sum, exact_product) = (&x + &y, &x * &y);
            prop_assert!(holds(sum - c, &(&exact_sum - &z)));
            prop_assert!(holds(sum * product, &(&exact_sum * &exact_product)));
            if z != Big::ZERO {
                prop_assert!(holds(sum / c, &(&exact_sum / &z)));
                prop_assert!((sum / c).relative() < 1e-14 || sum.relative() > 1e-15);
            }
            prop_assert!(holds((product * product + c * c).sqrt(), &(&exact_product * &exact_product + &z * &z).sqrt()));
            prop_assert!(holds(product.hypot(c), &(&exact_product * &exact_product + &z * &z).sqrt()));
            prop_assert!(a.partial_cmp(&b) == x.partial_cmp(&y));
        }

        /// Close exponents, where angles are of any size; the crate's own functions are the independent arithmetic.
        #[test]
        fn functions_are_within_the_radius(
            y in 0.0..1.0f64,
            x in -1.0..1.0f64,
            shift in -60..60isize,
            off in 0.0..1e-3f64,
        ) {
            // Known to a part, the truth being at one end of it.
            let blurred = |v: f64| (Ball::within(v, off * v.abs()), big::rounded(&big::exact(v + off * v), BITS));
            let ((b, y), (a, x)) = (blurred(y), blurred(x));
            let (b, y) = (b << shift, y << shift);
            let pi = Big::pi(BITS);
            prop_assert!(holds(b.angle(a), &big::angle(&y, &x, &pi)));
            let (square, big_square) = (b * b, &y * &y);
            prop_assert!(holds(square.asinh_over_root(), &big::asinh_over(&big_square, BITS)));
            if y > Big::ZERO && x != Big::ZERO {
                prop_assert!(holds(square.angle_over_root(a), &(big::angle(&y, &x, &pi) / &y)));
            }
        }
    }

    #[test]
    fn what_is_unknown_stays_so() {
        let around_zero = Ball::exact(1.0) - Ball::exact(1.0) * Ball::rounded(1.0, 1.0);
        assert!(!(around_zero > Ball::ZERO) && !(around_zero <= Ball::ZERO) && around_zero != Ball::ZERO);
        assert!((Ball::ONE / around_zero).relative() == f64::INFINITY);
        assert!(Ball::exact(f64::NAN).relative() == f64::INFINITY);
        let root = around_zero.sqrt();
        assert!(root.largest() > Ball::exact(1e-9) && !(root > Ball::ZERO));
        // Whatever it meets, and however far apart.
        let unknown = Ball::ONE / around_zero;
        for other in [Ball::ZERO, Ball::ONE, Ball::ONE << 2000, Ball::ONE >> 2000, around_zero, unknown] {
            for result in [unknown + other, other - unknown, unknown.hypot(other), (unknown + other).sqrt()] {
                assert!(
                    result.relative() == f64::INFINITY && !(result < Ball::ONE << 3000),
                    "{other:?}: {result:?}"
                );
            }
            let product = unknown * other;
            assert!(other.is_zero() || product.relative() == f64::INFINITY, "{product:?}");
            assert!(((Ball::ONE + unknown) * other).sqrt().relative() == f64::INFINITY || other.is_zero());
        }
        assert!(
            Ball::up_to(unknown).relative() == f64::INFINITY && unknown.largest().relative() == f64::INFINITY
        );
        assert!(Ball::ONE.widened(unknown.radius()).relative() == f64::INFINITY);
        // A radius far beyond the middle.
        let wide = Ball::ONE + Ball::up_to(Ball::ONE << 600);
        assert!(!((Ball::ONE << 900) + wide > (Ball::ONE << 900) - (Ball::ONE << 590)));
        // Infinitely many steps of exponents hold.
        let huge = (0..40).fold(Ball::exact(3.0), |x, _| x * x);
        assert!((huge / huge - Ball::ONE).largest() < Ball::exact(1e-3), "{huge:?}");
        assert_eq!((huge.value(), (Ball::ONE / huge).value()), (f64::INFINITY, 0.0));
    }

    #[test]
    fn the_better_of_two_is_taken() {
        let (good, bad) = (Ball::rounded(1e-30, 1.0), Ball::within(0.0, 1e-20));
        assert_eq!(good.or(bad).value(), 1e-30);
        assert_eq!(bad.or(good).value(), 1e-30);
    }
}
