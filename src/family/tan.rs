//! The device's `tan`.
//!
//! Permitted: as sin over cos, so nothing beyond -pi..pi nor within 2^-11 of a pole.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near, spread};
use super::problem::Scenario;
use crate::numeric::vulkan_limits::{self, quotient};

pub(super) static TAN: Builtin = Builtin {
    name: "tan",
    function: "builtin_tan",
    summary: "The device's tan: as sin over cos, each off by up to 2^-11",
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
    promise: |x| {
        Promise::scalar(libm::tan(x[0]), quotient(vulkan_limits::sin(x[0]), vulkan_limits::cos(x[0])))
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&TAN, |x| f64::tan(x[0]));
    }
}
