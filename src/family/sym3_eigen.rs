//! Eigenvalues and eigenvectors of a symmetric 3x3 matrix, ascending.
//!
//! Cyclic Jacobi rotations in f64 leave values within 48 EPS of the norm and vectors within that over their gap. Where
//! this is not 1e-11 of a value or of a radian, as in nearly singular matrices and nearly equal eigenvalues, the
//! rotations are done again with twofold entries (`numeric::symmetric3`). A matrix is singular exactly if its
//! determinant, a sum of exact products, is 0; then so is the eigenvalue.
//!
//! Equal eigenvalues, and such as differ by less than 2^-63 of the norm, define no directions: any will do that are
//! orthogonal. The zero matrix is the case of three.

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Relation, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::symmetric3::{EQUAL, Eigensystem, Symmetric3};
use crate::sample::{Draw, landmarks};

pub(super) struct Sym3Eigen;

const VALUES: [usize; 3] = [0, 1, 2];
const VECTORS: [usize; 3] = [3, 4, 5];

/// What plain f64 may be off by, relative for values and in radians: 1/400 of the bound that certifies.
const PLAIN: f64 = 1e-11;

impl Problem for Sym3Eigen {
    fn name(&self) -> &'static str {
        "sym3_eigen"
    }

    fn summary(&self) -> &'static str {
        "Eigenvalues, ascending, and orthonormal eigenvectors of a symmetric 3x3 matrix"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("xx", Type::Float),
                Field::new("yy", Type::Float),
                Field::new("zz", Type::Float),
                Field::new("xy", Type::Float),
                Field::new("xz", Type::Float),
                Field::new("yz", Type::Float),
            ]
        }
    }

    /// 0.1 % of an eigenvalue or 1 mrad of its direction: what a splat's or a light's outline shows.
    fn outputs(&self) -> &'static [Output] {
        const AXIS: Quantity = Quantity::UnitVector { sign_free: true };
        const {
            &[
                Output::new("e0", Type::Float, Quantity::Scalar, 1e-3).headline(),
                Output::new("e1", Type::Float, Quantity::Scalar, 1e-3),
                Output::new("e2", Type::Float, Quantity::Scalar, 1e-3),
                Output::new("q0", Type::Vec3, AXIS, 1e-3).headline(),
                Output::new("q1", Type::Vec3, AXIS, 1e-3),
                Output::new("q2", Type::Vec3, AXIS, 1e-3),
            ]
        }
    }

    fn relations(&self) -> &'static [Relation] {
        const {
            &[
                Relation::Orthogonal(VECTORS[0], VECTORS[1]),
                Relation::Orthogonal(VECTORS[0], VECTORS[2]),
                Relation::Orthogonal(VECTORS[1], VECTORS[2]),
            ]
        }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "covariances of splats and point clouds: axes of 1 mm to 1 m, up to 30:1, any orientation",
                draw: |draw, row| {
                    let longest = draw.log_uniform(1e-3, 1.0);
                    let squares = std::array::from_fn(|_| {
                        let axis = longest / draw.log_uniform(1.0, 30.0);
                        axis * axis
                    });
                    spectrum(draw, squares, row);
                },
            },
            Scenario {
                name: "near_equal",
                summary: "two or all three eigenvalues apart by log-uniform 2^-26..2^-2 of themselves, either sign",
                draw: |draw, row| {
                    let value = draw.sign() * draw.log_uniform(0.01, 100.0);
                    let near = |draw: &mut Draw| value * (1.0 + draw.log_uniform(1.0 / 67_108_864.0, 0.25));
                    let third = if draw.sign() > 0.0 { near(draw) } else { draw.uniform(-100.0, 100.0) };
                    let second = near(draw);
                    spectrum(draw, [value, second, third], row);
                },
            },
            Scenario {
                name: "graded",
                summary: "eigenvalues over up to 12 decades in any orientation, or entries graded by d_i d_j, d_i 1e-6..1",
                draw: graded,
            },
            Scenario {
                name: "indefinite",
                summary: "all entries uniform in -1..1, times log-uniform 1e-3..1e3",
                draw: |draw, row| {
                    let scale = draw.log_uniform(1e-3, 1e3);
                    row.fill_with(|| (scale * draw.uniform(-1.0, 1.0)) as f32);
                },
            },
            Scenario {
                name: "light_cone",
                summary: "V1 V1^T + V2 V2^T - C C^T of elliptic lights of radius 1, aspect 1 to 5, 0.3 to 300 away",
                draw: light_cone,
            },
            Scenario {
                name: "edge",
                summary: "zero, diagonal, multiple of one, rank one and two, exactly equal, subnormal and huge matrices; landmarks",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "gap",
                summary: "least distance of two eigenvalues over the largest in size",
                edges: &[1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1],
                coordinate: |_, truth| {
                    let [a, b, c] = VALUES.map(|k| truth.output(k)[0]);
                    (b - a).min(c - b) / a.abs().max(c.abs())
                },
            },
            Landmark {
                name: "smallest",
                summary: "least size of an eigenvalue over the largest",
                edges: &[1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1],
                coordinate: |_, truth| {
                    let sizes = VALUES.map(|k| truth.output(k)[0].abs());
                    sizes.into_iter().fold(f64::INFINITY, f64::min) / sizes.into_iter().fold(0.0, f64::max)
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let matrix = matrix(input);
        let norm = matrix.norm();
        let mut found = matrix.jacobi();
        if !good(&found, norm) {
            truth.escalate();
            found = matrix.jacobi_twofold();
        }
        for k in 0..3 {
            let q = found.vectors[k];
            truth.scalar(VALUES[k], found.values[k], found.value_bounds[k], matrix.change(q, q));
            let turn = if defined(&found, norm, k) {
                (0..3)
                    .filter(|j| *j != k)
                    .map(|j| matrix.change(found.vectors[j], q) / (found.values[j] - found.values[k]).abs())
                    .sum()
            } else {
                f64::INFINITY
            };
            truth.unit_vector(VECTORS[k], q, found.vector_bounds[k], turn);
        }
    }
}

