//! What [`super::clipped_ellipse`] computes, in as many digits as it takes.
//!
//! The cone is Minv O Minv^T for the dual quadric O of a light, both exact. Every quantity of the closed form has its own
//! formula in which nothing cancels but for grading, by which an eigenvalue may be 2^-1000 of another, and slivers above the
//! horizon. The precision grows until three results agree: what rounding decides differs between them, since what is exact is
//! first scaled by pi to that precision, and what follows from the frame has more digits than that. Powers of two and their likes
//! have long runs of zeros, which two precisions would round to the same, and differences of a few roundings are often 0 in both.

use glam::DVec3;

use super::big::{
    self, Big, STEP, Settling, Symmetric, Vector, abs, cross, dot, mapped, nearest, root, rounded, times,
    vector,
};
use super::clipped_cone::{Principal, Rim};

/// The first precision in bits, of two words with the next one that it must agree with.
const LEAST: usize = 96;
/// None begins beyond this one. Eigenvalues of f32's extremes differ by 2^2200.
const MOST: usize = 16384;
/// Digits beyond those of a frame, which show what its roundings do.
const GUARD: usize = 32;
/// What roundings take of a sum, beside what its terms lose.
const SLACK: usize = 10;

/// What must be 0 is 2^-20 of a sensitivity.
const REMAINDER: isize = 20;

/// Sensitivities of two precisions differ by no more: what both have lost may be alike to a percent.
const SAME: f64 = 1.0 / (1u64 << 20) as f64;

/// What a sensitivity may be off by.
pub const PERCENT: f64 = 0.01;

/// Enough for Newton's first steps.
const COARSE: usize = 96;

/// A light's cone after Minv.
pub struct GradedCone {
    pub minv: [DVec3; 3],
    /// The light's dual quadric, exact and at any scale: xx, yy, zz, xy, xz, yz.
    pub own: Symmetric,
    /// Any vector inside the nappe before Minv.
    pub center: DVec3,
}

/// The irradiance as a share of the full hemisphere's.
#[derive(Clone, Copy, Debug)]
pub struct Irradiance {
    pub value: f64,
    /// Absolute error bound: 1 where no precision did.
    pub bound: f64,
    /// To a percent, or the most that it may be where f32 has no digits of that.
    pub sensitivity: f64,
}

/// What other arithmetics know of it.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// The irradiance with its absolute error bound.
    pub irradiance: Option<(f64, f64)>,
    /// To a percent.
    pub sensitivity: Option<f64>,
    /// No more than so much; infinite or no number where nothing is known.
    pub most: f64,
}

impl Default for Known {
    fn default() -> Self {
        Known { irradiance: None, sensitivity: None, most: f64::INFINITY }
    }
}

impl Known {
    /// What is known of either, by `further` where not all of it is.
    pub fn or(self, further: impl FnOnce(&Self) -> Option<Self>) -> Self {
        if self.irradiance.is_some() && self.sensitivity.is_some() {
            return self;
        }
        let further = further(&self).unwrap_or_default();
        Known {
            irradiance: self.irradiance.or(further.irradiance),
            sensitivity: self.sensitivity.or(further.sensitivity),
            most: self.most.min(further.most),
        }
    }

    /// All there is to know, by `further` where this is not.
    pub fn or_else(self, further: impl FnOnce(Self) -> Irradiance) -> Irradiance {
        let most = Some(self.most).filter(|most| *most < f64::from(f32::MIN_POSITIVE));
        match (self.irradiance, self.sensitivity.or(most)) {
            (Some((value, bound)), Some(sensitivity)) => Irradiance { value, bound, sensitivity },
            _ => further(self),
        }
    }

    /// What the terms of the irradiance lose in their sum, in bits: they are of its kind, and a sensitivity is about as large as it.
    fn lost(self) -> usize {
        let size = self.irradiance.map(|(value, _)| value).or(self.sensitivity).unwrap_or(1.0);
        (-libm::log2(size.clamp(f64::MIN_POSITIVE, 1.0))) as usize
    }
}

/// The quadric after Minv, exactly.
struct Exact {
    minv: [Vector; 3],
    dual: Symmetric,
    adjugate: Symmetric,
    minus_det: Big,
    towards: Vector,
}

