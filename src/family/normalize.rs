//! The device's `normalize` of a vec3.
//!
//! Permitted: as v inversesqrt(dot(v, v)), so nothing where a square overflows, nor where all may be flushed. The limit of the
//! error's length is that of the components' limits.

use super::builtin::{AXIS, Builtin, Promise, VECTOR, any, near, spread_exponents};
use super::problem::Scenario;
use crate::catalog::{Field, Type};
use crate::numeric::vulkan_limits::{Interval, dot, inverse_sqrt, product};

pub(super) static NORMALIZE: Builtin = Builtin {
    name: "normalize",
    function: "builtin_normalize",
    summary: "The device's normalize of a vec3: as v inversesqrt(dot(v, v))",
    inputs: &[Field::new("v", Type::Vec3)],
    outputs: VECTOR,
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
    promise: permitted,
};

fn permitted(input: &[f64]) -> Promise {
    let v = [input[0], input[1], input[2]];
    // Squares of f32 are exact in f64.
    let length = libm::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    let inverse = inverse_sqrt(dot(v));
    let value = v.map(|c| c / length);
    let reach = |at: usize| product(Interval::of(v[at]), inverse).reach(value[at]);
    let [x, y, z] = [reach(0), reach(1), reach(2)];
    Promise::vector(value, (x * x + y * y + z * z).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::builtin::tests::agrees_with;

    #[test]
    fn agrees_with_the_system_s_library() {
        agrees_with(&NORMALIZE, |v| v[0] / v[0].hypot(v[1]).hypot(v[2]));
    }
}
