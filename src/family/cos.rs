//! The device's `cos`.
//!
//! Permitted: 2^-11 absolute on -pi..pi, nothing beyond. libm's cos reduces any f32 exactly enough (Payne and Hanek).

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near, spread};
use super::problem::Scenario;
use crate::numeric::vulkan_limits;

pub(super) static COS: Builtin = Builtin {
    name: "cos",
    function: "builtin_cos",
    summary: "The device's cos: 2^-11 absolute on -pi..pi, and no promise beyond",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "-pi..pi, half uniform, half log-uniform magnitudes",
            draw: |draw, row| row[0] = spread(draw, -std::f64::consts::PI, std::f64::consts::PI),
        },
        Scenario {
            name: "edge",
            summary: "half any bits, half landmark neighbours and those of multiples of pi",
            draw: |draw, row| {
                row[0] = if draw.below(2) == 0 {
                    any(draw)
                } else {
                    near(
                        draw,
                        &[
                            std::f32::consts::FRAC_PI_4,
                            std::f32::consts::FRAC_PI_2,
                            std::f32::consts::PI,
                            std::f32::consts::TAU,
                            355.0,
                        ],
                    )
                }
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::cos(x[0]), vulkan_limits::cos(x[0])),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&COS, |x| f64::cos(x[0]));
    }
}
