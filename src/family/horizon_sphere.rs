//! Irradiance of a uniform sphere that the horizon may cut, from its direction's cosine and its half angle.
//!
//! What remains of a disk, sphere or polygon light once it is replaced by the sphere of the same vector irradiance.
//! Truth is the closed form of [`clipped_sphere`], which does not cancel: products and squares of two f32 are exact in
//! f64, so plain f64 always does.

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::clipped_sphere::clipped_sphere;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::sample::{Draw, landmarks};

pub(super) struct HorizonSphere;

const IRRADIANCE: usize = 0;

impl Problem for HorizonSphere {
    fn name(&self) -> &'static str {
        "horizon_sphere"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of a sphere cut by the horizon, by the cosine of its direction and its squared sine of half angle"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("cos_theta", Type::Float), Field::new("sin2_half_angle", Type::Float)] }
    }

    /// One step of a 10-bit display.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("irradiance", Type::Float, Quantity::Irradiance, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "spheres 1 to 100 radii away (log-uniform) in any direction",
                draw: |draw, row| {
                    let sine = draw.log_uniform(0.01, 1.0);
                    store(row, draw.uniform(-1.0, 1.0), sine * sine);
                },
            },
            Scenario {
                name: "grazing",
                summary: "the centre close to the horizon: cosine of either sign, log-uniform in 1e-8..1e-2",
                draw: |draw, row| {
                    let cosine = draw.sign() * draw.log_uniform(1e-8, 1e-2);
                    store(row, cosine, draw.log_uniform(1e-4, 1.0));
                },
            },
            Scenario {
                name: "horizon",
                summary: "the rim touches the horizon but for 2^-24..0.1 of the sphere's sine, from above or below",
                draw: |draw, row| {
                    let sin2 = f64::from(draw.log_uniform(1e-6, 1.0) as f32);
                    let off = draw.sign() * draw.log_uniform(UNIT_ROUNDOFF, 0.1);
                    store(row, draw.sign() * (libm::sqrt(sin2) * (1.0 + off)).min(1.0), sin2);
                },
            },
            Scenario {
                name: "small",
                summary: "squared sine log-uniform in 1e-12..1e-4, half of them within two half angles of the horizon",
                draw: |draw, row| {
                    let sin2 = draw.log_uniform(1e-12, 1e-4);
                    let reach = draw.pick(&[2.0 * libm::sqrt(sin2), 1.0]);
                    store(row, draw.uniform(-reach, reach), sin2);
                },
            },
            Scenario {
                name: "near_full",
                summary: "the surface almost touches the sphere: 1 - squared sine 2^-24..0.1, cosines up to 2^-24 from +-1",
                draw: |draw, row| {
                    let sin2 = 1.0 - draw.log_uniform(UNIT_ROUNDOFF, 0.1);
                    let near = draw.sign() * (1.0 - draw.log_uniform(UNIT_ROUNDOFF, 1.0));
                    let any = draw.uniform(-1.0, 1.0);
                    store(row, draw.pick(&[near, any]), sin2);
                },
            },
            Scenario {
                name: "edge",
                summary: "both ends, squares, subnormals, landmark neighbours; up to 8 roundings beyond the ends, which count as the ends",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "cos_theta",
                summary: "cosine of the centre's direction with the normal",
                edges: &[-0.9, -0.5, -0.1, -1e-2, -1e-4, 0.0, 1e-4, 1e-2, 0.1, 0.5, 0.9],
                coordinate: |input, _| f64::from(input[0]),
            },
            Landmark {
                name: "sin2",
                summary: "squared sine of the half angle; 1: the surface touches the sphere",
                edges: &[1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 0.5, 0.9, 0.99, 0.9999],
                coordinate: |input, _| f64::from(input[1]),
            },
            Landmark {
                name: "lower_rim",
                summary: "elevation of the lower rim over the horizon in radians; below 0 the horizon cuts or hides the sphere",
                edges: &[-1.5, -1.0, -0.5, -0.1, -1e-2, -1e-4, 0.0, 1e-4, 1e-2, 0.1, 0.5],
                coordinate: |input, _| {
                    let angle = |sine: f64| libm::asin(sine.clamp(-1.0, 1.0));
                    angle(f64::from(input[0])) - angle(libm::sqrt(f64::from(input[1]).max(0.0)))
                },
            },
        ]
    }

    /// Inputs beyond -1..1 and 0..1 count as the nearer end.
    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let (c, s) = (f64::from(input[0]).clamp(-1.0, 1.0), f64::from(input[1]).clamp(0.0, 1.0));
        let sphere = clipped_sphere(c, s);
        // dE/ds grows as 1/sqrt(1 - s). What s changes by a rounding u = 2^-24 changes E by at most the integral of
        // (|c| + r/(pi sqrt(1 - s))) over that rounding, r <= sqrt(1 - c^2): |c| u + 2 r sqrt(u)/pi.
        let secant = c.abs() + std::f64::consts::FRAC_2_PI * libm::sqrt((1.0 - c * c) / UNIT_ROUNDOFF);
        let sensitivity = (c * sphere.by_cosine).abs() + s * sphere.by_sin2.abs().min(secant);
        truth.scalar(IRRADIANCE, sphere.irradiance, sphere.bound, sensitivity);
    }
}