/// Whether vector `k` is; diagonal matrices have exact values, which need only differ.
fn defined(found: &Eigensystem, norm: f64, k: usize) -> bool {
    let exact = found.value_bounds.iter().all(|bound| *bound == 0.0);
    found.gap(k) > if exact { 0.0 } else { EQUAL * norm }
}

fn good(found: &Eigensystem, norm: f64) -> bool {
    (0..3).all(|k| {
        found.value_bounds[k] <= PLAIN * found.values[k].abs()
            && (found.vector_bounds[k] <= PLAIN || norm == 0.0)
    })
}

fn matrix(input: &[f32]) -> Symmetric3 {
    let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|i| f64::from(input[i]));
    Symmetric3 { diagonal: [xx, yy, zz], opposite: [yz, xz, xy] }
}

fn store(row: &mut [f32], m: DMat3) {
    let values = [m.x_axis.x, m.y_axis.y, m.z_axis.z, m.y_axis.x, m.z_axis.x, m.z_axis.y];
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v.x * v, v.y * v, v.z * v)
}

/// A matrix with these eigenvalues, up to rounding, in any orientation.
fn spectrum(draw: &mut Draw, values: [f64; 3], row: &mut [f32]) {
    let frame = draw.frame();
    let [a, b, c] = values;
    store(row, a * outer(frame.x_axis) + b * outer(frame.y_axis) + c * outer(frame.z_axis));
}

fn graded(draw: &mut Draw, row: &mut [f32]) {
    if draw.sign() > 0.0 {
        let values = std::array::from_fn(|_| draw.sign() * draw.log_uniform(1e-12, 1.0));
        spectrum(draw, values, row);
    } else {
        let d: [f64; 3] = std::array::from_fn(|_| draw.log_uniform(1e-6, 1.0));
        let mut entry = |i: usize, j: usize| (d[i] * d[j] * draw.uniform(-1.0, 1.0)) as f32;
        for (slot, (i, j)) in row.iter_mut().zip([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]) {
            *slot = entry(i, j);
        }
    }
}

