//! The device's `acos`.
//!
//! Permitted: as atan2(sqrt(1 - x^2), x), so nothing at +-1, where the root is of 0; undefined beyond.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near, spread};
use super::problem::Scenario;
use crate::numeric::vulkan_limits::{Interval, atan2, product, sqrt, sum};
use crate::sample::Draw;

pub(super) static ACOS: Builtin = Builtin {
    name: "acos",
    function: "builtin_acos",
    summary: "The device's acos: as atan2(sqrt(1 - x x), x)",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "-1..1, half uniform, half log-uniform magnitudes",
            draw: |draw, row| row[0] = spread(draw, -1.0, 1.0),
        },
        Scenario {
            name: "edge",
            summary: "a quarter any bits, the others landmark neighbours and 2^-24..0.1 from the ends",
            draw: |draw, row| row[0] = if draw.below(4) == 0 { any(draw) } else { near_end(draw) },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::acos(x[0]), atan2(cosine(x[0]), Interval::of(x[0]))),
};

/// sqrt(1 - x^2), by f32 operations.
fn cosine(x: f64) -> Interval {
    sqrt(sum(Interval::of(1.0), product(Interval::of(-x), Interval::of(x))))
}

/// Neighbours of landmarks, and for half of them 1 - |x| log-uniform from 2^-24.
fn near_end(draw: &mut Draw) -> f32 {
    let near = near(draw, &[1.0, 0.5, std::f32::consts::FRAC_1_SQRT_2]);
    let gap = draw.log_uniform(1.0 / 16_777_216.0, 0.1);
    let end = (draw.sign() * (1.0 - gap)) as f32;
    if draw.below(2) == 0 { near } else { end }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&ACOS, |x| f64::acos(x[0]));
    }
}
