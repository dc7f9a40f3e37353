//! The device's `length` of a vec3.
//!
//! Permitted: as sqrt(dot(v, v)), so nothing where a square overflows, nor where all may be flushed.

use super::builtin::{AXIS, Builtin, Promise, R, any, near, spread_exponents};
use super::problem::Scenario;
use crate::catalog::{Field, Type};
use crate::numeric::vulkan_limits::{dot, sqrt};

pub(super) static LENGTH: Builtin = Builtin {
    name: "length",
    function: "builtin_length",
    summary: "The device's length of a vec3: as sqrt(dot(v, v))",
    inputs: &[Field::new("v", Type::Vec3)],
    outputs: R,
    scenarios: &[
        Scenario {
            name: "strata",
            summary: "components' magnitudes log-uniform in 2^-20..2^20",
            draw: |draw, row| row.fill_with(|| spread_exponents(draw, 20.0)),
        },
        Scenario {
            name: "edge",
            summary: "any bits, landmark neighbours crossed with landmark neighbours, and one of either",
            draw: |draw, row| {
                row.fill_with(|| if draw.below(8) == 0 { any(draw) } else { near(draw, &[3.0, 1e18]) })
            },
        },
    ],
    landmarks: AXIS,
    promise: |v| Promise::scalar(norm(v), sqrt(dot([v[0], v[1], v[2]]))),
};

/// Squares of f32 are exact in f64.
fn norm(v: &[f64]) -> f64 {
    libm::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&LENGTH, |v| v[0].hypot(v[1]).hypot(v[2]));
    }
}