impl GradedCone {
    /// The irradiance on a plane with normal +z, and the sum over all inputs x of |x dE/dx|: those of Minv, and by
    /// `of_light` of dE/dO those of the light. A `known` sensitivity is taken over, and an irradiance says
    /// how many digits to begin with.
    pub fn irradiance(&self, known: Known, of_light: impl Fn(&Symmetric) -> Big) -> Irradiance {
        let dark = Irradiance { value: 0.0, bound: 0.0, sensitivity: 0.0 };
        if self.is_below() {
            return dark;
        }
        let exact = self.exact();
        if exact.minus_det <= Big::ZERO {
            return dark;
        }
        let sensitivity_of = |attempt: &Attempt| self.sensitivity(&exact, attempt, &of_light);
        let mut before: Option<Attempt> = None;
        let mut settling = Settling::default();
        let least = LEAST.max((known.lost() + STEP + SLACK).next_multiple_of(STEP));
        for bits in big::precisions(least, MOST) {
            let start = before.as_ref().map(|before| &before.framed.cone.l);
            let Some(framed) = Framed::new(&exact, bits, start) else { continue };
            let Some((value, rim)) = framed.cone.irradiance(&framed.szz, bits + GUARD) else { continue };
            if value <= Big::ZERO {
                continue;
            }
            let is_settled = settling.with(&value, bits);
            let attempt = Attempt { framed, value, rim, bits };
            if let Some(before) = before.as_ref().filter(|_| is_settled)
                && let Some(sensitivity) = known.sensitivity.or_else(|| {
                    let (finer, coarser) = (sensitivity_of(&attempt)?, sensitivity_of(before)?);
                    ((finer - coarser).abs() <= SAME * finer).then_some(finer)
                })
            {
                let value = nearest(&attempt.value);
                return Irradiance { value, bound: 0.5 * f64::EPSILON * value, sensitivity };
            }
            before = Some(attempt);
        }
        Irradiance {
            value: before.map_or(0.0, |before| nearest(&before.value)),
            bound: 1.0,
            sensitivity: f64::INFINITY,
        }
    }

    /// Whether nothing of it is above the horizon.
    fn is_below(&self) -> bool {
        let up = self.minv.map(|column| big::exact(column.z));
        dot(&up, &vector(self.center)) <= Big::ZERO && dot(&up, &times(&self.own, &up)) <= Big::ZERO
    }

    fn exact(&self) -> Exact {
        let minv = self.minv.map(vector);
        let by_own = rows_times(&minv, &self.own);
        let entry = |i: usize, j: usize| {
            &by_own[i][0] * &minv[0][j] + &by_own[i][1] * &minv[1][j] + &by_own[i][2] * &minv[2][j]
        };
        let dual = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)];
        let determinant = dot(&minv[0], &cross(&minv[1], &minv[2]));
        let [axx, _, _, axy, axz, _] = minors(&self.own);
        let own = &self.own[0] * axx + &self.own[3] * axy + &self.own[4] * axz;
        let center = vector(self.center);
        let towards = mapped(&self.minv, &center);
        let adjugate = minors(&dual);
        Exact { minv, dual, adjugate, minus_det: -(&determinant * &determinant * own), towards }
    }

    /// The sum over all inputs of |x dE/dx|; nothing where this precision does not do. An irradiance that depends on
    /// directions alone does not change with Minv's scale nor the light's: what remains of either sum of x dE/dx is rounding.
    fn sensitivity(
        &self,
        exact: &Exact,
        attempt: &Attempt,
        of_light: &impl Fn(&Symmetric) -> Big,
    ) -> Option<f64> {
        let bits = attempt.bits + GUARD;
        let gradient = &attempt.framed.gradient(&attempt.rim, bits);
        let minv = exact.minv.each_ref().map(|column| column.each_ref().map(|entry| rounded(entry, bits)));
        // Columns G m; then G M O, and M^T G M.
        let by_gradient = minv.each_ref().map(|column| times(gradient, column));
        let rows = rows_times(&by_gradient, &self.own);
        let (mut of_minv, mut of_scale) = (Big::ZERO, Big::ZERO);
        for (k, column) in minv.iter().enumerate() {
            for (row, entry) in column.iter().enumerate() {
                let change = &rows[row][k] * entry;
                of_scale += &change;
                of_minv += abs(change);
            }
        }
        let [xx, yy, zz, xy, xz, yz] =
            [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(i, j)| dot(&minv[i], &by_gradient[j]));
        let [own_xx, own_yy, own_zz, own_xy, own_xz, own_yz] = &self.own;
        let off = (&xy * own_xy + &xz * own_xz + &yz * own_yz) << 1;
        let of_length = &xx * own_xx + &yy * own_yy + &zz * own_zz + off;
        let sum = (of_minv << 1) + of_light(&[xx, yy, zz, xy, xz, yz]);
        let is_rounding = |remainder: Big| abs(remainder) << REMAINDER <= sum;
        (is_rounding(of_scale) && is_rounding(of_length)).then(|| nearest(&sum))
    }
}

