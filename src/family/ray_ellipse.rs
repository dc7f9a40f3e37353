//! Where a ray meets a planar ellipse: o + t d = c + lambda u + gamma v with lambda^2 + gamma^2 <= 1 and t >= 0.
//!
//! u and v are conjugate semi-axes, d is a direction of any length. With q = o - c and [a, b, c] the determinant,
//!
//! ```text
//! D = [d, u, v]    lambda = [d, q, v]/D    gamma = [d, u, q]/D    t = -[q, u, v]/D
//! ```
//!
//! A **miss** is t = 3.4028235e38, the largest f32, and lambda = gamma = 0: finite, so that a shader may return and compare
//! it whatever it assumes of infinities, no legal t, and above every hit when the nearest is looked for. All of these are
//! misses: lambda^2 + gamma^2 > 1; t < 0; t of the largest f32 or more; D = 0, which is a ray parallel to the plane or within
//! it, semi-axes that are zero or parallel, and a zero direction. The border and t = 0 are hits. Whether results are a miss
//! is read from t alone.
//!
//! The *margin* of hit or miss is to first order: the class turns with the signs of [q, u, v] and of |D| - a [d, q, v] -
//! b [d, u, q], a^2 + b^2 = 1, polynomials whose gradients are cross products. From inside, (a, b) is tried along (lambda,
//! gamma) and in eight directions more, which finds the margin within a tenth.
//!
//! Each determinant is a dot product with a cross product of f32 values, whose components are rounded once in plain f64.
//! Where the terms cancel to less than 1/64, it is summed exactly instead.

mod scenarios;

use glam::DVec3;

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::products;
use crate::numeric::spacing::EPS;

pub(super) struct RayEllipse;

const T: usize = 0;
const LAMBDA: usize = 1;
const GAMMA: usize = 2;

/// t of a miss.
const MISS: f64 = f32::MAX as f64;

/// Determinants of plain f64 are taken where they exceed this share of the sum of their terms' magnitudes.
const CANCELLATION: f64 = 1.0 / 64.0;

/// A determinant in f64 is off by at most 6 EPS of that sum: q, the cross product, products and two sums. Two of them, and
/// a division.
const RELATIVE: f64 = (2.0 * 6.0 / CANCELLATION + 1.0) * EPS;

