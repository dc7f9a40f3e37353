//! Irradiance of an ellipsoid light under a linearly transformed cosine, the horizon included.
//!
//! The ellipsoid with centre c, semi-axes r along the columns of R (the rotation of q/|q|) covers the directions of the
//! cone with the dual quadric S = R D^2 R^T - c c^T, and Minv takes it to Minv S Minv^T: `numeric::clipped_ellipse` does the
//! rest. With b = R^T c, -det S = b_x^2 r_y^2 r_z^2 + b_y^2 r_z^2 r_x^2 + b_z^2 r_x^2 r_y^2 - r_x^2 r_y^2 r_z^2, in twofold arithmetic.
//!
//! From inside or on the ellipsoid every direction is lit: the answer is 1. One zero semi-axis leaves an ellipse, two
//! leave nothing; nothing, a singular Minv and a light below the horizon give exactly 0. q = 0 is no rotation: R = I.

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::big;
use crate::numeric::clipped_ellipse::{Changes, Cone};
use crate::numeric::exact3;
use crate::numeric::graded_cone::{GradedCone, Irradiance, Known};
use crate::numeric::rotation::Rotation;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::numeric::twofold::Twofold;
use crate::sample::{Draw, ggx};

pub(super) struct LtcEllipsoid;

const MINV: usize = 0;
const CENTER: usize = 9;
const ROTATION: usize = 12;
const RADIUS: usize = 16;

