//! The irradiance of the part of an elliptic cone above the horizon, and its gradient, as integrals of what is positive.
//!
//! They take the place of the closed forms of [`super::clipped_ellipse`] and [`super::clipped_cone`] where those cancel: far
//! lights and slivers. The rim is p(u) = (sqrt(e1) cos u, sqrt(e3) sin u, sqrt(l)), of height swing (cos(u - u0) - cos d). Lines
//! parallel to the horizon end on the rim at u0 - t and u0 + t, and the light's area is that of those with t in 0..d.

use std::f64::consts::{FRAC_PI_2, PI};

use super::gauss_legendre::{POINTS_4, POINTS_8, POINTS_16, visit};
use super::spacing::EPS;

/// Cosine and sine of an angle, neither of which has lost its digits by the other.
pub type Turn = (f64, f64);

/// The ellipse that a cone is, above the horizon.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Eigenvalues, e1 >= e3, of -l. e3 or l is 0 where it is as good as that beside the others.
    pub e1: f64,
    pub e3: f64,
    pub l: f64,
    /// u0 and d.
    pub middle: Turn,
    pub half: Turn,
    /// u0 - d and u0 + d, where the rim crosses the horizon.
    pub ends: [Turn; 2],
    /// How far off in absolute terms the angles may be: u0, d, and the ends.
    pub off: (f64, f64, [f64; 2]),
}

/// An integral, and how far off it may be by what quadrature and the angles' errors make of it.
pub type Integral = (f64, f64);

/// A line from which others are told, so that all that is near it is known relatively.
#[derive(Clone, Copy)]
struct Anchor {
    /// Its angle t, as such and less than d, and how far off the latter may be beside where the poles are.
    at: f64,
    gap: f64,
    gap_off: f64,
    line: Turn,
    /// Its ends on the rim, at u0 - t and u0 + t.
    points: [Turn; 2],
    /// How far off the angles of ends and line may be.
    off: [f64; 3],
}

/// A singularity at x +- i y from an anchor, and at all x + k pi: |x| <= pi/2. How far off x may be.
#[derive(Clone, Copy)]
struct Pole {
    x: f64,
    y: f64,
    off: f64,
}

/// A line: its height over the horizon in units of the rim's swing, the angle t, and its ends.
struct Line {
    height: f64,
    turn: Turn,
    points: [Turn; 2],
}

impl Segment {
    /// The irradiance as a share of the full hemisphere's, over sqrt(e1 e3 l) swing/pi. Nothing where poles are closer to the segment
    /// than f64 tells angles apart.
    ///
    /// Lines in closed form, across them by Gauss's rule.
    pub fn irradiance(&self) -> Option<Integral> {
        let &Segment { e1, e3, l, middle: (cos0, sin0), .. } = self;
        let along = self.along();
        let sum = self.integrate(|line| {
            let ((cos, sin), [first, second]) = (line.turn, line.points);
            // |p|^2 = (s^2 + delta)/along with s linear along the line.
            let delta = l * along + cos * cos * e1 * e3;
            let place = |(cos, sin): Turn| e3 * cos0 * sin - e1 * sin0 * cos;
            let square = |(cos, sin): Turn| along * (l + e1 * cos * cos + e3 * sin * sin);
            let (s1, s2) = (place(first), place(second));
            let (q1, q2) = (square(first), square(second));
            let root = libm::sqrt(delta);
            let width = 2.0 * along * sin;
            // With the angles phi1, phi2 of its ends from its foot, and theta between them, the line has
            // (theta + sin theta cos(phi1 + phi2))/(2 delta^(3/2)); a cosine below 0 is -1 and a square.
            let theta = libm::atan2(root * width, delta + s1 * s2);
            let sum = if s1 * s2 <= delta {
                theta + root * width / q1 * ((delta - s1 * s2) / q2)
            } else {
                let cosines = libm::sqrt(delta / q1) + libm::sqrt(delta / q2);
                arc_over_chord(theta) + libm::tan(0.5 * theta) * cosines * cosines
            };
            [line.height * sin * along / (2.0 * delta * root) * sum]
        });
        sum.map(|[sum]| sum)
    }