/// The rows of C S for the columns of C.
fn rows_times(columns: &[Vector; 3], [xx, yy, zz, xy, xz, yz]: &Symmetric) -> [Vector; 3] {
    let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    [0, 1, 2].map(|i| {
        [0, 1, 2]
            .map(|k| rows[0][k] * &columns[0][i] + rows[1][k] * &columns[1][i] + rows[2][k] * &columns[2][i])
    })
}

/// The adjugate of a symmetric matrix.
fn minors([x, y, z, xy, xz, yz]: &Symmetric) -> Symmetric {
    [y * z - yz * yz, x * z - xz * xz, x * y - xy * xy, xz * yz - xy * z, xy * yz - xz * y, xy * xz - yz * x]
}

/// What one precision has found.
struct Attempt {
    framed: Framed,
    value: Big,
    rim: Rim<Big>,
    bits: usize,
}

/// The cone in its principal frame, and that frame: of a quadric so many times the exact one.
struct Framed {
    unit: Big,
    cone: Principal<Big>,
    szz: Big,
    axes: [Vector; 3],
}

impl Framed {
    fn new(exact: &Exact, bits: usize, start: Option<&Big>) -> Option<Self> {
        let round = |x: &Big| rounded(x, bits);
        let unit = rounded(&Big::pi(bits), 0);
        let square = &unit * &unit;
        let dual = exact.dual.each_ref().map(|entry| round(&(entry * &unit)));
        let [xx, yy, zz, xy, xz, yz] = &dual;
        let adjugate = exact.adjugate.each_ref().map(|entry| round(&(entry * &square)));
        let [axx, ayy, azz, axy, axz, ayz] = &adjugate;
        let c2 = round(&((&exact.dual[0] + &exact.dual[1] + &exact.dual[2]) * &unit));
        let c1 = round(&((&exact.adjugate[0] + &exact.adjugate[1] + &exact.adjugate[2]) * &square));
        let c0 = round(&(&exact.minus_det * &square * &unit));
        let l = match start {
            Some(root) => newton(&c2, &c1, &c0, round(root), bits),
            None => positive_root(&c2, &c1, &c0, bits),
        }?;
        let sum = &c2 + &l;
        if sum <= Big::ZERO {
            return None;
        }
        // The adjugate of S + l, (l + e1)(l + e3) W3 W3^T.
        let (diagonal, off) = (|a: &Big, s: &Big| a + (&sum - s) * &l, |a: &Big, s: &Big| a - s * &l);
        let (axx, ayy, azz) = (diagonal(axx, xx), diagonal(ayy, yy), diagonal(azz, zz));
        let (axy, axz, ayz) = (off(axy, xy), off(axz, xz), off(ayz, yz));
        let column = if axx >= ayy && axx >= azz {
            [axx, axy, axz]
        } else if ayy >= azz {
            [axy, ayy, ayz]
        } else {
            [axz, ayz, azz]
        };
        let w3 = normalized(column)?;
        let towards = exact.towards.each_ref().map(round);
        let side = dot(&w3, &towards);
        // Far from what roundings leave.
        if abs(side.clone()) << (bits / 2) as isize <= root(&dot(&towards, &towards)) {
            return None;
        }
        let w3 = if side < Big::ZERO { w3.map(|component| -component) } else { w3 };

        let size = w3.clone().map(abs);
        let least = (0..3).fold(0, |least, k| if size[k] < size[least] { k } else { least });
        let across: Vector = std::array::from_fn(|k| {
            let product = &w3[k] * &w3[least];
            if k == least { Big::ONE - product } else { -product }
        });
        let b1 = normalized(across)?;
        let b2 = cross(&w3, &b1);
        let (s1, s2) = (times(&dual, &b1), times(&dual, &b2));
        let (s11, s22, s12) = (dot(&s1, &b1), dot(&s2, &b2), dot(&s1, &b2));
        let tau = (s11 - s22) >> 1;
        let h = root(&(&tau * &tau + &s12 * &s12));
        let e1 = (sum >> 1) + &h;
        let (cos, sin) = if h == Big::ZERO {
            (Big::ONE, Big::ZERO)
        } else {
            let half = |x: &Big| root(&((Big::ONE + x / &h) >> 1));
            if tau >= Big::ZERO {
                let cos = half(&tau);
                let sin = (s12 >> 1) / (&h * &cos);
                (cos, sin)
            } else {
                let sin = half(&-&tau);
                ((s12 >> 1) / (&h * &sin), sin)
            }
        };
        let w1: Vector = std::array::from_fn(|k| &cos * &b1[k] + &sin * &b2[k]);
        let w2: Vector = std::array::from_fn(|k| &cos * &b2[k] - &sin * &b1[k]);
        let e3 = &c0 / &l / &e1;
        let e3 = if e3 > e1 { e1.clone() } else { e3 };
        let guarded = |x: &Big| rounded(x, bits + GUARD);
        let axes = [w1, w2, w3].each_ref().map(|axis| axis.each_ref().map(guarded));
        let heights = axes.each_ref().map(|axis| axis[2].clone());
        let [e1, e3, l, volume] = [e1, e3, l, c0.sqrt()].each_ref().map(guarded);
        let cone = Principal { e1, e3, l, volume, heights };
        Some(Framed { unit: guarded(&unit), szz: guarded(&dual[2]), cone, axes })
    }

