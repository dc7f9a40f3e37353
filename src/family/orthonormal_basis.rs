//! A right-handed orthonormal basis about a normal: b1, b2 and n, with b1 x b2 = n.
//!
//! Any turn about n gives another one, so truth is a property. With n' = n/|n| its residuals are
//!
//! ```text
//! |b1|^2 - 1    |b2|^2 - 1    b1.b2    b1.n'    b2.n'    [b1, b2, n'] - 1
//! ```
//!
//! and an output's error is the largest of those that it takes part in, by magnitude. n is a unit vector only up to the
//! rounding of its components, so it is its direction that counts: for every n but 0 there is a basis without any
//! residual, and a form that needs |n| = 1 exactly answers for what it makes of 2^-24.
//!
//! n = 0 has no direction: any finite answer is right, and the oracle's is (1, 0, 0), (0, 1, 0).

use glam::DVec3;

use super::problem::{Landmark, Output, Problem, Quantity, Relation, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, landmarks};

pub(super) struct OrthonormalBasis;

const B1: usize = 0;
const B2: usize = 1;

/// How far n may be from a pole, as 1 - |z|: decades, and the last steps of f32.
const POLE: &[f64] = &[6.0e-8, 1.2e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0];

impl Problem for OrthonormalBasis {
    fn name(&self) -> &'static str {
        "orthonormal_basis"
    }

    fn summary(&self) -> &'static str {
        "Two unit vectors that complete a unit normal to a right-handed orthonormal basis"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("n", Type::Vec3)] }
    }

    /// As for other axes: 1e-3 of length or of a radian shows in a highlight of 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const {
            &[
                Output::new("b1", Type::Vec3, Quantity::Property, 1e-3).headline(),
                Output::new("b2", Type::Vec3, Quantity::Property, 1e-3).headline(),
            ]
        }
    }

    fn relations(&self) -> &'static [Relation] {
        &[Relation::Orthogonal(B1, B2)]
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "sphere",
                summary: "normals uniform on the sphere, rounded to f32",
                draw: |draw, row| store(row, draw.direction()),
            },
            Scenario {
                name: "near_minus_z",
                summary: "1 + z log-uniform in 2^-24..1: the pole that Frisvad's form divides by",
                draw: |draw, row| store(row, -near_z(draw)),
            },
            Scenario {
                name: "near_plus_z",
                summary: "1 - z log-uniform in 2^-24..1: normals of a height field",
                draw: |draw, row| store(row, near_z(draw)),
            },
            Scenario {
                name: "equator",
                summary: "|z| log-uniform in 2^-40..1: where forms by the sign of z change sides",
                draw: |draw, row| {
                    let z = draw.sign() * draw.log_uniform(libm::exp2(-40.0), 1.0);
                    let (cos, sin) = draw.angle();
                    let r = libm::sqrt(1.0 - z * z);
                    store(row, DVec3::new(r * cos, r * sin, z));
                },
            },
            Scenario {
                name: "not_unit",
                summary: "length off by log-uniform 2^-24..2^-12, half of them near the poles: normals after a few operations",
                draw: |draw, row| {
                    let scale = 1.0 + draw.sign() * draw.log_uniform(libm::exp2(-24.0), libm::exp2(-12.0));
                    let pole = draw.sign() > 0.0;
                    let n = if pole { draw.sign() * near_z(draw) } else { draw.direction() };
                    store(row, scale * n);
                },
            },
            Scenario {
                name: "edge",
                summary: "axes, zeros of either sign, coordinate planes, diagonals, thresholds and landmark neighbours",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "one_plus_z",
                summary: "1 + z of n/|n|; at 0 the pole -z",
                edges: POLE,
                coordinate: |input, _| pole_distance(input, -1.0),
            },
            Landmark {
                name: "one_minus_z",
                summary: "1 - z of n/|n|; at 0 the pole +z",
                edges: POLE,
                coordinate: |input, _| pole_distance(input, 1.0),
            },
            Landmark {
                name: "length_error",
                summary: "| |n| - 1 |: rounding of unit components leaves 2^-24",
                edges: &[1.0 / 67_108_864.0, 1.0 / 16_777_216.0, 2.5e-7, 1e-6, 1e-5, 1e-4],
                coordinate: |input, _| (normal(input).length() - 1.0).abs(),
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let Some(n) = direction(input) else {
            truth.unit_vector(B1, DVec3::X, 0.0, f64::INFINITY);
            truth.unit_vector(B2, DVec3::Y, 0.0, f64::INFINITY);
            return;
        };
        let (b1, b2) = basis(n);
        // An input change turns n' by up to 2^-24, which is then the residual of an unchanged basis with it; other
        // residuals change to second order.
        truth.unit_vector(B1, b1, 8.0 * EPS, 1.0);
        truth.unit_vector(B2, b2, 8.0 * EPS, 1.0);
    }

    fn residual(&self, output: usize, input: &[f32], values: &[f64]) -> f64 {
        let (b1, b2) = (DVec3::from_slice(values), DVec3::from_slice(&values[3..]));
        let Some(n) = direction(input) else {
            return if b1.is_finite() && b2.is_finite() { 0.0 } else { f64::NAN };
        };
        let own = if output == B1 { b1 } else { b2 };
        let residuals = [own.length_squared() - 1.0, own.dot(n), b1.dot(b2), b1.cross(b2).dot(n) - 1.0];
        // Not `f64::max`, which forgets NaN.
        let larger = |worst: f64, r: f64| if worst.is_nan() || r <= worst { worst } else { r };
        residuals.into_iter().map(f64::abs).fold(0.0, larger)
    }
}

