//! Principal axes of an ellipse from two conjugate semi-axes: the SVD of the 3x2 matrix [V1 V2].
//!
//! Lengths are its singular values, axes its left singular vectors, both signs of which are right. With the dot
//! products d11, d22, d12, tau = (d11 - d22)/2, h = hypot(tau, d12) and N = V1 x V2:
//!
//! ```text
//! l_max^2 = (d11 + d22)/2 + h        l_min = |N| / l_max
//! D_max   = (tau + h) V1 + d12 V2  if tau >= 0,  else  d12 V1 + (h - tau) V2        D_min = N x D_max
//! ```
//!
//! No step cancels but tau, d12 and N. Products of two f32 are exact in f64, so each component of N is one rounding
//! away from exact, and tau and d12 are sums of six and three exact terms, which escalation adds exactly.

use glam::{DVec2, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Relation, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::exact;
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, landmarks};

pub(super) struct EllipseAxes;

const MAJOR: usize = 0;
const MINOR: usize = 1;
const MAJOR_LEN: usize = 2;
const MINOR_LEN: usize = 3;

/// The angle in radians that exact sums are taken for.
const ACCURACY: f64 = 1.0 / (1u64 << 34) as f64;

impl Problem for EllipseAxes {
    fn name(&self) -> &'static str {
        "ellipse_axes"
    }

    fn summary(&self) -> &'static str {
        "Principal axes and lengths of an ellipse given by two conjugate semi-axes (2D eigensystem)"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("v1", Type::Vec3), Field::new("v2", Type::Vec3)] }
    }

    /// A length off by 0.1 % or an axis by 1 mrad shows in a rendered highlight of 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const AXIS: Quantity = Quantity::UnitVector { sign_free: true };
        const {
            &[
                Output::new("major", Type::Vec3, AXIS, 1e-3),
                Output::new("minor", Type::Vec3, AXIS, 1e-3),
                Output::new("major_len", Type::Float, Quantity::Magnitude, 1e-3),
                Output::new("minor_len", Type::Float, Quantity::Magnitude, 1e-3).headline(),
            ]
        }
    }

    fn relations(&self) -> &'static [Relation] {
        &[Relation::Orthogonal(MAJOR, MINOR)]
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "elliptic lights of 5 cm to 5 m, semi-axes 1:1 to 5:1, under an inverse LTC matrix of roughness 0.1 to 1",
                draw: scene,
            },
            Scenario {
                name: "aspect",
                summary: "aspect log-uniform in 1..1e6, any conjugate pair, any orientation, lengths 2^-4..2^4",
                draw: |draw, row| {
                    let aspect = draw.log_uniform(1.0, 1e6);
                    let length = draw.log_uniform(0.0625, 16.0);
                    conjugate_pair(draw, length, length / aspect, row);
                },
            },
            Scenario {
                name: "near_circle",
                summary: "aspect 1 + log-uniform 2^-26..2^-2: the axes' direction fades into rounding",
                draw: |draw, row| {
                    let excess = draw.log_uniform(1.0 / 67_108_864.0, 0.25);
                    let length = draw.log_uniform(0.0625, 16.0);
                    conjugate_pair(draw, length, length / (1.0 + excess), row);
                },
            },
            Scenario {
                name: "scale",
                summary: "lengths log-uniform in 2^-40..2^40, aspect 1..100: squares and fourth powers leave f32",
                draw: |draw, row| {
                    let length = draw.log_uniform(libm::exp2(-40.0), libm::exp2(40.0));
                    let aspect = draw.log_uniform(1.0, 100.0);
                    conjugate_pair(draw, length, length / aspect, row);
                },
            },
            Scenario {
                name: "edge",
                summary: "zero, parallel, equal, circular, subnormal, mixed-scale vectors and landmark neighbours",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "aspect",
                summary: "major over minor length",
                edges: &[1.0 + 1e-6, 1.0 + 1e-3, 1.1, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6],
                coordinate: |_, truth| truth.output(MAJOR_LEN)[0] / truth.output(MINOR_LEN)[0],
            },
            Landmark {
                name: "skew",
                summary: "sine of the angle between V1 and V2; 1: they are the axes up to scale",
                edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9],
                coordinate: |input, _| {
                    let (v1, v2) = vectors(input);
                    cross(v1, v2).length() / (v1.length() * v2.length())
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let (v1, v2) = vectors(input);
        let sum = v1.length_squared() + v2.length_squared();
        if sum == 0.0 {
            truth.unit_vector(MAJOR, DVec3::X, 0.0, f64::INFINITY);
            truth.unit_vector(MINOR, DVec3::Y, 0.0, f64::INFINITY);
            truth.scalar(MAJOR_LEN, 0.0, 0.0, 0.0);
            truth.scalar(MINOR_LEN, 0.0, 0.0, 0.0);
            return;
        }

        let mut tau = 0.5 * (v1.length_squared() - v2.length_squared());
        let mut d12 = v1.dot(v2);
        let mut h = libm::hypot(tau, d12);
        // Each dot product of exact terms is off by at most 2 EPS of its absolute sum, so (tau, d12) by 4 EPS sum; half
        // the angle by which that turns (tau, d12) is the most by which the axes turn.
        let mut turn = 2.0 * EPS * sum / h;
        if !(turn <= ACCURACY) {
            truth.escalate();
            let terms = |a: DVec3, b: DVec3| (a * b).to_array();
            let ([a, b, c], [d, e, f]) = (terms(v1, v1), terms(v2, v2));
            tau = 0.5 * exact::sum(&[a, b, c, -d, -e, -f]);
            d12 = exact::sum(&terms(v1, v2));
            h = libm::hypot(tau, d12);
            turn = 4.0 * EPS;
        }

        let n = cross(v1, v2);
        let area = n.length();
        let major_len = libm::sqrt(0.5 * sum + h);
        let minor_len = area / major_len;
        // The right singular vector of the major axis, up to its length, from two terms of one sign.
        let right = if tau >= 0.0 { DVec2::new(tau + h, d12) } else { DVec2::new(d12, h - tau) };
        let (major, right) = if h > 0.0 {
            ((right.x * v1 + right.y * v2).normalize(), right.normalize())
        } else {
            (v1.normalize(), DVec2::X)
        };
        let minor = if area > 0.0 { n.cross(major).normalize() } else { major.any_orthonormal_vector() };

        // First-order change of u^T A w when every entry of A = [V1 V2] changes by up to its own magnitude.
        let change = |u: DVec3, w: DVec2| u.abs().dot(v1.abs() * w.x.abs() + v2.abs() * w.y.abs());
        let other = DVec2::new(-right.y, right.x);
        let major_change = change(major, right);
        // Without an area the minor axis is arbitrary: any direction may be the one that the change opens.
        let minor_change = if area > 0.0 { change(minor, other) } else { libm::sqrt(sum) };
        let in_plane = (major_len * change(minor, right) + minor_len * change(major, other)) / (2.0 * h);
        let normal = if area > 0.0 { n / area } else { DVec3::ONE };
        let major_turn = in_plane + change(normal, right) / major_len;
        let minor_turn = in_plane + change(normal, other) / minor_len;
        let defined = |defined: bool, turn: f64| if defined { turn } else { f64::INFINITY };

        truth.unit_vector(MAJOR, major, turn + 8.0 * EPS, defined(h > 0.0, major_turn));
        truth.unit_vector(MINOR, minor, turn + 16.0 * EPS, defined(h > 0.0 && area > 0.0, minor_turn));
        truth.scalar(MAJOR_LEN, major_len, 4.0 * EPS * major_len, major_change);
        truth.scalar(MINOR_LEN, minor_len, 12.0 * EPS * minor_len, minor_change);
    }
}

