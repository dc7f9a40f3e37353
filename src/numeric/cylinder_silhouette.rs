//! A capped cylinder seen from the origin through a linear map: the irradiance inside its silhouette, by Stokes.
//!
//! The silhouette of a convex body bounds the directions in which it is seen, and a linear map m takes it along. For
//! a cylinder that the origin is outside of it is two generators and an arc of each cap's rim, the near one if that
//! cap faces away, the far one if it is seen; or one whole rim. Above the horizon z = 0, closed along it,
//!
//! ```text
//! E = (1/2 pi) |contour integral of (q x dq).z/|q|^2|
//! ```
//!
//! Generators are angles, arcs have the closed form of [`super::elliptic_arc`]. A thin or distant cylinder's terms cancel:
//! where the horizon cuts no rim its contour is summed by differences ([`super::slim_silhouette`]); the rest is left to
//! double-double.

mod slim;

use core::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::double_double::{DoubleDouble, Real};
use super::elliptic_arc::{Cone, Ellipse, Vector, cross, difference, dot};
use super::line_integral::Visible;
use super::products::{self, norm};
use slim::Slim;

/// A cylinder about p1..p2, its radius positive and its ends apart; coordinates of f32.
#[derive(Clone, Copy, Debug)]
pub struct Cylinder {
    pub ends: [DVec3; 2],
    pub radius: f64,
    frame: Frame<f64>,
}

/// Where the origin is, seen from a cylinder.
#[derive(Clone, Copy, Debug)]
struct Frame<T> {
    length: T,
    axis: Vector<T>,
    /// Across the axis, towards the origin, and the third direction axis x towards.
    towards: Vector<T>,
    across: Vector<T>,
    /// Distance of the origin from the infinite axis, and its place along it from the first end.
    gap: T,
    place: T,
}

/// The irradiance of a cylinder and its derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    pub irradiance: f64,
    /// What the roundings of the contour's terms and its quadrature sum up to at the most.
    pub rounding: f64,
    /// By the map's columns, both ends and the radius. All of one sign too many, should the contour run clockwise.
    pub by_map: [DVec3; 3],
    pub by_ends: [DVec3; 2],
    pub by_radius: f64,
    /// By the centres of the rims and by the axis's direction, apart: an end moves its rim, and tilts both.
    pub by_rims: [DVec3; 2],
    pub by_axis: DVec3,
}

impl<T: Real> Frame<T> {
    fn new([p1, p2]: [DVec3; 2]) -> Self {
        let times = |v: Vector<T>, factor: T| v.map(|c| c * factor);
        let along: Vector<T> = difference(lift(p2), lift(p1));
        let length = dot(along, along).sqrt();
        let axis = along.map(|c| c / length);
        let place = -dot(lift(p1), axis);
        // The nearer end keeps the foot's digits.
        let nearer = place.to_f64().abs() < (place - length).to_f64().abs();
        let mut foot = lift(if nearer { p1 } else { p2 });
        for _ in 0..2 {
            foot = difference(foot, times(axis, dot(foot, axis)));
        }
        let gap = dot(foot, foot).sqrt();
        let towards = if gap.to_f64() > 0.0 {
            foot.map(|c| -c / gap)
        } else {
            // Any direction across.
            let any = lift(DVec3::from_array(axis.map(T::to_f64)).any_orthonormal_vector());
            let any = difference(any, times(axis, dot(any, axis)));
            let size = dot(any, any).sqrt();
            any.map(|c| c / size)
        };
        Frame { length, axis, towards, across: cross(axis, towards), gap, place }
    }
}

impl Cylinder {
    pub fn new(p1: DVec3, p2: DVec3, radius: f64) -> Cylinder {
        Cylinder { ends: [p1, p2], radius, frame: Frame::new([p1, p2]) }
    }

    /// Whether the origin is in the cylinder or on it.
    pub fn holds_origin(&self) -> bool {
        self.frame.gap <= self.radius && (0.0..=self.frame.length).contains(&self.frame.place)
    }

