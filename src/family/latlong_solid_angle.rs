//! Solid angle of a rectangle of latitude and longitude, as of a pixel of an equirectangular image.
//!
//! ```text
//! Omega = |sin lat1 - sin lat0| |lon1 - lon0| = 2 |cos m sin w| |lon1 - lon0|     m = (lat0 + lat1)/2, w = (lat1 - lat0)/2
//! ```
//!
//! The first form cancels, the second does not. Sums and differences of two f32 are exact as pairs of f64, and
//! cos(hi + lo) = cos hi - lo sin hi beside the pole, where the cosine is small: plain f64 always does.
//!
//! The interval lies between its two ends in either order, so swapping them changes nothing; an empty one gives 0. A
//! rounded latitude may lie beyond the pole by up to 2^-24: the formula stands as it is.

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::exact::two_sum;
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, landmarks};

pub(super) struct LatlongSolidAngle;

/// The f32 nearest to pi/2, 4e-8 beyond the pole, and to pi.
const POLE: f64 = std::f32::consts::FRAC_PI_2 as f64;
const HALF_TURN: f64 = std::f32::consts::PI as f64;

impl Problem for LatlongSolidAngle {
    fn name(&self) -> &'static str {
        "latlong_solid_angle"
    }

    fn summary(&self) -> &'static str {
        "Solid angle of a rectangle of latitude and longitude (a pixel of an equirectangular image)"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("lat0", Type::Float),
                Field::new("lat1", Type::Float),
                Field::new("lon0", Type::Float),
                Field::new("lon1", Type::Float),
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
                name: "image",
                summary: "pixels of equirectangular images of 64 x 32 to 8192 x 4096, evenly over the image",
                draw: |draw, row| {
                    let height = 32 << draw.below(8);
                    pixel(draw, height, row);
                },
            },
            Scenario {
                name: "fine",
                summary: "images of 2^14 to 2^20 rows, half of them within 64 rows of a pole",
                draw: |draw, row| {
                    let height = 1 << (14 + draw.below(7));
                    if draw.sign() > 0.0 {
                        pixel(draw, height, row);
                    } else {
                        let from_pole = draw.below(64);
                        let line = if draw.sign() > 0.0 { from_pole } else { height - 1 - from_pole };
                        let column = draw.below(2 * height);
                        store_pixel(row, height, line, column);
                    }
                },
            },
            Scenario {
                name: "rectangle",
                summary: "any rectangle, height and width log-uniform 1e-6 to the whole sphere",
                draw: |draw, row| {
                    let (height, width) =
                        (draw.log_uniform(1e-6, 2.0 * POLE), draw.log_uniform(1e-6, 2.0 * HALF_TURN));
                    let (lat, lon) =
                        (draw.uniform(-POLE, POLE - height), draw.uniform(-HALF_TURN, HALF_TURN - width));
                    store(row, [lat, lat + height, lon, lon + width]);
                },
            },
            Scenario {
                name: "pole",
                summary: "one side 1e-7..1e-1 of a pole, the other up to ten times as far",
                draw: |draw, row| {
                    let near = if draw.below(4) == 0 { 0.0 } else { draw.log_uniform(1e-7, 0.1) };
                    let far = near + draw.log_uniform(1e-7, 1.0);
                    let side = draw.sign();
                    let lon = draw.uniform(-HALF_TURN, HALF_TURN);
                    let width = draw.uniform(-HALF_TURN, HALF_TURN) - lon;
                    store(row, [side * (POLE - far), side * (POLE - near), lon, lon + width]);
                },
            },
            Scenario {
                name: "edge",
                summary: "empty, reversed, the whole sphere, across the equator, subnormal and landmark values",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "height",
                summary: "difference of the latitudes in radians",
                edges: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0],
                coordinate: |input, _| (f64::from(input[1]) - f64::from(input[0])).abs(),
            },
            Landmark {
                name: "from_pole",
                summary: "distance of the middle latitude from the pole in radians",
                edges: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0],
                coordinate: |input, _| {
                    std::f64::consts::FRAC_PI_2 - (0.5 * (f64::from(input[0]) + f64::from(input[1]))).abs()
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let [lat0, lat1, lon0, lon1] = std::array::from_fn(|i| f64::from(input[i]));
        let (middle, rest) = two_sum(0.5 * lat0, 0.5 * lat1);
        let (sin, cos) = libm::sincos(middle);
        let height = 2.0 * (cos - rest * sin) * libm::sin(0.5 * (lat1 - lat0));
        let width = lon1 - lon0;
        let value = (height * width).abs();
        let of_latitudes = (lat0 * libm::cos(lat0)).abs() + (lat1 * libm::cos(lat1)).abs();
        let sensitivity = of_latitudes * width.abs() + (lon0.abs() + lon1.abs()) * height.abs();
        // Two functions within an ulp each, two differences and four products.
        truth.scalar(0, value, 12.0 * EPS * value, sensitivity);
    }
}

