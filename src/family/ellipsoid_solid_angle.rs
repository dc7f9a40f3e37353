//! Solid angle of an ellipsoid.
//!
//! The ellipsoid with centre c, semi-axes r along the columns of R (the rotation of q/|q|; the identity for q = 0) covers the
//! cone with the dual quadric S = R D^2 R^T - c c^T, whose solid angle [`Cone::solid_angle`] gives. With b = R^T c,
//! -det S = b_x^2 r_y^2 r_z^2 + b_y^2 r_z^2 r_x^2 + b_z^2 r_x^2 r_y^2 - r_x^2 r_y^2 r_z^2, in twofold arithmetic.
//!
//! From inside or on the ellipsoid every direction meets it: 4 pi; just outside it covers a half space only. One zero
//! semi-axis leaves an ellipse, two leave nothing: 0, as for an ellipse that is seen edge-on.

use std::f64::consts::PI;

use glam::DVec3;

use super::ellipsoid_scenes::{CENTER, INPUTS, LANDMARKS, RADIUS, ROTATION, SCENARIOS};
use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::clipped_ellipse::Cone;
use crate::numeric::cone_solid_angle;
use crate::numeric::exact3;
use crate::numeric::rotation::Rotation;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::numeric::twofold::Twofold;

pub(super) struct EllipsoidSolidAngle;