    /// The integrals of h/|p|^4 along the visible rim, h in units of the swing, times cos^2, sin^2, 1, cos sin, cos and sin of u.
    /// Where those have signs, errors are those of what has none.
    pub fn rim(&self) -> Option<[Integral; 6]> {
        let &Segment { e1, e3, l, .. } = self;
        let sums = self.integrate(|line| {
            let [first, second] = line.points.map(|(cos, sin)| {
                let q = l + e1 * cos * cos + e3 * sin * sin;
                let by = line.height / (q * q);
                [by * cos * cos, by * sin * sin, by, by * cos * sin, by * cos, by * sin]
            });
            // What has a sign is known as its size is; and it is 0 at the pole's foot, where the rest is not.
            let sum = |i: usize| first[i] + second[i];
            let size = |i: usize| first[i].abs() + second[i].abs();
            [sum(0), sum(1), sum(2), sum(3), sum(4), sum(5), size(3), size(4), size(5)]
        })?;
        Some(std::array::from_fn(|i| (sums[i].0, if i < 3 { sums[i].1 } else { sums[i + 3].1 })))
    }

    /// The square of half the longest line.
    pub fn along(&self) -> f64 {
        let &Segment { e1, e3, middle: (cos0, sin0), .. } = self;
        e1 * sin0 * sin0 + e3 * cos0 * cos0
    }

    /// Integrals over t in 0..d of what may be singular where a line or the rim passes through the apex, with their errors.
    fn integrate<const N: usize>(&self, f: impl Fn(Line) -> [f64; N]) -> Option<[Integral; N]> {
        let &Segment { e1, e3, l, half, .. } = self;
        let d = libm::atan2(half.1, half.0);
        // Complex angles at which the rim's and the lines' squares vanish.
        let rim = libm::asinh(libm::sqrt((l + e3) / (e1 - e3).max(0.0)));
        let lines = libm::asinh(libm::sqrt(l * self.along() / (e1 * e3)));
        let anchors = self.anchors(d, rim, lines);
        let mut panels = Panels(Vec::with_capacity(32));
        for (low, high) in anchors.iter().zip(&anchors[1..]) {
            let end = 0.5
                * if low.at == 0.0 {
                    high.at
                } else if high.gap == 0.0 {
                    low.gap
                } else {
                    let (cos, sin) = low.turn_to(high);
                    libm::atan2(sin, cos)
                };
            for (anchor, by) in [(low, 1.0), (high, -1.0)] {
                let ([x0, x1, x2], [off0, off1, off2]) = (anchor.poles(by), anchor.off);
                let poles = [
                    Pole { x: x0, y: rim, off: off0 },
                    Pole { x: x1, y: rim, off: off1 },
                    Pole { x: x2, y: lines, off: off2 },
                ];
                // The height is that of the rest to d.
                let height_off = |low: f64, high: f64| {
                    let rest = anchor.gap - by * if by > 0.0 { high } else { low };
                    if anchor.gap_off > 0.0 { anchor.gap_off / rest } else { 0.0 }
                };
                let (above, below) = (libm::sincos(0.5 * (d + anchor.at)), libm::sincos(0.5 * anchor.gap));
                let side = Side { anchor, by, above, below };
                panels.graded((0.0, end), &poles, &height_off, side)?;
            }
        }
        Some(panels.integrals(f))
    }

    /// The first line and the last, and between them those that narrow poles are at.
    fn anchors(&self, d: f64, rim: f64, lines: f64) -> Vec<Anchor> {
        let &Segment { middle, half, ends, off, .. } = self;
        let top = Anchor {
            at: 0.0,
            gap: d,
            gap_off: 0.0,
            line: (1.0, 0.0),
            points: [middle, middle],
            off: [off.0, off.0, 0.0],
        };
        let bottom = Anchor {
            at: d,
            gap: 0.0,
            gap_off: 0.0,
            line: half,
            points: ends,
            off: [off.2[0], off.2[1], off.1],
        };
        if !(rim < NARROW || lines < NARROW) {
            return vec![top, bottom];
        }
        // Where a point is in the plane of the axis or the line is through the middle, all of the line is known by u0.
        let (cos0, sin0) = middle;
        let side = if cos0 < 0.0 { -1.0 } else { 1.0 };
        let twice = (side * 2.0 * sin0 * cos0, side * (cos0 - sin0) * (cos0 + sin0));
        let within = [
            ((-side * sin0, side * cos0), [(0.0, -side), (-twice.0, twice.1)], [0.0, 2.0, 1.0]),
            ((side * sin0, side * cos0), [(twice.0, -twice.1), (0.0, side)], [2.0, 0.0, 1.0]),
            ((0.0, 1.0), [(sin0, -cos0), (-sin0, cos0)], [1.0, 1.0, 0.0]),
        ];
        let from_above = |x: f64| if x < 0.0 { x + PI } else { x };
        let (down, up) = (top.poles(1.0).map(from_above), bottom.poles(-1.0).map(from_above));
        let mut anchors = vec![top];
        for (k, (line, points, times)) in within.into_iter().enumerate() {
            let is_narrow = if k == 2 { lines < NARROW } else { rim < NARROW };
            // By the end that is nearer.
            let place = if down[k] > 0.0 && down[k] <= 0.5 * d {
                Some((down[k], d - down[k], off.0 + off.1 + 4.0 * EPS))
            } else if up[k] > 0.0 && up[k] <= 0.5 * d {
                Some((d - up[k], up[k], bottom.off[k]))
            } else {
                None
            };
            if let (true, Some((at, gap, gap_off))) = (is_narrow, place) {
                let off = times.map(|times| times * off.0);
                anchors.push(Anchor { at, gap, gap_off, line, points, off });
            }
        }
        anchors[1..].sort_by(|a, b| 0.0f64.total_cmp(&a.turn_to(b).1));
        anchors.push(bottom);
        anchors
    }
}

