//! Irradiance of a polygon clipped to the upper half space, with its gradient and a bound of its rounding error.
//!
//! By Stokes (Lambert's formula) the irradiance of what the contour encloses is the sum over its edges of
//! theta/(2 pi) n.z, n the unit normal of the plane through the edge and the origin and theta the edge's angle. An edge
//! that crosses z = 0 keeps its plane and loses part of its angle; where the contour leaves the upper half space and
//! comes back it is closed along the horizon, whose n.z is +-1, so by the difference of the azimuths. Pairs are made in
//! the order of the contour, as Sutherland & Hodgman's clipping (1974) makes them.
//!
//! n comes from the shorter corner's cross product with the edge, so small and distant polygons cancel in nothing but
//! the final sum, and that is what more precision is for.

use glam::DVec3;

use super::big;
use super::double_double::{DoubleDouble, Real};
use super::graded_polygon;
use super::products::{PAIR_ERROR, Pairs};

/// Share of the hemisphere's irradiance, signed: positive where the corners are anticlockwise seen from the origin.
#[derive(Clone, Copy, Debug)]
pub struct Irradiance<const N: usize> {
    pub value: f64,
    /// Bound of the error that rounding within the sum leaves, the corners taken as exact. At least 1 where rounding may
    /// have turned an angle near pi to its opposite: the origin lies on the contour or on the chord that closes it.
    pub bound: f64,
    /// Change of the value with each corner.
    pub gradient: [DVec3; N],
    /// Whether an edge or the closing chord passes exactly through the origin: the value then has no limit.
    pub touched: bool,
    /// Whether f64 did not do.
    pub escalated: bool,
}

/// The relative error that more precision is taken for: 2.9e-11, well beyond what certifying an f32 takes.
const ACCURACY: f64 = 1.0 / (1u64 << 35) as f64;

type Vector<T> = [T; 3];

/// A crossing of the horizon.
#[derive(Clone, Copy)]
struct Crossing<T> {
    /// z is exactly 0.
    point: Vector<T>,
    /// The edge, by its first corner.
    edge: usize,
    /// Share of the edge that lies before it.
    along: f64,
    /// z of the first corner less that of the second.
    drop: f64,
    /// Rounding error of the point, as a length.
    error: f64,
    gradient: DVec3,
    /// Whether the contour goes down here.
    leaves: bool,
}

/// The polygon's irradiance. Components of the corners are of at most 1e100 and (but for zeros) of at least 1e-70 of
/// the largest.
pub fn irradiance<T: Real, const N: usize>(corners: &[Vector<T>; N]) -> Irradiance<N> {
    of_exact(corners, [false; N])
}

/// The same where `alike` says of edges that both their ends are the same.
fn of_exact<T: Real, const N: usize>(corners: &[Vector<T>; N], alike: [bool; N]) -> Irradiance<N> {
    let mut contour = Contour {
        corners,
        alike,
        sum: T::from(0.0),
        absolute: 0.0,
        bound: 0.0,
        gradient: [DVec3::ZERO; N],
        touched: false,
        crossings: [None; N],
        crossed: 0,
    };
    for first in 0..N {
        contour.edge(first);
    }
    contour.close();
    contour.finish()
}

/// The irradiance in f64 of corners of any scale, known as pairs to [`PAIR_ERROR`]: the bound counts what f64 leaves of them.
/// `alike` says of edges that both their ends are the same: others may round to that.
pub fn of_pairs<const N: usize>(corners: &[Pairs; N], alike: [bool; N]) -> Irradiance<N> {
    of_rounded(corners.map(|corner| corner.map(|(high, _)| high)), alike, f64::ROUNDOFF)
}

