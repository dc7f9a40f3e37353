//! What the Vulkan specification permits a device's f32 operations to return, as intervals.
//!
//! Source: "Precision and Operation of SPIR-V Instructions" in the SPIR-V environment appendix of the Vulkan 1.3
//! specification. An operation is given the interval in which its operands lie and returns that of its permitted
//! results, so that an operation *inherited from* a formula is that formula over these functions. "Correctly rounded"
//! means either neighbour of the exact result (no rounding mode is promised), and the exact result where it is an f32;
//! `n` ULP means `n` times [`f32_spacing`], the smaller of two at a power of two. Where the specification promises
//! nothing the interval is [`Interval::ALL`].
//!
//! The ends are worked out in f64, so they are off by parts in 2^50: a device that errs by all that is permitted, and
//! not by one f32 more, is told apart from one that errs by more.

use super::exact::two_sum;
use super::spacing::f32_spacing;

const SMALLEST_NORMAL: f64 = f32::MIN_POSITIVE as f64;
/// The end of the divisors for which the precision of a quotient is promised, 2^126; the other is its reciprocal.
const LARGEST_DIVISOR: f64 = 4.0 / SMALLEST_NORMAL / 4.0;

/// The numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub low: f64,
    pub high: f64,
}

impl Interval {
    /// Anything at all, NaN included.
    pub const ALL: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// One value.
    pub const fn of(value: f64) -> Self {
        Interval { low: value, high: value }
    }

    /// The specification's E: how far from `exact` a result may be if its formula permits this interval.
    pub fn reach(self, exact: f64) -> f64 {
        let reach = (exact - self.low).abs().max((self.high - exact).abs());
        if reach.is_nan() { f64::INFINITY } else { reach }
    }

    fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Widened by `ulp` units in the last place of each end, and to zero from where a subnormal result may be flushed.
    fn within_ulp(self, ulp: f64) -> Self {
        Interval {
            low: self.low - ulp * f32_spacing(self.low),
            high: self.high + ulp * f32_spacing(self.high),
        }
        .flushed()
    }

    fn within(self, absolute: f64) -> Self {
        Interval { low: self.low - absolute, high: self.high + absolute }
    }

    fn flushed(self) -> Self {
        let low = if self.low > 0.0 && self.low < SMALLEST_NORMAL { 0.0 } else { self.low };
        let high = if self.high < 0.0 && self.high > -SMALLEST_NORMAL { 0.0 } else { self.high };
        Interval { low, high }
    }

    /// Both ends rounded to f32, outwards; an end that overflows leaves nothing promised. `rest` says which way the exact
    /// ends lie from those given in f64.
    fn rounded(self, rest: [f64; 2]) -> Self {
        let (down, up) = (round_down(self.low, rest[0]), round_up(self.high, rest[1]));
        if down.is_finite() && up.is_finite() {
            Interval { low: f64::from(down), high: f64::from(up) }.flushed()
        } else {
            Interval::ALL
        }
    }

    /// The images of both ends under a function that grows (or falls) throughout.
    fn monotone(self, function: impl Fn(f64) -> f64) -> Self {
        let (a, b) = (function(self.low), function(self.high));
        Interval { low: a.min(b), high: a.max(b) }
    }
}

/// The largest f32 that is not above `value + rest`, where `rest` is below f64's last place.
fn round_down(value: f64, rest: f64) -> f32 {
    let nearest = value as f32;
    let above = f64::from(nearest) > value || (f64::from(nearest) == value && rest < 0.0);
    if above { nearest.next_down() } else { nearest }
}

fn round_up(value: f64, rest: f64) -> f32 {
    -round_down(-value, -rest)
}

/// `a + b`: correctly rounded.
pub fn sum(a: Interval, b: Interval) -> Interval {
    if !a.is_finite() || !b.is_finite() {
        return Interval::ALL;
    }
    // A sum that f64 rounds to an f32 is not that f32, and both its neighbours are permitted.
    let (low, below) = two_sum(a.low, b.low);
    let (high, above) = two_sum(a.high, b.high);
    Interval { low, high }.rounded([below, above])
}

