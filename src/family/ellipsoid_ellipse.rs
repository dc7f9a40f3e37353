//! The ellipse that covers the same directions as an ellipsoid: its centre and its principal semi-axes, as vectors.
//!
//! Source: Heitz, "Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid", 2016. With
//! centre c, semi-axes r along the columns of R (the rotation of q/|q|; the identity for q = 0), b = R^T c, v = r_x r_y r_z and
//! g_k = b_k v/r_k, the paper's P_b is g/v, and in the ellipsoid's own frame the ellipse is
//!
//! ```text
//! centre (1 - v^2/|g|^2) b        semi-axes: those of (1 - v^2/|g|^2) D (I - g g^T/|g|^2) D,  D = diag(r)
//! ```
//!
//! Its 2D eigensystem is taken in the basis a, g x a of the plane across g, a in a coordinate plane, all in twofold
//! arithmetic: sums and differences of diagonal entries are exact to 2^-90, wherever they cancel.
//!
//! Stated answers: from inside or on the ellipsoid there is no ellipse, and centre and axes are all zero; likewise where
//! nothing is seen, with two zero semi-axes, or one that is seen edge-on. One zero semi-axis is an ellipse already. The
//! axes of a circle have a length but no direction.

use glam::{DMat3, DVec3};

use super::ellipsoid_scenes::{CENTER, INPUTS, LANDMARKS, RADIUS, ROTATION, SCENARIOS};
use super::problem::{Landmark, Output, Problem, Quantity, Relation, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::exact3;
use crate::numeric::rotation::Rotation;
use crate::numeric::spacing::{EPS, UNIT_ROUNDOFF};
use crate::numeric::twofold::Twofold;

pub(super) struct EllipsoidEllipse;

const ELLIPSE_CENTER: usize = 0;
const MAJOR: usize = 1;
const MINOR: usize = 2;

/// A difference of the two eigenvalues below this share of their sum counts as none: 2^-60, f32 roundings to the power 2.5.
const CIRCLE: f64 = 1.0 / (1u64 << 60) as f64;
/// What twofold arithmetic leaves of the difference, as a share of the sum.
const TWOFOLD: f64 = 1.0 / (1u128 << 90) as f64;

impl Problem for EllipsoidEllipse {
    fn name(&self) -> &'static str {
        "ellipsoid_ellipse"
    }

    fn summary(&self) -> &'static str {
        "The ellipse that covers the same directions as an ellipsoid: centre and principal semi-axes"
    }

    fn inputs(&self) -> &'static [Field] {
        INPUTS
    }

    /// A light whose outline is off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const AXIS: Quantity = Quantity::Vector { sign_free: true };
        const {
            &[
                Output::new("center", Type::Vec3, Quantity::Vector { sign_free: false }, 1e-3),
                Output::new("major", Type::Vec3, AXIS, 1e-3),
                Output::new("minor", Type::Vec3, AXIS, 1e-3).headline(),
            ]
        }
    }

    fn relations(&self) -> &'static [Relation] {
        &[Relation::Orthogonal(MAJOR, MINOR)]
    }

    fn scenarios(&self) -> &'static [Scenario] {
        SCENARIOS
    }

    fn landmarks(&self) -> &'static [Landmark] {
        LANDMARKS
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let body = Body::new(input);
        let outside = (body.g2 - body.v * body.v).value();
        let by_length = body.unit.recip();
        if outside <= 0.0 {
            // Just inside, four roundings may open a gap: share up to what they change it by.
            let gap =
                4.0 * UNIT_ROUNDOFF * body.share_changes().iter().map(|change| change.abs()).sum::<f64>();
            let near = body.g2.value() > 0.0 && -outside <= gap * body.g2.value();
            let (center, axis) = if near { (gap, libm::sqrt(gap)) } else { (0.0, 0.0) };
            let sensitivity = |size: f64, length: f64| size * length * by_length / (4.0 * UNIT_ROUNDOFF);
            truth.vector(ELLIPSE_CENTER, DVec3::ZERO, 0.0, sensitivity(center, body.b.length()));
            truth.vector(MAJOR, DVec3::ZERO, 0.0, sensitivity(axis, body.r.max_element()));
            truth.vector(MINOR, DVec3::ZERO, 0.0, sensitivity(axis, body.r.max_element()));
            return;
        }
        let share = outside / body.g2.value();
        let center = share * exact3::vector(&input[CENTER..]);
        let ellipse = body.ellipse(share);
        let changes = body.changes(share, &ellipse);
        let matrix = body.rotation.matrix();

        truth.vector(ELLIPSE_CENTER, center, 5.0 * EPS * center.length(), changes[0] * by_length);
        for (output, k) in [(MAJOR, 0), (MINOR, 1)] {
            let length = ellipse.lengths[k] * by_length;
            // Rounding of a dozen steps, none of which cancels, and the turn that the eigensystem leaves.
            let bound = length * (24.0 * EPS + ellipse.turn);
            truth.vector(output, length * (matrix * ellipse.axes[k]), bound, changes[1 + k] * by_length);
        }
    }
}