    /// dE/dS of the exact one.
    fn gradient(&self, rim: &Rim<Big>, bits: usize) -> Symmetric {
        let local = self.cone.gradient(rim, bits);
        // From the principal frame to the world's.
        let world: [Vector; 3] = std::array::from_fn(|k| self.axes.each_ref().map(|axis| axis[k].clone()));
        let half = world.each_ref().map(|row| times(&local, row));
        [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(i, j)| dot(&half[i], &world[j]) * &self.unit)
    }
}

fn normalized(v: Vector) -> Option<Vector> {
    let length = root(&dot(&v, &v));
    (length > Big::ZERO).then(|| v.map(|component| component / &length))
}

/// The one positive root of l^3 + c2 l^2 + c1 l - c0, all of whose roots are real: within a few roundings, for the slope
/// there is (l + e1)(l + e3), and no term is larger than a few times that and l.
pub(super) fn positive_root(c2: &Big, c1: &Big, c0: &Big, bits: usize) -> Option<Big> {
    let all = [c2, c1, c0];
    let [c2, c1, c0] = all.map(|c| rounded(c, COARSE));
    let [c2, c1, c0] = [&c2, &c1, &c0];
    // Two upper bounds, one of which is near: Laguerre's, and the root without the cube.
    let mut l = ((root(&(c2 * c2 - c1 * Big::from(3))) << 1) - c2) / Big::from(3);
    if *c2 > Big::ZERO {
        let spread = root(&(c1 * c1 + ((c2 * c0) << 2)));
        let other = if *c1 > Big::ZERO {
            (c0.clone() << 1) / (spread + c1)
        } else {
            (spread - c1) / (c2.clone() << 1)
        };
        if l <= Big::ZERO || other < l {
            l = other;
        }
    }
    if l <= Big::ZERO {
        return None;
    }
    let l = newton(c2, c1, c0, l, COARSE)?;
    let [c2, c1, c0] = all;
    newton(c2, c1, c0, rounded(&l, bits), bits)
}