/// The same, from corners whose components have this relative error.
fn of_rounded<T: Real, const N: usize>(
    corners: [Vector<T>; N],
    alike: [bool; N],
    error: f64,
) -> Irradiance<N> {
    // By a power of two, exactly: no square leaves f64's range.
    let largest = corners
        .iter()
        .flatten()
        .fold(0.0f64, |largest, c| largest.max(c.to_f64().abs()))
        .clamp(1e-200, 1e200);
    let scale = T::from(libm::exp2(-libm::floor(libm::log2(largest))));
    let corners = corners.map(|corner| corner.map(|c| c * scale));
    let mut found = of_exact(&corners, alike);
    for (corner, gradient) in corners.iter().zip(&mut found.gradient) {
        for (component, slope) in corner.iter().zip(gradient.to_array()) {
            found.bound += 2.0 * error * (component.to_f64() * slope).abs();
        }
        *gradient *= scale.to_f64();
    }
    found
}

impl<const N: usize> Irradiance<N> {
    /// Whether there is a value, and rounding leaves at most `ACCURACY` of it in doubt.
    pub fn is_certain(&self) -> bool {
        !self.touched && self.bound <= ACCURACY * self.value.abs()
    }

    /// The same where that is certain, and else of these very pairs in double-double.
    pub fn finer(self, corners: &[Pairs; N], alike: [bool; N]) -> Self {
        if self.is_certain() {
            return self;
        }
        let corners = corners.map(|corner| corner.map(|(high, low)| DoubleDouble::new(high, low)));
        Irradiance { escalated: true, ..of_rounded(corners, alike, PAIR_ERROR) }
    }

    /// The same where that is certain, and else with the value in as many digits as it takes; the sign is lost.
    pub fn refined(self, corners: impl FnOnce() -> [big::Vector; N]) -> Self {
        if self.is_certain() {
            return self;
        }
        match graded_polygon::irradiance(&corners()) {
            Some(value) => {
                let bound = 0.5 * f64::EPSILON * value;
                Irradiance { value, bound, touched: false, escalated: true, ..self }
            }
            None => self,
        }
    }
}

struct Contour<'a, T, const N: usize> {
    corners: &'a [Vector<T>; N],
    alike: [bool; N],
    sum: T,
    /// Sum of the terms' magnitudes.
    absolute: f64,
    bound: f64,
    gradient: [DVec3; N],
    touched: bool,
    crossings: [Option<Crossing<T>>; N],
    crossed: usize,
}