/// `a b`: correctly rounded.
pub fn product(a: Interval, b: Interval) -> Interval {
    if !a.is_finite() || !b.is_finite() {
        return Interval::ALL;
    }
    let corners = [a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high];
    let low = corners.into_iter().fold(f64::INFINITY, f64::min);
    let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
    Interval { low, high }.rounded([0.0; 2])
}

/// `a / b`: 2.5 ULP, for divisors whose magnitude is in 2^-126..2^126.
pub fn quotient(a: Interval, b: Interval) -> Interval {
    let magnitudes = if b.low > 0.0 { (b.low, b.high) } else { (-b.high, -b.low) };
    if !(magnitudes.0 >= SMALLEST_NORMAL && magnitudes.1 <= LARGEST_DIVISOR && a.is_finite()) {
        return Interval::ALL;
    }
    let corners = [a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high];
    let low = corners.into_iter().fold(f64::INFINITY, f64::min);
    let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
    Interval { low, high }.within_ulp(2.5)
}

/// `inversesqrt(x)`: 2 ULP; undefined from 0 downwards.
pub fn inverse_sqrt(x: Interval) -> Interval {
    if !(x.low > 0.0 && x.high.is_finite()) {
        return Interval::ALL;
    }
    x.monotone(|x| 1.0 / libm::sqrt(x)).within_ulp(2.0)
}

/// `sqrt(x)`: as `1 / inversesqrt(x)`, so that nothing is promised at 0, whose inverse root is infinite.
pub fn sqrt(x: Interval) -> Interval {
    quotient(Interval::of(1.0), inverse_sqrt(x))
}

/// `exp(x)`: 3 + 2 |x| ULP.
pub fn exp(x: Interval) -> Interval {
    exponential(x, libm::exp)
}

/// `exp2(x)`: 3 + 2 |x| ULP.
pub fn exp2(x: Interval) -> Interval {
    exponential(x, libm::exp2)
}

fn exponential(x: Interval, function: fn(f64) -> f64) -> Interval {
    if !x.is_finite() {
        return Interval::ALL;
    }
    let end = |x: f64, sign: f64| {
        let value = function(x);
        value + sign * (3.0 + 2.0 * x.abs()) * f32_spacing(value)
    };
    Interval { low: end(x.low, -1.0), high: end(x.high, 1.0) }.flushed()
}

/// `log(x)`: 3 ULP, or less than 2^-21 for x in 0.5..2; undefined from 0 downwards.
pub fn log(x: f64) -> Interval {
    logarithm(x, libm::log)
}

/// `log2(x)`: as [`log`].
pub fn log2(x: f64) -> Interval {
    logarithm(x, libm::log2)
}

fn logarithm(x: f64, function: fn(f64) -> f64) -> Interval {
    if !(x > 0.0 && x.is_finite()) {
        return Interval::ALL;
    }
    let value = Interval::of(function(x));
    if (0.5..=2.0).contains(&x) { value.within(1.0 / 2_097_152.0) } else { value.within_ulp(3.0) }
}

/// `sin(x)`: 2^-11 for x in -pi..pi.
pub fn sin(x: f64) -> Interval {
    circular(x, libm::sin(x))
}

/// `cos(x)`: as [`sin`].
pub fn cos(x: f64) -> Interval {
    circular(x, libm::cos(x))
}

fn circular(x: f64, value: f64) -> Interval {
    if x.abs() <= std::f64::consts::PI { Interval::of(value).within(1.0 / 2048.0) } else { Interval::ALL }
}

/// `atan(x)`: 4096 ULP.
pub fn atan(x: f64) -> Interval {
    Interval::of(libm::atan(x)).within_ulp(4096.0)
}

/// `atan2(y, x)`: 4096 ULP; undefined at the origin. `y` or `x` is one value, and `y` does not straddle 0.
pub fn atan2(y: Interval, x: Interval) -> Interval {
    if !y.is_finite() || !x.is_finite() || (y == Interval::of(0.0) && x == y) {
        return Interval::ALL;
    }
    let (a, b) = (libm::atan2(y.low, x.low), libm::atan2(y.high, x.high));
    Interval { low: a.min(b), high: a.max(b) }.within_ulp(4096.0)
}

