//! The device's `log2`.
//!
//! Permitted: 3 ULP, and an absolute 2^-21 for x in 0.5..2; undefined from 0 downwards, and so where a subnormal is flushed.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near};
use super::problem::Scenario;
use crate::numeric::vulkan_limits;

pub(super) static LOG2: Builtin = Builtin {
    name: "log2",
    function: "builtin_log2",
    summary: "The device's log2: 3 ULP, and 2^-21 absolute for x in 0.5..2",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "2^-126..2^126 log-uniform; half of them 0.25..4 uniform",
            draw: |draw, row| {
                row[0] = if draw.below(2) == 0 {
                    draw.uniform(0.25, 4.0) as f32
                } else {
                    draw.log_uniform(1.2e-38, 8e37) as f32
                }
            },
        },
        Scenario {
            name: "edge",
            summary: "a quarter any bits, the others positive landmark neighbours",
            draw: |draw, row| {
                row[0] = if draw.below(4) == 0 {
                    any(draw)
                } else {
                    near(draw, &[1.0, 0.5, 2.0, std::f32::consts::E, f32::MAX]).abs()
                }
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::log2(x[0]), vulkan_limits::log2(x[0])),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&LOG2, |x| f64::log2(x[0]));
    }
}
