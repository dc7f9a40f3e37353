//! Floating point of any precision and any exponent, and the elementary functions that cones need of it.
//!
//! [`Big`] is dashu-float's binary number. It carries its precision: exact numbers give exact sums and products, and what
//! is made of numbers of some precision has the larger of theirs. The crate's own inverse functions are correctly rounded
//! at 50 times the time of these, which are good to a few units of the last place.

use dashu_float::FBig;

use super::clipped_cone::{Number, Operand};

pub type Big = FBig;

/// A vector.
pub type Vector = [Big; 3];

/// The upper triangle xx, yy, zz, xy, xz, yz of a symmetric matrix.
pub type Symmetric = [Big; 6];

/// Halvings of an argument before its series, which then has 2^-5 or less.
const HALVINGS: usize = 5;

/// This very number, and exact arithmetic with its like.
pub fn exact(x: f64) -> Big {
    Big::try_from(x).expect("a finite number").with_precision(0).value()
}

/// These very numbers.
pub fn vector(v: glam::DVec3) -> Vector {
    v.to_array().map(exact)
}

/// This number to `bits`.
pub fn rounded(x: &Big, bits: usize) -> Big {
    x.clone().with_precision(bits).value()
}

/// The nearest f64, which may be 0 or infinite.
pub fn nearest(x: &Big) -> f64 {
    x.to_f64().value()
}

/// |x|.
pub fn abs(x: Big) -> Big {
    if x < Big::ZERO { -x } else { x }
}

/// From one precision to one that it must agree with: what the coarser one has to be good to.
pub const STEP: usize = 32;

/// Precisions in bits: three that may agree, and then from twice as many.
pub fn precisions(least: usize, most: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(least), |bits| Some(2 * bits))
        .take_while(move |bits| *bits <= most)
        .flat_map(|bits| [bits, bits + STEP, bits + 2 * STEP])
}

/// Whether results of growing precision have settled: three in a row agree. A coarser one may be right by luck, and the finer one then
/// is no better than it looks.
#[derive(Default)]
pub struct Settling {
    before: Option<(Big, usize)>,
    agreed: u32,
}

impl Settling {
    /// Whether they have with this one, of so many bits.
    pub fn with(&mut self, value: &Big, bits: usize) -> bool {
        let agrees = |(before, fewer): &(Big, usize)| agree(value, before, bits - fewer);
        self.agreed = if self.before.as_ref().is_some_and(agrees) { self.agreed + 1 } else { 0 };
        self.before = Some((value.clone(), bits));
        self.agreed >= 2
    }
}

/// Whether a result and one of `fewer` bits less agree so far that the finer is good to 2^-60: what rounding leaves of it is
/// 2^-`fewer` of what it leaves of the other. Less than 2^-32 may be chance.
fn agree(finer: &Big, coarser: &Big, fewer: usize) -> bool {
    let bits = 60usize.saturating_sub(fewer).max(32);
    abs(finer - coarser) << bits as isize <= abs(finer.clone())
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

/// m v for columns of m, exactly if v is exact.
pub fn mapped(m: &[glam::DVec3; 3], [x, y, z]: &Vector) -> Vector {
    let [a, b, c] = m.map(vector);
    [0, 1, 2].map(|row| &a[row] * x + &b[row] * y + &c[row] * z)
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
        half /= ((one.clone() + cosh) << 1).sqrt();
        halvings += 1;
    }
    let t2 = &half * &half / (&one + &half * &half);
    let t = t2.sqrt();
    ((t * series(&t2, bits)) << halvings) / s
}

/// 1 + x/3 + x^2/5 + ... for |x| <= 2^-9, to `bits`: atanh(t)/t of t^2, atan(t)/t of -t^2.
fn series(x: &Big, bits: usize) -> Big {
    let fixed = |x: &Big| (x.clone() << bits as isize).to_int().value();
    let step = fixed(x);
    let mut power = fixed(&Big::ONE);
    let mut sum = power.clone();
    // Every term is 9 bits smaller.
    for k in 1..=bits / 9 + 2 {
        power = (power * &step) >> bits;
        sum += &power / (2 * k + 1);
    }
    rounded(&(Big::from_parts(sum, -(bits as isize))), bits)
}

impl Operand<Big> for Big {}
impl Operand<Big> for &Big {}

impl Number for Big {
    fn whole(n: u8) -> Self {
        Big::from(n)
    }

    fn pi(bits: usize) -> Self {
        Big::pi(bits)
    }

    fn root(&self) -> Self {
        root(self)
    }

    fn angle(&self, x: &Self, pi: &Self) -> Self {
        angle(self, x, pi)
    }

    fn angle_over(&self, x: &Self, pi: &Self) -> Self {
        let y = root(self);
        if y == Big::ZERO { Big::ONE / x } else { angle(&y, x, pi) / y }
    }

    fn better(self, _: Self) -> Self {
        self
    }

    fn asinh_over(&self, bits: usize) -> Self {
        asinh_over(self, bits)
    }

    fn negligible(_: isize, bits: usize) -> isize {
        bits as isize
    }

    fn without(self, _: &Self) -> Self {
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: &Big, b: &Big, bits: isize) {
        assert!(abs(a - b) << bits <= abs(b.clone()), "{a} for {b}");
    }

    /// The crate's own functions are the independent arithmetic.
    #[test]
    fn functions_agree_with_correctly_rounded_ones() {
        for bits in [256, 512] {
            let pi = Big::pi(bits);
            for (y, x) in [(1.0, 1.0), (1e-30, 1.0), (0.3, -2.0), (5.0, 1e-3), (5.0, -1e-20), (2.0, 0.0)] {
                let (y, x) = (rounded(&exact(y), bits), rounded(&exact(x), bits));
                close(&angle(&y, &x, &pi), &y.atan2(&x), bits as isize - 8);
            }
            for z in [1e-200, 1e-3, 0.5, 3.0, 1e100] {
                let z = rounded(&exact(z), bits);
                close(&asinh_over(&(&z * &z), bits), &(z.asinh() / &z), bits as isize - 8);
            }
            assert_eq!(asinh_over(&Big::ZERO, bits), Big::ONE);
        }
    }
}