/// An ellipsoid in its own frame, lengths times a power of two.
struct Body {
    unit: f64,
    rotation: Rotation,
    r: DVec3,
    b: DVec3,
    /// The normal of the ellipse's preimage, and v, times a power of two that brings the larger to 1/2..1.
    g: exact3::Vector,
    v: Twofold,
    g2: Twofold,
}

/// Principal semi-axes in the ellipsoid's frame.
struct Ellipse {
    /// Unit: major, minor, across the ellipse.
    axes: [DVec3; 3],
    lengths: [f64; 2],
    /// Half the difference of the squared lengths over the sum.
    split: f64,
    /// By how much the axes may be turned; without a difference they may be any.
    turn: f64,
}

impl Body {
    fn new(input: &[f32]) -> Self {
        let (center, radius) = (exact3::vector(&input[CENTER..]), exact3::vector(&input[RADIUS..]).abs());
        let power = |largest: f64| libm::ldexp(1.0, -libm::frexp(largest).1);
        let unit = power(center.abs().max_element().max(radius.max_element()));
        let (c, r) = (center * unit, radius * unit);
        let rotation = Rotation::new(&input[ROTATION..RADIUS]);
        let b = rotation.columns.map(|a| a[0] * c.x + a[1] * c.y + a[2] * c.z);
        let product = Twofold::product;
        let g = [b[0] * product(r.y, r.z), b[1] * product(r.z, r.x), b[2] * product(r.x, r.y)];
        let v = product(r.x, r.y) * r.z;
        let scale = power(g.iter().fold(v.value(), |largest, g| largest.max(g.value().abs())));
        let (g, v) = (g.map(|g| g.scaled(scale)), v.scaled(scale));
        let g2 = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        let b = DVec3::from_array(b.map(|b| b.value()));
        Body { unit, rotation, r, b, g, v, g2 }
    }

