//! The device's `inversesqrt`.
//!
//! Permitted: 2 ULP; undefined from 0 downwards, and so where a subnormal is flushed.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near};
use super::problem::Scenario;
use crate::numeric::vulkan_limits::{Interval, inverse_sqrt};

pub(super) static INVERSESQRT: Builtin = Builtin {
    name: "inversesqrt",
    function: "builtin_inversesqrt",
    summary: "The device's inversesqrt: 2 ULP",
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
    promise: |x| Promise::scalar(1.0 / libm::sqrt(x[0]), inverse_sqrt(Interval::of(x[0]))),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&INVERSESQRT, |x| 1.0 / x[0].sqrt());
    }
}
