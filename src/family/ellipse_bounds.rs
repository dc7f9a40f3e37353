//! The axis-aligned box of an ellipse in space, from its centre and two conjugate semi-axes:
//!
//! ```text
//! min, max = c -+ e,   e = sqrt(u^2 + v^2) component by component
//! ```
//!
//! What a box leaves out is not found: besides its errors it is judged by whether it encloses the ellipse, to the last
//! bit. One rounding the wrong way fails that, as it may open a crack between neighbours.
//!
//! Ellipses whose box leaves the range of f32 are outside of the problem. Everything is worked in twofold f64 and rounded
//! once: an enclosure is judged wrongly only where a box's side lies within 2^-53 of it, and exact sides are exact.

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Relation, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::double_double::{DoubleDouble, Real};
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, landmarks};

pub(super) struct EllipseBounds;

const MIN: usize = 0;
const MAX: usize = 1;

impl Problem for EllipseBounds {
    fn name(&self) -> &'static str {
        "ellipse_bounds"
    }

    fn summary(&self) -> &'static str {
        "Axis-aligned box of an ellipse in space, and whether it encloses it"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("center", Type::Vec3), Field::new("u", Type::Vec3), Field::new("v", Type::Vec3)] }
    }

    /// A corner off by 1e-4 of its distance from the origin makes no box noticeably larger or smaller.
    fn outputs(&self) -> &'static [Output] {
        const CORNER: Quantity = Quantity::Vector { sign_free: false };
        const {
            &[
                Output::new("min", Type::Vec3, CORNER, 1e-4).headline(),
                Output::new("max", Type::Vec3, CORNER, 1e-4).headline(),
            ]
        }
    }

    fn relations(&self) -> &'static [Relation] {
        &[Relation::Encloses { min: MIN, max: MAX }]
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "elliptic lights of 5 cm to 5 m within 10 m, axes 1:1 to 5:1",
                draw: |draw, row| {
                    let (frame, radius) = (draw.frame(), draw.log_uniform(0.05, 5.0));
                    let ratio = draw.uniform(0.2, 1.0);
                    let centre = draw.uniform(0.0, 10.0) * draw.direction();
                    store(row, centre, radius * frame.x_axis, radius * ratio * frame.y_axis);
                },
            },
            Scenario {
                name: "disk",
                summary: "splats: disks of 1 mm to 1 m within 100 m",
                draw: |draw, row| {
                    let (frame, radius) = (draw.frame(), draw.log_uniform(1e-3, 1.0));
                    let centre = draw.log_uniform(0.1, 100.0) * draw.direction();
                    disk(row, centre, radius, &frame);
                },
            },
            Scenario {
                name: "flat",
                summary: "disks tilted by log-uniform 1e-8..1 rad out of a coordinate plane: one extent all but vanishes",
                draw: |draw, row| {
                    let (tilt, axis) = (draw.log_uniform(1e-8, 1.0), draw.below(3));
                    let (frame, radius) = (tilted(draw, tilt, axis), draw.log_uniform(0.05, 5.0));
                    let centre = draw.log_uniform(1e-6, 10.0) * draw.direction();
                    disk(row, centre, radius, &frame);
                },
            },
            Scenario {
                name: "conjugate",
                summary: "any conjugate semi-axes of an ellipse of aspect log-uniform in 1..1e6",
                draw: |draw, row| {
                    let (frame, radius) = (draw.frame(), draw.log_uniform(0.05, 5.0));
                    let (a, b) = (frame.x_axis, frame.y_axis / draw.log_uniform(1.0, 1e6));
                    let (cos, sin) = draw.angle();
                    let centre = draw.uniform(0.0, 10.0) * draw.direction();
                    store(row, centre, radius * (cos * a + sin * b), radius * (cos * b - sin * a));
                },
            },
            Scenario {
                name: "offset",
                summary: "centre log-uniform 1e-4..1e8 radii from the origin: beyond 2^24 the box is one number thick",
                draw: |draw, row| {
                    let (frame, radius) = (draw.frame(), draw.log_uniform(0.05, 5.0));
                    let centre = radius * draw.log_uniform(1e-4, 1e8) * draw.direction();
                    disk(row, centre, radius, &frame);
                },
            },
            Scenario {
                name: "scale",
                summary: "as scene, lengths times 2^-80..2^80: squares leave f32",
                draw: |draw, row| {
                    let (frame, ratio) = (draw.frame(), draw.uniform(0.2, 1.0));
                    let radius = libm::exp2(draw.uniform(-80.0, 80.0));
                    let centre = radius * draw.log_uniform(0.1, 10.0) * draw.direction();
                    store(row, centre, radius * frame.x_axis, radius * ratio * frame.y_axis);
                },
            },
            Scenario {
                name: "edge",
                summary: "points, segments, coordinate planes, corners at zero, mixed scales, subnormals, landmark neighbours",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "offset",
                summary: "distance of the centre over the longest half extent; from 2^24 on a box is one number thick",
                edges: &[1e-3, 0.1, 1.0, 10.0, 1e3, 1e5, 16_777_216.0],
                coordinate: |input, _| {
                    let (c, u, v) = vectors(input);
                    c.length() / extent(u, v).max_element()
                },
            },
            Landmark {
                name: "flatness",
                summary: "shortest over longest half extent; at 0 the ellipse lies in a coordinate plane",
                edges: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1],
                coordinate: |input, _| {
                    let (_, u, v) = vectors(input);
                    extent(u, v).min_element() / extent(u, v).max_element()
                },
            },
            Landmark {
                name: "size",
                summary: "longest half extent; squares leave the normal range of f32 below 1e-19 and above 1.8e19",
                edges: &[1e-30, 1.1e-19, 1e-10, 1e-4, 1.0, 1e4, 1e10, 1.8e19, 1e30],
                coordinate: |input, _| {
                    let (_, u, v) = vectors(input);
                    extent(u, v).max_element()
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let (c, u, v) = vectors(input);
        let (mut min, mut max) = (DVec3::ZERO, DVec3::ZERO);
        for k in 0..3 {
            let (center, square) = (DoubleDouble::from(c[k]), |x: f64| DoubleDouble::product(x, x));
            let half = (square(u[k]) + square(v[k])).sqrt();
            min[k] = (center - half).to_f64();
            max[k] = (center + half).to_f64();
        }
        // e changes by itself, being homogeneous of degree one in u and v with gradients of their own signs.
        let sensitivity = (c.abs() + extent(u, v)).length();
        truth.vector(MIN, min, EPS * min.length(), sensitivity);
        truth.vector(MAX, max, EPS * max.length(), sensitivity);
    }
}

