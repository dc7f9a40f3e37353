//! Solid angle of an ellipse given by its centre and two conjugate semi-axes.
//!
//! The ellipse covers the cone with the dual quadric S = V1 V1^T + V2 V2^T - C C^T, of determinant -[C, V1, V2]^2, whose
//! solid angle [`Cone::solid_angle`] gives: the determinant is rounded once, the quadric is twofold.
//!
//! Seen from its own plane the ellipse covers nothing from outside, and 2 pi from inside or from its rim; an ellipse
//! without an area covers nothing from anywhere.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::clipped_ellipse::Cone;
use crate::numeric::cone_solid_angle;
use crate::numeric::exact3;
use crate::numeric::products;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::numeric::twofold::Twofold;
use crate::sample::{Draw, landmarks};

pub(super) struct EllipseSolidAngle;

/// The relative error that exact invariants are taken for.
const ACCURACY: f64 = 1.0 / (1u64 << 34) as f64;

impl Problem for EllipseSolidAngle {
    fn name(&self) -> &'static str {
        "ellipse_solid_angle"
    }

    fn summary(&self) -> &'static str {
        "Solid angle of an ellipse given by its centre and two conjugate semi-axes"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("center", Type::Vec3), Field::new("v1", Type::Vec3), Field::new("v2", Type::Vec3)] }
    }

    /// A light off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("solid_angle", Type::Float, Quantity::SolidAngle, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "elliptic lights of 5 cm to 5 m, semi-axes 1:1 to 5:1, centres 0.2 to 20 m off in any direction",
                draw: |draw, row| {
                    let (major, aspect) = (draw.log_uniform(0.05, 5.0), draw.log_uniform(1.0, 5.0));
                    let center = draw.log_uniform(0.2, 20.0) * draw.direction();
                    place(draw, row, center, major, major / aspect);
                },
            },
            Scenario {
                name: "facing",
                summary: "discs that face the point, half of them squeezed or turned by 1e-8..1e-2",
                draw: facing,
            },
            Scenario {
                name: "far",
                summary: "lights of aspect 1 to 5, log-uniform 10 to 1e5 radii away in any direction",
                draw: |draw, row| {
                    let (major, aspect) = (draw.log_uniform(0.05, 5.0), draw.log_uniform(1.0, 5.0));
                    let center = major * draw.log_uniform(10.0, 1e5) * draw.direction();
                    place(draw, row, center, major, major / aspect);
                },
            },
            Scenario {
                name: "near_plane",
                summary: "height log-uniform 1e-5..1e-1 of the radius, up to two semi-axes from the centre, aspect 1 to 5",
                draw: |draw, row| {
                    let (major, aspect) = (draw.log_uniform(0.05, 5.0), draw.log_uniform(1.0, 5.0));
                    let frame = draw.frame();
                    let (cos, sin) = draw.angle();
                    let (u, v) = (major * frame.x_axis, major / aspect * frame.y_axis);
                    let offset = draw.uniform(0.0, 2.0);
                    let height = major * draw.log_uniform(1e-5, 1e-1);
                    let center = offset * (cos * u + sin * v) + height * frame.z_axis;
                    conjugate(draw, row, center, u, v);
                },
            },
            Scenario {
                name: "needle",
                summary: "aspect log-uniform 1 to 1e4, centres 0.1 to 10 major semi-axes off in any direction",
                draw: |draw, row| {
                    let (major, aspect) = (draw.log_uniform(0.05, 5.0), draw.log_uniform(1.0, 1e4));
                    let center = major * draw.log_uniform(0.1, 10.0) * draw.direction();
                    place(draw, row, center, major, major / aspect);
                },
            },
            Scenario {
                name: "edge",
                summary: "in the plane, on the rim, no area, parallel semi-axes, any scale, subnormal and landmark values",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "solid_angle",
                summary: "the solid angle itself: small for far lights, 2 pi in the light's plane",
                edges: &[1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 3.0, 6.0, 6.25],
                coordinate: |_, truth| truth.output(0)[0],
            },
            Landmark {
                name: "grazing",
                summary: "cosine between the light's normal and the centre's direction",
                edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9],
                coordinate: |input, _| {
                    let [c, v1, v2] = vectors(input);
                    v1.cross(v2).dot(c).abs() / (v1.cross(v2).length() * c.length())
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let [c, v1, v2] = vectors(input);
        let largest = [c, v1, v2].iter().fold(0.0f64, |largest, v| v.abs().max_element().max(largest));
        let unit = libm::ldexp(1.0, -libm::frexp(largest).1);
        let [c, v1, v2] = [c, v1, v2].map(|v| v * unit);
        let volume = exact3::determinant(c, v1, v2);
        if volume == 0.0 {
            return in_plane(c, v1, v2, truth);
        }
        let square = |v: DVec3| exact3::square(&v.to_array().map(Twofold::from));
        let (s1, s2, sc) = (square(v1), square(v2), square(c));
        let dual = std::array::from_fn(|i| s1[i] + s2[i] - sc[i]);
        let cone = Cone { dual, minus_det: volume * volume, towards: c };
        let doubt = cone.doubt(c * c + v1 * v1 + v2 * v2);
        if !(doubt <= ACCURACY) {
            return graded(c, v1, v2, truth);
        }
        let seen = cone.solid_angle();
        let sensitivity: f64 =
            [c, v1, v2].iter().map(|v| (2.0 * (seen.gradient * *v) * *v).abs().element_sum()).sum();
        truth.scalar(0, seen.value, (cone_solid_angle::BOUND + doubt) * seen.value, sensitivity);
    }
}

