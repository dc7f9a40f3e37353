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
//! Generators are angles in closed form. Arcs are Gauss panels short enough for the integrand's poles, |q(phi)| = 0 at
//! complex phi, to stay outside of an ellipse in which the rule is good to 1e-16: 1/|q|^2 has an elementary
//! antiderivative only in the roots of a quartic, which cost more digits than the panels do.

use core::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::gauss_legendre::{self, POINTS_8, POINTS_16};
use super::line_integral::Visible;
use super::products::norm;

/// A cylinder about p1..p2, its radius positive and its ends apart.
#[derive(Clone, Copy, Debug)]
pub struct Cylinder {
    pub ends: [DVec3; 2],
    pub radius: f64,
    length: f64,
    axis: DVec3,
    /// Across the axis, towards the origin, and the third direction axis x towards.
    towards: DVec3,
    across: DVec3,
    /// Distance of the origin from the infinite axis, and its place along it from the first end.
    gap: f64,
    place: f64,
}

/// The irradiance of a cylinder and its derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    pub irradiance: f64,
    /// Sum of the magnitudes of the contour's terms, over 2 pi: roundings are in units of it.
    pub terms: f64,
    /// By the map's columns, both ends and the radius. All of one sign too many, should the contour run clockwise.
    pub by_map: [DVec3; 3],
    pub by_ends: [DVec3; 2],
    pub by_radius: f64,
    /// By the centres of the rims and by the axis's direction, apart: an end moves its rim, and tilts both.
    pub by_rims: [DVec3; 2],
    pub by_axis: DVec3,
}

impl Cylinder {
    pub fn new(p1: DVec3, p2: DVec3, radius: f64) -> Cylinder {
        let length = norm(p2 - p1);
        let axis = (p2 - p1) / length;
        let place = -p1.dot(axis);
        // The nearer end keeps the foot's digits.
        let foot = if place.abs() < (place - length).abs() { p1 } else { p2 };
        let foot = foot - foot.dot(axis) * axis;
        let foot = foot - foot.dot(axis) * axis;
        let gap = norm(foot);
        let towards = if gap > 0.0 { -foot / gap } else { axis.any_orthonormal_vector() };
        let across = axis.cross(towards);
        Cylinder { ends: [p1, p2], radius, length, axis, towards, across, gap, place }
    }

    /// Whether the origin is in the cylinder or on it.
    pub fn holds_origin(&self) -> bool {
        self.gap <= self.radius && (0.0..=self.length).contains(&self.place)
    }

    /// The irradiance through `map` of a cylinder that does not hold the origin.
    ///
    /// Absolute error about 16 EPS of `terms` (EPS = 2^-53), and what a few EPS of the coordinates change.
    pub fn seen(&self, map: &DMat3) -> Seen {
        let mut contour =
            Contour { cylinder: self, map, seen: Seen::default(), sum: 0.0, first: None, last: None };
        if self.gap <= self.radius {
            contour.arc(usize::from(self.place > 0.0), [0.0, TAU], [0, 0]);
        } else {
            let side = (self.gap - self.radius) * (self.gap + self.radius);
            let rim = libm::atan2(libm::sqrt(side), self.radius);
            let (far1, far2) = (self.place < 0.0, self.place > self.length);
            contour.generator([0, 1], rim, [0, 1]);
            contour.arc(1, [rim, if far2 { TAU - rim } else { -rim }], [1, 2]);
            contour.generator([1, 0], -rim, [2, 3]);
            contour.arc(0, [-rim, if far1 { rim - TAU } else { rim }], [3, 0]);
        }
        contour.close()
    }

    fn radial(&self, angle: f64) -> DVec3 {
        let (sin, cos) = angle.sin_cos();
        cos * self.towards + sin * self.across
    }
}

/// An end of a visible piece: the point, and which corner of the contour it is unless the horizon cut it.
type End = (DVec3, Option<u8>);

struct Contour<'a> {
    cylinder: &'a Cylinder,
    map: &'a DMat3,
    seen: Seen,
    sum: f64,
    first: Option<End>,
    last: Option<End>,
}

