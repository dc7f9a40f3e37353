//! Irradiance of a capped cylinder under a linearly transformed cosine: the light that line lights approximate.
//!
//! A convex body of uniform radiance counts each direction once, so truth is the cosine's integral over the directions
//! inside its silhouette, after Minv and above the horizon (`cylinder_silhouette`). A point in the cylinder or on it
//! sees nothing but the light: 1. A cylinder without length or radius and a singular Minv are exactly dark. A negative
//! radius counts as its magnitude.
//!
//! The silhouette's points are off by a few 2^-53 of the coordinates, which first derivatives turn into a bound, and the
//! contour's sum by a few of its terms. Where that is more than 2^-34 of the value - barely visible cylinders, thin ones
//! whose rims the horizon cuts - the sum is done again in double-double.

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::cylinder_silhouette::{Cylinder, Seen};
use crate::numeric::line_integral::{matrix, vector};
use crate::numeric::products;
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, ggx};

pub(super) struct LtcCylinder;

/// What the contour in double-double is off by, in units of its terms: a hundred roundings of its least exact function.
const FINE: f64 = 1.0 / (1u128 << 88) as f64;
/// The relative error that more precision is taken for: 5.8e-11, well beyond what certifying an f32 takes.
const ACCURACY: f64 = 1.0 / (1u64 << 34) as f64;

const P1: usize = 9;
const P2: usize = 12;
const RADIUS: usize = 15;

impl Problem for LtcCylinder {
    fn name(&self) -> &'static str {
        "ltc_cylinder"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of a capped cylinder under a linearly transformed cosine: what line lights approximate"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("minv", Type::Mat3),
                Field::new("p1", Type::Vec3),
                Field::new("p2", Type::Vec3),
                Field::new("radius", Type::Float),
            ]
        }
    }

    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("irradiance", Type::Float, Quantity::Irradiance, 1e-4).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "ggx_alpha_02",
                summary: "tubes of half-length 0.1..2 and radius 0.001..0.3 over a floor, GGX of alpha 0.2",
                draw: |draw, row| tube(draw, 0.2, row),
            },
            Scenario {
                name: "ggx_alpha_01",
                summary: "the same, GGX of alpha 0.1",
                draw: |draw, row| tube(draw, 0.1, row),
            },
            Scenario {
                name: "ggx_alpha_05",
                summary: "the same, GGX of alpha 0.5",
                draw: |draw, row| tube(draw, 0.5, row),
            },
            Scenario {
                name: "edge",
                summary: "seen end-on, from within and from next to it, flat, on and below the horizon, no length or radius, any scale",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "thickness",
                summary: "radius over the distance of the axis; the approximation is for small ones, 1 and more: touching",
                edges: &[1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0],
                coordinate: |input, _| thickness(input),
            },
            Landmark {
                name: "distance_over_length",
                summary: "distance of the middle over the length",
                edges: &[0.3, 1.0, 3.0, 10.0, 30.0, 100.0],
                coordinate: |input, _| {
                    let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
                    0.5 * (p1 + p2).length() / (p2 - p1).length()
                },
            },
            Landmark {
                name: "width_over_lobe",
                summary: "radius over the distance of the axis, over the lobe's width across: large for sharp lobes",
                edges: &[1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0],
                coordinate: |input, _| thickness(input) / lobe_width(&matrix(input)),
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let minv = matrix(input);
        let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
        let radius = f64::from(input[RADIUS]).abs();
        if radius == 0.0 || p1 == p2 || products::is_singular(&minv) {
            truth.scalar(0, 0.0, 0.0, 0.0);
            return;
        }
        let cylinder = Cylinder::new(p1, p2, radius);
        if cylinder.holds_origin() {
            truth.scalar(0, 1.0, 0.0, 0.0);
            return;
        }
        let seen = cylinder.seen(&minv);
        let (mut value, normwise) = (seen.irradiance, normwise_sensitivity(&minv, &cylinder, &seen));
        let mut bound = seen.rounding + 4.0 * EPS * normwise;
        if !(bound <= ACCURACY * value) && bound > 0.0 {
            truth.escalate();
            let (fine, terms) = cylinder.seen_finely(&minv);
            (value, bound) = (fine, FINE * (terms + normwise));
        }
        truth.scalar(0, value, bound, sensitivity(&minv, &cylinder, &seen));
    }
}

/// How E changes when every vector that the contour is made of is off by its own length in the worst direction, as it
/// is by a few EPS of that. The axis's direction counts by itself: the difference of the ends is exact.
fn normwise_sensitivity(minv: &DMat3, cylinder: &Cylinder, seen: &Seen) -> f64 {
    let rims: f64 = seen.by_rims.iter().zip(cylinder.ends).map(|(by, p)| by.length() * p.length()).sum();
    let map: f64 = (0..3).map(|k| seen.by_map[k].length() * minv.col(k).length()).sum();
    rims + seen.by_axis.length() + map + seen.by_radius.abs() * cylinder.radius
}