    fn ellipse(&self, share: f64) -> Ellipse {
        let (g, g2) = (self.g, self.g2);
        let size = g.map(|g| g.value().abs());
        // a has the two largest components of g, turned by a right angle.
        let drop = (0..3).fold(0, |least, k| if size[k] < size[least] { k } else { least });
        let (i, j) = ((drop + 1) % 3, (drop + 2) % 3);
        let zero = Twofold::ZERO;
        let mut a = [zero; 3];
        (a[i], a[j]) = (-g[j], g[i]);
        let n = g[i] * g[i] + g[j] * g[j];
        // g x a, of length sqrt(g2 n).
        let mut other = [zero; 3];
        (other[i], other[j], other[drop]) = (-(g[drop] * g[i]), -(g[drop] * g[j]), n);

        let r = self.r.to_array();
        let stretched = |v: &exact3::Vector| [0, 1, 2].map(|k| v[k] * r[k]);
        let dot = |u: &exact3::Vector, v: &exact3::Vector| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let (da, dother) = (stretched(&a), stretched(&other));
        // Gram matrix of D a/|a| and D (g x a)/|g x a|, times n g2.
        let (q11, q22) = (g2 * dot(&da, &da), dot(&dother, &dother));
        let q12 = libm::sqrt(g2.value()) * dot(&da, &dother).value();
        let tau = 0.5 * (q11 - q22).value();
        let h = libm::hypot(tau, q12);
        let sum = (q11 + q22).value();
        let scale = n.value() * g2.value();
        let major2 = (0.5 * sum + h) / scale;
        let flat = DVec3::new(r[1] * r[2] * size[0], r[2] * r[0] * size[1], r[0] * r[1] * size[2]);
        let minor2 = flat.length_squared() / (g2.value() * major2);

        let vector = |v: exact3::Vector, length: f64| DVec3::from_array(v.map(|c| c.value())) / length;
        let (first, second) = (vector(da, libm::sqrt(n.value())), vector(dother, libm::sqrt(scale)));
        let split = h / sum;
        let along = if split <= CIRCLE {
            first
        } else if tau >= 0.0 {
            (tau + h) * first + q12 * second
        } else {
            q12 * first + (h - tau) * second
        };
        let signs = DVec3::from_array(g.map(|g| 1.0f64.copysign(g.value())));
        let (major, across) = (along.normalize(), (flat * signs).normalize());
        let minor = across.cross(major);
        let root = libm::sqrt(share);
        let lengths = [root * libm::sqrt(major2), root * libm::sqrt(minor2.min(major2))];
        let turn = if split <= CIRCLE { 0.0 } else { TWOFOLD / split };
        Ellipse { axes: [major, minor, across], lengths, split, turn }
    }

    /// Changes of share = 1 - v^2/|g|^2 for a relative change of each component of c, q and r by one.
    fn share_changes(&self) -> [f64; 10] {
        let mut changes = [0.0; 10];
        for (change, Step { b, r, .. }) in changes.iter_mut().zip(self.steps()) {
            *change = -self.iota_change(b, r);
        }
        changes
    }

    /// What a relative change of each input by one does to b and to r, and by how much it turns the frame.
    fn steps(&self) -> [Step; 10] {
        let matrix = self.rotation.matrix();
        let c = matrix * self.b;
        let mut steps = [Step { b: DVec3::ZERO, r: DVec3::ZERO, turn: DVec3::ZERO }; 10];
        for k in 0..3 {
            steps[k].b = matrix.transpose() * (c * DVec3::AXES[k]);
            steps[RADIUS + k].r = DVec3::AXES[k];
        }
        for (step, turn) in steps[ROTATION..].iter_mut().zip(self.rotation.turns()) {
            step.turn = matrix.transpose() * turn;
            step.b = self.b.cross(step.turn);
        }
        steps
    }

    /// Change of v^2/|g|^2 = 1/|P_b|^2 for the changes of b and, relative, of r.
    fn iota_change(&self, b: DVec3, r: DVec3) -> f64 {
        let (v, g2) = (self.v.value(), self.g2.value());
        if g2 == 0.0 {
            return 0.0;
        }
        let q = v / g2 * DVec3::from_array(self.g.map(|g| g.value()));
        // v/r_k times the scale of g, from g_k/b_k where v itself may be 0.
        let inverse =
            DVec3::new(self.r.y * self.r.z, self.r.z * self.r.x, self.r.x * self.r.y) * self.scale_of_g();
        -2.0 * ((q * (v / g2) * inverse).dot(b) - (q * q).dot(r))
    }

    /// The power of two by which g was multiplied.
    fn scale_of_g(&self) -> f64 {
        let k =
            (0..3).fold(
                0,
                |largest, k| {
                    if self.g[k].value().abs() > self.g[largest].value().abs() { k } else { largest }
                },
            );
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        self.g[k].value() / (self.b[k] * self.r[i] * self.r[j])
    }