impl Problem for LtcEllipsoid {
    fn name(&self) -> &'static str {
        "ltc_ellipsoid"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of an ellipsoid light under a linearly transformed cosine, clipped by the horizon"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("minv", Type::Mat3),
                Field::new("center", Type::Vec3),
                Field::new("rotation", Type::Vec4),
                Field::new("radius", Type::Vec3),
            ]
        }
    }

    /// 1e-4 of the hemisphere is a tenth of a step of 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("irradiance", Type::Float, Quantity::Irradiance, 1e-4).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "ggx",
                summary: "ellipsoids of 5 cm to 1 m, aspects to 4, up to 5 m away over a floor of GGX roughness 0.1 to 1",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.1, 1.0), draw.uniform(0.087, 1.0));
                    let size = draw.log_uniform(0.05, 1.0);
                    let radius = [(); 3].map(|()| size * draw.uniform(0.25, 1.0));
                    place(draw, row, minv, radius, 1.05, 20.0);
                },
            },
            Scenario {
                name: "flat",
                summary: "aspects to 1000: discs and rods, 1.1 to 20 lengths away",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.3, 1.0), draw.uniform(0.1, 1.0));
                    let radius = [(); 3].map(|()| draw.log_uniform(1e-3, 1.0));
                    place(draw, row, minv, radius, 1.1, 20.0);
                },
            },
            Scenario {
                name: "far",
                summary: "10 to 1e5 lengths away, aspects to 4, roughness 0.3 to 1",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.3, 1.0), draw.uniform(0.1, 1.0));
                    let radius = [(); 3].map(|()| draw.uniform(0.25, 1.0));
                    place(draw, row, minv, radius, 10.0, 1e5);
                },
            },
            Scenario {
                name: "near_surface",
                summary: "the point 1e-5 to 0.1 of a radius off the surface, aspects to 4, plain cosine",
                draw: |draw, row| {
                    let radius = [(); 3].map(|()| draw.uniform(0.25, 1.0));
                    place(draw, row, DMat3::IDENTITY, radius, 1.0 + 1e-5, 1.1);
                },
            },
            Scenario {
                name: "edge",
                summary: "from inside, zero semi-axes, no rotation, turns by 90 degrees, quaternions of any length, any scale",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "aspect",
                summary: "longest over shortest semi-axis",
                edges: &[1.001, 1.1, 2.0, 4.0, 10.0, 1e2, 1e3],
                coordinate: |input, _| {
                    let radius = exact3::vector(&input[RADIUS..]).abs();
                    radius.max_element() / radius.min_element()
                },
            },
            Landmark {
                name: "distance",
                summary: "distance of the centre over the longest semi-axis, before Minv",
                edges: &[0.3, 1.0, 1.1, 2.0, 10.0, 1e2, 1e3, 1e4],
                coordinate: |input, _| {
                    exact3::vector(&input[CENTER..]).length()
                        / exact3::vector(&input[RADIUS..]).abs().max_element()
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let unit = |largest: f64| libm::ldexp(1.0, -libm::frexp(largest).1);
        let minv = exact3::columns(&input[MINV..]);
        let (center, radius) = (exact3::vector(&input[CENTER..]), exact3::vector(&input[RADIUS..]));
        let by_matrix = unit(minv.iter().fold(0.0, |largest, c| c.abs().max_element().max(largest)));
        let by_length = unit(center.abs().max_element().max(radius.abs().max_element()));
        let (m, c, r) = (minv.map(|column| column * by_matrix), center * by_length, radius * by_length);
        let rotation = Rotation::new(&input[ROTATION..RADIUS]);

        let r2 = r.to_array().map(|r| Twofold::product(r, r));
        let axes = &rotation.columns;
        let b = axes.map(|a| a[0] * c.x + a[1] * c.y + a[2] * c.z);
        let b2 = b.map(|b| b * b);
        let faces = [r2[1] * r2[2], r2[2] * r2[0], r2[0] * r2[1]];
        let shell = r2[0] * faces[0];
        let reach = b2[0] * faces[0] + b2[1] * faces[1] + b2[2] * faces[2];
        let outside = (reach - shell).value();
        if outside <= 0.0 {
            if shell.value() == 0.0 {
                return truth.scalar(0, 0.0, 0.0, f64::INFINITY);
            }
            // A few roundings from outside, where half of the light may be hidden.
            let near = -outside < 64.0 * UNIT_ROUNDOFF * shell.value();
            return truth.scalar(0, 1.0, 0.0, if near { f64::INFINITY } else { 0.0 });
        }

        let determinant = exact3::determinant(minv[0], minv[1], minv[2]) * by_matrix * by_matrix * by_matrix;
        let matrix = DMat3::from_cols(m[0], m[1], m[2]);
        // Minv S Minv^T from the images of the semi-axes and the centre.
        let squares = [0, 1, 2].map(|k| {
            let [x, y, z] = axes[k].map(|component| component * r[k]);
            exact3::square(&[0, 1, 2].map(|row| x * m[0][row] + y * m[1][row] + z * m[2][row]))
        });
        let image = exact3::transformed(&m, c);
        let cc = exact3::square(&image);
        let cone = Cone {
            dual: std::array::from_fn(|i| squares[0][i] + squares[1][i] + squares[2][i] - cc[i]),
            minus_det: determinant * determinant * outside,
            towards: DVec3::from_array(image.map(|component| component.value())),
        };
        let size = DMat3::from_cols(m[0].abs(), m[1].abs(), m[2].abs());
        let (of_center, of_radius) = (size * c.abs(), size * DVec3::splat(r.abs().max_element()));
        let terms = of_center * of_center + of_radius * of_radius;
        if determinant == 0.0 {
            let below = cone.dual[2].value() < 0.0 && cone.towards.z < 0.0;
            return truth.scalar(0, 0.0, 0.0, if below { 0.0 } else { f64::INFINITY });
        }
        let found = cone.irradiance(terms).and_then(|light| {
            let turned = rotation.matrix();
            let solid = turned * DMat3::from_diagonal(r * r) * turned.transpose();
            let own = solid - DMat3::from_cols(c * c.x, c * c.y, c * c.z);
            let by_own = matrix.transpose() * light.gradient * matrix;
            let by_minv = 2.0 * light.gradient * matrix * own;
            let (mut of_minv, mut of_light) = (Changes::default(), Changes::default());
            (0..3).for_each(|k| of_minv.add(by_minv.col(k) * m[k]));
            of_light.add(-2.0 * (by_own * c) * c);
            of_light.add(DVec3::from_array([0, 1, 2].map(|k| {
                let axis = turned.col(k);
                2.0 * r[k] * r[k] * axis.dot(by_own * axis)
            })));
            let of_rotation = rotation.sensitivity(solid * by_own);
            // What the radii change goes through the rotation, whose terms are up to twice as many.
            Some((light, of_minv.size(of_light, 2.0 * light.off(terms))? + of_rotation))
        });
        let Some((light, sensitivity)) = found else {
            truth.escalate();
            let light = graded(minv, center, &rotation, radius);
            return truth.scalar(0, light.value, light.bound, light.sensitivity);
        };
        if light.escalated {
            truth.escalate();
        }
        truth.scalar(0, light.value, light.bound, sensitivity);
    }
}