/// The sum over all inputs of |derivative times input|.
fn sensitivity(minv: &DMat3, cylinder: &Cylinder, seen: &Seen) -> f64 {
    let mut sum = seen.by_radius.abs() * cylinder.radius;
    for (by, p) in seen.by_ends.iter().zip(cylinder.ends) {
        sum += by.abs().dot(p.abs());
    }
    for (column, by) in seen.by_map.iter().enumerate() {
        sum += by.abs().dot(minv.col(column).abs());
    }
    if sum.is_nan() { f64::INFINITY } else { sum }
}

fn thickness(input: &[f32]) -> f64 {
    let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
    let along = p2 - p1;
    let s = (-p1.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    f64::from(input[RADIUS]) / (p1 + s * along).length()
}

/// The lobe's width across the plane of incidence over its length: alpha, about.
fn lobe_width(minv: &DMat3) -> f64 {
    let cofactors =
        [minv.y_axis.cross(minv.z_axis), minv.z_axis.cross(minv.x_axis), minv.x_axis.cross(minv.y_axis)];
    let column = |k: usize| DVec3::from_array(cofactors.map(|c| c[k]));
    column(1).length() / column(2).length()
}

fn store(row: &mut [f32], minv: DMat3, [p1, p2]: [DVec3; 2], radius: f64) {
    let values = minv.to_cols_array().into_iter().chain(p1.to_array()).chain(p2.to_array()).chain([radius]);
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

fn tube(draw: &mut Draw, alpha: f64, row: &mut [f32]) {
    let minv = ggx::minv(libm::sqrt(alpha), draw.uniform(0.02, 1.0));
    let center = DVec3::new(draw.uniform(-5.0, 5.0), draw.uniform(-5.0, 5.0), draw.uniform(0.1, 4.0));
    let half = draw.log_uniform(0.1, 2.0) * draw.direction();
    store(row, minv, [center - half, center + half], draw.log_uniform(1e-3, 0.3));
}

/// The point stays off the surface by a thousandth of the scene at the least: on it, rounding decides between 1 and less.
fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(9);
    let minv =
        if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx::minv(draw.uniform(0.3, 1.0), draw.unit()) };
    let frame = draw.frame();
    let (axis, across) = (frame.z_axis, frame.x_axis);
    let (half, radius) = (draw.log_uniform(0.1, 3.0), draw.log_uniform(0.01, 3.0));
    // A gap between the point and what it faces.
    let gap = draw.log_uniform(0.01, 1.0);
    let shift = draw.uniform(-0.9, 0.9) * half;
    let about = |center: DVec3, axis: DVec3| [center - half * axis, center + half * axis];
    match kind {
        // Facing a cap: exactly on the axis, and off it but within the radius.
        0 => {
            let height = gap + half;
            store(row, minv, about(height * DVec3::Z, DVec3::Z), radius);
        }
        1 => store(row, minv, about((gap + half) * axis + 0.9 * radius * draw.unit() * across, axis), radius),
        // Next to the side.
        2 => store(row, minv, about((radius + gap) * across + shift * axis, axis), radius),
        // Within.
        3 => store(row, minv, about(0.9 * radius * draw.unit() * across + shift * axis, axis), radius),
        // Flat as a coin, seen from anywhere.
        4 => {
            let center = (radius + 1.0) * draw.direction();
            let thin = draw.log_uniform(1e-4, 1e-2) * axis;
            store(row, minv, [center - thin, center + thin], 0.9 * radius);
        }
        // Cut by the horizon lengthwise; below it.
        5 => store(row, DMat3::IDENTITY, about(DVec3::new(0.0, radius + gap, 0.0), DVec3::X), radius),
        6 => store(row, DMat3::IDENTITY, about(DVec3::new(gap, 1.0, -half - radius - gap), axis), radius),
        7 => {
            let center = (radius + half + gap) * draw.direction();
            let kind = draw.below(3);
            let ends = if kind == 0 { [center, center] } else { about(center, axis) };
            let map = if kind == 1 { DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0)) } else { minv };
            store(row, map, ends, if kind == 2 { 0.0 } else { radius });
        }
        _ => {
            let scale = libm::exp2(f64::from(draw.below(81)) - 40.0);
            let center = (radius + half + gap) * draw.direction();
            store(row, minv, about(center, axis).map(|p| scale * p), scale * radius);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::{CERTIFIED, find};
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(LtcCylinder.outputs());
        LtcCylinder.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut check: impl FnMut(&[f32], &Truth)) {
        let scenario = LtcCylinder.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 16];
            (scenario.draw)(draw, &mut row);
            check(&row, &truth_of(&row));
        });
    }

    #[test]
    fn every_truth_is_certified_and_a_share_of_the_hemisphere() {
        for scenario in LtcCylinder.scenarios() {
            let mut positive = 0;
            each(scenario.name, 10_000, |row, truth| {
                assert!(row.iter().all(|v| v.is_finite()), "{row:?}");
                let value = truth.values()[0];
                assert!((0.0..=1.0).contains(&value), "{row:?}: {truth:?}");
                assert!(!truth.sensitivities()[0].is_nan(), "{row:?}: {truth:?}");
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                positive += u32::from(value > 0.0);
            });
            assert!(positive > 3_000, "{}: {positive} cylinders above the horizon", scenario.name);
        }
    }

    /// The line light's truth is defined as this limit.
    #[test]
    fn a_thin_cylinder_is_its_radius_times_the_line_light() {
        let line = find("ltc_line").unwrap();
        let mut compared = 0;
        each("ggx_alpha_05", 2_000, |row, _| {
            let mut thin = row.to_vec();
            thin[RADIUS] = 1.0 / 65_536.0;
            let mut limit = Truth::new(line.outputs());
            line.oracle(&row[..RADIUS], &mut limit);
            let expected = limit.values()[0] / 65_536.0;
            let value = truth_of(&thin).values()[0];
            let (p1, p2) = (vector(&row[P1..]), vector(&row[P2..]));
            let sine = p1.cross(p2).length() / (p1.length() * p2.length());
            // Off the end-on view, where caps count; second order in radius over distance, and the caps' first order.
            if sine > 0.05 && p1.length().min(p2.length()) > 0.5 {
                assert!(
                    (value - expected).abs() < 3e-3 * expected + 1e-11,
                    "{row:?}: {value} for {expected}"
                );
                compared += 1;
            }
        });
        assert!(compared > 1_000, "{compared}");
    }

    #[test]
    fn swaps_and_scales() {
        each("ggx_alpha_02", 2_000, |row, truth| {
            let value = truth.values()[0];
            let mut swapped = row.to_vec();
            swapped[P1..RADIUS].rotate_left(3);
            // Twice what the family promises.
            assert!((truth_of(&swapped).values()[0] - value).abs() <= 1.2e-10 * value, "{row:?}");
            let doubled: Vec<f32> =
                row.iter().enumerate().map(|(i, v)| if i < P1 { *v } else { 2.0 * v }).collect();
            assert_eq!(truth_of(&doubled).values()[0], value, "{row:?}");
        });
    }

    /// f64's error, by double-double, is within what is promised, whether or not that is enough.
    #[test]
    fn bounds_hold_before_escalation() {
        for scenario in LtcCylinder.scenarios() {
            let mut compared = 0;
            each(scenario.name, 5_000, |row, _| {
                let (minv, [p1, p2]) = (matrix(row), [P1, P2].map(|k| vector(&row[k..])));
                let radius = f64::from(row[RADIUS]);
                if radius == 0.0 || p1 == p2 || products::determinant(&minv) == 0.0 {
                    return;
                }
                let cylinder = Cylinder::new(p1, p2, radius);
                if cylinder.holds_origin() {
                    return;
                }
                let seen = cylinder.seen(&minv);
                let bound = seen.rounding + 4.0 * EPS * normwise_sensitivity(&minv, &cylinder, &seen);
                let error = (seen.irradiance - cylinder.seen_finely(&minv).0).abs();
                assert!(error <= bound, "{row:?}: {error:e} for {bound:e}");
                compared += 1;
            });
            assert!(compared > 2_000, "{}: {compared}", scenario.name);
        }
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for scenario in ["ggx_alpha_01", "ggx_alpha_05"] {
            let mut worst: f64 = 0.0;
            let scenario = LtcCylinder.scenario(scenario).unwrap();
            Stream::new(5, "sensitivity").visit(0, 3_000, |_, draw| {
                let mut row = [0.0; 16];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-14);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let change = (truth_of(&changed).values()[0] - before.values()[0]).abs() / step;
                let sensitivity = before.sensitivities()[0];
                // First order only: what a step changes by a tenth is left out.
                if sensitivity * step < 0.1 * before.values()[0] {
                    worst = worst.max(change / sensitivity);
                }
            });
            // 1.2: second-order terms where a step changes a tenth. 0.3: all signs at their worst are rare.
            assert!((0.3..=1.2).contains(&worst), "{}: {worst}", scenario.name);
        }
    }
}