impl Anchor {
    /// Cosine and sine of the angle from this line to another.
    fn turn_to(&self, other: &Anchor) -> Turn {
        let ((cos, sin), (to_cos, to_sin)) = (self.line, other.line);
        (cos * to_cos + sin * to_sin, cos * to_sin - sin * to_cos)
    }

    /// How far from here, up or down by the sign of `by`, the ends are in the plane of the axis, where their cosine is 0, and the line
    /// is through the middle.
    fn poles(&self, by: f64) -> [f64; 3] {
        let [first, second] = self.points;
        [(first, -by), (second, by), (self.line, by)].map(|((cos, sin), moves)| half_turn(moves * cos, sin))
    }
}

/// Lines from an anchor on, up or down by the sign of `by`.
#[derive(Clone, Copy)]
struct Side<'a> {
    anchor: &'a Anchor,
    by: f64,
    /// Sines and cosines of half the sum and half the difference of d and the anchor's angle.
    above: (f64, f64),
    below: (f64, f64),
}

impl Side<'_> {
    /// The line that is `t` from the anchor. It is no nearer to d than half of what the anchor is, so that heights keep their digits.
    fn line_at(&self, t: f64) -> Line {
        let Side { anchor, by, above, below } = *self;
        let (sin, cos) = libm::sincos(0.5 * t);
        let turn = (2.0 * sin * cos, 1.0 - 2.0 * sin * sin);
        Line {
            height: 2.0 * (above.0 * cos + by * above.1 * sin) * (below.0 * cos - by * below.1 * sin),
            turn: turned(anchor.line, turn, by),
            points: [turned(anchor.points[0], turn, -by), turned(anchor.points[1], turn, by)],
        }
    }
}

/// The angle's cosine and sine after a turn with that (sine, cosine), forth or back.
fn turned((cos, sin): Turn, (sin_t, cos_t): (f64, f64), by: f64) -> Turn {
    (cos * cos_t - by * sin * sin_t, sin * cos_t + by * cos * sin_t)
}

/// x - sin x for x in 0..pi/2, to a few roundings: below 1/2 by its series, whose next term is 2^-58 of the sum.
fn arc_over_chord(x: f64) -> f64 {
    if x > 0.5 {
        return x - libm::sin(x);
    }
    let square = x * x;
    let mut sum = 1.0;
    for k in (2..=7).rev() {
        let k = f64::from(k);
        sum = 1.0 - sum * square / (2.0 * k * (2.0 * k + 1.0));
    }
    x * square / 6.0 * sum
}

/// The angle of (x, y) or of (-x, -y), in -pi/2..pi/2.
fn half_turn(y: f64, x: f64) -> f64 {
    if x < 0.0 { libm::atan2(-y, -x) } else { libm::atan2(y, x) }
}

/// Panels of an integral: three poles at 2^-120 off the real axis take as many, and more are for an arithmetic that does not know
/// f64's angles.
const MOST: usize = 3 * 2 * 120;

/// Poles that are so near the real axis are anchors: f64's angles tell others to 2^-44 of their distance.
const NARROW: f64 = 1.0 / (1u64 << 8) as f64;

/// A panel is far from a pole that is so many half lengths from its ends together: on the ellipse of semi-axes' sum rho = 3.3, or
/// beyond.
const FAR: f64 = 3.6;

/// The highest order of a pole, at which it amplifies what is off.
const ORDER: f64 = 4.0;

/// Gauss's rules of n points, and more than they are off by where such a pole is on that ellipse: the first term of the error's
/// expansion, (2 n)^3/6 rho^(-2 n), is a fifth to a third of these. Roundings are little beside them.
const RULES: [(&[(f64, f64)], f64); 3] = [
    (&POINTS_4, 1.0 / (1u64 << 5) as f64),
    (&POINTS_8, 1.0 / (1u64 << 16) as f64),
    (&POINTS_16, 1.0 / (1u64 << 41) as f64),
];

