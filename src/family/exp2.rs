//! The device's `exp2`.
//!
//! Permitted: 3 + 2 |x| ULP; overflow gives infinity or the largest f32, and a result among the subnormals may be flushed.

use super::builtin::{AXIS, Builtin, Promise, X, Y, any, near, spread};
use super::problem::Scenario;
use crate::numeric::vulkan_limits::{self, Interval};

pub(super) static EXP2: Builtin = Builtin {
    name: "exp2",
    function: "builtin_exp2",
    summary: "The device's exp2: 3 + 2 |x| ULP",
    inputs: X,
    outputs: Y,
    scenarios: &[
        Scenario {
            name: "domain",
            summary: "-126..128, where the result is an f32: half uniform, half log-uniform magnitudes",
            draw: |draw, row| row[0] = spread(draw, -126.0, 128.0),
        },
        Scenario {
            name: "edge",
            summary: "half any bits, half landmark neighbours and those of whole numbers",
            draw: |draw, row| {
                row[0] =
                    if draw.below(2) == 0 { any(draw) } else { near(draw, &[1.0, 10.0, 126.0, 128.0, 149.0]) }
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::exp2(x[0]), vulkan_limits::exp2(Interval::of(x[0]))),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&EXP2, |x| f64::exp2(x[0]));
    }
}