/// `dot(v, v)`: as the sum of the squares, in any order.
pub fn dot(v: [f64; 3]) -> Interval {
    let [a, b, c] = v.map(|c| product(Interval::of(c), Interval::of(c)));
    let orders = [sum(sum(a, b), c), sum(sum(b, c), a), sum(sum(c, a), b)];
    orders
        .into_iter()
        .fold(orders[0], |all, one| Interval { low: all.low.min(one.low), high: all.high.max(one.high) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ULP_ABOVE_ONE: f64 = f32::EPSILON as f64;

    #[test]
    fn the_table_s_own_numbers() {
        // exp(1) = 2.718..: five units of 2^-22.
        assert!(
            (exp(Interval::of(1.0)).reach(libm::exp(1.0)) / (5.0 * 2.0 * ULP_ABOVE_ONE) - 1.0).abs() < 1e-8
        );
        // exp2(3) = 8 exactly: nine units of the spacing below 8.
        assert_eq!(exp2(Interval::of(3.0)).reach(8.0), 9.0 * 4.0 * ULP_ABOVE_ONE);
        assert_eq!(log2(1.5).reach(libm::log2(1.5)), 2f64.powi(-21));
        assert_eq!(log2(4.0).reach(2.0), 3.0 * ULP_ABOVE_ONE);
        // The smaller spacing at a power of two.
        assert_eq!(inverse_sqrt(Interval::of(0.25)).reach(2.0), 2.0 * ULP_ABOVE_ONE);
        assert_eq!(quotient(Interval::of(3.0), Interval::of(2.0)).reach(1.5), 2.5 * ULP_ABOVE_ONE);
        assert_eq!(sin(3.0).reach(libm::sin(3.0)), 2f64.powi(-11));
    }

    #[test]
    fn where_nothing_is_promised() {
        for nothing in [
            sqrt(Interval::of(0.0)),
            sqrt(Interval::of(-1.0)),
            log(0.0),
            log2(-1.0),
            // f32's pi is above pi.
            sin(f64::from(std::f32::consts::PI)),
            quotient(Interval::of(1.0), Interval { low: -1.0, high: 1.0 }),
            quotient(Interval::of(1.0), Interval::of(1.5 * LARGEST_DIVISOR)),
            product(Interval::of(1e30), Interval::of(1e30)),
            atan2(Interval::of(0.0), Interval::of(0.0)),
        ] {
            assert_eq!(nothing.reach(0.5), f64::INFINITY, "{nothing:?}");
        }
        assert_eq!(LARGEST_DIVISOR, 2f64.powi(126));
    }

    /// 1 - x^2 just below 1: x^2 may round either way, so the difference is one or two spacings below 1, and its root
    /// off by a factor of sqrt(2).
    #[test]
    fn a_formula_permits_what_its_worst_roundings_give() {
        let x = f64::from(1f32.next_down());
        let difference = sum(Interval::of(1.0), product(Interval::of(-x), Interval::of(x)));
        assert_eq!(difference, Interval { low: 2f64.powi(-24), high: 2f64.powi(-23) });
        let root = sqrt(difference);
        assert!((root.high / root.low / std::f64::consts::SQRT_2 - 1.0).abs() < 2e-6, "{root:?}");
    }

    #[test]
    fn exact_results_are_promised_exactly() {
        assert_eq!(product(Interval::of(1.5), Interval::of(-2.0)), Interval::of(-3.0));
        assert_eq!(sum(Interval::of(1.5), Interval::of(-2.0)), Interval::of(-0.5));
        assert_eq!(dot([3.0, 4.0, 0.0]), Interval::of(25.0));
        // In f64 this sum is 1.
        let above = sum(Interval::of(1.0), Interval::of(1e-30));
        assert_eq!(above, Interval { low: 1.0, high: 1.0 + ULP_ABOVE_ONE });
        let tenth = f64::from(0.1f32);
        let square = product(Interval::of(tenth), Interval::of(tenth));
        assert_eq!(square.high - square.low, f32_spacing(tenth * tenth));
    }

    /// A result among the subnormals may be flushed to zero.
    #[test]
    fn flushing_is_permitted() {
        let tiny = product(Interval::of(1e-20), Interval::of(1e-20));
        assert_eq!(tiny.low, 0.0);
        assert_eq!(exp2(Interval::of(-130.0)).low, 0.0);
    }
}