    /// The irradiance through `map`, of f32 values, of a cylinder that does not hold the origin, and its derivatives.
    ///
    /// Absolute error `rounding`, and what 4 EPS (2^-53) of every vector that the contour is made of change.
    pub fn seen(&self, map: &DMat3) -> Seen {
        let mut silhouette = Silhouette::new(self, self.frame, map, 1.0);
        let mut derivatives = Derivatives { cylinder: self, map, seen: Seen::default() };
        if let Some(slim) = Slim::new(&silhouette, map * (self.ends[1] - self.ends[0])) {
            let (irradiance, rounding) = slim.integrate(&mut derivatives);
            return Seen { irradiance, rounding, ..derivatives.finish() };
        }
        let determinant = products::determinant(map);
        for rim in &mut silhouette.rims {
            rim.volume *= determinant;
        }
        let (irradiance, terms) = silhouette.walk(|piece| derivatives.add(piece));
        Seen { irradiance, rounding: 16.0 * f64::ROUNDOFF * terms, ..derivatives.finish() }
    }

    /// The irradiance by the same in double-double, and the sum of the terms' magnitudes: errors are 2^-88 of that.
    pub fn seen_finely(&self, map: &DMat3) -> (f64, f64) {
        let columns: [Vector<DoubleDouble>; 3] = [lift(map.x_axis), lift(map.y_axis), lift(map.z_axis)];
        let determinant = dot(columns[0], cross(columns[1], columns[2]));
        Silhouette::new(self, Frame::new(self.ends), map, determinant).walk(|_| ())
    }
}

/// The mapped rims, and where the generators touch them.
struct Silhouette<T> {
    /// t = 0 is towards the origin.
    rims: [Ellipse<T>; 2],
    gap: f64,
    radius: f64,
    place: f64,
    length: f64,
    /// Cosine and sine of the generators' angle about the axis.
    touch: [T; 2],
}

/// A part of the contour.
enum Piece<T> {
    /// A generator of the touching angle's sign between these rims, seen or not.
    Generator { rims: [usize; 2], sign: f64, ends: [Vector<T>; 2] },
    /// The visible part of a rim, or all of it; t counts from `signs[0]` towards, with the sign of `signs[1]`.
    Arc {
        rim: usize,
        signs: [f64; 2],
        ellipse: Ellipse<T>,
        cone: Cone<T>,
        ends: Option<(Vector<T>, Vector<T>, f64)>,
    },
}

/// An end of a visible piece: the point, and which corner of the contour it is unless the horizon cut it.
type End<T> = (Vector<T>, Option<u8>);

/// The sum along a contour.
struct Sum<T> {
    value: T,
    size: f64,
    first: Option<End<T>>,
    last: Option<End<T>>,
}

impl<T: Real> Silhouette<T> {
    fn new(cylinder: &Cylinder, frame: Frame<T>, map: &DMat3, determinant: T) -> Self {
        let columns: [Vector<T>; 3] = [lift(map.x_axis), lift(map.y_axis), lift(map.z_axis)];
        let times = |v: Vector<T>| {
            [0, 1, 2].map(|k| columns[0][k] * v[0] + columns[1][k] * v[1] + columns[2][k] * v[2])
        };
        let radius = T::from(cylinder.radius);
        let [cos, sin] = [frame.towards, frame.across].map(|v| times(v).map(|c| c * radius));
        let heights = [-frame.place, frame.length - frame.place];
        let rims = [0, 1].map(|k| Ellipse {
            center: times(lift(cylinder.ends[k])),
            cos,
            sin,
            volume: determinant * (radius * radius) * heights[k],
        });
        let outside = (frame.gap - radius) * (frame.gap + radius);
        Silhouette {
            rims,
            gap: frame.gap.to_f64(),
            radius: cylinder.radius,
            place: frame.place.to_f64(),
            length: frame.length.to_f64(),
            touch: [radius / frame.gap, outside.sqrt() / frame.gap],
        }
    }