/// What a panel may be off by beside the whole.
const SHARE: f64 = 1.0 / (1u64 << 45) as f64;

/// The most that an integrand may be off by.
const LOST: f64 = 0.01;

/// A part of a side, far from every pole, and what its integrand may be off by.
struct Panel<'a> {
    side: Side<'a>,
    low: f64,
    high: f64,
    off: f64,
}

impl Panel<'_> {
    /// Integrals by a rule, and of absolute values.
    fn integrals<const N: usize>(
        &self,
        points: &[(f64, f64)],
        f: &impl Fn(Line) -> [f64; N],
    ) -> [Integral; N] {
        let mut sums = [(0.0, 0.0); N];
        visit(points, self.low, self.high, |t, weight| {
            for ((sum, size), term) in sums.iter_mut().zip(f(self.side.line_at(t))) {
                *sum += weight * term;
                *size += weight * term.abs();
            }
        });
        sums
    }
}

struct Panels<'a>(Vec<Panel<'a>>);

impl<'a> Panels<'a> {
    /// Adds low..high of a side, graded towards the poles, where lines are singular and nowhere else: its ends are within 0..pi.
    /// Nothing where a panel is not known.
    ///
    /// What angles are off by counts by the pole's distance from the panel; `unknown` is what else a panel's integrand may be off
    /// by.
    fn graded(
        &mut self,
        (low, high): (f64, f64),
        poles: &[Pole; 3],
        unknown: &impl Fn(f64, f64) -> f64,
        side: Side<'a>,
    ) -> Option<()> {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let mut off = unknown(low, high);
        let mut near: Option<f64> = None;
        for &Pole { x, y, off: of_pole } in poles {
            let x = if middle - x > FRAC_PI_2 { x + PI } else { x };
            // y is no less than 2^-500, or as good as 0.
            let from = |end: f64| libm::sqrt((x - end) * (x - end) + y * y);
            let distance = from(low) + from(high);
            if !(distance >= FAR * half) {
                near = Some((x - middle) / half);
            } else {
                off += ORDER * (of_pole + 4.0 * EPS * high) / (0.5 * distance - half);
            }
        }
        let Some(place) = near else {
            // A pole that may be elsewhere leaves its own part out.
            let is_known = off <= LOST && self.0.len() < MOST;
            self.0.push(Panel { side, low, high, off });
            return is_known.then_some(());
        };
        // 0.3 of it where the pole is near an end, half where it is not.
        let cut = if place < -0.5 {
            low + 0.6 * half
        } else if place > 0.5 {
            high - 0.6 * half
        } else {
            middle
        };
        // Two lines that f64 does not tell apart.
        if !(low < cut && cut < high) {
            return None;
        }
        self.graded((low, cut), poles, unknown, side)?;
        self.graded((cut, high), poles, unknown, side)
    }

