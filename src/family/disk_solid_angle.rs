//! Solid angle of a disk seen from a point on its axis.
//!
//! ```text
//! Omega = 2 pi (1 - cos theta) = 2 pi R^2 / (h (h + d))     tan theta = R/d, h = hypot(R, d)
//! ```
//!
//! The first form cancels, the second does not. Squares of f32 are exact in f64, so plain f64 always does.
//!
//! Signs do not count: a disk behind is a disk. From the disk's own plane (d = 0) half of all directions hit it, and a
//! disk without a radius is never hit, from its own centre neither: 2 pi and 0.

use std::f64::consts::TAU;

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, landmarks};

pub(super) struct DiskSolidAngle;

impl Problem for DiskSolidAngle {
    fn name(&self) -> &'static str {
        "disk_solid_angle"
    }

    fn summary(&self) -> &'static str {
        "Solid angle of a disk seen from a point on its axis"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("radius", Type::Float), Field::new("distance", Type::Float)] }
    }

    /// A light off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("solid_angle", Type::Float, Quantity::SolidAngle, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "disk lights of 5 cm to 5 m, 0.1 to 20 m away",
                draw: |draw, row| store(row, draw.log_uniform(0.05, 5.0), draw.log_uniform(0.1, 20.0)),
            },
            Scenario {
                name: "far",
                summary: "distance log-uniform 1 to 1e6 radii: the sun is at 215, what follows is smaller than a pixel",
                draw: |draw, row| {
                    let radius = draw.log_uniform(0.05, 5.0);
                    store(row, radius, radius * draw.log_uniform(1.0, 1e6));
                },
            },
            Scenario {
                name: "near",
                summary: "distance log-uniform 1e-8 to 1 radii",
                draw: |draw, row| {
                    let radius = draw.log_uniform(0.05, 5.0);
                    store(row, radius, radius * draw.log_uniform(1e-8, 1.0));
                },
            },
            Scenario {
                name: "scale",
                summary: "radius log-uniform 2^-60..2^60, distance 0.01 to 100 radii: squares leave f32",
                draw: |draw, row| {
                    let radius = draw.log_uniform(libm::exp2(-60.0), libm::exp2(60.0));
                    store(row, radius, radius * draw.log_uniform(0.01, 100.0));
                },
            },
            Scenario {
                name: "edge",
                summary: "zero, equal, negative, subnormal and landmark values",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[Landmark {
            name: "tangent",
            summary: "radius over distance: small for far disks",
            edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e4, 1e6],
            coordinate: |input, _| f64::from(input[0]).abs() / f64::from(input[1]).abs(),
        }]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let (radius, distance) = (f64::from(input[0]).abs(), f64::from(input[1]).abs());
        if radius == 0.0 {
            return truth.scalar(0, 0.0, 0.0, 0.0);
        }
        let square = radius * radius;
        let slant = libm::sqrt(square + distance * distance);
        // Rounding may go beyond the half space.
        let value = (TAU * (square / slant) / (slant + distance)).min(TAU);
        // Seven roundings, of which the root's argument counts half. Radius and distance change the value alike.
        let change = TAU * (distance / slant) * (square / slant / slant);
        truth.scalar(0, value, 8.0 * EPS * value, 2.0 * change);
    }
}

fn store(row: &mut [f32], radius: f64, distance: f64) {
    row[0] = radius as f32;
    row[1] = distance as f32;
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let (a, b) = (draw.log_uniform(1e-3, 1e3), draw.log_uniform(1e-3, 1e3));
    let kind = draw.below(8);
    match kind {
        0 => store(row, 0.0, if draw.sign() > 0.0 { 0.0 } else { a }),
        1 => store(row, a, 0.0),
        2 => store(row, a, a),
        3 => store(row, draw.sign() * a, draw.sign() * b),
        4 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000))),
        5 => {
            store(row, a, b);
            row[draw.below(2) as usize] = landmarks::near_landmark(draw);
        }
        6 => store(row, draw.log_uniform(1e-30, 1e30), draw.log_uniform(1e-30, 1e30)),
        _ => row.fill_with(|| landmarks::near_landmark(draw)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(DiskSolidAngle.outputs());
        DiskSolidAngle.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = DiskSolidAngle.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 2];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    /// 1 - cos theta = 2 sin^2(theta/2), an identity that does not cancel either.
    #[test]
    fn every_truth_is_certified_and_that_of_the_half_angle() {
        for scenario in DiskSolidAngle.scenarios() {
            each(scenario.name, 20_000, |_, row, truth| {
                let value = truth.values()[0];
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=TAU).contains(&value), "{row:?}: {truth:?}");
                let (radius, distance) = (f64::from(row[0]).abs(), f64::from(row[1]).abs());
                let sine = libm::sin(0.5 * libm::atan2(radius, distance));
                let expected = 2.0 * TAU * sine * sine;
                assert!((value - expected).abs() <= 16.0 * EPS * expected, "{row:?}: {value} {expected}");
            });
        }
    }

    #[test]
    fn degenerate_disks_have_their_stated_answers() {
        for (row, expected) in
            [([0.0, 0.0], 0.0), ([0.0, 1.0], 0.0), ([1.0, 0.0], TAU), ([-3.0, -4.0], 0.4 * TAU * 0.5)]
        {
            let value = truth_of(&row).values()[0];
            assert!((value - expected).abs() <= 4.0 * EPS * expected, "{row:?}: {value}");
        }
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        for scenario in ["scene", "far", "near"] {
            each(scenario, 2_000, |draw, row, before| {
                let step = 2f64.powi(-12);
                let changed = [row[0], row[1]].map(|v| (f64::from(v) * (1.0 + draw.sign() * step)) as f32);
                let change = (truth_of(&changed).values()[0] - before.values()[0]).abs() / step;
                worst = worst.max(change / before.sensitivities()[0]);
            });
        }
        // 1.01: second order at this step. Of four pairs of signs two are the worst.
        assert!((0.95..=1.01).contains(&worst), "{worst}");
    }
}
