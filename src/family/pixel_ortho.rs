//! Solid angle of a pixel of an orthographic image of the hemisphere: of the part of a rectangle inside the unit circle,
//! over which every area element dx dy stands for dx dy/sqrt(1 - x^2 - y^2) of the sphere.
//!
//! The published primitive ends at the circle, and its four-corner difference cancels as the square of the resolution;
//! [`disk_rectangle`] clips exactly and does not cancel, but for rectangles that are much longer than wide.
//!
//! The rectangle lies between its two corners, in any order: swapping ends changes nothing. An empty one and one outside
//! the circle give exactly 0.

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::disk_rectangle::clipped;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::sample::{Draw, landmarks};

pub(super) struct PixelOrtho;

impl Problem for PixelOrtho {
    fn name(&self) -> &'static str {
        "pixel_ortho"
    }

    fn summary(&self) -> &'static str {
        "Solid angle of a pixel of an orthographic image of the hemisphere, clipped by the unit circle"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("x0", Type::Float),
                Field::new("y0", Type::Float),
                Field::new("x1", Type::Float),
                Field::new("y1", Type::Float),
            ]
        }
    }

    /// A pixel's weight off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("solid_angle", Type::Float, Quantity::SolidAngle, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "image",
                summary: "pixels of images of 8 to 4096 squared that touch the disk's bounding square, evenly",
                draw: |draw, row| {
                    let size = 8 << draw.below(10);
                    let (column, line) = (draw.below(size), draw.below(size));
                    store_pixel(row, size, column, line);
                },
            },
            Scenario {
                name: "boundary",
                summary: "pixels of the same images that the unit circle cuts",
                draw: |draw, row| {
                    let size = 8 << draw.below(10);
                    boundary_pixel(draw, size, row);
                },
            },
            Scenario {
                name: "decimal",
                summary: "pixels of images of 1000, 5000 and 10000 squared, whose corners are rounded; half of them cut",
                draw: |draw, row| {
                    let size = draw.pick(&[1_000, 5_000, 10_000]);
                    inner_or_boundary(draw, size, row);
                },
            },
            Scenario {
                name: "fine",
                summary: "pixels of images of 2^13 to 2^20 squared, half of them cut",
                draw: |draw, row| {
                    let size = 1 << (13 + draw.below(8));
                    inner_or_boundary(draw, size, row);
                },
            },
            Scenario {
                name: "window",
                summary: "any rectangle that may stick out of the disk, sides log-uniform 1e-3 to 2",
                draw: |draw, row| {
                    let (width, height) = (draw.log_uniform(1e-3, 2.0), draw.log_uniform(1e-3, 2.0));
                    let (x, y) = (draw.uniform(-1.1, 1.1 - width), draw.uniform(-1.1, 1.1 - height));
                    store(row, [x, y, x + width, y + height]);
                },
            },
            Scenario {
                name: "grazing",
                summary: "the corner nearest to the centre 1e-6..1e-1 inside the circle, sides log-uniform 1e-3 to 1",
                draw: |draw, row| {
                    let (cos, sin) = draw.angle();
                    let radius = 1.0 - draw.log_uniform(1e-6, 0.1);
                    let (width, height) = (draw.log_uniform(1e-3, 1.0), draw.log_uniform(1e-3, 1.0));
                    let (x, y) = (radius * cos, radius * sin);
                    store(row, [x, y, x + width.copysign(x), y + height.copysign(y)]);
                },
            },
            Scenario {
                name: "edge",
                summary: "empty, reversed, whole, outside; corners on the circle or a rounding off; subnormal and landmark values",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "side",
                summary: "the shorter side; 2/n in an image of n x n",
                edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0],
                coordinate: |input, _| {
                    let side = |a: usize, b: usize| (f64::from(input[a]) - f64::from(input[b])).abs();
                    side(2, 0).min(side(3, 1))
                },
            },
            Landmark {
                name: "far_corner",
                summary: "1 - x^2 - y^2 of the corner farthest from the centre; below 0 the circle cuts the pixel",
                edges: &[-1.0, -0.1, -1e-2, -1e-3, -1e-4, 0.0, 1e-4, 1e-3, 1e-2, 0.1, 0.5],
                coordinate: |input, _| {
                    let reach = |a: usize, b: usize| f64::from(input[a]).abs().max(f64::from(input[b]).abs());
                    1.0 - reach(0, 2) * reach(0, 2) - reach(1, 3) * reach(1, 3)
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let [a, b, c, d] = std::array::from_fn(|i| f64::from(input[i]));
        let ([x0, x1], [y0, y1]) = ([a.min(c), a.max(c)], [b.min(d), b.max(d)]);
        let area = clipped(x0, y0, x1, y1);
        if area.escalated {
            truth.escalate();
        }
        let [left, low, right, high] = area.densities;
        let mut sensitivity = x0.abs() * left + y0.abs() * low + x1.abs() * right + y1.abs() * high;
        // A corner at the circle, where the first order says nothing: what four roundings outwards do.
        let nearest = |low: f64, high: f64| low.max(-high).max(0.0);
        let (x, y) = (nearest(x0, x1), nearest(y0, y1));
        const STEP: f64 = 4.0 * UNIT_ROUNDOFF;
        if x1 > x0 && y1 > y0 && (1.0 - x * x - y * y).abs() < 32.0 * UNIT_ROUNDOFF {
            let out = |v: f64, way: f64| v + way * v.abs() * STEP;
            let grown = clipped(out(x0, -1.0), out(y0, -1.0), out(x1, 1.0), out(y1, 1.0));
            sensitivity = sensitivity.max((grown.value - area.value) / STEP);
        }
        truth.scalar(0, area.value, area.bound, sensitivity);
    }
}