/// The same in any precision. With N = |q|^2 R the quadric is N D^2 N^T - |q|^4 c c^T, which needs no quotient.
fn graded(minv: [DVec3; 3], center: DVec3, rotation: &Rotation, radius: DVec3) -> Irradiance {
    let (columns, norm) = rotation.exact();
    let r2 = big::vector(radius).map(|r| &r * &r);
    let c = big::vector(center).map(|component| component * &norm);
    let (cc, squares) = (big::square(&c), columns.each_ref().map(big::square));
    let solid: big::Symmetric =
        std::array::from_fn(|i| &squares[0][i] * &r2[0] + &squares[1][i] * &r2[1] + &squares[2][i] * &r2[2]);
    let own = std::array::from_fn(|i| &solid[i] - &cc[i]);
    GradedCone { minv, own, center }.irradiance(Known::default(), |by_own| {
        let mut sum = big::moved(by_own, &c);
        for (axis, r2) in columns.iter().zip(&r2) {
            sum += big::abs((big::dot(axis, &big::times(by_own, axis)) << 1) * r2);
        }
        // The antisymmetric part of solid G turns the light.
        let rows = |s: &big::Symmetric| {
            let [xx, yy, zz, xy, xz, yz] = s.clone();
            [[xx, xy.clone(), xz.clone()], [xy, yy, yz.clone()], [xz, yz, zz]]
        };
        let (solid, gradient) = (rows(&solid), rows(by_own));
        let part =
            |i: usize, j: usize| (big::dot(&solid[i], &gradient[j]) - big::dot(&solid[j], &gradient[i])) << 1;
        let torque = [part(1, 2), part(2, 0), part(0, 1)];
        for turn in rotation.turns() {
            sum += big::abs(big::dot(&torque, &big::vector(turn)));
        }
        sum
    })
}

