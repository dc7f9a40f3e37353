//! Solid angle of a pixel of a cube map: of an axis-aligned rectangle on the plane z = 1.
//!
//! The four-corner difference of A(x, y) = atan(x y/sqrt(1 + x^2 + y^2)) cancels as the square of the resolution;
//! [`plane_rectangle`] does not cancel at all, in plain f64.
//!
//! The rectangle lies between its two corners, in any order: swapping ends changes nothing. An empty one gives 0.

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::plane_rectangle::{self, side_density, solid_angle};
use crate::sample::{Draw, landmarks};

pub(super) struct PixelCube;

impl Problem for PixelCube {
    fn name(&self) -> &'static str {
        "pixel_cube"
    }

    fn summary(&self) -> &'static str {
        "Solid angle of a rectangle on the plane z = 1 (a pixel of a cube map)"
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

    /// A texel's weight off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("solid_angle", Type::Float, Quantity::SolidAngle, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "cube_map",
                summary: "pixels of cube map faces of 8 to 4096 squared, evenly over the face",
                draw: |draw, row| {
                    let size = 8 << draw.below(10);
                    pixel(draw, size, row);
                },
            },
            Scenario {
                name: "decimal",
                summary: "pixels of faces of 1000, 5000 and 10000 squared, whose corners are rounded",
                draw: |draw, row| {
                    let size = draw.pick(&[1_000, 5_000, 10_000]);
                    pixel(draw, size, row);
                },
            },
            Scenario {
                name: "fine",
                summary: "pixels of faces of 2^13 to 2^20 squared",
                draw: |draw, row| {
                    let size = 1 << (13 + draw.below(8));
                    pixel(draw, size, row);
                },
            },
            Scenario {
                name: "window",
                summary: "any rectangle within -1..1, sides log-uniform 1e-6 to 2",
                draw: |draw, row| {
                    let (width, height) = (draw.log_uniform(1e-6, 2.0), draw.log_uniform(1e-6, 2.0));
                    let (x, y) = (draw.uniform(-1.0, 1.0 - width), draw.uniform(-1.0, 1.0 - height));
                    store(row, [x, y, x + width, y + height]);
                },
            },
            Scenario {
                name: "wide",
                summary: "fields of view to 179.9 degrees: corners to 1000, sides log-uniform 1e-3 to 2000",
                draw: |draw, row| {
                    let (width, height) = (draw.log_uniform(1e-3, 2e3), draw.log_uniform(1e-3, 2e3));
                    let (x, y) = (draw.uniform(-1e3, 1e3 - width), draw.uniform(-1e3, 1e3 - height));
                    store(row, [x, y, x + width, y + height]);
                },
            },
            Scenario {
                name: "edge",
                summary: "empty, reversed, whole faces, centred on the axis, subnormal and landmark values to 1e10",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "side",
                summary: "the shorter side; 2/n in a face of n x n",
                edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2],
                coordinate: |input, _| sides(input).into_iter().fold(f64::INFINITY, f64::min),
            },
            Landmark {
                name: "aspect",
                summary: "longer over shorter side",
                edges: &[1.01, 2.0, 10.0, 1e2, 1e3, 1e4, 1e5],
                coordinate: |input, _| {
                    let [width, height] = sides(input);
                    width.max(height) / width.min(height)
                },
            },
            Landmark {
                name: "off_axis",
                summary: "distance of the middle from the face's centre",
                edges: &[1e-3, 1e-2, 0.1, 0.5, 1.0, 1.5, 10.0, 1e2],
                coordinate: |input, _| {
                    let [x0, y0, x1, y1] = std::array::from_fn(|i| f64::from(input[i]));
                    libm::hypot(0.5 * (x0 + x1), 0.5 * (y0 + y1))
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let [x0, y0, x1, y1] = std::array::from_fn(|i| f64::from(input[i]));
        let value = solid_angle(x0, y0, x1, y1);
        let sensitivity = x0.abs() * side_density(x0, y0, y1)
            + x1.abs() * side_density(x1, y0, y1)
            + y0.abs() * side_density(y0, x0, x1)
            + y1.abs() * side_density(y1, x0, x1);
        truth.scalar(0, value, plane_rectangle::BOUND * value, sensitivity);
    }
}