/// Newton's steps from an upper bound, where the cubic is convex, or from near the root.
fn newton(c2: &Big, c1: &Big, c0: &Big, mut l: Big, bits: usize) -> Option<Big> {
    for _ in 0..64 {
        let value = ((&l + c2) * &l + c1) * &l - c0;
        let slope = (&l * Big::from(3) + (c2.clone() << 1)) * &l + c1;
        if slope <= Big::ZERO {
            return None;
        }
        let step = value / slope;
        // The next one would be this one's square.
        let last = abs(step.clone()) << (bits / 2 + 4) as isize <= l;
        l = if step < l { l - step } else { l >> 1 };
        if last {
            return Some(l);
        }
    }
    None
}

/// What the families' tests have compared of f64's results with those here.
#[cfg(test)]
#[derive(Default)]
pub struct Agreement {
    compared: usize,
    worst: f64,
}

#[cfg(test)]
impl Agreement {
    /// A configuration that is not looked at from within; `jumps` are of its sensitivity.
    pub fn add(&mut self, value: f64, sensitivity: f64, jumps: f64, exact: Irradiance, row: &[f32]) {
        if exact.value == 0.0 {
            return assert!(value <= 1e-322, "{row:?}: {value:e}");
        }
        // The bound that more precision is asked for at.
        // And what f64 has no digits of.
        let off = (value - exact.value).abs();
        assert!(off <= 1.5e-11 * exact.value + 1e-322, "{row:?}: {value:e} {exact:?}");
        assert!(exact.bound <= 1e-15 * exact.value, "{row:?}: {exact:?}");
        // Of what f32 has no digits of, a bound.
        if sensitivity < f64::from(f32::MIN_POSITIVE) {
            assert!(sensitivity >= 0.99 * exact.sensitivity, "{row:?}: {sensitivity} {exact:?}");
        } else if jumps <= 1e9 * exact.sensitivity {
            // What the subtraction leaves of the digits.
            self.worst = self.worst.max(((sensitivity - jumps) / exact.sensitivity - 1.0).abs());
        }
        self.compared += 1;
    }

    /// Enough of them agreed; of sensitivities a percent is promised.
    pub fn check(self, scenario: &str) {
        let Agreement { compared, worst } = self;
        assert!(worst < 0.01 && compared > 100, "{scenario}: {worst} of {compared}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of radius r straight above at 1 under a Minv that stretches z by s: (r/s)^2/(1 + (r/s)^2), and of every
    /// height what scale leaves of it.
    #[test]
    fn circles_of_any_size_are_their_sine_squared() {
        for exponent in [-300, -120, -10, 0, 7, 100, 400] {
            let s = libm::ldexp(1.0, exponent);
            let own = [1.0, 1.0, -1.0, 0.0, 0.0, 0.0].map(big::exact);
            let minv = [DVec3::X, DVec3::Y, s * DVec3::Z];
            let found =
                GradedCone { minv, own, center: DVec3::Z }.irradiance(Known::default(), |_| Big::ZERO);
            let expected = 1.0 / (1.0 + s * s);
            assert!((found.value - expected).abs() <= 2e-16 * expected, "{s}: {found:?} {expected}");
            // dE/d ln x_k of three entries: -E^2 s^2 for z, and half of its opposite for x and y each.
            let sensitivity = 4.0 * expected * (s * s * expected);
            assert!(
                (found.sensitivity - sensitivity).abs() <= 1e-12 * sensitivity,
                "{s}: {found:?} {sensitivity}"
            );
        }
    }

    #[test]
    fn dark_and_flat_cones_give_nothing() {
        let dark = |own: [f64; 6], center: DVec3| {
            let minv = [DVec3::X, DVec3::Y, DVec3::Z];
            GradedCone { minv, own: own.map(big::exact), center }
                .irradiance(Known::default(), |_| Big::ZERO)
                .value
        };
        assert_eq!(dark([1.0, 1.0, -1.0, 0.0, 0.0, 0.0], -DVec3::Z), 0.0);
        assert_eq!(dark([1.0, 0.0, -1.0, 0.0, 0.0, 0.0], DVec3::Z), 0.0);
        // Touching the horizon from below.
        assert_eq!(dark([-3.0, 1.0, 0.0, 0.0, 2.0, 0.0], DVec3::new(2.0, 0.0, -1.0)), 0.0);
    }
}