fn store(row: &mut [f32], minv: DMat3, center: DVec3, rotation: [f64; 4], radius: [f64; 3]) {
    let values = [minv.to_cols_array().as_slice(), &center.to_array(), &rotation, &radius].concat();
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// A uniform rotation as a unit quaternion.
fn turn(draw: &mut Draw) -> [f64; 4] {
    let share = draw.unit();
    let ((c1, s1), (c2, s2)) = (draw.angle(), draw.angle());
    let (a, b) = (libm::sqrt(1.0 - share), libm::sqrt(share));
    [a * c1, a * s1, b * c2, b * s2]
}

/// An ellipsoid turned anyhow, above the floor; `near` and `far` bound |D^-1 R^T c|, which is 1 on the surface.
fn place(draw: &mut Draw, row: &mut [f32], minv: DMat3, radius: [f64; 3], near: f64, far: f64) {
    let rotation = turn(draw);
    let q = glam::DQuat::from_array(rotation);
    let direction = draw.direction();
    let off = 1.0 + draw.log_uniform(near - 1.0, far - 1.0);
    let center = q * (off * direction * DVec3::from_array(radius));
    let center = if center.z < 0.0 { -center } else { center };
    store(row, minv, center, rotation, radius);
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let identity = DMat3::IDENTITY;
    let kind = draw.below(8);
    let (rotation, direction) = (turn(draw), draw.direction());
    let radius = [(); 3].map(|()| draw.uniform(0.25, 1.0));
    let up = DVec3::new(direction.x, direction.y, direction.z.abs());
    let half = core::f64::consts::FRAC_1_SQRT_2;
    match kind {
        0 => store(row, identity, 0.2 * draw.unit() * direction, rotation, radius),
        1 => store(row, identity, 2.0 * up, rotation, [radius[0], radius[1], 0.0]),
        2 => store(row, identity, 2.0 * up, rotation, [radius[0], 0.0, 0.0]),
        3 => store(row, identity, 2.0 * up, [0.0; 4], radius),
        4 => store(row, identity, 2.0 * up, [half, 0.0, 0.0, half], radius),
        5 => {
            let scale = draw.log_uniform(1e-6, 1e6);
            store(row, identity, 2.0 * up, rotation.map(|q| q * scale), radius);
        }
        6 => {
            let scale = libm::exp2(f64::from(draw.below(61)) - 30.0);
            store(row, identity, 2.0 * scale * up, rotation, radius.map(|r| r * scale));
        }
        _ => {
            let a = draw.direction();
            store(row, DMat3::from_cols(a, a, direction), 2.0 * up, rotation, radius);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::problem::CERTIFIED;
    use crate::numeric::graded_cone::Agreement;
    use crate::sample::{Stream, landmarks};

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(LtcEllipsoid.outputs());
        LtcEllipsoid.oracle(input, &mut truth);
        truth
    }

    #[test]
    fn every_truth_is_certified_and_a_share() {
        for scenario in LtcEllipsoid.scenarios() {
            let mut lit = 0;
            Stream::new(11, scenario.name).visit(0, 20_000, |_, draw| {
                let mut row = [0.0; 19];
                (scenario.draw)(draw, &mut row);
                let truth = truth_of(&row);
                assert!(row.iter().all(|v| v.is_finite()), "{row:?}");
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=1.0).contains(&truth.values()[0]), "{row:?}: {truth:?}");
                assert!(truth.sensitivities()[0] >= 0.0, "{row:?}: {truth:?}");
                lit += u32::from(truth.values()[0] > 0.0);
            });
            assert!(lit > 5_000, "{}: {lit}", scenario.name);
        }
    }

    /// A linear map of a sphere is an ellipsoid: Minv of one is Minv M of the other.
    #[test]
    fn a_sphere_seen_through_its_map_is_the_ellipsoid() {
        let (s, u) = (2.0f32, 0.5f32);
        let stretched =
            [s, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, u, 0.75, 1.0, 2.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let plain =
            [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.5, 1.0, 1.0, 0.0, 0.0, 0.0, 3.0, 2.0, 1.0, 0.5];
        let (a, b) = (truth_of(&stretched).values()[0], truth_of(&plain).values()[0]);
        assert!((a - b).abs() < 1e-15 && a > 0.1, "{a} {b}");
    }

    fn compare(agreement: &mut Agreement, row: &[f32]) {
        let truth = truth_of(row);
        let value = truth.values()[0];
        let (center, radius) = (exact3::vector(&row[CENTER..]), exact3::vector(&row[RADIUS..]));
        // Of no size, or looked at from within.
        if radius.min_element() == 0.0 || value == 1.0 {
            return;
        }
        let rotation = Rotation::new(&row[ROTATION..RADIUS]);
        let exact = graded(exact3::columns(&row[MINV..]), center, &rotation, radius);
        agreement.add(value, truth.sensitivities()[0], 0.0, exact, row);
    }

    /// f64 with its tests against any precision.
    #[test]
    fn both_arithmetics_agree() {
        for scenario in LtcEllipsoid.scenarios() {
            let mut agreement = Agreement::default();
            Stream::new(4, scenario.name).visit(0, 400, |_, draw| {
                let mut row = [0.0; 19];
                (scenario.draw)(draw, &mut row);
                compare(&mut agreement, &row);
            });
            agreement.check(scenario.name);
        }
    }

    /// Where determinants leave the range of f64, and far from it.
    #[test]
    fn no_exponents_are_too_large_or_small() {
        let mut agreement = Agreement::default();
        Stream::new(12, "exponents").visit(0, 2_000, |_, draw| {
            let mut row = [0.0; 19];
            (LtcEllipsoid.scenario("ggx").unwrap().draw)(draw, &mut row);
            (0..ROTATION).chain(RADIUS..19).for_each(|at| row[at] = landmarks::any_exponent(draw));
            compare(&mut agreement, &row);
        });
        agreement.check("exponents");
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for name in ["ggx", "far", "flat", "near_surface"] {
            let mut worst: f64 = 0.0;
            let scenario = LtcEllipsoid.scenario(name).unwrap();
            Stream::new(5, "sensitivity").visit(0, 3_000, |_, draw| {
                let mut row = [0.0; 19];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-20);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let after = truth_of(&changed);
                let change = (after.values()[0] - before.values()[0]).abs() / step;
                let (here, there) = (before.sensitivities()[0], after.sensitivities()[0]);
                // First order only: not where the answer changes by a twentieth, or the slope itself by a tenth.
                if here * step < 0.05 * before.values()[0] && (there / here - 1.0).abs() < 0.1 {
                    worst = worst.max(change / here);
                }
            });
            // 1.2: second order at this step, and the rim's quadrature. 0.2: all signs at their worst are rare.
            assert!((0.2..=1.2).contains(&worst), "{name}: {worst}");
        }
    }
}