    /// The irradiance and the sum of the terms' magnitudes over 2 pi; every piece of which something is seen is visited.
    fn walk(&self, mut visit: impl FnMut(Piece<T>)) -> (f64, f64) {
        let mut sum = Sum { value: T::from(0.0), size: 0.0, first: None, last: None };
        if self.gap <= self.radius {
            let rim = usize::from(self.place > 0.0);
            self.arc(&mut sum, rim, [1.0, 1.0], PI, [0, 0], &mut visit);
        } else {
            let angle = libm::atan2(self.touch[1].to_f64(), self.touch[0].to_f64());
            let (far0, far1) = (self.place < 0.0, self.place > self.length);
            let turned = |far: bool| if far { (-1.0, PI - angle) } else { (1.0, angle) };
            self.generator(&mut sum, [0, 1], 1.0, [0, 1], &mut visit);
            let (side, half) = turned(far1);
            self.arc(&mut sum, 1, [side, -1.0], half, [1, 2], &mut visit);
            self.generator(&mut sum, [1, 0], -1.0, [2, 3], &mut visit);
            let (side, half) = turned(far0);
            self.arc(&mut sum, 0, [side, 1.0], half, [3, 0], &mut visit);
        }
        if let (Some(last), Some(first)) = (sum.last, sum.first) {
            sum.along_horizon(last, first);
        }
        ((sum.value / T::TAU).to_f64().abs().min(1.0), sum.size / TAU)
    }

    /// The point of a rim on the generator of this sign.
    fn corner(&self, rim: usize, sign: f64) -> Vector<T> {
        self.rims[rim].at([self.touch[0], T::from(sign) * self.touch[1]])
    }

    fn generator(
        &self,
        sum: &mut Sum<T>,
        rims: [usize; 2],
        sign: f64,
        corners: [u8; 2],
        visit: &mut impl FnMut(Piece<T>),
    ) {
        let [a, b] = rims.map(|rim| self.corner(rim, sign));
        let (above_a, above_b) = (a[2].to_f64() > 0.0, b[2].to_f64() > 0.0);
        if !above_a && !above_b {
            return;
        }
        let chord = difference(b, a);
        let nearer = if length(a) < length(b) { a } else { b };
        let normal = cross(nearer, chord);
        // From the corner above: the crossing is that corner and a part of the chord.
        let drop = a[2] - b[2];
        let crossing = |above: Vector<T>, part: T| {
            [above[0] + chord[0] * part, above[1] + chord[1] * part, T::from(0.0)]
        };
        let (start, end, part) = if above_a && above_b {
            ((a, Some(corners[0])), (b, Some(corners[1])), T::from(1.0))
        } else if above_a {
            let part = a[2] / drop;
            ((a, Some(corners[0])), (crossing(a, part), None), part)
        } else {
            let part = b[2] / drop;
            ((crossing(b, part), None), (b, Some(corners[1])), -part)
        };
        sum.join(start, end);
        let size = dot(normal, normal).sqrt();
        if size.to_f64() > 0.0 {
            let angle = (part * size).atan2(dot(start.0, end.0));
            let term = angle * normal[2] / size;
            // Of the normal a rounding is lost, which counts where the generator is seen end-on.
            let tilt = angle.to_f64() * (length(nearer) / size.to_f64()) * length(chord);
            sum.add(term, term.to_f64().abs() + 0.25 * tilt);
        }
        visit(Piece::Generator { rims, sign, ends: [a, b] });
    }

    /// The part of a rim within `half` of t = 0, where t is counted as `signs` say.
    fn arc(
        &self,
        sum: &mut Sum<T>,
        rim: usize,
        signs: [f64; 2],
        half: f64,
        corners: [u8; 2],
        visit: &mut impl FnMut(Piece<T>),
    ) {
        let whole = &self.rims[rim];
        let [side, turn] = signs.map(T::from);
        let ellipse = Ellipse {
            center: whole.center,
            cos: whole.cos.map(|c| c * side),
            sin: whole.sin.map(|c| c * turn),
            volume: whole.volume * side * turn,
        };
        let (z, across) = (ellipse.center[2], [ellipse.cos[2], ellipse.sin[2]]);
        let slope = (across[0] * across[0] + across[1] * across[1]).sqrt();
        let rest = (slope - z) * (slope + z);
        let cut = rest.to_f64() > 0.0;
        if !cut && !(z.to_f64() > 0.0) {
            return;
        }
        let cone = ellipse.cone();
        if !cut && half >= PI {
            let term = ellipse.whole(&cone);
            sum.add(term.value, term.size);
            visit(Piece::Arc { rim, signs, ellipse, cone, ends: None });
            return;
        }
        // The angles of which the rim is above the horizon: within `reach` of `top`.
        let (top, reach) = if cut {
            let top = libm::atan2(across[1].to_f64(), across[0].to_f64());
            (top, libm::atan2(rest.to_f64().sqrt(), -z.to_f64()))
        } else {
            (0.0, PI)
        };
        for shift in [-TAU, 0.0, TAU] {
            let (low, high) = (top + shift - reach, top + shift + reach);
            let (from, to) = if cut { (low.max(-half), high.min(half)) } else { (-half, half) };
            if !(from < to) || (!cut && shift != 0.0) || (half >= PI && shift != 0.0) {
                continue;
            }
            let end = |is_corner: bool, direction: f64, corner: u8| {
                if is_corner {
                    // The generators' points, whatever the signs.
                    (self.corner(rim, direction * signs[1]), Some(corner))
                } else {
                    let d = T::from(direction);
                    let (cos, sin) = (-z / slope, d * rest.sqrt() / slope);
                    let [x, y] = across.map(|c| c / slope);
                    let point = ellipse.at([x * cos - y * sin, y * cos + x * sin]);
                    ([point[0], point[1], T::from(0.0)], None)
                }
            };
            let (start, stop) = if half >= PI {
                (end(false, -1.0, 0), end(false, 1.0, 0))
            } else {
                (end(from == -half, -1.0, corners[0]), end(to == half, 1.0, corners[1]))
            };
            let sweep = if half >= PI { 2.0 * reach } else { to - from };
            sum.join(start, stop);
            let term = ellipse.arc(&cone, start.0, stop.0, sweep);
            // Where the horizon cuts the rim the ends turn with the frame's roundings apart from one another.
            sum.add(term.value, if cut { 4.0 * term.size } else { term.size });
            visit(Piece::Arc { rim, signs, ellipse, cone, ends: Some((start.0, stop.0, sweep)) });
        }
    }
}