impl Problem for EllipsoidSolidAngle {
    fn name(&self) -> &'static str {
        "ellipsoid_solid_angle"
    }

    fn summary(&self) -> &'static str {
        "Solid angle of an ellipsoid"
    }

    fn inputs(&self) -> &'static [Field] {
        INPUTS
    }

    /// A light off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("solid_angle", Type::Float, Quantity::SolidAngle, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        SCENARIOS
    }

    fn landmarks(&self) -> &'static [Landmark] {
        LANDMARKS
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let (center, radius) = (exact3::vector(&input[CENTER..]), exact3::vector(&input[RADIUS..]));
        let largest = center.abs().max_element().max(radius.abs().max_element());
        let unit = libm::ldexp(1.0, -libm::frexp(largest).1);
        let (c, r) = (center * unit, radius * unit);
        let rotation = Rotation::new(&input[ROTATION..RADIUS]);
        let axes = &rotation.columns;
        let r2 = r.to_array().map(|r| Twofold::product(r, r));
        let b = axes.map(|a| a[0] * c.x + a[1] * c.y + a[2] * c.z);
        let b2 = b.map(|b| b * b);
        let shell = r2[0] * r2[1] * r2[2];
        let reach = b2[0] * r2[1] * r2[2] + b2[1] * r2[2] * r2[0] + b2[2] * r2[0] * r2[1];
        let outside = (reach - shell).value();
        if outside <= 0.0 {
            if shell.value() == 0.0 {
                return truth.scalar(0, 0.0, 0.0, 0.0);
            }
            // A few roundings from outside, where half of the directions miss.
            let near = -outside < 64.0 * UNIT_ROUNDOFF * shell.value();
            return truth.scalar(0, 4.0 * PI, 0.0, if near { f64::INFINITY } else { 0.0 });
        }

        let cc = exact3::square(&c.to_array().map(Twofold::from));
        let squares = axes.map(|a| exact3::square(&a));
        let solid: [Twofold; 6] =
            std::array::from_fn(|i| squares[0][i] * r2[0] + squares[1][i] * r2[1] + squares[2][i] * r2[2]);
        let dual = std::array::from_fn(|i| solid[i] - cc[i]);
        let seen = Cone { dual, minus_det: outside, towards: c }.solid_angle();
        let by_center = 2.0 * (seen.gradient * c) * c;
        let of_radius: f64 = (0..3)
            .map(|k| {
                let axis = DVec3::from_array(axes[k].map(|component| component.value()));
                (2.0 * r[k] * r[k] * axis.dot(seen.gradient * axis)).abs()
            })
            .sum();
        let of_rotation = rotation.sensitivity(exact3::symmetric(&solid) * seen.gradient);
        let near = outside < 64.0 * UNIT_ROUNDOFF * shell.value();
        let sensitivity =
            if near { f64::INFINITY } else { by_center.abs().element_sum() + of_radius + of_rotation };
        truth.scalar(0, seen.value, cone_solid_angle::BOUND * seen.value, sensitivity);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::{Draw, Stream};

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(EllipsoidSolidAngle.outputs());
        EllipsoidSolidAngle.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
        let scenario = EllipsoidSolidAngle.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 10];
            (scenario.draw)(draw, &mut row);
            visit(draw, &row, &truth_of(&row));
        });
    }

    #[test]
    fn every_truth_is_certified_and_a_solid_angle() {
        for scenario in EllipsoidSolidAngle.scenarios() {
            let mut seen = 0;
            each(scenario.name, 20_000, |_, row, truth| {
                let value = truth.values()[0];
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=2.0 * PI).contains(&value) || value == 4.0 * PI, "{row:?}: {truth:?}");
                assert!(truth.sensitivities()[0] >= 0.0, "{row:?}: {truth:?}");
                seen += u32::from(value > 0.0);
            });
            assert!(seen > 10_000, "{}: {seen}", scenario.name);
        }
    }

    /// A sphere's cap: 2 pi s/(1 + cos) with s = sin^2.
    #[test]
    fn spheres_are_caps() {
        for distance in [1.0f32 + f32::EPSILON, 1.5, 40.0, 1e5] {
            let (d, r) = (f64::from(distance), 1.0);
            let sine2 = r * r / (d * d);
            let expected = 2.0 * PI * sine2 / (1.0 + libm::sqrt((d - r) * (d + r)) / d);
            let row = [0.6 * distance, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.6, 0.6, 0.6];
            let value = truth_of(&row).values()[0];
            // 0.6 times the distance is rounded.
            assert!(
                (value / expected - 1.0).abs() < 4e-7 * (1.0 + 1.0 / libm::sqrt(d - 1.0)),
                "{distance}: {value} {expected}"
            );
        }
    }

    #[test]
    fn stated_answers() {
        let value = |center: [f32; 3], radius: [f32; 3]| {
            truth_of(&[center.as_slice(), &[0.0, 0.0, 0.0, 1.0], &radius].concat()).values()[0]
        };
        assert_eq!(value([0.1, 0.2, 0.0], [1.0, 0.5, 2.0]), 4.0 * PI);
        assert_eq!(value([0.0, 0.0, 2.0], [1.0, 0.5, 2.0]), 4.0 * PI);
        assert_eq!(value([0.0, 1.0, 2.0], [1.0, 0.0, 0.0]), 0.0);
        assert_eq!(value([3.0, 0.0, 0.0], [1.0, 1.0, 0.0]), 0.0);
        // Flat: a disk of radius 1 at distance 1.
        let disk = value([0.0, 0.0, 1.0], [1.0, 1.0, 0.0]);
        assert!((disk / (2.0 * PI * (1.0 - libm::sqrt(0.5))) - 1.0).abs() < 1e-14, "{disk}");
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for name in ["scene", "flat", "far", "near_surface"] {
            let mut worst: f64 = 0.0;
            each(name, 3_000, |draw, row, before| {
                let step = 2f64.powi(-20);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let after = truth_of(&changed);
                let change = (after.values()[0] - before.values()[0]).abs() / step;
                let (here, there) = (before.sensitivities()[0], after.sensitivities()[0]);
                // First order only: not where the answer changes by a twentieth, or the slope itself by a tenth.
                if here * step < 0.05 * before.values()[0] && (there / here - 1.0).abs() < 0.1 {
                    worst = worst.max(change / here);
                }
            });
            // 1.2: second order at this step. 0.3: ten signs at their worst are rare.
            assert!((0.3..=1.2).contains(&worst), "{name}: {worst}");
        }
    }
}
