//! The device's `atan(y, x)`.
//!
//! Permitted: 4096 ULP; undefined at the origin. On the negative x axis the sign of a zero y, which a device may ignore, and
//! that of a subnormal, which it may flush, choose between pi and -pi: nothing is promised there.

use super::builtin::{AXIS, Builtin, Promise, R, any, near, spread_exponents};
use super::problem::Scenario;
use crate::catalog::{Field, Type};
use crate::numeric::vulkan_limits::{self, Interval};

pub(super) static ATAN2: Builtin = Builtin {
    name: "atan2",
    function: "builtin_atan2",
    summary: "The device's atan(y, x): 4096 ULP",
    inputs: &[Field::new("y", Type::Float), Field::new("x", Type::Float)],
    outputs: R,
    scenarios: &[
        Scenario {
            name: "strata",
            summary: "magnitudes log-uniform in 2^-30..2^30, of any sign",
            draw: |draw, row| row.fill_with(|| spread_exponents(draw, 30.0)),
        },
        Scenario {
            name: "edge",
            summary: "any bits, landmark neighbours crossed with landmark neighbours, and one of either",
            draw: |draw, row| {
                row.fill_with(|| if draw.below(4) == 0 { any(draw) } else { near(draw, &[f32::MAX]) })
            },
        },
    ],
    landmarks: AXIS,
    promise: permitted,
};

fn permitted(input: &[f64]) -> Promise {
    let (y, x) = (input[0], input[1]);
    let either_side = x < 0.0 && y.abs() < f64::from(f32::MIN_POSITIVE);
    let interval =
        if either_side { Interval::ALL } else { vulkan_limits::atan2(Interval::of(y), Interval::of(x)) };
    Promise::scalar(libm::atan2(y, x), interval)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&ATAN2, |x| f64::atan2(x[0], x[1]));
    }
}