impl<T: Real, const N: usize> Contour<'_, T, N> {
    /// Adds the part of an edge that is above the horizon.
    fn edge(&mut self, first: usize) {
        let second = (first + 1) % N;
        let (a, b) = (self.corners[first], self.corners[second]);
        let (above_a, above_b) = (a[2].to_f64() > 0.0, b[2].to_f64() > 0.0);
        if !above_a && !above_b {
            return;
        }
        let chord = difference(b, a);
        let (length_a, length_b) = (length(a), length(b));
        let normal = cross(if length_a < length_b { a } else { b }, chord);
        // Each component of the chord is rounded once, and the products and their difference once more.
        let normal_error = 4.0 * T::ROUNDOFF * length_a.min(length_b) * length(chord);

        let (start, end, part, cut) = if above_a && above_b {
            (a, b, T::from(1.0), 0.0)
        } else {
            // From the corner above: the crossing is that corner and a part of the chord, with the sign of its way.
            let drop = a[2] - b[2];
            let (above, from_above) = if above_a { (a, a[2] / drop) } else { (b, b[2] / drop) };
            let offset = chord.map(|c| c * from_above);
            let point = [above[0] + offset[0], above[1] + offset[1], T::from(0.0)];
            let magnitude = |v: Vector<T>| libm::hypot(v[0].to_f64(), v[1].to_f64());
            let along = if above_a { from_above } else { T::from(1.0) + from_above };
            let error = T::ROUNDOFF * (magnitude(above) + 6.0 * magnitude(offset));
            self.crossings[self.crossed] = Some(Crossing {
                point,
                edge: first,
                along: along.to_f64(),
                drop: drop.to_f64(),
                error,
                gradient: DVec3::ZERO,
                leaves: above_a,
            });
            self.crossed += 1;
            let part = if above_a { from_above } else { -from_above };
            let (start, end) = if above_a { (a, point) } else { (point, b) };
            // An error along the crossing's own direction is one of the cosine that the sine does not share.
            (start, end, part, error / magnitude(point))
        };

        let (u, w) = (round(start), round(end));
        let cosine = dot(start, end);
        let whole_sine = dot(normal, normal).sqrt();
        let (at_u, at_w) = if whole_sine.to_f64() > 0.0 {
            let sine = part * whole_sine;
            let theta = sine.atan2(cosine);
            self.add(theta * normal[2] / (whole_sine * T::TAU));
            let turn = normal_error / whole_sine.to_f64();
            let theta = theta.to_f64();
            self.bound += theta / core::f64::consts::TAU * (3.0 * turn + 12.0 * T::ROUNDOFF + cut);
            if turn > 0.01 {
                self.bound += 1.0;
            }
            edge_gradient(round(normal) / whole_sine.to_f64(), sine.to_f64(), theta, u, w)
        } else {
            if !self.alike[first] {
                self.bound += 1.0;
            }
            self.touched |= cosine.to_f64() <= 0.0;
            parallel_gradient(u, w)
        };
        if above_a {
            self.gradient[first] += at_u;
        } else if let Some(crossing) = &mut self.crossings[self.crossed - 1] {
            crossing.gradient += at_u;
        }
        if above_b {
            self.gradient[second] += at_w;
        } else if let Some(crossing) = &mut self.crossings[self.crossed - 1] {
            crossing.gradient += at_w;
        }
    }

    /// Adds the ways along the horizon, each from where the contour leaves to where it comes back.
    fn close(&mut self) {
        for position in 0..self.crossed {
            let next = (position + 1) % self.crossed;
            let (Some(mut from), Some(mut to)) = (self.crossings[position], self.crossings[next]) else {
                continue;
            };
            if !from.leaves {
                continue;
            }
            let way = difference(to.point, from.point);
            let sine = cross(from.point, way)[2];
            let cosine = dot(from.point, to.point);
            let angle = sine.atan2(cosine);
            let (c, d) = (round(from.point), round(to.point));
            let (cc, dd) = (c.length_squared(), d.length_squared());
            if sine.to_f64() == 0.0 && cosine.to_f64() <= 0.0 {
                self.touched = true;
                continue;
            }
            self.add(angle / T::TAU);
            let off = from.error / cc.sqrt() + to.error / dd.sqrt();
            // The points' own errors, which the edges' terms do not share, and what the sine loses beside them.
            self.bound += off / core::f64::consts::TAU;
            self.bound += 4.0 * T::ROUNDOFF * (length(way) / dd.sqrt() + angle.to_f64().abs());
            if core::f64::consts::PI - angle.to_f64().abs() <= off + 8.0 * T::ROUNDOFF {
                self.bound += 1.0;
            }
            from.gradient -= DVec3::Z.cross(c) / (cc * core::f64::consts::TAU);
            to.gradient += DVec3::Z.cross(d) / (dd * core::f64::consts::TAU);
            self.crossings[position] = Some(from);
            self.crossings[next] = Some(to);
        }
    }

    /// Hands the crossings' gradients on to their edges' corners.
    fn finish(mut self) -> Irradiance<N> {
        for crossing in self.crossings.iter().flatten() {
            let (first, second) = (crossing.edge, (crossing.edge + 1) % N);
            let chord = round(difference(self.corners[second], self.corners[first]));
            let shift = crossing.gradient + DVec3::Z * (crossing.gradient.dot(chord) / crossing.drop);
            self.gradient[first] += (1.0 - crossing.along) * shift;
            self.gradient[second] += crossing.along * shift;
        }
        Irradiance {
            value: self.sum.to_f64(),
            // And the sum is rounded to f64.
            bound: self.bound + 4.0 * T::ROUNDOFF * self.absolute + f64::ROUNDOFF * self.sum.to_f64().abs(),
            gradient: self.gradient,
            touched: self.touched,
            escalated: false,
        }
    }

    fn add(&mut self, term: T) {
        self.sum = self.sum + term;
        self.absolute += term.to_f64().abs();
    }
}