fn sides(input: &[f32]) -> [f64; 2] {
    [(f64::from(input[2]) - f64::from(input[0])).abs(), (f64::from(input[3]) - f64::from(input[1])).abs()]
}

fn store(row: &mut [f32], values: [f64; 4]) {
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// A pixel of a face of `size` x `size` pixels.
fn pixel(draw: &mut Draw, size: u32, row: &mut [f32]) {
    let at = |k: u32| 2.0 * f64::from(k) / f64::from(size) - 1.0;
    let (column, line) = (draw.below(size), draw.below(size));
    store(row, [at(column), at(line), at(column + 1), at(line + 1)]);
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(8);
    let [a, b, c, d] = [(); 4].map(|()| draw.sign() * draw.log_uniform(1e-3, 10.0));
    match kind {
        0 => store(row, [a, b, a, d]),
        // In any order.
        1 => store(row, [a, b, c, d]),
        2 => store(row, [-a, -b, a, b]),
        3 => store(row, [0.0, 0.0, a, b]),
        4 => {
            let whole = draw.pick(&[1.0, 1e3, 1e6, 1e10]);
            store(row, [-whole, -whole, whole, whole]);
        }
        5 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        // Neighbours, within a few roundings of each other.
        6 => {
            let (x, y) = (a as f32, b as f32);
            let (over, up) = (1 + i64::from(draw.below(4)), 1 + i64::from(draw.below(4)));
            row.copy_from_slice(&[x, y, landmarks::neighbour(x, over), landmarks::neighbour(y, up)]);
        }
        _ => row.fill_with(|| landmarks::near_landmark(draw).clamp(-1e10, 1e10)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;
    use std::f64::consts::PI;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(PixelCube.outputs());
        PixelCube.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = PixelCube.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 4];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    /// Against the published primitive in f64: four arctangents, each within 2 roundings.
    #[test]
    fn every_truth_is_certified_and_that_of_the_primitive() {
        let corner = |x: f64, y: f64| libm::atan2(x * y, libm::sqrt(1.0 + x * x + y * y));
        for scenario in PixelCube.scenarios() {
            each(scenario.name, 20_000, |_, row, truth| {
                let value = truth.values()[0];
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=2.0 * PI).contains(&value), "{row:?}: {truth:?}");
                let [x0, y0, x1, y1] = std::array::from_fn(|i| f64::from(row[i]));
                let corners = [corner(x1, y1), -corner(x0, y1), -corner(x1, y0), corner(x0, y0)];
                let slack = 4.0 * f64::EPSILON * corners.iter().map(|c| c.abs()).sum::<f64>();
                assert!((value - corners.iter().sum::<f64>().abs()).abs() <= slack, "{row:?}: {value}");
            });
        }
    }

    #[test]
    fn order_and_emptiness() {
        let value = |row: [f32; 4]| truth_of(&row).values()[0];
        assert_eq!(value([0.25, 0.0, 0.25, 1.0]), 0.0);
        let upright = value([-0.25, 0.5, 0.75, 0.625]);
        assert!(upright > 0.0);
        assert_eq!(value([0.75, 0.5, -0.25, 0.625]), upright);
        assert_eq!(value([-0.25, 0.625, 0.75, 0.5]), upright);
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        for scenario in ["cube_map", "window", "wide"] {
            each(scenario, 5_000, |draw, row, before| {
                let step = 2f64.powi(-16);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let (here, there) = (before.values()[0], truth_of(&changed).values()[0]);
                // First order only, and not beyond where the value vanishes.
                if before.sensitivities()[0] * step < 0.05 * here {
                    worst = worst.max((there - here).abs() / step / before.sensitivities()[0]);
                }
            });
        }
        // 1.1: second order. 0.9: one draw of sixteen has all signs at their worst.
        assert!((0.9..=1.1).contains(&worst), "{worst}");
    }
}