fn store(row: &mut [f32], values: [f64; 4]) {
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// A pixel of an image of `height` rows and twice as many columns.
fn pixel(draw: &mut Draw, height: u32, row: &mut [f32]) {
    let (line, column) = (draw.below(height), draw.below(2 * height));
    store_pixel(row, height, line, column);
}

fn store_pixel(row: &mut [f32], height: u32, line: u32, column: u32) {
    let at = |k: u32| std::f64::consts::PI * f64::from(k) / f64::from(height);
    let (lat, lon) = (|k| at(k) - std::f64::consts::FRAC_PI_2, |k| at(k) - std::f64::consts::PI);
    store(row, [lat(line), lat(line + 1), lon(column), lon(column + 1)]);
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(7);
    let [a, b] = [(); 2].map(|()| draw.uniform(-POLE, POLE));
    let [c, d] = [(); 2].map(|()| draw.uniform(-HALF_TURN, HALF_TURN));
    match kind {
        0 => store(row, [a, a, c, d]),
        1 => store(row, [a, b, c, c]),
        // In any order.
        2 => store(row, [a, b, c, d]),
        3 => store(row, [-POLE, POLE, -HALF_TURN, HALF_TURN]),
        4 => store(row, [-a, a, -c, c]),
        5 => row.fill_with(|| f32::from_bits(draw.below(0x0100_0000)) * draw.sign() as f32),
        _ => {
            let limits = [POLE, POLE, HALF_TURN, HALF_TURN].map(|limit| limit as f32);
            for (slot, limit) in row.iter_mut().zip(limits) {
                let near_limit = draw.below(3) == 0;
                *slot = if near_limit {
                    draw.sign() as f32 * landmarks::neighbour(limit, -i64::from(draw.below(100)))
                } else {
                    landmarks::near_landmark(draw).clamp(-limit, limit)
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(LatlongSolidAngle.outputs());
        LatlongSolidAngle.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = LatlongSolidAngle.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 4];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    /// Against the difference of sines, each of which is off by 2 roundings of 1 absolutely.
    #[test]
    fn every_truth_is_certified_and_that_of_the_definition() {
        for scenario in LatlongSolidAngle.scenarios() {
            each(scenario.name, 20_000, |_, row, truth| {
                let value = truth.values()[0];
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=4.0 * HALF_TURN).contains(&value), "{row:?}: {truth:?}");
                let [lat0, lat1, lon0, lon1] = std::array::from_fn(|i| f64::from(row[i]));
                let width = (lon1 - lon0).abs();
                let expected = (libm::sin(lat1) - libm::sin(lat0)).abs() * width;
                assert!((value - expected).abs() <= (4.0 * width + 16.0 * expected) * EPS, "{row:?}");
            });
        }
    }

    #[test]
    fn order_and_emptiness() {
        let value = |row: [f32; 4]| truth_of(&row).values()[0];
        assert_eq!(value([0.25, 0.25, 0.0, 1.0]), 0.0);
        assert_eq!(value([0.25, 0.5, 1.0, 1.0]), 0.0);
        let upright = value([-0.25, 0.5, -1.0, 2.0]);
        assert!(upright > 0.0);
        assert_eq!(value([0.5, -0.25, -1.0, 2.0]), upright);
        assert_eq!(value([-0.25, 0.5, 2.0, -1.0]), upright);
        let pole = POLE as f32;
        let sphere = value([-pole, pole, -2.0 * pole, 2.0 * pole]);
        assert!((sphere / (4.0 * HALF_TURN) - 1.0).abs() < 1e-14, "{sphere}");
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        let mut worst: f64 = 0.0;
        for scenario in ["image", "rectangle"] {
            each(scenario, 5_000, |draw, row, before| {
                let step = 2f64.powi(-14);
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