/// A basis for a unit vector: n reflected to the axis +-z that is further from it, and so are x and y. The formula of
/// Duff et al., "Building an Orthonormal Basis, Revisited", 2017, here in f64, where it loses 4 EPS.
fn basis(n: DVec3) -> (DVec3, DVec3) {
    let sign = 1f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), DVec3::new(b, sign + n.y * n.y * a, -n.y))
}

fn normal(input: &[f32]) -> DVec3 {
    DVec3::new(f64::from(input[0]), f64::from(input[1]), f64::from(input[2]))
}

/// n/|n|; none for 0. Squares of f32 stay within f64's range.
fn direction(input: &[f32]) -> Option<DVec3> {
    let n = normal(input);
    let length = n.length();
    (length > 0.0).then(|| n / length)
}

/// 1 - sign z of n/|n| without cancellation; NaN for 0.
fn pole_distance(input: &[f32], sign: f64) -> f64 {
    let n = normal(input) / normal(input).length();
    let along = sign * n.z;
    if along > 0.0 { (n.x * n.x + n.y * n.y) / (1.0 + along) } else { 1.0 - along }
}

fn store(row: &mut [f32], n: DVec3) {
    for (slot, value) in row.iter_mut().zip(n.to_array()) {
        *slot = value as f32;
    }
}

/// A unit vector with 1 - z log-uniform in 2^-24..1.
fn near_z(draw: &mut Draw) -> DVec3 {
    let gap = draw.log_uniform(libm::exp2(-24.0), 1.0);
    let (cos, sin) = draw.angle();
    let r = libm::sqrt(gap * (2.0 - gap));
    DVec3::new(r * cos, r * sin, 1.0 - gap)
}

/// Values of z at which published forms change their branch.
const THRESHOLDS: [f32; 8] = [-0.999_999_9, -0.999_999, -0.999_980_57, -0.9999, -0.999, 0.999, 0.0, -0.7];

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(7);
    let zero = |draw: &mut Draw| (0.0 * draw.sign()) as f32;
    let axis = draw.below(3) as usize;
    match kind {
        0 => {
            row.fill_with(|| zero(draw));
            row[axis] = draw.sign() as f32;
        }
        // In a coordinate plane, the zero of either sign.
        1 => {
            let (cos, sin) = draw.angle();
            row[axis] = zero(draw);
            row[(axis + 1) % 3] = cos as f32;
            row[(axis + 2) % 3] = sin as f32;
        }
        // An axis but for neighbours of zero and of 1.
        2 => {
            row.fill_with(|| landmarks::neighbour(0.0, i64::from(draw.below(201)) - 100));
            let inwards = -i64::from(draw.below(5));
            row[axis] = landmarks::neighbour(1.0, inwards) * draw.sign() as f32;
        }
        3 => {
            let threshold = draw.pick(&THRESHOLDS);
            let z = landmarks::neighbour(threshold, i64::from(draw.below(9)) - 4).clamp(-1.0, 1.0);
            unit_with(draw, z, 2, row);
        }
        // One component a landmark or next to it, which may be tiny.
        4 => {
            let value = landmarks::near_landmark(draw);
            unit_with(draw, if value.abs() <= 1.0 { value } else { value.recip() }, axis, row);
        }
        // Components of equal magnitude: ties between them.
        5 => {
            let third = libm::sqrt(1.0 / 3.0) as f32;
            row.fill_with(|| third * draw.sign() as f32);
        }
        _ => {
            let half = libm::sqrt(0.5) as f32;
            row.fill_with(|| half * draw.sign() as f32);
            row[axis] = zero(draw);
        }
    }
}