fn light_cone(draw: &mut Draw, row: &mut [f32]) {
    let frame = draw.frame();
    let minor = 1.0 / draw.log_uniform(1.0, 5.0);
    let center = draw.log_uniform(0.3, 300.0) * draw.direction();
    store(row, outer(frame.x_axis) + minor * minor * outer(frame.y_axis) - outer(center));
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let integer = |draw: &mut Draw| f64::from(draw.below(17)) - 8.0;
    let vector = |draw: &mut Draw| DVec3::new(integer(draw), integer(draw), integer(draw));
    match draw.below(11) {
        0 => row.fill(0.0),
        1 => store(row, DMat3::from_diagonal(vector(draw))),
        2 => store(row, DMat3::from_diagonal(DVec3::splat(f64::from(landmarks::near_landmark(draw))))),
        3 => {
            row.fill(0.0);
            row[..3].fill_with(|| landmarks::near_landmark(draw));
        }
        4 => store(row, outer(vector(draw))),
        5 => store(row, outer(vector(draw)) - outer(vector(draw))),
        // Two equal eigenvalues, exactly: a multiple of one plus a matrix of rank one.
        6 => {
            let multiple = integer(draw);
            store(row, DMat3::from_diagonal(DVec3::splat(multiple)) + draw.sign() * outer(vector(draw)));
        }
        7 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        8 => {
            let scale = draw.log_uniform(1e15, 1e30);
            row.fill_with(|| (scale * draw.uniform(-1.0, 1.0)) as f32);
        }
        // One block and one value apart.
        9 => {
            row.fill_with(|| draw.uniform(-1.0, 1.0) as f32);
            let apart = draw.below(3) as usize;
            for opposite in [3, 4, 5] {
                if opposite != 5 - apart {
                    row[opposite] = 0.0;
                }
            }
        }
        _ => {
            row.fill_with(|| draw.uniform(-1.0, 1.0) as f32);
            row[draw.below(6) as usize] = landmarks::near_landmark(draw);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::numeric::spacing::EPS;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(Sym3Eigen.outputs());
        Sym3Eigen.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32], &Truth)) {
        let scenario = Sym3Eigen.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 6];
            (scenario.draw)(draw, &mut row);
            visit(&row, &truth_of(&row));
        });
    }

    fn dense(row: &[f32]) -> DMat3 {
        let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|i| f64::from(row[i]));
        DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz))
    }

    #[test]
    fn every_truth_is_certified_and_satisfies_the_definition() {
        for scenario in Sym3Eigen.scenarios() {
            each(scenario.name, 10_000, |row, truth| {
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!(truth.values().iter().all(|value| value.is_finite()), "{row:?}: {truth:?}");
                let values = VALUES.map(|k| truth.output(k)[0]);
                let vectors = VECTORS.map(|k| DVec3::from_slice(truth.output(k)));
                assert!(values.is_sorted(), "{row:?}: {truth:?}");
                let a = dense(row);
                let slack = 256.0 * EPS * matrix(row).norm();
                for (value, vector) in values.into_iter().zip(vectors) {
                    assert!((a * vector - value * vector).length() <= slack, "{row:?}: {truth:?}");
                }
                for (j, k) in [(0, 1), (0, 2), (1, 2)] {
                    assert!(vectors[j].dot(vectors[k]).abs() <= 64.0 * EPS, "{row:?}: {truth:?}");
                }
            });
        }
    }

    #[test]
    fn equal_eigenvalues_define_no_direction() {
        let undefined = |row: [f32; 6]| VECTORS.map(|k| truth_of(&row).sensitivities()[k].is_infinite());
        assert_eq!(undefined([0.0; 6]), [true; 3]);
        assert_eq!(undefined([2.0, 2.0, 2.0, 0.0, 0.0, 0.0]), [true; 3]);
        assert_eq!(undefined([-2.0, -2.0, -2.0, 1.0, 1.0, 1.0]), [true, true, false]);
        assert_eq!(undefined([1.0, 4.0, 9.0, 2.0, 3.0, 6.0]), [true, true, false]);
        // Values far below the norm but exact.
        assert_eq!(undefined([1.0, 1e-30, 2e-30, 0.0, 0.0, 0.0]), [false; 3]);
    }

    /// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst = [0.0f64; 6];
        let scenario = Sym3Eigen.scenario("indefinite").unwrap();
        Stream::new(5, "sensitivity").visit(0, 5_000, |_, draw| {
            let mut row = [0.0; 6];
            (scenario.draw)(draw, &mut row);
            let before = truth_of(&row);
            let step = 2f64.powi(-14);
            let changed: Vec<f32> =
                row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
            let after = truth_of(&changed);
            let sensitivities = before.sensitivities();
            // First order only: leave out what turns by more than a hundredth of a radian.
            if VECTORS.iter().any(|k| sensitivities[*k] * step > 0.01) {
                return;
            }
            for k in VALUES {
                let change = (after.output(k)[0] - before.output(k)[0]).abs() / step;
                worst[k] = worst[k].max(change / sensitivities[k]);
            }
            for k in VECTORS {
                let (a, b) = (DVec3::from_slice(before.output(k)), DVec3::from_slice(after.output(k)));
                worst[k] = worst[k].max(a.cross(b).length() / step / sensitivities[k]);
            }
        });
        // 1.1: second-order terms. 0.5: some of 5000 draws come close to the worst signs of all six entries.
        assert!(worst.iter().all(|worst| (0.5..=1.1).contains(worst)), "{worst:?}");
    }

    #[test]
    fn the_twofold_path_is_taken_where_it_must_be_and_not_always() {
        let share = |scenario| {
            let mut escalated = 0;
            each(scenario, 5_000, |_, truth| escalated += u32::from(truth.escalated()));
            f64::from(escalated) / 5_000.0
        };
        assert!(share("indefinite") < 0.02);
        assert!((0.3..0.9).contains(&share("near_equal")));
        assert!((0.3..1.0).contains(&share("graded")));
    }
}
