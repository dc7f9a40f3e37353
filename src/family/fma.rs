//! The device's `fma`.
//!
//! Permitted: as a product, then a sum, each correctly rounded in either direction: it need not be fused.

use super::builtin::{AXIS, Builtin, Promise, R, any, near, spread_exponents};
use super::problem::Scenario;
use crate::catalog::{Field, Type};
use crate::numeric::vulkan_limits::{Interval, product, sum};

pub(super) static FMA: Builtin = Builtin {
    name: "fma",
    function: "builtin_fma",
    summary: "The device's fma: as a product, then a sum",
    inputs: &[Field::new("x", Type::Float), Field::new("y", Type::Float), Field::new("z", Type::Float)],
    outputs: R,
    scenarios: &[
        Scenario {
            name: "strata",
            summary: "magnitudes log-uniform in 2^-20..2^20; half of them with z = -(x y), rounded",
            draw: |draw, row| {
                row.fill_with(|| spread_exponents(draw, 20.0));
                // Half of them cancel but for the product's rounding.
                if draw.below(2) == 0 {
                    row[2] = -(row[0] * row[1]);
                }
            },
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
    promise: |x| {
        let [a, b, c] = [x[0], x[1], x[2]].map(Interval::of);
        Promise::scalar(x[0] * x[1] + x[2], sum(product(a, b), c))
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&FMA, |x| f64::mul_add(x[0], x[1], x[2]));
    }
}