/// A unit vector with this component, the others random.
fn unit_with(draw: &mut Draw, value: f32, axis: usize, row: &mut [f32]) {
    let (cos, sin) = draw.angle();
    let r = libm::sqrt(1.0 - f64::from(value) * f64::from(value));
    row[axis] = value;
    row[(axis + 1) % 3] = (r * cos) as f32;
    row[(axis + 2) % 3] = (r * sin) as f32;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(OrthonormalBasis.outputs());
        OrthonormalBasis.oracle(input, &mut truth);
        truth
    }

    fn worst_residual(input: &[f32], values: &[f64]) -> f64 {
        [B1, B2]
            .map(|output| OrthonormalBasis.residual(output, input, values))
            .into_iter()
            .fold(0.0, f64::max)
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32])) {
        let scenario = OrthonormalBasis.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 3];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row);
        });
    }

    #[test]
    fn the_oracle_has_the_property() {
        for scenario in OrthonormalBasis.scenarios() {
            each(scenario.name, 20_000, |_, row| {
                let truth = truth_of(row);
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                // Six roundings in the basis and as many in its residuals.
                assert!(worst_residual(row, truth.values()) <= 12.0 * EPS, "{row:?}: {truth:?}");
                // Draws are unit up to what their scenarios say.
                let allowed =
                    if scenario.name == "not_unit" { 2.5e-4 } else { 6.0 * f64::from(f32::EPSILON) };
                assert!((normal(row).length() - 1.0).abs() <= allowed, "{}: {row:?}", scenario.name);
            });
        }
    }

    #[test]
    fn every_flaw_shows_in_the_output_it_belongs_to() {
        let n = [0.0, 0.0, 1.0];
        let residuals =
            |values: [f64; 6]| [B1, B2].map(|output| OrthonormalBasis.residual(output, &n, &values));
        assert_eq!(residuals([1.0, 0.0, 0.0, 0.0, 1.0, 0.0]), [0.0, 0.0]);
        // Turned about n, and left-handed.
        assert_eq!(residuals([0.0, 1.0, 0.0, -1.0, 0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(residuals([0.0, 1.0, 0.0, 1.0, 0.0, 0.0]), [2.0, 2.0]);
        // Too long: |b2|^2 = 1.5625, and the volume is 1.25.
        assert_eq!(residuals([1.0, 0.0, 0.0, 0.0, 1.25, 0.0]), [0.25, 0.5625]);
        // b1 leans towards n; b2 leans towards b1.
        assert_eq!(residuals([1.0, 0.0, 0.125, 0.0, 1.0, 0.0]), [0.125, 0.0]);
        assert_eq!(residuals([1.0, 0.0, 0.0, 0.25, 1.0, 0.0]), [0.25, 0.25]);
        assert!(residuals([1.0, 0.0, 0.0, f64::NAN, 1.0, 0.0]).iter().all(|r| r.is_nan()));
    }

    /// b1.b2 is not a number, and the volume, which comes after it, is one: infinite.
    #[test]
    fn what_is_not_a_number_is_not_forgotten() {
        let infinity = f64::INFINITY;
        let values = [infinity, -infinity, 0.0, 1.0, 1.0, -1.0];
        let (b1, b2) = (DVec3::from_slice(&values), DVec3::from_slice(&values[3..]));
        assert_eq!(b1.cross(b2).dot(DVec3::ONE), infinity);
        for output in [B1, B2] {
            assert!(OrthonormalBasis.residual(output, &[1.0; 3], &values).is_nan());
        }
    }

    #[test]
    fn the_length_of_the_normal_does_not_count_and_zero_has_no_direction() {
        each("sphere", 1_000, |draw, row| {
            let scale = libm::exp2(f64::from(draw.below(200)) - 100.0) as f32;
            let scaled: Vec<f32> = row.iter().map(|c| c * scale).collect();
            assert_eq!(truth_of(&scaled).values(), truth_of(row).values(), "{row:?}");
        });
        let zero = truth_of(&[0.0, -0.0, 0.0]);
        assert_eq!(zero.sensitivities(), [f64::INFINITY; 2]);
        assert_eq!(worst_residual(&[0.0; 3], &[9.0; 6]), 0.0);
        assert!(OrthonormalBasis.residual(B1, &[0.0; 3], &[f64::INFINITY; 6]).is_nan());
    }

    /// Residuals of an unchanged basis after the normal has changed are within the stated sensitivity, and near it.
    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        each("sphere", 5_000, |draw, row| {
            let truth = truth_of(row);
            let step = libm::exp2(-12.0);
            let changed: Vec<f32> =
                row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
            worst = worst.max(worst_residual(&changed, truth.values()) / step);
        });
        // 1.01: second order at a step of 2^-12.
        assert!((0.5..=1.01).contains(&worst), "{worst}");
    }

    #[test]
    fn distances_to_the_poles() {
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
        assert!(close(pole_distance(&[1e-6, 0.0, -1.0], -1.0), 0.5e-12));
        assert!(close(pole_distance(&[0.0, 1e-4, 1.0], 1.0), 0.5e-8));
        assert!(close(pole_distance(&[0.0, 0.0, 2.0], -1.0), 2.0));
        assert!(pole_distance(&[0.0; 3], 1.0).is_nan());
    }
}
