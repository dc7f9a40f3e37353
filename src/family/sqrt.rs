//! The device's `sqrt`.
//!
//! Permitted: as 1 / inversesqrt(x), so nothing at 0, whose inverse root is infinite; undefined below.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near};
use super::problem::Scenario;
use crate::numeric::vulkan_limits::{self, Interval};

pub(super) static SQRT: Builtin = Builtin {
    name: "sqrt",
    function: "builtin_sqrt",
    summary: "The device's sqrt: as 1 / inversesqrt(x)",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "2^-126..2^126 log-uniform; half of them 0..4 uniform",
            draw: |draw, row| {
                row[0] = if draw.below(2) == 0 {
                    draw.uniform(0.0, 4.0) as f32
                } else {
                    draw.log_uniform(1.2e-38, 8e37) as f32
                }
            },
        },
        Scenario {
            name: "edge",
            summary: "a quarter any bits, the others positive landmark neighbours",
            draw: |draw, row| {
                row[0] = if draw.below(4) == 0 { any(draw) } else { near(draw, &[1.0, 4.0, f32::MAX]).abs() }
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::sqrt(x[0]), vulkan_limits::sqrt(Interval::of(x[0]))),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&SQRT, |x| f64::sqrt(x[0]));
    }
}