impl<T: Real> Sum<T> {
    fn add(&mut self, term: T, size: f64) {
        self.value = self.value + term;
        self.size += size;
    }

    /// Joins a visible piece to the last one, along the horizon where they do not meet.
    fn join(&mut self, start: End<T>, end: End<T>) {
        match self.last {
            None => self.first = Some(start),
            Some(last) => self.along_horizon(last, start),
        }
        self.last = Some(end);
    }

    fn along_horizon(&mut self, (from, corner): End<T>, (to, other): End<T>) {
        if corner.is_none() || corner != other {
            let way = difference(to, from);
            let sine = from[0] * way[1] - from[1] * way[0];
            let angle = sine.atan2(from[0] * to[0] + from[1] * to[1]);
            self.add(angle, angle.to_f64().abs());
        }
    }
}

/// Collects derivatives by what the contour depends on.
struct Derivatives<'a> {
    cylinder: &'a Cylinder,
    map: &'a DMat3,
    seen: Seen,
}

impl Derivatives<'_> {
    fn add(&mut self, piece: Piece<f64>) {
        let frame = &self.cylinder.frame;
        let (towards, across) = (DVec3::from_array(frame.towards), DVec3::from_array(frame.across));
        match piece {
            Piece::Generator { rims, sign, ends } => {
                let cos = self.cylinder.radius / frame.gap;
                let radial = cos * towards + sign * libm::sqrt(1.0 - cos * cos) * across;
                let [a, b] = ends.map(DVec3::from_array);
                // From the nearer end, where less cancels.
                let area = if norm(a) < norm(b) { a.cross(b - a) } else { b.cross(b - a) };
                let Some(piece) = Visible::new(a, b, area) else { return };
                let [by_a, by_b] = piece.contour_gradient();
                self.derive(rims[0], by_a, [(radial, by_a)]);
                self.derive(rims[1], by_b, [(radial, by_b)]);
            }
            Piece::Arc { rim, signs: [side, turn], ellipse, cone, ends } => {
                let ends =
                    ends.map(|(start, end, sweep)| (DVec3::from_array(start), DVec3::from_array(end), sweep));
                let [by, by_cos, by_sin] = ellipse.derivatives(&cone, ends);
                self.derive(rim, by, [(side * towards, by_cos), (turn * across, by_sin)]);
            }
        }
    }

    /// The sum `by` of derivatives of E by contour points map (ends[rim] + radius radial), and the sum of the same times
    /// each component of `radial`: on to what the points depend on.
    fn derive<const N: usize>(&mut self, rim: usize, by: DVec3, radial: [(DVec3, DVec3); N]) {
        let Cylinder { ends, radius, frame } = self.cylinder;
        for (column, slot) in self.seen.by_map.iter_mut().enumerate() {
            let across: DVec3 = radial.iter().map(|(direction, by)| direction[column] * *by).sum();
            *slot += ends[rim][column] * by + *radius * across;
        }
        let back = |by: DVec3| self.map.transpose() * by;
        self.seen.by_rims[rim] += back(by);
        for (direction, by) in radial {
            let by = back(by);
            self.seen.by_radius += by.dot(direction);
            // A turning axis tilts the rims.
            self.seen.by_axis -= *radius * by.dot(DVec3::from_array(frame.axis)) * direction;
        }
    }

    fn finish(mut self) -> Seen {
        let tilt = self.seen.by_axis / self.cylinder.frame.length;
        self.seen.by_ends = [self.seen.by_rims[0] - tilt, self.seen.by_rims[1] + tilt];
        self.seen
    }
}

