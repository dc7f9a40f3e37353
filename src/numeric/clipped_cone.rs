//! The irradiance of an elliptic cone's part above the horizon from its principal frame, in any arithmetic.
//!
//! The closed form of [`super::clipped_ellipse`], where every quantity has its own formula in which nothing cancels but for
//! slivers above the horizon, so that results are as good as eigenvalues and heights are, however the cone is graded.
//!
//! The gradient is G = (sqrt(e1 e3 l)/2pi) times the integral of p.z n n^T/|p|^4 over the visible u, with the tangent planes'
//! normals n = (cos u/sqrt(e1), sin u/sqrt(e3), -1/sqrt(l)) in the principal frame. With h = p.z, q = |p|^2 = A cos^2 u +
//! B sin^2 u, k = A - B and Ic, Is, I1 the integrals of cos, sin and 1 over q, integration by parts leaves of the ends, where h is
//! 0, the difference of h' alone, -2 sqrt(S_zz):
//!
//! ```text
//! 2 A k int h cos^2/q^2 = (A + k) h1 Ic + A h2 Is + k h3 I1 - 2 sqrt(S_zz)      h = h1 cos u + h2 sin u + h3
//! 2 B k int h sin^2/q^2 = (k - B) h2 Is - B h1 Ic + k h3 I1 + 2 sqrt(S_zz)
//! ```
//!
//! The last diagonal entry makes tr(G S) = 0: a scale changes nothing. Entries off the diagonal are what turns about the axes do,
//! which change the heights alone, and to first order nothing but them: 2 pi dE = dW1.z Ix + dW2.z Iy + dW3.z Iz.
//!
//! What is small or far has other forms: irradiances of narrow cones are that of a segment in the tangent plane, and gradients
//! where all of the rim is as long (q is constant: round cones, and every narrow one) those of a circle's arc.

use std::ops::{Add, Div, Mul, Neg, Shl, Shr, Sub};

/// A cone whose squared tangents are this power of 1/2 has one cosine, to the accuracy asked of values.
const NARROW: isize = 38;

/// A rim is even where its squared lengths differ by this power of 1/2, to the accuracy asked of gradients.
const EVEN: isize = 17;

/// What stands on either side of an operator.
pub trait Operand<T>:
    Sized
    + Neg<Output = T>
    + Add<T, Output = T>
    + Sub<T, Output = T>
    + Mul<T, Output = T>
    + Div<T, Output = T>
    + for<'b> Add<&'b T, Output = T>
    + for<'b> Sub<&'b T, Output = T>
    + for<'b> Mul<&'b T, Output = T>
    + for<'b> Div<&'b T, Output = T>
{
}

/// An arithmetic. A comparison that it cannot decide is not true.
pub trait Number:
    Clone + PartialOrd + Operand<Self> + Shl<isize, Output = Self> + Shr<isize, Output = Self>
{
    fn whole(n: u8) -> Self;

    /// Pi to `bits`.
    fn pi(bits: usize) -> Self;

    /// The root of what is positive but for roundings.
    fn root(&self) -> Self;

    /// The angle of the point (`x`, self), self >= 0 but for roundings, in 0..=pi, which `pi` is.
    fn angle(&self, x: &Self, pi: &Self) -> Self;

    /// That angle over the ordinate, by its square: 1/x for 0.
    fn angle_over(&self, x: &Self, pi: &Self) -> Self;

    /// Of two results for one number that which is known better, if that is known.
    fn better(self, other: Self) -> Self;

    /// asinh(z)/z by z^2, to `bits`.
    fn asinh_over(&self, bits: usize) -> Self;

    /// The power of 1/2 that may be left out beside 1 where `wanted` will do: more, if nobody tells what was.
    fn negligible(wanted: isize, bits: usize) -> isize;

    /// This, of which `share` was left out, or less.
    fn without(self, share: &Self) -> Self;
}

/// Eigenvalues e1 >= e3 > 0 > -l of the dual quadric, sqrt(e1 e3 l), and the heights of the axes W1, W2, W3.
#[derive(Clone, Copy, Debug)]
pub struct Principal<T> {
    pub e1: T,
    pub e3: T,
    pub l: T,
    pub volume: T,
    pub heights: [T; 3],
}

/// The visible rim: the integrals over q of cos, sin and 1 along it.
pub struct Rim<T> {
    of_cos: T,
    of_sin: T,
    of_one: T,
    part: Part<T>,
}

/// How much of the rim is visible.
enum Part<T> {
    All,
    /// 2 `sqrt(S_zz)`.
    Cut(T),
    /// Of an even rim, for which differences by k have no digits: cosines and sines of u0 and of d, and what
    /// share of it k is.
    CutEven([T; 2], [T; 2], T),
}