/// The gradients of theta/(2 pi) n.z at both ends of an edge with the unit normal n: within the plane an end changes
/// theta, along n it tilts the plane about the other end.
fn edge_gradient(normal: DVec3, sine: f64, theta: f64, u: DVec3, w: DVec3) -> (DVec3, DVec3) {
    use core::f64::consts::TAU;
    let (length_u, length_w) = (u.length(), w.length());
    let (across_u, across_w) = (normal.cross(u) / length_u, normal.cross(w) / length_w);
    let ratio = if sine > 0.0 { theta / (sine / (length_u * length_w)) } else { 1.0 };
    (
        (ratio * across_w.z * normal - normal.z * across_u) / (TAU * length_u),
        (normal.z * across_w - ratio * across_u.z * normal) / (TAU * length_w),
    )
}

/// The same for parallel ends: the edge is (u x w).z / (2 pi |u||w|) to first order.
fn parallel_gradient(u: DVec3, w: DVec3) -> (DVec3, DVec3) {
    let scale = core::f64::consts::TAU * u.length() * w.length();
    if scale > 0.0 {
        (w.cross(DVec3::Z) / scale, DVec3::Z.cross(u) / scale)
    } else {
        (DVec3::ZERO, DVec3::ZERO)
    }
}

fn difference<T: Real>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot<T: Real>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T: Real>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn round<T: Real>(v: Vector<T>) -> DVec3 {
    DVec3::new(v[0].to_f64(), v[1].to_f64(), v[2].to_f64())
}