fn vectors(input: &[f32]) -> (DVec3, DVec3) {
    let component = |i: usize| f64::from(input[i]);
    (
        DVec3::new(component(0), component(1), component(2)),
        DVec3::new(component(3), component(4), component(5)),
    )
}

/// a x b for vectors of f32 values: every product is exact, so every component is rounded once.
fn cross(a: DVec3, b: DVec3) -> DVec3 {
    a.cross(b)
}

fn store(row: &mut [f32], v1: DVec3, v2: DVec3) {
    for (slot, value) in row.iter_mut().zip(v1.to_array().into_iter().chain(v2.to_array())) {
        *slot = value as f32;
    }
}

/// Any conjugate pair of the ellipse with these semi-axis lengths, in any orientation.
fn conjugate_pair(draw: &mut Draw, major: f64, minor: f64, row: &mut [f32]) {
    let frame = draw.frame();
    let (cos, sin) = draw.angle();
    let (a, b) = (major * frame.x_axis, minor * frame.y_axis);
    store(row, cos * a + sin * b, cos * b - sin * a);
}

fn scene(draw: &mut Draw, row: &mut [f32]) {
    let radius = draw.log_uniform(0.05, 5.0);
    let ratio = draw.uniform(0.2, 1.0);
    let frame = draw.frame();
    let roughness = draw.log_uniform(0.1, 1.0);
    let (stretch, flatten) = (1.0 / roughness, draw.uniform(0.5, 1.0));
    let (shear_x, shear_z) = (draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5));
    let minv = glam::DMat3::from_cols(
        DVec3::new(stretch, 0.0, shear_z),
        DVec3::new(0.0, flatten * stretch, 0.0),
        DVec3::new(shear_x * stretch, 0.0, 1.0),
    );
    store(row, minv * (radius * frame.x_axis), minv * (radius * ratio * frame.y_axis));
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(10);
    let direction = draw.direction();
    let v1 = draw.log_uniform(1e-3, 1e3) * direction;
    // Rounded first, so that what follows is exact in f32 where it says so.
    let v1 = DVec3::from_array(v1.to_array().map(|c| f64::from(c as f32)));
    match kind {
        0 => store(row, DVec3::ZERO, if draw.sign() > 0.0 { v1 } else { DVec3::ZERO }),
        1 => store(row, v1, DVec3::ZERO),
        // Exactly parallel, by a power of two; then nearly parallel, by a factor that rounds.
        2 => store(row, v1, draw.sign() * libm::exp2(f64::from(draw.below(41)) - 20.0) * v1),
        3 => store(row, v1, draw.sign() * draw.log_uniform(0.01, 100.0) * v1),
        4 => store(row, v1, v1),
        // An exact circle, in a coordinate plane.
        5 => store(row, DVec3::new(v1.x, v1.y, 0.0), DVec3::new(-v1.y, v1.x, 0.0)),
        6 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        7 => row.fill_with(|| (draw.sign() * draw.log_uniform(1e-15, 1e15)) as f32),
        8 => {
            let (a, b) = (landmarks::near_landmark(draw), landmarks::near_landmark(draw));
            row.fill(0.0);
            let axis = draw.below(3) as usize;
            row[axis] = a;
            row[3 + (axis + 1) % 3] = b;
        }
        _ => row.fill_with(|| landmarks::near_landmark(draw)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(EllipseAxes.outputs());
        EllipseAxes.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32], &Truth)) {
        let scenario = EllipseAxes.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 6];
            (scenario.draw)(draw, &mut row);
            visit(&row, &truth_of(&row));
        });
    }

    #[test]
    fn every_truth_is_certified_and_satisfies_the_definition() {
        for scenario in EllipseAxes.scenarios() {
            each(scenario.name, 20_000, |row, truth| {
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!(truth.values().iter().all(|value| value.is_finite()), "{row:?}: {truth:?}");
                let (v1, v2) = vectors(row);
                let (major, minor) =
                    (DVec3::from_slice(truth.output(MAJOR)), DVec3::from_slice(truth.output(MINOR)));
                let (major_len, minor_len) = (truth.output(MAJOR_LEN)[0], truth.output(MINOR_LEN)[0]);
                // The axes are left singular vectors: A^T u has the singular value's length. Rounding in this very
                // check is 8 EPS of the major length.
                let along = |u: DVec3| libm::hypot(u.dot(v1), u.dot(v2));
                let slack = 16.0 * EPS * major_len;
                assert!((along(major) - major_len).abs() <= slack, "{row:?}");
                assert!((along(minor) - minor_len).abs() <= slack, "{row:?}");
                assert!(major.dot(minor).abs() <= 8.0 * EPS, "{row:?}");
                assert!(major_len >= minor_len * (1.0 - 16.0 * EPS), "{row:?}");
            });
        }
    }

    /// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        let scenario = EllipseAxes.scenario("scene").unwrap();
        Stream::new(5, "sensitivity").visit(0, 5_000, |_, draw| {
            let mut row = [0.0; 6];
            (scenario.draw)(draw, &mut row);
            let before = truth_of(&row);
            let step = 2f64.powi(-12);
            let changed: Vec<f32> =
                row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
            let after = truth_of(&changed);
            for output in [MAJOR_LEN, MINOR_LEN] {
                let change = (after.output(output)[0] - before.output(output)[0]).abs() / step;
                worst = worst.max(change / before.sensitivities()[output]);
            }
            let (a, b) = (DVec3::from_slice(before.output(MINOR)), DVec3::from_slice(after.output(MINOR)));
            let sensitivity = before.sensitivities()[MINOR];
            // First order only: leave out what turns by more than a tenth of a radian.
            if sensitivity * step < 0.1 {
                worst = worst.max(a.cross(b).length() / step / sensitivity);
            }
        });
        // 1.1: second-order terms at a step of 2^-12. 0.3: all signs at their worst are rare among 5000 draws.
        assert!((0.3..=1.1).contains(&worst), "{worst}");
    }

    #[test]
    fn near_circles_escalate() {
        let mut escalated = 0;
        each("near_circle", 10_000, |_, truth| escalated += u32::from(truth.escalated()));
        assert!((1..5_000).contains(&escalated), "{escalated}");
        each("aspect", 1_000, |row, truth| {
            assert!(
                !truth.escalated() || truth.output(MAJOR_LEN)[0] < 1.01 * truth.output(MINOR_LEN)[0],
                "{row:?}"
            )
        });
    }
}
