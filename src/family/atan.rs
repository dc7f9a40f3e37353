//! The device's `atan`.
//!
//! Permitted: 4096 ULP.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near};
use super::problem::Scenario;
use crate::numeric::vulkan_limits;

pub(super) static ATAN: Builtin = Builtin {
    name: "atan",
    function: "builtin_atan",
    summary: "The device's atan: 4096 ULP",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "+-1e-9..1e9, log-uniform; half of them uniform in -4..4",
            draw: |draw, row| {
                row[0] = if draw.below(2) == 0 {
                    draw.uniform(-4.0, 4.0) as f32
                } else {
                    (draw.sign() * draw.log_uniform(1e-9, 1e9)) as f32
                }
            },
        },
        Scenario {
            name: "edge",
            summary: "half any bits, half landmark neighbours",
            draw: |draw, row| {
                row[0] = if draw.below(2) == 0 { any(draw) } else { near(draw, &[1.0, 0.5, 2.0, f32::MAX]) }
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::atan(x[0]), vulkan_limits::atan(x[0])),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&ATAN, |x| f64::atan(x[0]));
    }
}