    /// Sensitivities of centre, major and minor semi-axis.
    fn changes(&self, share: f64, ellipse: &Ellipse) -> [f64; 3] {
        let g = DVec3::from_array(self.g.map(|g| g.value()));
        let (r, b) = (self.r, self.b);
        let iota = 1.0 - share;
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        // D (I - g g^T/g2) D, its diagonal without cancellation.
        let g2 = self.g2.value();
        let squares = g * g;
        let rest = DVec3::new(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
        let mut plane = -outer(r * g, r * g) * (1.0 / g2);
        for k in 0..3 {
            plane.col_mut(k)[k] = r[k] * r[k] * rest[k] / g2;
        }
        let [w1, w2, w3] = ellipse.axes;
        let [l1, l2] = ellipse.lengths;
        let (s1, s2) = (l1 * l1, l2 * l2);
        let gap = 2.0 * ellipse.split * (s1 + s2);
        let mut sums = [0.0; 3];
        for step in self.steps() {
            let d_iota = self.iota_change(step.b, step.r);
            let of_radius = DMat3::from_diagonal(2.0 * r * r * step.r);
            let of_center = (outer(step.b, b) + outer(b, step.b)) * iota + outer(b, b) * d_iota;
            let change = plane * -d_iota + (of_radius - of_center) * share;
            let (of_major, of_minor) = (change * w1, change * w2);
            let between = w2.dot(of_major);
            // In the frame's own turn as well.
            let center = share * (step.b + step.turn.cross(b)) - d_iota * b;
            let major = w1 * (w1.dot(of_major) / (2.0 * l1))
                + l1 * (w2 * (between / gap) + w3 * (w3.dot(of_major) / s1))
                + step.turn.cross(l1 * w1);
            let minor = w2 * (w2.dot(of_minor) / (2.0 * l2))
                + l2 * (w3 * (w3.dot(of_minor) / s2) - w1 * (between / gap))
                + step.turn.cross(l2 * w2);
            sums[0] += center.length();
            sums[1] += major.length();
            sums[2] += minor.length();
        }
        if ellipse.split <= CIRCLE {
            sums[1..].fill(f64::INFINITY);
        } else if l2 == 0.0 {
            sums[2] = 0.0;
        }
        sums
    }
}

#[derive(Clone, Copy)]
struct Step {
    b: DVec3,
    r: DVec3,
    turn: DVec3,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(EllipsoidEllipse.outputs());
        EllipsoidEllipse.oracle(input, &mut truth);
        truth
    }

