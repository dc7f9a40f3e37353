//! Solid angle of the directions whose orthographic image lies in an axis-aligned rectangle: the area of the hemisphere
//! z >= 0 of the unit sphere over the part of the rectangle inside the unit circle.
//!
//! Cut along the axes, a rectangle is up to four of which each lies in one quadrant. Over each of those the region is
//! bounded by arcs of small circles x = c, y = c and of the horizon. It is the geodesic polygon of its corners and, for
//! each side, the segment between the small circle's arc and the great circle's:
//!
//! ```text
//! tan(Omega/2) = [a, b, c]/(1 + a.b + b.c + c.a)            a triangle (van Oosterom & Strackee 1983), a, b, c unit vectors
//! S(c, T) = 2 (atan(c T) - c atan T)                        a segment: T is the tangent of a quarter of the arc's azimuths
//! ```
//!
//! Determinants come from differences of neighbouring corners, all of one sign once z0 - z1 is written as
//! (x1^2 - x0^2)/(z0 + z1), so triangles do not cancel; segments are added on the near sides and subtracted on the far
//! ones, which costs what the rectangle is longer than wide. Beyond a limit everything is worked again in twice the digits.

use super::double_double::{DoubleDouble, Real};
use super::spacing::f32_spacing;

/// Roundings in a term: of its corner heights, determinant and angle. Observed and not proved: thin pixels across the
/// circle's rim were seen to take 56.
const ROUNDINGS: f64 = 128.0;

/// A solid angle in steradians, with its absolute error bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipped {
    pub value: f64,
    pub bound: f64,
    pub escalated: bool,
    /// How fast the value grows with the rectangle's left, low, right and high sides moving outwards: the arcs' azimuths. A
    /// side that lies on an axis has 0.
    pub densities: [f64; 4],
}

/// The relative error that more precision is taken for: 5.8e-11, well beyond what certifying an f32 takes.
const ACCURACY: f64 = 1.0 / (1u64 << 34) as f64;

/// The part of the rectangle between (`x0`, `y0`) and (`x1`, `y1`) inside the unit circle; the corners in any order, of f32
/// values or others whose squares are exact in f64 (otherwise as if they were rounded by 2^-53).
pub fn clipped(x0: f64, y0: f64, x1: f64, y1: f64) -> Clipped {
    let (x, y) = ([x0.min(x1), x0.max(x1)], [y0.min(y1), y0.max(y1)]);
    let first = whole::<f64>(x, y);
    if first.bound <= (ACCURACY * first.value).max(f32_spacing(0.0) / 32.0) {
        return first;
    }
    let second = whole::<DoubleDouble>(x, y);
    Clipped { escalated: true, ..second }
}

fn whole<R: Real>(x: [f64; 2], y: [f64; 2]) -> Clipped {
    let (mut value, mut terms, mut densities) = (R::from(0.0), 0.0, [0.0; 4]);
    for (mirrored_x, [left, right]) in halves(x).into_iter().enumerate() {
        for (mirrored_y, [low, high]) in halves(y).into_iter().enumerate() {
            let Some(part) = in_quadrant::<R>([left, right], [low, high]) else { continue };
            value = value + part.value;
            terms += part.terms;
            // What is the near side in the mirror image is the far one of the rectangle; a cut is none.
            let [near_x, near_y, far_x, far_y] = part.azimuths;
            densities[2 * mirrored_x] += if left > 0.0 { near_x } else { 0.0 };
            densities[1 + 2 * mirrored_y] += if low > 0.0 { near_y } else { 0.0 };
            densities[2 - 2 * mirrored_x] += far_x;
            densities[3 - 2 * mirrored_y] += far_y;
        }
    }
    let bound = ROUNDINGS * R::ROUNDOFF * terms + f64::EPSILON * value.to_f64().abs();
    Clipped { value: value.to_f64().clamp(0.0, core::f64::consts::TAU), bound, escalated: false, densities }
}

/// The parts of an interval on either side of zero, by distance from it, the nearer end first.
fn halves([low, high]: [f64; 2]) -> [[f64; 2]; 2] {
    [[low.max(0.0), high.max(0.0)], [-high.min(0.0), -low.min(0.0)]]
}

struct Part<R> {
    value: R,
    /// Sum of the terms' sizes.
    terms: f64,
    /// Of the left, low, right and high sides' arcs, about the axes across them.
    azimuths: [f64; 4],
}