impl Contour<'_> {
    fn add(&mut self, term: f64) {
        self.sum += term;
        self.seen.terms += term.abs() / TAU;
    }

    /// Joins a visible piece to the last one, along the horizon where they do not meet.
    fn join(&mut self, start: End, end: End) {
        match self.last {
            None => self.first = Some(start),
            Some(last) => self.along_horizon(last, start),
        }
        self.last = Some(end);
    }

    fn along_horizon(&mut self, from: End, to: End) {
        if from.1.is_none() || from.1 != to.1 {
            let ((a, _), (b, _)) = (from, to);
            self.add(libm::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
        }
    }

    /// The derivative `by` of E by a contour point map (ends[end] + radius radial): on to what the point depends on.
    fn derive(&mut self, by: DVec3, end: usize, radial: DVec3) {
        let cylinder = self.cylinder;
        let point = cylinder.ends[end] + cylinder.radius * radial;
        for (column, slot) in self.seen.by_map.iter_mut().enumerate() {
            *slot += point[column] * by;
        }
        let back = self.map.transpose() * by;
        self.seen.by_rims[end] += back;
        self.seen.by_radius += back.dot(radial);
        // A turning axis tilts the rims.
        self.seen.by_axis -= cylinder.radius * back.dot(cylinder.axis) * radial;
    }

    fn generator(&mut self, [from, to]: [usize; 2], angle: f64, corners: [u8; 2]) {
        let radial = self.cylinder.radial(angle);
        let [a, b] =
            [from, to].map(|end| *self.map * (self.cylinder.ends[end] + self.cylinder.radius * radial));
        let step = *self.map * (self.cylinder.ends[to] - self.cylinder.ends[from]);
        // From the nearer end, where less cancels.
        let area = if norm(a) < norm(b) { a.cross(step) } else { b.cross(step) };
        let Some(piece) = Visible::new(a, b, area) else { return };
        self.join(
            (piece.ends[0], (a.z >= 0.0).then_some(corners[0])),
            (piece.ends[1], (b.z >= 0.0).then_some(corners[1])),
        );
        self.add(piece.contour_term());
        let [by_a, by_b] = piece.contour_gradient();
        self.derive(by_a, from, radial);
        self.derive(by_b, to, radial);
    }

    fn arc(&mut self, end: usize, [from, to]: [f64; 2], corners: [u8; 2]) {
        let cylinder = self.cylinder;
        let rim = Rim {
            center: *self.map * cylinder.ends[end],
            cos: cylinder.radius * (*self.map * cylinder.towards),
            sin: cylinder.radius * (*self.map * cylinder.across),
        };
        let crossings = rim.crossings(from, to);
        let mut start = from;
        for stop in crossings.into_iter().flatten().chain([to]) {
            if rim.at(0.5 * (start + stop)).z > 0.0 {
                let corner = |place: f64| match place {
                    place if place == from => Some(corners[0]),
                    place if place == to => Some(corners[1]),
                    _ => None,
                };
                self.join((rim.at(start), corner(start)), (rim.at(stop), corner(stop)));
                self.panels(&rim, end, start, stop, 0);
            }
            start = stop;
        }
    }

    fn panels(&mut self, rim: &Rim, end: usize, from: f64, to: f64, depth: u32) {
        let half = 0.5 * (to - from).abs();
        let reach = norm(rim.at(0.5 * (from + to)));
        let size = rim.size();
        // q moves by at most size (exp |z| - 1) over a complex step z; |q . q| > 0 while that is below 0.41 |q|.
        let free = |z: f64| size * (libm::exp(z) - 1.0) <= 0.41 * reach;
        // Semi-axes' sum 10, axis 5.05, 10^-16; or 3.3, 1.8, 3.3^-32 = 3e-17.
        let rule = if free(5.05 * half) {
            &POINTS_8[..]
        } else if free(1.8 * half) || depth >= 24 {
            &POINTS_16[..]
        } else {
            let middle = 0.5 * (from + to);
            self.panels(rim, end, from, middle, depth + 1);
            self.panels(rim, end, middle, to, depth + 1);
            return;
        };
        let mut term = 0.0;
        gauss_legendre::visit(rule, from, to, |angle, weight| {
            let (sin, cos) = angle.sin_cos();
            let q = rim.center + cos * rim.cos + sin * rim.sin;
            let area = q.cross(cos * rim.sin - sin * rim.cos);
            let inverse = 1.0 / q.length_squared();
            term += weight * area.z * inverse;
            let by = (-weight / PI * q.z * inverse * inverse) * area;
            self.derive(by, end, cos * self.cylinder.towards + sin * self.cylinder.across);
        });
        self.add(term);
    }

    fn close(mut self) -> Seen {
        if let (Some(last), Some(first)) = (self.last, self.first) {
            self.along_horizon(last, first);
        }
        self.seen.irradiance = (self.sum.abs() / TAU).min(1.0);
        let tilt = self.seen.by_axis / self.cylinder.length;
        self.seen.by_ends = [self.seen.by_rims[0] - tilt, self.seen.by_rims[1] + tilt];
        self.seen
    }
}

/// q = center + cos(angle) cos + sin(angle) sin.
struct Rim {
    center: DVec3,
    cos: DVec3,
    sin: DVec3,
}

impl Rim {
    fn at(&self, angle: f64) -> DVec3 {
        let (sin, cos) = angle.sin_cos();
        self.center + cos * self.cos + sin * self.sin
    }

    fn size(&self) -> f64 {
        libm::sqrt(self.cos.length_squared() + self.sin.length_squared())
    }

    /// The angles strictly between `from` and `to`, in order, where the rim crosses the horizon.
    fn crossings(&self, from: f64, to: f64) -> [Option<f64>; 2] {
        let slope = libm::hypot(self.cos.z, self.sin.z);
        if !(self.center.z.abs() < slope) {
            return [None; 2];
        }
        let top = libm::atan2(self.sin.z, self.cos.z);
        let half = libm::acos(-self.center.z / slope);
        let direction = if to > from { 1.0 } else { -1.0 };
        let length = (to - from).abs();
        let mut found = [top - half, top + half].map(|angle| {
            let ahead = ((angle - from) * direction).rem_euclid(TAU);
            (ahead > 0.0 && ahead < length).then_some(ahead)
        });
        if let [Some(a), Some(b)] = found
            && a > b
        {
            found = [Some(b), Some(a)];
        }
        found.map(|ahead| ahead.map(|ahead| from + direction * ahead))
    }
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