    /// The integrals with their errors. Most panels are next to nothing beside the largest.
    fn integrals<const N: usize>(&self, f: impl Fn(Line) -> [f64; N]) -> [Integral; N] {
        let coarse: Vec<[Integral; N]> = self.0.iter().map(|panel| panel.integrals(RULES[0].0, &f)).collect();
        let all: [f64; N] = std::array::from_fn(|k| coarse.iter().map(|sums| sums[k].1).sum());
        let mut integrals = [(0.0, 0.0); N];
        for (panel, coarse) in self.0.iter().zip(coarse) {
            let is_enough = |off: f64| (0..N).all(|k| off * coarse[k].1 <= SHARE * all[k]);
            let at = RULES[..2].iter().position(|rule| is_enough(rule.1)).unwrap_or(2);
            let (points, rule_off) = RULES[at];
            let sums = if at == 0 { coarse } else { panel.integrals(points, &f) };
            for ((sum, error), (part, size)) in integrals.iter_mut().zip(sums) {
                *sum += part;
                *error += size * (panel.off + rule_off);
            }
        }
        integrals
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numeric::big::{self, Big};
    use crate::numeric::clipped_cone::Principal;

    /// As many as the closed form's terms may cancel to, and their halves.
    const BITS: usize = 3000;

    /// A segment by e1, e3 over l and the squares of up, across and middle over l, and the closed form's irradiance over
    /// sqrt(e1 e3 l) swing/pi and gradient over swing/2pi, in units of l.
    fn exactly(e1: f64, e3: f64, [up, across, middle]: [f64; 3]) -> Option<(Segment, f64, [f64; 6])> {
        let digits = |x: f64| big::rounded(&big::exact(x), BITS);
        let (e1, e3) = (digits(e1), digits(e3));
        let (up, across, middle) = (digits(up), digits(across), digits(middle));
        let szz = &up * &up + &across * &across - &middle * &middle;
        if szz <= Big::ZERO {
            return None;
        }
        let swing = big::root(&(&up * &up + &across * &across));
        // Heights that are no unit vector's are of the same cone seen from a light's place, all scaled alike.
        let (a, b) = (big::root(&e1), big::root(&e3));
        let heights = [&up / &a, &across / &b, middle.clone()];
        let length =
            big::root(&(&heights[0] * &heights[0] + &heights[1] * &heights[1] + &heights[2] * &heights[2]));
        let heights = heights.map(|height| height / &length);
        let szz = szz / &length / &length;
        let l = digits(1.0);
        let volume = big::root(&(&e1 * &e3));
        let cone = Principal { e1: e1.clone(), e3: e3.clone(), l, volume: volume.clone(), heights };
        let (value, rim) = cone.irradiance(&szz, BITS)?;
        let gradient = cone.gradient(&rim, BITS);
        let pi = Big::pi(BITS);
        let unit = &swing / &length / pi;
        let value = value / &volume / &unit;
        let by = [&b / &a, &a / &b, &a * &b, digits(1.0), -&b, -&a];
        let rim = std::array::from_fn(|i| big::nearest(&((gradient[i].clone() << 1) / &by[i] / &unit)));

        let [cos0, sin0, cos_d] = [&up, &across, &-middle].map(|x| x / &swing);
        let sin_d = big::root(&(szz * &length * &length)) / &swing;
        let turn = |cos: Big, sin: Big| (big::nearest(&cos), big::nearest(&sin));
        let segment = Segment {
            e1: big::nearest(&e1),
            e3: big::nearest(&e3),
            l: 1.0,
            middle: turn(cos0.clone(), sin0.clone()),
            half: turn(cos_d.clone(), sin_d.clone()),
            ends: [
                turn(&cos0 * &cos_d + &sin0 * &sin_d, &sin0 * &cos_d - &cos0 * &sin_d),
                turn(&cos0 * &cos_d - &sin0 * &sin_d, &sin0 * &cos_d + &cos0 * &sin_d),
            ],
            off: (0.0, 0.0, [0.0; 2]),
        };
        // Cosines and sines are rounded.
        let off = |(cos, sin): Turn| 2.0 * EPS * (cos * sin).abs();
        let segment =
            Segment { off: (off(segment.middle), off(segment.half), segment.ends.map(off)), ..segment };
        Some((segment, big::nearest(&value), rim))
    }

    proptest! {
        /// Needles, slivers, flat cones and any between, against the closed form in thousands of digits.
        #[test]
        fn integrals_are_the_closed_forms(
            e1 in -120.0..120.0f64,
            slim in 0.01..200.0f64,
            up in -100.0..0.0f64,
            across in -100.0..0.0f64,
            middle in -100.0..0.0f64,
            signs in 0..8u8,
        ) {
            let sign = |k: u8| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
            let heights = [sign(0) * up.exp2(), sign(1) * across.exp2(), sign(2) * middle.exp2()];
            let Some((segment, value, rim)) = exactly(e1.exp2(), (e1 - slim).exp2(), heights) else {
                return Ok(());
            };
            if let Some((found, error)) = segment.irradiance() {
                prop_assert!((found - value).abs() <= error, "{segment:?}: {found:e} {error:e} {value:e}");
            }
            if let Some(found) = segment.rim() {
                for ((found, error), expected) in found.into_iter().zip(rim) {
                    prop_assert!((found - expected).abs() <= error, "{segment:?}: {found:e} {error:e} {expected:e}");
                }
            }
        }
    }

    /// The pole of the rim is so near to the middle of the range that nothing but an anchor at it tells it from the angles about it.
    #[test]
    fn poles_within_are_anchors() {
        for heights in [[0.6, 0.8, 0.1], [0.6, -0.8, 0.1], [0.6, 0.8, -0.3], [0.99, 0.1, 0.5]] {
            let (segment, value, _) = exactly(2f64.powi(120), 2f64.powi(-60), heights).unwrap();
            let (found, error) = segment.irradiance().unwrap();
            assert!(
                error <= 1e-12 * value && (found - value).abs() <= error,
                "{segment:?}: {found:e} {error:e} {value:e}"
            );
        }
    }
}