impl Problem for RayEllipse {
    fn name(&self) -> &'static str {
        "ray_ellipse"
    }

    fn summary(&self) -> &'static str {
        "Ray against a planar ellipse: distance and place in its semi-axes, or a miss"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("origin", Type::Vec3),
                Field::new("direction", Type::Vec3),
                Field::new("center", Type::Vec3),
                Field::new("u", Type::Vec3),
                Field::new("v", Type::Vec3),
            ]
        }
    }

    /// A hit 1e-4 of its distance in front of the surface shades itself; a thousandth of a semi-axis is half a texel of 1024.
    fn outputs(&self) -> &'static [Output] {
        const {
            &[
                Output::new("t", Type::Float, Quantity::Scalar, 1e-4).headline(),
                Output::new("lambda", Type::Float, Quantity::Coordinate, 1e-3).headline(),
                Output::new("gamma", Type::Float, Quantity::Coordinate, 1e-3),
            ]
        }
    }

    fn is_miss(&self, values: &[f64]) -> bool {
        values[T] >= MISS
    }

    fn scenarios(&self) -> &'static [Scenario] {
        scenarios::ALL
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "radius",
                summary: "hypot(lambda, gamma) where the ray's line meets the plane; at 1 the border",
                edges: &[0.5, 0.9, 0.99, 1.0 - 1e-4, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.0 + 1e-4, 1.01, 1.1, 2.0],
                coordinate: |input, _| {
                    let ray = Ray::new(input);
                    libm::hypot(ray.lambda, ray.gamma) / ray.det.abs()
                },
            },
            Landmark {
                name: "margin",
                summary: "change of the inputs that turns hit into miss or back, in roundings of 2^-24; below 4 it explains either",
                edges: &[1.0, 4.0, 16.0, 64.0, 1e3, 1e4, 1e6],
                coordinate: |_, truth| truth.margin() * 16_777_216.0,
            },
            Landmark {
                name: "grazing",
                summary: "sine of the angle between ray and plane; at 0 they are parallel",
                edges: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5],
                coordinate: |input, _| {
                    let ray = Ray::new(input);
                    ray.det.abs() / (ray.d.length() * ray.u.cross(ray.v).length())
                },
            },
            Landmark {
                name: "distance",
                summary: "from origin to centre, in semi-major axes",
                edges: &[1e-4, 1e-2, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6],
                coordinate: |input, _| {
                    let ray = Ray::new(input);
                    (ray.o - ray.c).length() / ray.u.length().max(ray.v.length())
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let mut ray = Ray::new(input);
        if ray.cancels() {
            truth.escalate();
            ray.sum_exactly();
        }
        let radius = libm::hypot(ray.lambda, ray.gamma);
        let hits_plane = ray.det != 0.0;
        let t = -ray.volume / ray.det;
        truth.set_margin(ray.margin(radius));
        if !(hits_plane && radius <= ray.det.abs() && (0.0..MISS).contains(&t)) {
            truth.scalar(T, MISS, 0.0, 0.0);
            truth.scalar(LAMBDA, 0.0, 0.0, 0.0);
            truth.scalar(GAMMA, 0.0, 0.0, 0.0);
            return;
        }

        let (lambda, gamma) = (ray.lambda / ray.det, ray.gamma / ray.det);
        // The equation's own first-order change e must be made up for by d dt - u dlambda - v dgamma.
        let change = ray.o.abs()
            + ray.c.abs()
            + t * ray.d.abs()
            + lambda.abs() * ray.u.abs()
            + gamma.abs() * ray.v.abs();
        let moved = |cofactor: DVec3| cofactor.abs().dot(change) / ray.det.abs();
        // -0 is no distance: 0 - x is 0 where x is.
        truth.scalar(T, 0.0 + t, RELATIVE * t, moved(ray.u.cross(ray.v)));
        truth.scalar(LAMBDA, 0.0 + lambda, RELATIVE * lambda.abs(), moved(ray.v.cross(ray.d)));
        truth.scalar(GAMMA, 0.0 + gamma, RELATIVE * gamma.abs(), moved(ray.d.cross(ray.u)));
    }
}

/// Directions an eighth of a turn apart.
const AROUND: [(f64, f64); 8] = {
    const S: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [(1.0, 0.0), (S, S), (0.0, 1.0), (-S, S), (-1.0, 0.0), (-S, -S), (0.0, -1.0), (S, -S)]
};

/// One configuration and its determinants.
struct Ray {
    o: DVec3,
    d: DVec3,
    c: DVec3,
    u: DVec3,
    v: DVec3,
    /// D = [d, u, v].
    det: f64,
    /// [d, q, v] and [d, u, q]: lambda and gamma times D.
    lambda: f64,
    gamma: f64,
    /// [q, u, v] = -t D.
    volume: f64,
}

impl Ray {
    /// In plain f64.
    fn new(input: &[f32]) -> Self {
        let vector =
            |i: usize| DVec3::new(f64::from(input[i]), f64::from(input[i + 1]), f64::from(input[i + 2]));
        let [o, d, c, u, v] = [0, 3, 6, 9, 12].map(vector);
        let q = o - c;
        let normal = u.cross(v);
        Ray {
            o,
            d,
            c,
            u,
            v,
            det: d.dot(normal),
            lambda: q.dot(v.cross(d)),
            gamma: q.dot(d.cross(u)),
            volume: q.dot(normal),
        }
    }

