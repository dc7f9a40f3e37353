//! The device's `exp`.
//!
//! Permitted: 3 + 2 |x| ULP; overflow gives infinity or the largest f32, and a result among the subnormals may be flushed.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near, spread};
use super::problem::Scenario;
use crate::numeric::vulkan_limits::{self, Interval};

pub(super) static EXP: Builtin = Builtin {
    name: "exp",
    function: "builtin_exp",
    summary: "The device's exp: 3 + 2 |x| ULP",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "-87..88, where the result is an f32: half uniform, half log-uniform magnitudes",
            draw: |draw, row| row[0] = spread(draw, -87.0, 88.0),
        },
        Scenario {
            name: "edge",
            summary: "half any bits, half landmark neighbours and those of the ends of the range",
            draw: |draw, row| {
                row[0] = if draw.below(2) == 0 {
                    any(draw)
                } else {
                    near(draw, &[std::f32::consts::LN_2, 88.72284, 87.336_54, 103.972_08])
                }
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::exp(x[0]), vulkan_limits::exp(Interval::of(x[0]))),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&EXP, |x| f64::exp(x[0]));
    }
}