fn store(row: &mut [f32], values: [f64; 4]) {
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// A pixel of an image of `size` x `size` pixels.
fn store_pixel(row: &mut [f32], size: u32, column: u32, line: u32) {
    let at = |k: u32| 2.0 * f64::from(k) / f64::from(size) - 1.0;
    store(row, [at(column), at(line), at(column + 1), at(line + 1)]);
}

/// A pixel that the circle cuts, in any octant.
fn boundary_pixel(draw: &mut Draw, size: u32, row: &mut [f32]) {
    let (cos, sin) = draw.angle();
    let index = |v: f64| (0.5 * (v + 1.0) * f64::from(size)) as u32;
    store_pixel(row, size, index(cos).min(size - 1), index(sin).min(size - 1));
}

fn inner_or_boundary(draw: &mut Draw, size: u32, row: &mut [f32]) {
    if draw.sign() > 0.0 {
        return boundary_pixel(draw, size, row);
    }
    let (cos, sin) = draw.angle();
    let radius = libm::sqrt(draw.unit());
    let index = |v: f64| (0.5 * (radius * v + 1.0) * f64::from(size)) as u32;
    store_pixel(row, size, index(cos).min(size - 1), index(sin).min(size - 1));
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(9);
    let [a, b, c, d] = [(); 4].map(|()| draw.uniform(-1.2, 1.2));
    match kind {
        0 => store(row, [a, b, a, d]),
        // In any order.
        1 => store(row, [a, b, c, d]),
        2 => {
            let whole = draw.pick(&[1.0, 1.5, 1e10]);
            store(row, [-whole, -whole, whole, whole]);
        }
        // Outside but for the bounding square, and touching the circle from outside.
        3 => {
            let corner = draw.uniform(0.7072, 1.0) * draw.sign();
            store(row, [corner, corner, 1.0_f64.copysign(corner), 1.0_f64.copysign(corner)]);
        }
        4 => store(row, [draw.sign(), a, 2.0, c]),
        // A corner as near to the circle as f32 comes, either near or far.
        5 => {
            let (cos, sin) = draw.angle();
            let off = i64::from(draw.below(7)) - 3;
            let (x, y) = (cos as f32, landmarks::neighbour(sin as f32, off));
            let (width, height) = (draw.log_uniform(1e-6, 1.0), draw.log_uniform(1e-6, 1.0));
            let way = draw.sign();
            let (over, up) = (way * width.copysign(cos), way * height.copysign(sin));
            row.copy_from_slice(&[x, y, (cos + over) as f32, (sin + up) as f32]);
        }
        // The circle's four exact points.
        6 => {
            let side = draw.log_uniform(1e-6, 1.0);
            let ways = [draw.sign(), draw.sign()];
            let corners = [
                [ways[0], 0.0, ways[0] * (1.0 - side), ways[1] * side],
                [0.0, ways[0], ways[1] * side, ways[0] * (1.0 - side)],
            ];
            store(row, draw.pick(&corners));
        }
        7 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        _ => row.fill_with(|| landmarks::near_landmark(draw).clamp(-1e10, 1e10)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;
    use std::f64::consts::TAU;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(PixelOrtho.outputs());
        PixelOrtho.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = PixelOrtho.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 4];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    /// Against the primitive in f64, whose height is 0 outside the circle.
    #[test]
    fn every_truth_is_certified_and_that_of_the_primitive() {
        let corner = |x: f64, y: f64| {
            let (x, y) = (x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0));
            let z = libm::sqrt((1.0 - x * x - y * y).max(0.0));
            y * libm::atan2(x, z) + x * libm::atan2(y, z) - libm::atan2(x * y, z)
        };
        for scenario in PixelOrtho.scenarios() {
            let (mut seen, mut escalated) = (0, 0);
            each(scenario.name, 20_000, |_, row, truth| {
                let value = truth.values()[0];
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=TAU).contains(&value), "{row:?}: {truth:?}");
                assert!(truth.sensitivities()[0] >= 0.0, "{row:?}: {truth:?}");
                let [x0, y0, x1, y1] = std::array::from_fn(|i| f64::from(row[i]));
                let expected = corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
                assert!((value - expected.abs()).abs() <= 1e-14, "{row:?}: {value} {expected}");
                seen += u32::from(value > 0.0);
                escalated += u32::from(truth.escalated());
            });
            assert!(seen > 8_000 && escalated < 4_000, "{}: {seen} {escalated}", scenario.name);
        }
    }

    #[test]
    fn order_emptiness_and_the_outside() {
        let value = |row: [f32; 4]| truth_of(&row).values()[0];
        assert_eq!(value([0.25, 0.0, 0.25, 1.0]), 0.0);
        assert_eq!(value([0.75, 0.75, 0.875, 1.0]), 0.0);
        assert_eq!(value([1.0, -0.5, 1.5, 0.5]), 0.0);
        let upright = value([-0.25, 0.5, 0.75, 0.625]);
        assert!(upright > 0.0);
        assert_eq!(value([0.75, 0.5, -0.25, 0.625]), upright);
        assert_eq!(value([-0.25, 0.625, 0.75, 0.5]), upright);
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        for scenario in ["image", "window", "grazing"] {
            each(scenario, 5_000, |draw, row, before| {
                let step = 2f64.powi(-18);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let after = truth_of(&changed);
                let (here, there) = (before.values()[0], after.values()[0]);
                let (sensitivity, next) = (before.sensitivities()[0], after.sensitivities()[0]);
                // First order only, and not beyond where the value vanishes or its slope changes.
                if sensitivity * step < 0.05 * here && (next / sensitivity - 1.0).abs() < 0.1 {
                    worst = worst.max((there - here).abs() / step / sensitivity);
                }
            });
        }
        // 1.1: second order. 0.9: one draw of sixteen has all signs at their worst.
        assert!((0.9..=1.1).contains(&worst), "{worst}");
    }
}