    fn vectors(truth: &Truth) -> [DVec3; 3] {
        [ELLIPSE_CENTER, MAJOR, MINOR].map(|output| DVec3::from_slice(truth.output(output)))
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut crate::sample::Draw, &[f32], &Truth)) {
        let scenario = EllipsoidEllipse.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 10];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    #[test]
    fn every_truth_is_certified_and_finite() {
        for scenario in EllipsoidEllipse.scenarios() {
            let mut seen = 0;
            each(scenario.name, 20_000, |_, row, truth| {
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!(truth.values().iter().all(|value| value.is_finite()), "{row:?}: {truth:?}");
                assert!(truth.sensitivities().iter().all(|value| *value >= 0.0), "{row:?}: {truth:?}");
                let [_, major, minor] = vectors(truth);
                assert!(
                    major.dot(minor).abs() <= 1e-14 * major.length() * minor.length(),
                    "{row:?}: {truth:?}"
                );
                assert!(minor.length() <= major.length() * (1.0 + 1e-15), "{row:?}: {truth:?}");
                seen += u32::from(major.length() > 0.0);
            });
            assert!(seen > 10_000, "{}: {seen}", scenario.name);
        }
    }

    /// The definition: the ray through every point of the ellipse's rim touches the ellipsoid. With P = D^-1 R^T, the ray
    /// t p touches the unit sphere about P c where (P p . P c)^2 = |P p|^2 (|P c|^2 - 1).
    #[test]
    fn rays_through_the_rim_touch_the_ellipsoid() {
        for scenario in ["scene", "sphere", "far"] {
            each(scenario, 2_000, |draw, row, truth| {
                let [center, major, minor] = vectors(truth);
                let rotation = Rotation::new(&row[ROTATION..RADIUS]).matrix();
                let to_sphere = |p: DVec3| rotation.transpose() * p / exact3::vector(&row[RADIUS..]);
                let (cos, sin) = draw.angle();
                let p = to_sphere(center + cos * major + sin * minor);
                let c = to_sphere(exact3::vector(row));
                let (left, right) = (p.dot(c) * p.dot(c), p.length_squared() * (c.length_squared() - 1.0));
                // A squared sine of up to 1/|c|^2 is what the two differ by where the ray misses by a radius.
                let slack = 1e-13 * p.length_squared() * c.length_squared();
                assert!((left - right).abs() <= slack, "{row:?}: {left} {right}");
            });
        }
    }

    #[test]
    fn stated_answers() {
        let row =
            |center: [f32; 3], radius: [f32; 3]| [center.as_slice(), &[0.0, 0.0, 0.0, 1.0], &radius].concat();
        let nothing = [DVec3::ZERO; 3];
        assert_eq!(vectors(&truth_of(&row([0.1, 0.2, 0.0], [1.0, 0.5, 2.0]))), nothing);
        assert_eq!(vectors(&truth_of(&row([0.0, 0.0, 2.0], [1.0, 0.5, 2.0]))), nothing);
        assert_eq!(vectors(&truth_of(&row([0.0, 1.0, 2.0], [1.0, 0.0, 0.0]))), nothing);
        assert_eq!(vectors(&truth_of(&row([3.0, 0.0, 0.0], [1.0, 1.0, 0.0]))), nothing);
        // A flat one is itself.
        let [center, major, minor] = vectors(&truth_of(&row([1.0, 2.0, 2.0], [2.0, 1.0, 0.0])));
        assert_eq!(center, DVec3::new(1.0, 2.0, 2.0));
        assert!((major.abs() - 2.0 * DVec3::X).length() < 1e-15 && (minor.abs() - DVec3::Y).length() < 1e-15);
        // A sphere's disk: 1 - (r/d)^2 of the centre, radius r sqrt(1 - (r/d)^2).
        let truth = truth_of(&row([0.0, 0.0, 2.0], [1.0; 3]));
        let [center, major, minor] = vectors(&truth);
        assert_eq!(center, DVec3::new(0.0, 0.0, 1.5));
        assert!(
            (major.length_squared() - 0.75).abs() < 1e-15 && (minor.length_squared() - 0.75).abs() < 1e-15
        );
        assert_eq!(truth.sensitivities()[1..], [f64::INFINITY; 2]);
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for name in ["scene", "flat", "far", "near_surface"] {
            let mut worst = [0.0f64; 3];
            each(name, 3_000, |draw, row, before| {
                let step = 2f64.powi(-20);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let after = truth_of(&changed);
                for (output, (a, b)) in vectors(before).into_iter().zip(vectors(&after)).enumerate() {
                    let (here, there) = (before.sensitivities()[output], after.sensitivities()[output]);
                    // First order only: not where it changes by a twentieth, or the slope itself by a tenth.
                    if here * step < 0.05 * a.length() && (there / here - 1.0).abs() < 0.1 {
                        let change = (a - b).length().min((a + b).length()) / step;
                        worst[output] = worst[output].max(change / here);
                    }
                }
            });
            // 1.2: second order at this step. 0.3: ten signs and directions at their worst are rare.
            assert!(worst.iter().all(|worst| (0.3..=1.2).contains(worst)), "{name}: {worst:?}");
        }
    }
}