/// The same by exact invariants of the dual quadric. The sensitivity by differences: each component changes by 2^-20 of
/// itself, the value's own error by 2^-27 of the difference.
fn graded(c: DVec3, v1: DVec3, v2: DVec3, truth: &mut Truth) {
    const STEP: f64 = 1.0 / (1u64 << 20) as f64;
    truth.escalate();
    let value = cone_solid_angle::graded(c, v1, v2);
    let mut sensitivity = 0.0;
    for vector in 0..3 {
        for component in 0..3 {
            let mut moved = [c, v1, v2];
            let entry = &mut moved[vector][component];
            if *entry != 0.0 {
                *entry *= 1.0 + STEP;
                let [c, v1, v2] = moved;
                sensitivity += (cone_solid_angle::graded(c, v1, v2) - value).abs() / STEP;
            }
        }
    }
    truth.scalar(0, value, cone_solid_angle::BOUND * value, sensitivity);
}

/// The stated answers where [C, V1, V2] = 0 exactly.
fn in_plane(c: DVec3, v1: DVec3, v2: DVec3, truth: &mut Truth) {
    let square = |a: DVec3, b: DVec3| {
        let pairs = products::cross(a, b).map(|(hi, lo)| Twofold { hi, lo });
        pairs[0] * pairs[0] + pairs[1] * pairs[1] + pairs[2] * pairs[2]
    };
    let area2 = square(v1, v2);
    if area2.value() == 0.0 {
        return truth.scalar(0, 0.0, 0.0, 0.0);
    }
    // The origin is C + x V1 + y V2 with x^2 + y^2 = (|C x V2|^2 + |C x V1|^2)/|V1 x V2|^2.
    let margin = (area2 - square(c, v1) - square(c, v2)).value() / area2.value();
    // Leaving the plane by a height h changes the answer by about 2 h over the distance from the rim.
    let volume = c.abs().dot(DVec3::new(
        (v1.y * v2.z).abs() + (v1.z * v2.y).abs(),
        (v1.z * v2.x).abs() + (v1.x * v2.z).abs(),
        (v1.x * v2.y).abs() + (v1.y * v2.x).abs(),
    ));
    let height = 3.0 * volume / libm::sqrt(area2.value()) / libm::sqrt(libm::sqrt(area2.value()));
    // Beside the rim rounding chooses the side.
    let sensitivity =
        if margin.abs() < 32.0 * UNIT_ROUNDOFF { f64::INFINITY } else { 2.0 * PI * height / margin.abs() };
    truth.scalar(0, if margin >= 0.0 { TAU } else { 0.0 }, 0.0, sensitivity);
}