fn lift<T: Real>(v: DVec3) -> Vector<T> {
    v.to_array().map(T::from)
}

fn length<T: Real>(v: Vector<T>) -> f64 {
    norm(DVec3::from_array(v.map(T::to_f64)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cylinder() -> Cylinder {
        Cylinder::new(DVec3::new(-1.0, 2.0, 1.5), DVec3::new(1.5, 1.0, 2.5), 0.4)
    }

    /// A disk of radius r overhead at height h has the irradiance r^2/(r^2 + h^2), and so has a cylinder seen end-on.
    #[test]
    fn end_on_it_is_its_disk() {
        for (radius, height) in [(0.1, 1.0), (1.0, 1.0), (30.0, 1.0), (1.0, 1e-3)] {
            let seen =
                Cylinder::new(DVec3::new(0.0, 0.0, height), DVec3::new(0.0, 0.0, height + 2.0), radius)
                    .seen(&DMat3::IDENTITY);
            let exact = radius * radius / (radius * radius + height * height);
            // 16 EPS of terms up to radius/height of the whole.
            assert!(
                (seen.irradiance - exact).abs() < 1e-14,
                "{radius} {height}: {} for {exact}",
                seen.irradiance
            );
        }
    }

    /// Half of what lies symmetrically about the horizon.
    #[test]
    fn the_horizon_halves_an_upright_cylinder() {
        let map = DMat3::IDENTITY;
        let whole = Cylinder::new(DVec3::new(3.0, 0.0, -2.0), DVec3::new(3.0, 0.0, 2.0), 1.0).seen(&map);
        let half = Cylinder::new(DVec3::new(3.0, 0.0, 0.0), DVec3::new(3.0, 0.0, 2.0), 1.0).seen(&map);
        assert!((whole.irradiance - half.irradiance).abs() < 1e-14, "{whole:?} {half:?}");
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let map = DMat3::from_cols_array(&[1.3, 0.1, -0.4, 0.0, 0.8, 0.2, 0.5, -0.3, 0.9]);
        let base = cylinder();
        for shift in [DVec3::ZERO, DVec3::new(0.0, 0.0, -2.0), DVec3::new(4.0, 0.0, 0.0)] {
            let ends = base.ends.map(|p| p + shift);
            let value = |ends: [DVec3; 2], radius: f64, map: &DMat3| {
                Cylinder::new(ends[0], ends[1], radius).seen(map).irradiance
            };
            let seen = Cylinder::new(ends[0], ends[1], base.radius).seen(&map);
            let step = 1e-6;
            let mut sign = 0.0;
            let mut check = |given: f64, of: &dyn Fn(f64) -> f64| {
                let difference = (of(step) - of(-step)) / (2.0 * step);
                if sign == 0.0 {
                    sign = (given * difference).signum();
                }
                assert!((sign * given - difference).abs() < 1e-7, "{given} for {difference}");
            };
            check(seen.by_radius, &|d| value(ends, base.radius + d, &map));
            for axis in 0..3 {
                let unit = DVec3::AXES[axis];
                check(seen.by_ends[0][axis], &|d| value([ends[0] + d * unit, ends[1]], base.radius, &map));
                check(seen.by_ends[1][axis], &|d| value([ends[0], ends[1] + d * unit], base.radius, &map));
                for row in 0..3 {
                    check(seen.by_map[axis][row], &|d| {
                        let mut moved = map;
                        moved.col_mut(axis)[row] += d;
                        value(ends, base.radius, &moved)
                    });
                }
            }
        }
    }
}