impl<T: Number> Principal<T>
where
    for<'a> &'a T: Operand<T>,
{
    /// The irradiance as a share of the full hemisphere's, which may be all rounding; `szz` is S_zz. Nothing where its sign is not
    /// known, nor where no angle is.
    pub fn irradiance(&self, szz: &T, bits: usize) -> Option<(T, Rim<T>)> {
        let Principal { e1, e3, l, volume, heights: [z1, z2, z3] } = self;
        let (a, b, c) = (e1.root(), e3.root(), l.root());
        let (big, small, k) = (l + e1, l + e3, e1 - e3);
        let mean = (&big * &small).root();
        let pi = T::pi(bits);
        let tau = pi.clone() << 1;
        let zero = T::whole(0);
        if *szz <= zero {
            let value = &a * &b / &mean * z3;
            let rim = Rim { of_cos: zero.clone(), of_sin: zero.clone(), of_one: tau / mean, part: Part::All };
            return Some((value, rim));
        }
        if !(*szz > zero) {
            return None;
        }
        // Squares of heights, and those of the rim.
        let (w1, w2, w3) = (z1 * z1, z2 * z2, z3 * z3);
        let (m1, m2, m3) = (e1 * &w1, e3 * &w2, l * &w3);
        let m = (szz + &m3).better(&m1 + &m2);
        let twice = szz.root() << 1;
        // The crossings' angle; as S_zz = m1 + m2 - m3, the ordinates are one, and the one with the smaller terms is better.
        let u = -((l * &big * &small).root() * z3 * &twice);
        let v = [
            &m3 * (&big + &small) - &m1 * &small - &m2 * &big,
            &m3 * &big - szz * &small - &m2 * &k,
            &m3 * &small - szz * &big + &m1 * &k,
        ];
        let v = v.into_iter().reduce(T::better).expect("three");
        let turn = if u < zero { &tau - (-&u).angle(&v, &pi) } else { u.angle(&v, &pi) };
        let (square, level) = (&u * &u + &v * &v, &m1 + &m2);
        if square == zero || level == zero {
            return None;
        }
        let of_log = ((szz * &big * &k * &m1 / &square) << 2).asinh_over(bits) / square.root();
        let x = l * (&m + &k * &w3) + e3 * (&m - &k * &w2);
        let of_angle = ((szz * &small * &k * &m2) << 2).angle_over(&x, &pi);
        let of_one = turn / mean;
        let (of_cos, of_sin) = (z1 * &a * &twice * of_log, z2 * &b * &twice * of_angle);
        let whole = || {
            let plane = &m3 * (e1 + e3) + &m1 * (l - e3) + &m2 * (l - e1);
            let dphi = (volume * &twice).angle(&plane, &pi);
            let contour = &a * &b * z3 * &of_one - &b * &c * z1 * &of_cos - &a * &c * z2 * &of_sin;
            (contour + dphi) / &tau
        };
        // e1 - e3 is known to no more than half of the digits where the cone is narrow.
        let even = k.clone() << T::negligible(EVEN, bits / 2) <= big;
        let (value, part) = if even {
            let (level, swing) = (level.root(), m.root());
            let half = [-(z3 * &c) / &swing, szz.root() / &swing];
            let [cos_d, sin_d] = &half;
            // Narrow cones are even, too.
            let value = if e1.clone() << T::negligible(NARROW, bits) <= *l {
                // A segment of the ellipse in the tangent plane, where no cosine is another than the height's: the integral of
                // p - cos d over p > cos d in the unit disk.
                let bow = ((sin_d * sin_d * sin_d) << 1) / T::whole(3);
                let segment = bow - cos_d * (sin_d.angle(cos_d, &pi) - cos_d * sin_d);
                (&a * &b * swing * segment / (&pi * l * &c)).without(&((e1.clone() << 1) / l))
            } else {
                whole()
            };
            let share = (k << 2) / &big;
            (value, Part::CutEven([z1 * &a / &level, z2 * &b / level], half, share))
        } else {
            (whole(), Part::Cut(twice.clone()))
        };
        Some((value, Rim { of_cos, of_sin, of_one, part }))
    }

    /// dE/dS in the frame of the axes: xx, yy, zz, xy, xz, yz.
    pub fn gradient(&self, rim: &Rim<T>, bits: usize) -> [T; 6] {
        let Principal { e1, e3, l, volume, heights: [z1, z2, z3] } = self;
        let Rim { of_cos, of_sin, of_one, part } = rim;
        let (a, b, c) = (e1.root(), e3.root(), l.root());
        let (up, across, middle) = (z1 * &a, z2 * &b, z3 * &c);
        let (big, small, k) = (l + e1, l + e3, e1 - e3);
        let two_tau = T::pi(bits) << 2;
        let [ix, iy, iz] = [-(&b * &c * of_cos), -(&a * &c * of_sin), &a * &b * of_one];
        // e1 and e3 times the first two.
        let half = volume / &two_tau;
        let one = &middle * of_one;
        let (xx, yy, xy) = match part {
            Part::All => (one.clone() / &big, one / &small, T::whole(0)),
            Part::Cut(twice) => {
                let (x, y) = (up * of_cos, across * of_sin);
                let of_big = (&x * (&big + &k) + &y * &big - twice) / &k + &one;
                let of_small = (y * (&k - &small) - x * &small + twice) / &k + one;
                (of_big / &big, of_small / &small, (z2 * &ix - z1 * &iy) / (&two_tau * k))
            }
            Part::CutEven([cos0, sin0], [cos_d, sin_d], share) => {
                // Towards u0 and across it, where q is the same all around.
                let swing = (&up * &up + &across * &across).root();
                let area = &big * &big;
                let known = |term: T| term.without(share);
                let (turn, chord) = (known(one * &big), known((middle * sin_d * cos_d) << 1));
                let third = known((&swing * sin_d * sin_d * sin_d / T::whole(3)) << 2);
                let along = (known((swing * sin_d) << 2) - &third + &turn + &chord) / &area;
                let aside = (third + turn - chord) / area;
                let xy = cos0 * sin0 * (&along - &aside) * &half / (&a * &b);
                let (cos2, sin2) = (cos0 * cos0, sin0 * sin0);
                (&cos2 * &along + &sin2 * &aside, sin2 * along + cos2 * aside, xy)
            }
        };
        let (xx, yy) = (xx * &half, yy * half);
        let zz = (&xx + &yy) / l;
        // Turns about an axis change the heights alone.
        let (xz, yz) = ((z3 * ix - z1 * &iz) / (&two_tau * big), (z3 * iy - z2 * iz) / (two_tau * small));
        [xx / e1, yy / e3, zz, xy, xz, yz]
    }
}
