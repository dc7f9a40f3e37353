//! The device's division.
//!
//! Permitted: 2.5 ULP for divisors of magnitudes 2^-126..2^126, nothing for others.

use super::builtin::{AXIS, Builtin, Promise, R, any, near, spread_exponents};
use super::problem::Scenario;
use crate::catalog::{Field, Type};
use crate::numeric::vulkan_limits::{Interval, quotient};

pub(super) static DIV: Builtin = Builtin {
    name: "div",
    function: "builtin_div",
    summary: "The device's x / y: 2.5 ULP for |y| in 2^-126..2^126",
    inputs: &[Field::new("x", Type::Float), Field::new("y", Type::Float)],
    outputs: R,
    scenarios: &[
        Scenario {
            name: "strata",
            summary: "magnitudes log-uniform in 2^-40..2^40, of any sign",
            draw: |draw, row| row.fill_with(|| spread_exponents(draw, 40.0)),
        },
        Scenario {
            name: "edge",
            summary: "any bits, landmark neighbours crossed with landmark neighbours, and one of either",
            draw: |draw, row| {
                row.fill_with(|| if draw.below(4) == 0 { any(draw) } else { near(draw, &[3.0, f32::MAX]) })
            },
        },
    ],
    landmarks: AXIS,
    promise: |x| Promise::scalar(x[0] / x[1], quotient(Interval::of(x[0]), Interval::of(x[1]))),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&DIV, |x| x[0] * x[1].recip());
    }
}