/// Half extents in plain f64. Squares of f32 neither overflow nor underflow there.
fn extent(u: DVec3, v: DVec3) -> DVec3 {
    DVec3::from_array((u * u + v * v).to_array().map(libm::sqrt))
}

fn vectors(input: &[f32]) -> (DVec3, DVec3, DVec3) {
    let vector = |i: usize| DVec3::new(f64::from(input[i]), f64::from(input[i + 1]), f64::from(input[i + 2]));
    (vector(0), vector(3), vector(6))
}

fn store(row: &mut [f32], c: DVec3, u: DVec3, v: DVec3) {
    for (slots, vector) in row.chunks_exact_mut(3).zip([c, u, v]) {
        for (slot, value) in slots.iter_mut().zip(vector.to_array()) {
            *slot = value as f32;
        }
    }
}

fn disk(row: &mut [f32], centre: DVec3, radius: f64, frame: &DMat3) {
    store(row, centre, radius * frame.x_axis, radius * frame.y_axis);
}

/// A frame whose x and y axes lie within `tilt` of a coordinate plane, by any turn within it.
fn tilted(draw: &mut Draw, tilt: f64, axis: u32) -> DMat3 {
    let ((cos, sin), (turn_cos, turn_sin)) = (draw.angle(), draw.angle());
    let (tilt_sin, tilt_cos) = libm::sincos(tilt);
    let hinge = DVec3::new(cos, sin, 0.0);
    let rise = DVec3::new(-sin * tilt_cos, cos * tilt_cos, tilt_sin);
    let (x, y) = (turn_cos * hinge + turn_sin * rise, turn_cos * rise - turn_sin * hinge);
    let turned = |a: DVec3| match axis {
        0 => DVec3::new(a.z, a.x, a.y),
        1 => DVec3::new(a.y, a.z, a.x),
        _ => a,
    };
    DMat3::from_cols(turned(x), turned(y), turned(x.cross(y)))
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(8);
    let (frame, radius) = (draw.frame(), draw.log_uniform(1e-3, 1e3));
    let centre = draw.uniform(0.0, 4.0) * radius * draw.direction();
    let (u, v) = (radius * frame.x_axis, radius * draw.uniform(0.0, 1.0) * frame.y_axis);
    let axis = draw.below(3) as usize;
    match kind {
        // A point, then segments: parallel semi-axes, equal ones, one zero.
        0 => store(row, centre, DVec3::ZERO, DVec3::ZERO),
        1 => store(row, centre, u, draw.pick(&[0.0, 1.0, -0.5, 0.3]) * u),
        // Along the axes: sides that are exact sums.
        2 => store(row, centre, radius * DVec3::AXES[axis], radius * DVec3::AXES[(axis + 1) % 3]),
        // One corner at the origin, up to rounding: the centre is the half extent.
        3 => store(row, draw.sign() * extent(u, v), u, v),
        // Each component at a scale of its own, up to 1e30: the box stays within f32.
        4 => row.fill_with(|| (draw.sign() * draw.log_uniform(1e-30, 1e30)) as f32),
        5 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        6 => {
            store(row, centre, u, v);
            row[draw.below(9) as usize] = landmarks::near_landmark(draw);
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
        let mut truth = Truth::new(EllipseBounds.outputs());
        EllipseBounds.oracle(input, &mut truth);
        truth
    }

    fn corners(truth: &Truth) -> (DVec3, DVec3) {
        (DVec3::from_slice(truth.output(MIN)), DVec3::from_slice(truth.output(MAX)))
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = EllipseBounds.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 9];
            (scenario.draw)(draw, &mut row);
            assert!(row.iter().all(|value| value.is_finite()), "{}: {row:?}", scenario.name);
            visit(draw, &row, &truth_of(&row));
        });
    }

    /// Points of the ellipse lie within the box, and one of them on each side.
    #[test]
    fn every_box_is_tight() {
        for scenario in EllipseBounds.scenarios() {
            each(scenario.name, 3_000, |_, row, truth| {
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                let ((c, u, v), (min, max)) = (vectors(row), corners(truth));
                assert!(max.abs().max_element() <= f64::from(f32::MAX), "{row:?}");
                assert!(min.abs().max_element() <= f64::from(f32::MAX), "{row:?}");
                // Roundings of the points themselves.
                let slack = 8.0 * EPS * (c.abs() + u.abs() + v.abs());
                let point = |cos: f64, sin: f64| c + cos * u + sin * v;
                for step in 0..16 {
                    let (sin, cos) = libm::sincos(f64::from(step) * std::f64::consts::TAU / 16.0);
                    let p = point(cos, sin);
                    assert!(p.cmpge(min - slack).all() && p.cmple(max + slack).all(), "{row:?}: {p}");
                }
                for k in 0..3 {
                    let along = libm::atan2(v[k], u[k]);
                    let (sin, cos) = libm::sincos(along);
                    assert!((point(cos, sin)[k] - max[k]).abs() <= slack[k], "{row:?}");
                    assert!((point(-cos, -sin)[k] - min[k]).abs() <= slack[k], "{row:?}");
                }
            });
        }
    }

    #[test]
    fn known_boxes() {
        let corners_of = |row: &[f32]| corners(&truth_of(row));
        let (min, max) = corners_of(&[1.0, 2.0, 3.0, 3.0, 0.0, 0.0, 4.0, 0.0, 1.0]);
        assert_eq!((min, max), (DVec3::new(-4.0, 2.0, 2.0), DVec3::new(6.0, 2.0, 4.0)));
        // Exactly zero, and the side of a tiny ellipse far away rounded once.
        assert_eq!(corners_of(&[5.0, 0.0, -0.0, 3.0, 0.0, 0.0, 4.0, 0.0, 0.0]).0.x, 0.0);
        let tiny = corners_of(&[1.0, 0.0, 0.0, 1e-30, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!((tiny.0.x, tiny.1.x), (1.0, 1.0));
        // sqrt(2) in twofold numbers, less its nearest f32: beyond the digits of f64's own root.
        let root = std::f32::consts::SQRT_2;
        let rest = corners_of(&[root, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0]).0.x;
        let f64_rest = f64::from(root) - std::f64::consts::SQRT_2;
        // sqrt(2) is 1.4142135623730951 - 9.667293313452913e-17.
        assert_eq!(rest, f64_rest + 9.667293313452913e-17);
    }

    /// Stated sensitivities cover what random input changes really do, and not by orders of magnitude.
    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        let step = libm::exp2(-12.0);
        for scenario in ["scene", "flat", "offset", "conjugate"] {
            each(scenario, 5_000, |draw, row, before| {
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let after = truth_of(&changed);
                for output in [MIN, MAX] {
                    let corner = |truth: &Truth| DVec3::from_slice(truth.output(output));
                    let change = (corner(&after) - corner(before)).length();
                    worst = worst.max(change / step / before.sensitivities()[output]);
                }
            });
        }
        // 1.001: rounding of the changed inputs, 2^-24 against 2^-12.
        assert!((0.8..=1.001).contains(&worst), "{worst}");
    }
}