/// A corner of the region, relative to the nearest one: (x - x0, y - y0, z0 - z), all non-negative; and z.
#[derive(Clone, Copy)]
struct Corner<R> {
    over: R,
    up: R,
    down: R,
    z: R,
}

fn in_quadrant<R: Real>([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Option<Part<R>> {
    if !(x1 > x0 && y1 > y0) {
        return None;
    }
    let one = R::from(1.0);
    let [rx0, rx1, ry0, ry1] = [x0, x1, y0, y1].map(R::from);
    // 1 - x^2 - y^2 is exact but for its last rounding.
    let inside = |x: f64, y: f64| remainder::<R>(x, y);
    let z2 = inside(x0, y0);
    if !(z2.to_f64() > 0.0) {
        return None;
    }
    let (z2_right, z2_top, z2_far) = (inside(x1, y0), inside(x0, y1), inside(x1, y1));
    let z = z2.sqrt();
    let (width, height) = (rx1 - rx0, ry1 - ry0);
    // Radii of the four small circles.
    let radius = |c: f64| ((one - R::from(c)) * (one + R::from(c))).sqrt();
    let (has_right, has_top) = (z2_right.to_f64() > 0.0, z2_top.to_f64() > 0.0);

    // Along the lower side to its end, inside or on the horizon; up the right side; likewise the other way round.
    let (end_low, z_low) = if has_right {
        let z_right = z2_right.sqrt();
        (width, z_right)
    } else {
        (z2 / (radius(y0) + rx0), R::from(0.0))
    };
    let (end_left, z_left) = if has_top {
        let z_top = z2_top.sqrt();
        (height, z_top)
    } else {
        (z2 / (radius(x0) + ry0), R::from(0.0))
    };
    let fall =
        |from: R, to: R, dx: R, dy: R, x: R, y: R| (dx * (x + x + dx) + dy * (y + y + dy)) / (from + to);
    let zero = R::from(0.0);
    let low = Corner { over: end_low, up: zero, down: fall(z, z_low, end_low, zero, rx0, ry0), z: z_low };
    let left =
        Corner { over: zero, up: end_left, down: fall(z, z_left, zero, end_left, rx0, ry0), z: z_left };

    let mut sum = Sum { value: zero, terms: 0.0 };
    let mut azimuths = [0.0; 4];
    let nearest = [rx0, ry0, z];
    azimuths[1] = sum.segment(1.0, y0, [rx0, rx0 + end_low], end_low, [z, z_low]);
    azimuths[0] = sum.segment(1.0, x0, [ry0, ry0 + end_left], end_left, [z, z_left]);
    if z2_far.to_f64() > 0.0 {
        let z_far = z2_far.sqrt();
        let far = Corner { over: width, up: height, down: fall(z, z_far, width, height, rx0, ry0), z: z_far };
        // Steps from the corner on the lower side up, and from the far one to the left.
        let rise = fall(z_low, z_far, zero, height, rx1, ry0);
        sum.triangle(nearest, low, far, [height * low.down, width * rise, width * height]);
        let back = fall(z_left, z_far, width, zero, rx0, ry1);
        sum.triangle(nearest, far, left, [height * back, width * left.down, width * height]);
        azimuths[2] = sum.segment(-1.0, x1, [ry0, ry1], height, [z_low, z_far]);
        azimuths[3] = sum.segment(-1.0, y1, [rx0, rx1], width, [z_left, z_far]);
        return Some(Part { value: sum.value, terms: sum.terms, azimuths });
    }

    // The horizon cuts the far corner off, between `first` and `second`.
    let mut first = low;
    if has_right {
        let end = z2_right / (radius(x1) + ry0);
        first = Corner { over: width, up: end, down: z, z: zero };
        sum.triangle(nearest, low, first, [end * low.down, width * z_low, width * end]);
        azimuths[2] = sum.segment(-1.0, x1, [ry0, ry0 + end], end, [z_low, zero]);
    }
    let mut second = left;
    if has_top {
        let end = z2_top / (radius(y1) + rx0);
        second = Corner { over: end, up: height, down: z, z: zero };
        azimuths[3] = sum.segment(-1.0, y1, [rx0, rx0 + end], end, [z_left, zero]);
    }
    // Both on the horizon: how far back, and up, it is from one to the other.
    let beyond = zero - z2_far;
    let back = match (has_right, has_top) {
        (true, true) => beyond / (rx1 + radius(y1)),
        (true, false) => width,
        (false, true) => height * (ry0 + ry1) / (radius(y0) + radius(y1)),
        (false, false) => end_low,
    };
    let rise = match (has_right, has_top) {
        (true, true) => beyond / (ry1 + radius(x1)),
        (true, false) => width * (rx0 + rx1) / (radius(x0) + radius(x1)),
        (false, true) => height,
        (false, false) => end_left,
    };
    sum.triangle(nearest, first, second, [z * rise, z * back, first.over * rise + first.up * back]);
    if has_top {
        let end = second.over;
        sum.triangle(nearest, second, left, [height * z_left, end * left.down, height * end]);
    }
    Some(Part { value: sum.value, terms: sum.terms, azimuths })
}

/// 1 - x^2 - y^2, rounded once for squares that are exact in f64.
fn remainder<R: Real>(x: f64, y: f64) -> R {
    let (rx, ry) = (R::from(x), R::from(y));
    let direct = (R::from(1.0) - rx * rx) - ry * ry;
    if R::ROUNDOFF > 1e-20 { R::from(super::exact::sum(&[1.0, -(x * x), -(y * y)])) } else { direct }
}

struct Sum<R> {
    value: R,
    terms: f64,
}

impl<R: Real> Sum<R> {
    /// The triangle of the corner `nearest`, `u` and `v`, from (u - nearest) x (v - u), whose components are all non-negative.
    fn triangle(&mut self, nearest: [R; 3], u: Corner<R>, v: Corner<R>, normal: [R; 3]) {
        let [x, y, z] = nearest;
        let determinant = x * normal[0] + y * normal[1] + z * normal[2];
        let dot =
            |a: Corner<R>, b: Corner<R>| (x + a.over) * (x + b.over) + (y + a.up) * (y + b.up) + a.z * b.z;
        let start = Corner { over: R::from(0.0), up: R::from(0.0), down: R::from(0.0), z };
        let denominator = R::from(1.0) + dot(start, u) + dot(u, v) + dot(v, start);
        let half = determinant.atan2(denominator);
        self.value = self.value + (half + half);
        self.terms += 2.0 * half.to_f64();
    }

    /// `sign` times the segment on the small circle at distance `c`, where the other coordinate goes from `ends[0]` by `step`
    /// to `ends[1]` and the height from `heights[0]` to `heights[1]`. Returns the arc's azimuth.
    fn segment(&mut self, sign: f64, c: f64, ends: [R; 2], step: R, heights: [R; 2]) -> f64 {
        let one = R::from(1.0);
        let rc = R::from(c);
        let square = (one - rc) * (one + rc);
        let across = ends[1] * heights[0] + ends[0] * heights[1];
        let along = square + ends[0] * ends[1] + heights[0] * heights[1];
        let tangent = square * step * (ends[0] + ends[1]) / across / along;
        let value = segment(c, tangent);
        self.value = self.value + R::from(sign) * value;
        self.terms += value.to_f64().abs();
        2.0 * tangent.atan2(one).to_f64()
    }
}

/// S(c, T) for 0 <= c < 1, 0 <= T <= 1.
fn segment<R: Real>(c: f64, tangent: R) -> R {
    let (one, rc) = (R::from(1.0), R::from(c));
    if tangent.to_f64() < 0.25 {
        // 2 c (1 - c^2) sum of (-1)^(k+1) T^(2k+1)/(2k+1) (1 + c^2 + .. + c^(2k-2)).
        let (square, c2) = (tangent * tangent, rc * rc);
        let (mut power, mut geometric, mut sum) = (tangent * square, one, R::from(0.0));
        for k in 1..40 {
            let term = power * geometric / R::from(f64::from(2 * k + 1));
            sum = sum + term;
            if term.to_f64().abs() <= 0.25 * R::ROUNDOFF * sum.to_f64() {
                break;
            }
            power = R::from(0.0) - power * square;
            geometric = geometric * c2 + one;
        }
        return R::from(2.0) * rc * ((one - rc) * (one + rc)) * sum;
    }
    let half = if c < 0.5 {
        (rc * tangent).atan2(one) - rc * tangent.atan2(one)
    } else {
        let rest = one - rc;
        rest * tangent.atan2(one) - (rest * tangent).atan2(one + rc * tangent * tangent)
    };
    half + half
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI, TAU};
    use proptest::prelude::*;

    fn solid_angle(x0: f64, y0: f64, x1: f64, y1: f64) -> f64 {
        let clipped = clipped(x0, y0, x1, y1);
        assert!(clipped.bound <= f32_spacing(clipped.value) / 16.0, "{clipped:?}");
        clipped.value
    }

    /// The area over 0..x, 0..y in closed form, the rectangle's far corner inside the circle or not; off by 1e-15.
    fn corner(x: f64, y: f64) -> f64 {
        let (x, y) = (x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0));
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        y * x.atan2(z) + x * y.atan2(z) - (x * y).atan2(z)
    }

    fn by_corners(x0: f64, y0: f64, x1: f64, y1: f64) -> f64 {
        corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
    }

    #[test]
    fn known_regions() {
        assert!((solid_angle(-1.0, -1.0, 1.0, 1.0) - TAU).abs() < 1e-14);
        assert!((solid_angle(0.0, 0.0, 3.0, -2.0) - FRAC_PI_2).abs() < 1e-14);
        // A zone's half: Archimedes.
        assert!((solid_angle(0.25, -1.0, 0.5, 1.0) / (PI * 0.25) - 1.0).abs() < 1e-13);
        assert!((solid_angle(0.75, -1.0, 2.0, 1.0) / (PI * 0.25) - 1.0).abs() < 1e-13);
        assert_eq!(solid_angle(0.75, 0.75, 1.0, 1.0), 0.0);
        assert_eq!(solid_angle(0.25, 0.5, 0.25, 1.0), 0.0);
        assert_eq!(solid_angle(1.0, 0.0, 2.0, 1.0), 0.0);
    }

    /// The square of f32 coordinates is exact; rounding others would move the circle.
    fn short(v: f64) -> f64 {
        f64::from(v as f32)
    }

    proptest! {
        #[test]
        fn is_the_difference_of_corners(x in -1.2..1.2f64, y in -1.2..1.2f64, w in 1e-3..2.0f64, h in 1e-3..2.0f64) {
            let [x0, y0, x1, y1] = [x, y, x + w, y + h].map(short);
            let (value, expected) = (solid_angle(x0, y0, x1, y1), by_corners(x0, y0, x1, y1));
            prop_assert!((value - expected).abs() <= 2e-14, "{value} {expected}");
        }

        /// Sub-pixels add up to their pixel relatively, which a difference of corners does not show.
        #[test]
        fn parts_add_up(x in -1.0..1.0f64, y in -1.0..1.0f64, side in -20.0..0.0f64) {
            let side = side.exp2();
            let [x0, y0, x1, y1] = [x, y, x + side, y + 0.75 * side].map(short);
            let middle = short(x0 + 0.3 * (x1 - x0));
            let whole = solid_angle(x0, y0, x1, y1);
            let parts = solid_angle(x0, y0, middle, y1) + solid_angle(middle, y0, x1, y1);
            prop_assert!((whole - parts).abs() <= 1e-11 * whole, "{whole} {parts}");
        }

        #[test]
        fn both_precisions_agree(x in -1.0..1.0f64, y in -1.0..1.0f64, w in -18.0..0.5f64, h in -18.0..0.5f64) {
            let [x0, y0, x1, y1] = [x, y, x + w.exp2(), y + h.exp2()].map(short);
            let (one, two) = (whole::<f64>([x0, x1], [y0, y1]), whole::<DoubleDouble>([x0, x1], [y0, y1]));
            prop_assert!((one.value - two.value).abs() <= one.bound, "{one:?} {two:?}");
        }

        #[test]
        fn densities_are_slopes(x in -0.7..0.5f64, y in -0.7..0.5f64, w in 0.05..0.2f64, h in 0.05..0.2f64) {
            let [x0, y0, x1, y1] = [x, y, x + w, y + h].map(short);
            let step = f64::from(2f32.powi(-20));
            let sides = clipped(x0, y0, x1, y1).densities;
            let grown = [
                by_corners(x0 - step, y0, x0 + step, y1),
                by_corners(x0, y0 - step, x1, y0 + step),
                by_corners(x1 - step, y0, x1 + step, y1),
                by_corners(x0, y1 - step, x1, y1 + step),
            ];
            for (density, grown) in sides.into_iter().zip(grown) {
                // Rounding of the corners over the step, and the strip's own curvature.
                prop_assert!((density - grown / (2.0 * step)).abs() <= 2e-8, "{sides:?} {grown:?}");
            }
        }
    }
}