fn store(row: &mut [f32], cosine: f64, sin2: f64) {
    row[0] = cosine as f32;
    row[1] = sin2 as f32;
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let sin2 = draw.log_uniform(1e-6, 1.0) as f32;
    let cosine = draw.uniform(-1.0, 1.0) as f32;
    let kind = draw.below(8);
    let near_one = landmarks::neighbour(1.0, i64::from(draw.below(17)) - 8);
    let sign = draw.sign() as f32;
    (row[0], row[1]) = match kind {
        0 => (draw.pick(&[-1.0, 1.0, 0.0, -0.0]), draw.pick(&[0.0, 1.0, sin2])),
        1 => (cosine, draw.pick(&[0.0, 1.0])),
        2 => (sign * near_one, sin2),
        3 => (cosine, near_one),
        4 => (sign * near_one, landmarks::neighbour(1.0, i64::from(draw.below(17)) - 8)),
        // The rim exactly on the horizon, where the cosine has 12 bits, and the roundings around it.
        5 => {
            let short = f32::from_bits(cosine.to_bits() & 0xffff_f000);
            (short, landmarks::neighbour(short * short, i64::from(draw.below(5)) - 2))
        }
        6 => (sign * f32::from_bits(draw.below(0x0100_0000)), f32::from_bits(draw.below(0x0100_0000))),
        _ => (landmarks::near_landmark(draw).clamp(-1.0, 1.0), landmarks::near_landmark(draw).abs().min(1.0)),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::problem::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(HorizonSphere.outputs());
        HorizonSphere.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32], f64, &Truth)) {
        let scenario = HorizonSphere.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 2];
            (scenario.draw)(draw, &mut row);
            let truth = truth_of(&row);
            visit(&row, truth.output(IRRADIANCE)[0], &truth);
        });
    }

    #[test]
    fn every_truth_is_certified_and_plausible() {
        for scenario in HorizonSphere.scenarios() {
            each(scenario.name, 20_000, |row, irradiance, truth| {
                assert!(truth.worst_bound() <= CERTIFIED && !truth.escalated(), "{row:?}: {truth:?}");
                assert!(truth.sensitivities()[0].is_finite(), "{row:?}: {truth:?}");
                let (c, s) = (f64::from(row[0]).clamp(-1.0, 1.0), f64::from(row[1]).clamp(0.0, 1.0));
                // Between the clipped cosine of the whole sphere, and the part of the sphere on this side of a
                // horizon through its centre at most.
                assert!(irradiance >= c.max(0.0) * s, "{row:?}: {truth:?}");
                assert!(irradiance <= s * (1.0 + c) * 0.5 + s * c.abs().max(0.5), "{row:?}: {truth:?}");
                assert_eq!(irradiance == 0.0, s == 0.0 || (c < 0.0 && c * c >= s), "{row:?}: {truth:?}");
            });
        }
    }

    /// A sphere seen more directly, and one that covers more, is brighter; up to the bounds of both truths.
    #[test]
    fn grows_with_both_inputs() {
        for scenario in HorizonSphere.scenarios() {
            each(scenario.name, 5_000, |row, irradiance, truth| {
                for (column, end) in [(0, 1.0f32), (1, 1.0f32)] {
                    let mut more = [row[0], row[1]];
                    more[column] = landmarks::neighbour(row[column], 1 << 10).min(end);
                    let after = truth_of(&more);
                    let slack = 1e-13 * irradiance.max(f64::from(f32::MIN_POSITIVE) * 1e-6);
                    assert!(after.output(0)[0] >= irradiance - slack, "{row:?}: {truth:?} {after:?}");
                }
            });
        }
    }

    /// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
    #[test]
    fn sensitivities_cover_real_changes() {
        for scenario in ["scene", "grazing", "small"] {
            let mut worst: f64 = 0.0;
            let scenario = HorizonSphere.scenario(scenario).unwrap();
            Stream::new(5, "sensitivity").visit(0, 5_000, |_, draw| {
                let mut row = [0.0; 2];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-12);
                // The secant stands for a rounding, not for this step; and what the horizon hides has no change.
                if before.sensitivities()[0] == 0.0 || row[1] > 0.99 {
                    return;
                }
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let change = (truth_of(&changed).output(0)[0] - before.output(0)[0]).abs() / step;
                // First order only: at the rim the light below the horizon vanishes as the fifth power of the rest.
                if before.output(0)[0] > 1e-6 * f64::from(row[1]) {
                    worst = worst.max(change / before.sensitivities()[0]);
                }
            });
            assert!((0.9..=1.1).contains(&worst), "{}: {worst}", scenario.name);
        }
    }

    /// Near s = 1 no step is small: there the sensitivity is the secant over one rounding.
    #[test]
    fn the_secant_covers_a_rounding_at_the_end() {
        for bits in [0u32, 0x3d00_0000, 0x3f00_0000, 0x3f70_0000] {
            let c = f32::from_bits(bits);
            let (at, below) = (truth_of(&[c, 1.0]), truth_of(&[c, 1.0 - f32::EPSILON / 2.0]));
            let change = (at.output(0)[0] - below.output(0)[0]) / UNIT_ROUNDOFF;
            let ratio = change / at.sensitivities()[0];
            assert!((0.5..=1.001).contains(&ratio), "{c}: {ratio}");
        }
    }
}