fn length<T: Real>(v: Vector<T>) -> f64 {
    round(v).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{Draw, Stream};

    fn quad(draw: &mut Draw) -> [DVec3; 4] {
        let frame = draw.frame();
        let centre = draw.log_uniform(0.5, 5.0) * draw.direction();
        let (x, y) = (draw.uniform(0.1, 2.0) * frame.x_axis, draw.uniform(0.1, 2.0) * frame.y_axis);
        [centre - x - y, centre + x - y, centre + x + y, centre - x + y]
    }

    fn value<const N: usize>(corners: &[DVec3; N]) -> f64 {
        irradiance(&corners.map(|c| c.to_array())).value
    }

    /// Midpoint sum of cos cos'/(pi r^2) over the quad's area, in cells of which those below the horizon count nothing.
    fn by_area(corners: &[DVec3; 4], cells: u32) -> f64 {
        let (x, y) = (corners[1] - corners[0], corners[3] - corners[0]);
        let area = x.cross(y);
        let mut sum = 0.0;
        for i in 0..cells {
            for j in 0..cells {
                let at = |k: u32| (f64::from(k) + 0.5) / f64::from(cells);
                let point = corners[0] + at(i) * x + at(j) * y;
                let r2 = point.length_squared();
                sum += point.z.max(0.0) * point.dot(area) / (r2 * r2);
            }
        }
        sum / f64::from(cells * cells) / core::f64::consts::PI
    }

    #[test]
    fn is_the_integral_over_the_area() {
        let mut clipped = 0;
        Stream::new(3, "area").visit(0, 150, |_, draw| {
            let corners = quad(draw);
            let sign = DVec3::dot(corners[0], (corners[1] - corners[0]).cross(corners[3] - corners[0]));
            // Where the quad is nearer than its cells are wide the sum is coarse.
            if sign.abs() < 0.2 {
                return;
            }
            let above = corners.iter().filter(|c| c.z > 0.0).count();
            clipped += u32::from((1..4).contains(&above));
            let (exact, sum) = (value(&corners), by_area(&corners, 200));
            // The midpoint rule's error is the second derivative's, (size/200)^2 of the height's.
            assert!((exact - sum).abs() < 2e-3 * (exact.abs() + 0.01), "{corners:?}: {exact} {sum}");
        });
        assert!(clipped > 20, "{clipped}");
    }

    #[test]
    fn both_precisions_agree_within_the_bound() {
        Stream::new(4, "precisions").visit(0, 5_000, |_, draw| {
            let corners = quad(draw).map(|c| c.to_array());
            let plain = irradiance(&corners);
            let fine = irradiance(&corners.map(|c| c.map(DoubleDouble::from)));
            assert!((plain.value - fine.value).abs() <= plain.bound, "{plain:?} {fine:?}");
            let rounded = f64::ROUNDOFF * fine.value.abs();
            assert!(fine.bound < rounded + 1e-25 || fine.bound >= 1.0, "{fine:?}");
        });
    }

    #[test]
    fn splitting_sums_and_turning_negates() {
        Stream::new(5, "split").visit(0, 5_000, |_, draw| {
            let [a, b, c, d] = quad(draw);
            let part = draw.unit();
            let (e, f) = (a + part * (b - a), d + part * (c - d));
            let bound = irradiance(&[a, b, c, d].map(|c| c.to_array())).bound;
            // The new corners are rounded; close to the origin that counts as much as the bound says of the whole.
            let allowed = 100.0 * bound + 1e-14;
            let (whole, parts) = (value(&[a, b, c, d]), value(&[a, e, f, d]) + value(&[e, b, c, f]));
            assert!((whole - parts).abs() <= allowed, "{whole} {parts}");
            assert!((value(&[d, c, b, a]) + whole).abs() <= allowed);
            assert!((value(&[b, c, d, a]) - whole).abs() <= allowed);
            assert!((value(&[a, b, c]) + value(&[a, c, d]) - whole).abs() <= allowed);
        });
    }

    /// An infinite plane overhead is the whole hemisphere; upright, beginning at the horizon, it is half of it.
    #[test]
    fn limits() {
        let s = 1e8;
        let overhead = [[-s, -s, 1.0], [s, -s, 1.0], [s, s, 1.0], [-s, s, 1.0]];
        assert!((irradiance(&overhead).value.abs() - 1.0).abs() < 1e-7);
        let upright = [[1.0, -s, -s], [1.0, s, -s], [1.0, s, s], [1.0, -s, s]];
        assert!((irradiance(&upright).value.abs() - 0.5).abs() < 1e-7);
        let below = [[1.0, 0.0, -1.0], [0.0, 1.0, -0.5], [-1.0, 0.0, 0.0], [0.0, -1.0, -1.0]];
        assert_eq!(irradiance(&below).value, 0.0);
        let through = [[-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]];
        assert!(irradiance(&through).touched);
    }

    #[test]
    fn gradients_are_differences() {
        Stream::new(6, "gradients").visit(0, 2_000, |_, draw| {
            let corners = quad(draw);
            let found = irradiance(&corners.map(|c| c.to_array()));
            let largest = found.gradient.iter().map(|g| g.length()).fold(0.0, f64::max);
            // Second order: curvature grows as the square of the gradient near the origin.
            if largest > 3.0 || corners.iter().any(|c| c.z.abs() < 1e-3) {
                return;
            }
            for (index, gradient) in found.gradient.iter().enumerate() {
                let step = 1e-5 * draw.direction();
                let moved = |sign: f64| {
                    let mut corners = corners;
                    corners[index] += sign * step;
                    value(&corners)
                };
                let change = moved(1.0) - moved(-1.0);
                assert!((change - 2.0 * gradient.dot(step)).abs() < 1e-8, "{corners:?} {index} {change:e}");
            }
        });
    }
}
