//! The device's `pow`.
//!
//! Permitted: as exp2(y log2(x)); undefined for x < 0, and nothing promised at x = 0, whose logarithm is infinite.

use super::builtin::{AXIS, Builtin, Promise, R, any, near, spread};
use super::problem::Scenario;
use crate::catalog::{Field, Type};
use crate::numeric::vulkan_limits::{Interval, exp2, log2, product};

pub(super) static POW: Builtin = Builtin {
    name: "pow",
    function: "builtin_pow",
    summary: "The device's pow: as exp2(y log2(x))",
    inputs: &[Field::new("x", Type::Float), Field::new("y", Type::Float)],
    outputs: R,
    scenarios: &[
        Scenario {
            name: "strata",
            summary: "x log-uniform in 1e-6..1e3, y in -10..10 or a specular exponent of 1 to 10000",
            draw: |draw, row| {
                row[0] = draw.log_uniform(1e-6, 1e3) as f32;
                row[1] = if draw.below(2) == 0 {
                    spread(draw, -10.0, 10.0)
                } else {
                    draw.log_uniform(1.0, 1e4) as f32
                };
            },
        },
        Scenario {
            name: "edge",
            summary: "any bits, landmark neighbours crossed with landmark neighbours, and one of either; three quarters of x positive",
            draw: |draw, row| {
                let x = if draw.below(4) == 0 { any(draw) } else { near(draw, &[1.0, 10.0, f32::MAX]) };
                row[0] = if draw.below(4) == 0 { x } else { x.abs() };
                row[1] = if draw.below(4) == 0 { any(draw) } else { near(draw, &[2.2, 1.0, 126.0]) };
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(libm::pow(x[0], x[1]), exp2(product(Interval::of(x[1]), log2(x[0])))),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&POW, |x| f64::powf(x[0], x[1]));
    }
}