fn vectors(input: &[f32]) -> [DVec3; 3] {
    [0, 3, 6].map(|at| exact3::vector(&input[at..]))
}

fn store(row: &mut [f32], center: DVec3, v1: DVec3, v2: DVec3) {
    let values = [center, v1, v2].into_iter().flat_map(|v| v.to_array());
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// Any conjugate pair of the ellipse with the semi-axes u, v.
fn conjugate(draw: &mut Draw, row: &mut [f32], center: DVec3, u: DVec3, v: DVec3) {
    let (cos, sin) = draw.angle();
    store(row, center, cos * u + sin * v, cos * v - sin * u);
}

fn place(draw: &mut Draw, row: &mut [f32], center: DVec3, major: f64, minor: f64) {
    let frame = draw.frame();
    conjugate(draw, row, center, major * frame.x_axis, minor * frame.y_axis);
}

fn facing(draw: &mut Draw, row: &mut [f32]) {
    let radius = draw.log_uniform(0.05, 5.0);
    let distance = draw.log_uniform(0.1, 20.0);
    let [squeeze, x, y] = if draw.sign() > 0.0 {
        [0.0; 3]
    } else {
        std::array::from_fn(|_| draw.sign() * draw.log_uniform(1e-8, 1e-2))
    };
    let frame = draw.frame();
    let center = distance * (frame.z_axis + x * frame.x_axis + y * frame.y_axis);
    store(row, center, radius * frame.x_axis, radius * (1.0 + squeeze) * frame.y_axis);
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(9);
    let (u, v) = (draw.log_uniform(0.05, 5.0), draw.log_uniform(0.05, 5.0));
    let direction = draw.direction();
    let [a, b] = [(); 2].map(|()| draw.uniform(-2.0, 2.0));
    match kind {
        // In the plane, outside and inside alike.
        0 => store(row, DVec3::new(a * u, b * v, 0.0), u * DVec3::X, v * DVec3::Y),
        1 => {
            let height = if draw.sign() > 0.0 { 0.0 } else { draw.log_uniform(1e-8, 1.0) };
            let ends = [DVec3::new(u, 0.0, height), DVec3::new(0.0, -v, height)];
            store(row, draw.pick(&ends), u * DVec3::X, v * DVec3::Y);
        }
        2 => store(row, DVec3::ZERO, u * DVec3::X, v * direction),
        3 => store(row, 3.0 * direction, u * DVec3::X, draw.pick(&[DVec3::ZERO, 2.0 * u * DVec3::X])),
        // A disc on its axis.
        4 => store(row, DVec3::new(0.0, 0.0, a), u * DVec3::X, -u * DVec3::Y),
        5 => {
            let scale = libm::exp2(f64::from(draw.below(61)) - 30.0);
            place(draw, row, 2.0 * scale * direction, scale * u, scale * v);
        }
        6 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        7 => {
            place(draw, row, 2.0 * direction, u, v);
            row[draw.below(9) as usize] = landmarks::near_landmark(draw).clamp(-1e10, 1e10);
        }
        _ => row.fill_with(|| landmarks::near_landmark(draw).clamp(-1e10, 1e10)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(EllipseSolidAngle.outputs());
        EllipseSolidAngle.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = EllipseSolidAngle.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 9];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    /// By mpmath from invariants of 400 digits. Twofold invariants were off by up to 2e-6 of these.
    #[test]
    fn graded_cones_keep_their_digits() {
        const ROWS: [([f32; 9], f64); 4] = [
            (
                [
                    -9.999979e-05,
                    -1.0000112e-03,
                    9.9999925e-05,
                    9.9999736e-05,
                    -1.0000109e-03,
                    1.0000002e-07,
                    -2.1475092e+09,
                    1e+10,
                    5.000026e-01,
                ],
                0.476_632_217_754_637_3,
            ),
            (
                [
                    -9.99998e-21,
                    -1.0000054e-03,
                    1.1754873e-38,
                    1.1754987e-38,
                    -9.999907e-04,
                    1.0000028e-20,
                    -1.0000035e-07,
                    -1e+10,
                    -1.0000049e-07,
                ],
                5.355_896_159_345_345,
            ),
            (
                [
                    9.999991e-05,
                    -1.0842147e-19,
                    1.0000005e-07,
                    1.000004e-20,
                    -4.6565893e-10,
                    -4.65662e-10,
                    -1.0000037e+00,
                    1e+10,
                    1e+10,
                ],
                8.714_016_513_725_34e-11,
            ),
            (
                [
                    9.999964e-21,
                    -9.999947e-05,
                    4.6565876e-10,
                    1.000003e-20,
                    -9.999942e-21,
                    1.175496e-38,
                    -1.9999887e+00,
                    2.1474854e+09,
                    -2.1475018e+09,
                ],
                5.656_905_974_671_321e-16,
            ),
        ];
        for (row, expected) in ROWS {
            let truth = truth_of(&row);
            let value = truth.values()[0];
            assert!(truth.escalated() && truth.sensitivities()[0].is_finite());
            assert!((value / expected - 1.0).abs() <= cone_solid_angle::BOUND, "{row:?}: {value}");
        }
    }

    #[test]
    fn every_truth_is_certified_and_a_solid_angle() {
        for scenario in EllipseSolidAngle.scenarios() {
            each(scenario.name, 20_000, |_, row, truth| {
                let value = truth.values()[0];
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=TAU).contains(&value), "{row:?}: {truth:?}");
                assert!(truth.sensitivities()[0] >= 0.0, "{row:?}: {truth:?}");
            });
        }
    }

    /// The definition, over the ellipse's own area: N.p/|p|^3 at p = C + r (V1 cos t + V2 sin t), by midpoints in t, which
    /// converge geometrically, and Gauss's rule in r.
    #[test]
    fn is_the_integral_over_the_ellipse() {
        use crate::numeric::gauss_legendre::{POINTS_16, visit};
        for scenario in ["scene", "facing", "needle"] {
            let mut checked = 0;
            each(scenario, 1_000, |_, row, truth| {
                let [c, v1, v2] = vectors(row);
                // Where the point is at least as far off as the ellipse is large, both rules have converged.
                if c.length() < 2.0 * libm::sqrt(v1.length_squared() + v2.length_squared()) {
                    return;
                }
                let normal = v1.cross(v2);
                let mut sum = 0.0;
                visit(&POINTS_16, 0.0, 1.0, |radius, weight| {
                    for k in 0..64 {
                        let (sin, cos) = libm::sincos(TAU * (f64::from(k) + 0.5) / 64.0);
                        let p = c + radius * (cos * v1 + sin * v2);
                        sum += weight * radius * normal.dot(p) / p.length().powi(3) * TAU / 64.0;
                    }
                });
                let value = truth.values()[0];
                // N.p cancels in this check as [C, V1, V2] does.
                let slack = 1e-12 * value + 1e-14 * normal.length() * c.length() / c.length().powi(3);
                assert!((value - sum.abs()).abs() <= slack, "{row:?}: {value} {sum}");
                checked += 1;
            });
            assert!(checked > 100, "{scenario}: {checked}");
        }
    }

    #[test]
    fn stated_answers() {
        let value = |row: [f32; 9]| truth_of(&row).values()[0];
        let in_plane = |x: f32| value([x, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        assert_eq!([in_plane(0.0), in_plane(2.0), in_plane(3.0), in_plane(3.1)], [TAU, TAU, TAU, 0.0]);
        assert_eq!(value([1.0, 2.0, 3.0, 1.0, 1.0, 0.0, 2.0, 2.0, 0.0]), 0.0);
        assert_eq!(value([0.0; 9]), 0.0);
        // A disk of radius 3 from 4 above its centre.
        let disk = value([0.0, 4.0, 0.0, 0.0, 0.0, 3.0, -3.0, 0.0, 0.0]);
        assert!((disk / (TAU * 0.2) - 1.0).abs() < 1e-14, "{disk}");
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for name in ["scene", "needle", "far", "near_plane"] {
            let mut worst: f64 = 0.0;
            each(name, 3_000, |draw, row, before| {
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
            // 1.2: second order at this step. 0.3: nine signs at their worst are rare.
            assert!((0.3..=1.2).contains(&worst), "{name}: {worst}");
        }
    }
}