    /// Whether the terms of a determinant cancel to less than f64 is good for. Zeros do, unless all their terms are zero.
    fn cancels(&self) -> bool {
        let q = (self.o - self.c).abs();
        let normal = self.u.cross(self.v).abs();
        [
            (self.det, self.d.abs().dot(normal)),
            (self.lambda, q.dot(self.v.cross(self.d).abs())),
            (self.gamma, q.dot(self.d.cross(self.u).abs())),
            (self.volume, q.dot(normal)),
        ]
        .into_iter()
        .any(|(sum, terms)| sum.abs() < CANCELLATION * terms)
    }

    /// Every determinant again, rounded once.
    fn sum_exactly(&mut self) {
        let q = products::difference(self.o, self.c);
        let normal = products::cross(self.u, self.v);
        self.det = products::dot(self.d, &normal);
        self.lambda = products::dot_exact(&q, &products::cross(self.v, self.d));
        self.gamma = products::dot_exact(&q, &products::cross(self.d, self.u));
        self.volume = products::dot_exact(&q, &normal);
    }

    /// The least relative change of every input that turns a hit into a miss or a miss into a hit, to first order.
    /// `radius` is hypot([d, q, v], [d, u, q]).
    fn margin(&self, radius: f64) -> f64 {
        let Ray { o, d, c, u, v, det, lambda, gamma, volume } = self;
        let (q, q_change) = (*o - *c, o.abs() + c.abs());
        let normal = u.cross(*v);
        // The most by which a function of these gradients changes when every input changes by its own magnitude.
        let change = |by_d: DVec3, by_u: DVec3, by_v: DVec3, by_q: DVec3| {
            d.abs().dot(by_d.abs())
                + u.abs().dot(by_u.abs())
                + v.abs().dot(by_v.abs())
                + q_change.dot(by_q.abs())
        };
        let turns = |value: f64, change: f64| if change > 0.0 { value.abs() / change } else { f64::INFINITY };
        let det_change = change(normal, v.cross(*d), d.cross(*u), DVec3::ZERO);
        let det_turns = turns(*det, det_change);

        // The ellipse is the strip aL + bG <= |D|, L = [d, q, v] and G = [d, u, q], for every direction (a, b) at once. This
        // is the strip's change, with D's sign given.
        let strip_change = |sign: f64, (a, b): (f64, f64)| {
            change(
                sign * normal - a * q.cross(*v) - b * u.cross(q),
                sign * v.cross(*d) - b * q.cross(*d),
                sign * d.cross(*u) - a * d.cross(q),
                -a * v.cross(*d) - b * d.cross(*u),
            )
        };
        let own = if radius > 0.0 { (lambda / radius, gamma / radius) } else { (0.0, 0.0) };
        if *det == 0.0 {
            // Without a plane there is nothing to hit, however the inputs change; else D may go either way.
            let either = strip_change(1.0, own).max(strip_change(-1.0, own));
            return if det_change > 0.0 { turns(radius, either) } else { f64::INFINITY };
        }
        let mut inside_turns = turns(det.abs() - radius, strip_change(det.signum(), own));
        // From well inside, another border than the nearest may be the first that a change brings up.
        for (a, b) in AROUND.into_iter().filter(|_| radius < det.abs()) {
            let strip = turns(det.abs() - (a * lambda + b * gamma), strip_change(det.signum(), (a, b)));
            inside_turns = inside_turns.min(strip);
        }
        let volume_change = change(DVec3::ZERO, v.cross(q), q.cross(*u), normal);
        // D through zero turns the sign of t as well.
        let front_turns = turns(*volume, volume_change).min(det_turns);
        let reach_turns = turns(volume.abs() - MISS * det.abs(), volume_change + MISS * det_change);

        let conditions = [
            (radius <= det.abs(), inside_turns),
            (-volume * det >= 0.0, front_turns),
            (volume.abs() < MISS * det.abs(), reach_turns),
        ];
        if conditions.iter().all(|(holds, _)| *holds) {
            conditions.into_iter().map(|(_, turns)| turns).fold(det_turns, f64::min)
        } else {
            conditions.into_iter().filter(|(holds, _)| !holds).map(|(_, turns)| turns).fold(0.0, f64::max)
        }
    }
}

#[cfg(test)]
mod tests;
