//! Irradiance of a line light under a linearly transformed cosine, for each unit of radius.
//!
//! Truth is the limit of (1/R) times the integral over a cylinder of radius R about the segment p1..p2, R -> 0, of the
//! part above the horizon of the cosine's own space: the strip of half width R across the plane of light and point.
//! With q(s) = Minv (p1 + s (p2 - p1)) the width, the plane's normal and all of Minv's distortion gather in one factor:
//!
//! ```text
//! I = (2/pi) |det Minv| |p1 x p2| J      J = integral over s in 0..1 of max(q.z, 0)/|q|^4
//! ```
//!
//! det Minv and p1 x p2 are computed exactly and rounded, and J by `line_integral`, where nothing cancels. So plain
//! f64 holds everywhere once Minv p1 x Minv p2 comes from exact cofactors.
//!
//! Degenerate lights have the answer 0: a line seen end-on (p1 x p2 = 0), equal ends, a singular Minv. That holds as
//! well where the point lies *on* the light, the one place where the limit would be infinite.

use core::f64::consts::FRAC_2_PI;

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::line_integral::{Visible, matrix, vector, visible};
use crate::numeric::products::{self, cross_terms, norm};
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, ggx, landmarks};

pub(super) struct LtcLine;

/// Columns of the ends, after Minv's nine.
const P1: usize = 9;
const P2: usize = 12;

impl Problem for LtcLine {
    fn name(&self) -> &'static str {
        "ltc_line"
    }

    fn summary(&self) -> &'static str {
        "Irradiance per unit radius of a line light under a linearly transformed cosine"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("minv", Type::Mat3), Field::new("p1", Type::Vec3), Field::new("p2", Type::Vec3)] }
    }

    /// Not a share of anything, since it is per unit radius: a light off by 0.1 % shows in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("irradiance", Type::Float, Quantity::Magnitude, 1e-3).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "ggx",
                summary: "tubes of half-length 0.1..2 over a floor, up to 5 away, GGX of roughness 0.1..1",
                draw: |draw, row| {
                    let minv = ggx_minv(draw);
                    let center = over_floor(draw);
                    let half = draw.log_uniform(0.1, 2.0) * draw.direction();
                    store(row, minv, center - half, center + half);
                },
            },
            Scenario {
                name: "far",
                summary: "half-length 0.25 at 10..1e5 lengths, the cosine itself or GGX",
                draw: |draw, row| {
                    let minv = if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx_minv(draw) };
                    let mut away = draw.direction();
                    away.z = away.z.abs();
                    let center = 0.5 * draw.log_uniform(10.0, 1e5) * away;
                    let half = 0.25 * draw.direction();
                    store(row, minv, center - half, center + half);
                },
            },
            Scenario {
                name: "grazing",
                summary: "both ends 1e-6..0.1 of their distance above the horizon",
                draw: |draw, row| {
                    let minv = if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx_minv(draw) };
                    let end = |draw: &mut Draw| {
                        let (cos, sin) = draw.angle();
                        let distance = draw.log_uniform(0.3, 10.0);
                        DVec3::new(distance * cos, distance * sin, distance * draw.log_uniform(1e-6, 0.1))
                    };
                    let (p1, p2) = (end(draw), end(draw));
                    // Grazing in the cosine's space, where the horizon is.
                    let m = if minv == DMat3::IDENTITY { minv } else { minv.inverse() };
                    store(row, minv, m * p1, m * p2);
                },
            },
            Scenario {
                name: "near",
                summary: "the line passes the point at 1e-6..0.1 of its half-length",
                draw: |draw, row| {
                    let minv = if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx_minv(draw) };
                    let frame = draw.frame();
                    let half = draw.log_uniform(0.1, 10.0);
                    let mut foot = half * draw.log_uniform(1e-6, 0.1) * frame.x_axis;
                    foot.z = foot.z.abs();
                    // Kept orthogonal to the foot, so that the distance is as drawn.
                    let along = foot.cross(frame.y_axis).normalize();
                    let shift = draw.uniform(-0.8, 0.8);
                    store(
                        row,
                        minv,
                        foot + (shift - 1.0) * half * along,
                        foot + (shift + 1.0) * half * along,
                    );
                },
            },
            Scenario {
                name: "horizon",
                summary: "tubes that the horizon cuts, either end below, GGX of roughness 0.1..1",
                draw: |draw, row| {
                    let minv = ggx_minv(draw);
                    let m = minv.inverse();
                    let end = |draw: &mut Draw, side: f64| {
                        let q = draw.log_uniform(0.3, 5.0) * draw.direction();
                        m * DVec3::new(q.x, q.y, side * q.z.abs())
                    };
                    let side = draw.sign();
                    let (p1, p2) = (end(draw, side), end(draw, -side));
                    store(row, minv, p1, p2);
                },
            },
            Scenario {
                name: "long",
                summary: "half-length 10..1e6 at distance 0.3..3: the ends are at infinity",
                draw: |draw, row| {
                    let minv = if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx_minv(draw) };
                    let mut foot = draw.log_uniform(0.3, 3.0) * draw.direction();
                    foot.z = foot.z.abs();
                    let along = foot.cross(draw.direction()).normalize();
                    let (before, after) = (draw.log_uniform(10.0, 1e6), draw.log_uniform(10.0, 1e6));
                    store(row, minv, foot - before * along, foot + after * along);
                },
            },
            Scenario {
                name: "edge",
                summary: "equal ends, lines through the point, on the horizon and below it, landmark neighbours, any scale",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "distance_over_length",
                summary: "distance of the middle over the length; the ends' directions fall together where it is large",
                edges: &[0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5],
                coordinate: |input, _| {
                    let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
                    0.5 * norm(p1 + p2) / norm(p2 - p1)
                },
            },
            Landmark {
                name: "gap_over_length",
                summary: "distance of the infinite line over the length; the integrand peaks where it is small",
                edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0],
                coordinate: |input, _| {
                    let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
                    let length = norm(p2 - p1);
                    norm(p1.cross(p2)) / length / length
                },
            },
            Landmark {
                name: "elevation",
                summary: "sine of the higher end's elevation in the cosine's space; 0 and below: on the horizon or under it",
                edges: &[-0.1, 0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5],
                coordinate: |input, _| {
                    let minv = matrix(input);
                    let sine = |p: DVec3| {
                        let q = minv * p;
                        q.z / norm(q)
                    };
                    sine(vector(&input[P1..])).max(sine(vector(&input[P2..])))
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let minv = matrix(input);
        let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
        let ends = [p1, p2].map(|p| products::transform_sum(&minv, &[p]));
        let cofactors = products::cofactors(&minv);
        let normal = products::cross(p1, p2);
        let Some(part) = visible(ends, &cofactors, &normal) else {
            truth.scalar(0, 0.0, 0.0, 0.0);
            return;
        };
        let determinant = products::dot(minv.x_axis, &cofactors[0]);
        let normal = products::rounded(&normal);
        let size = norm(normal);
        let weight = determinant.abs() * size;
        if weight == 0.0 {
            truth.scalar(0, 0.0, 0.0, degenerate_sensitivity(&minv, p1, p2, &part));
            return;
        }
        let scale = FRAC_2_PI * (weight / part.length_product());
        // Past the largest f64 only if the line passes the point at 1e-100 of its length.
        let value = (scale * part.cosine_integral()).min(f64::MAX);
        let sensitivity = sensitivity(&minv, p1, p2, determinant, normal / size, size, &part);
        // Scale takes 8 roundings, the integral 200.
        truth.scalar(0, value, 208.0 * EPS * value, sensitivity);
    }
}

/// The sum over all inputs of |derivative times input|, from I = (2/pi) |det| |n| J.
fn sensitivity(
    minv: &DMat3,
    p1: DVec3,
    p2: DVec3,
    determinant: f64,
    direction: DVec3,
    size: f64,
    part: &Visible,
) -> f64 {
    let integral = part.cosine_integral() / part.length_product();
    let [by_a, by_b] = part.gradient();
    let weight = determinant.abs() * size;
    let transposed = minv.transpose();
    let by_p1 = determinant.abs() * integral * p2.cross(direction) + weight * (transposed * by_a);
    let by_p2 = determinant.abs() * integral * direction.cross(p1) + weight * (transposed * by_b);
    let cofactors =
        [minv.y_axis.cross(minv.z_axis), minv.z_axis.cross(minv.x_axis), minv.x_axis.cross(minv.y_axis)];
    let mut sum = by_p1.abs().dot(p1.abs()) + by_p2.abs().dot(p2.abs());
    for (column, cofactor) in cofactors.into_iter().enumerate() {
        let by_column = determinant.signum() * size * integral * cofactor
            + weight * (p1[column] * by_a + p2[column] * by_b);
        sum += by_column.abs().dot(minv.col(column).abs());
    }
    finite(FRAC_2_PI * sum)
}

/// Where |det| |n| = 0 the value has a kink: by how much it may grow.
fn degenerate_sensitivity(minv: &DMat3, p1: DVec3, p2: DVec3, part: &Visible) -> f64 {
    let integral = part.cosine_integral() / part.length_product();
    let normal_change = 2.0 * norm(cross_terms(p1, p2));
    let determinant_change = 3.0 * minv.x_axis.abs().dot(cross_terms(minv.y_axis, minv.z_axis));
    let determinant = minv.determinant().abs();
    let size = norm(p1.cross(p2));
    finite(FRAC_2_PI * integral * (determinant * normal_change + size * determinant_change))
}

/// What is undefined or beyond f64 is infinite: on the light, at the edge of the number range.
fn finite(sensitivity: f64) -> f64 {
    if sensitivity.is_nan() { f64::INFINITY } else { sensitivity }
}

fn store(row: &mut [f32], minv: DMat3, p1: DVec3, p2: DVec3) {
    let values = minv.to_cols_array().into_iter().chain(p1.to_array()).chain(p2.to_array());
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

fn ggx_minv(draw: &mut Draw) -> DMat3 {
    let roughness = draw.uniform(0.1, 1.0);
    let cos_theta = draw.uniform(0.02, 1.0);
    ggx::minv(roughness, cos_theta)
}

/// The middle of a light that hangs over a floor: up to 5 to each side, 0.1 to 4 high.
fn over_floor(draw: &mut Draw) -> DVec3 {
    DVec3::new(draw.uniform(-5.0, 5.0), draw.uniform(-5.0, 5.0), draw.uniform(0.1, 4.0))
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(10);
    let minv = if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx_minv(draw) };
    let point = |draw: &mut Draw| {
        let mut p = draw.log_uniform(0.1, 10.0) * draw.direction();
        p.z = p.z.abs();
        // Rounded first, so that what follows is exact in f32 where it says so.
        DVec3::from_array(p.to_array().map(|c| f64::from(c as f32)))
    };
    let (p1, p2) = (point(draw), point(draw));
    match kind {
        0 => store(row, minv, p1, p1),
        // End-on exactly, with the point off the light or on it; then by a factor that rounds.
        1 => store(row, minv, p1, draw.sign() * libm::exp2(f64::from(draw.below(21)) - 10.0) * p1),
        2 => store(row, minv, p1, draw.log_uniform(0.01, 100.0) * p1),
        3 => store(row, minv, p1, DVec3::ZERO),
        // On the horizon, and below it.
        4 => store(row, DMat3::IDENTITY, p1.with_z(0.0), p2.with_z(0.0)),
        5 => store(
            row,
            DMat3::IDENTITY,
            p1.with_z(-p1.z),
            p2.with_z(if draw.sign() > 0.0 { 0.0 } else { -p2.z }),
        ),
        // A singular matrix.
        6 => store(row, DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0)), p1, p2),
        // Any scale of the scene, which divides the answer.
        7 => {
            let scale = libm::exp2(f64::from(draw.below(81)) - 40.0);
            store(row, minv, scale * p1, scale * p2);
        }
        8 => {
            store(row, minv, p1, p2);
            let slot = P1 + draw.below(6) as usize;
            row[slot] = landmarks::near_landmark(draw);
        }
        _ => {
            store(row, DMat3::IDENTITY, p1, p2);
            for slot in &mut row[P1..] {
                *slot = landmarks::near_landmark(draw);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::numeric::gauss_legendre::{POINTS_16, visit};
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(LtcLine.outputs());
        LtcLine.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut check: impl FnMut(&[f32], &Truth)) {
        let scenario = LtcLine.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 15];
            (scenario.draw)(draw, &mut row);
            check(&row, &truth_of(&row));
        });
    }

    #[test]
    fn every_truth_is_certified_and_finite() {
        for scenario in LtcLine.scenarios() {
            let mut positive = 0;
            each(scenario.name, 20_000, |row, truth| {
                assert!(row.iter().all(|v| v.is_finite()), "{row:?}");
                let value = truth.values()[0];
                assert!(value.is_finite() && value >= 0.0, "{row:?}: {truth:?}");
                assert!(!truth.sensitivities()[0].is_nan(), "{row:?}: {truth:?}");
                // A truth past the largest f32 has no spacing to speak of.
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                positive += u32::from(value > 0.0);
            });
            assert!(positive > 3_000, "{}: {positive} lights above the horizon", scenario.name);
        }
    }

    /// The definition itself: radiance from the two-sided strip of half width R across the plane of light and point,
    /// integrated over the strip with its own normal, divided by R.
    #[test]
    fn is_the_limit_of_a_thin_strip() {
        each("ggx", 300, |row, truth| {
            let minv = matrix(row);
            let (p1, p2) = (vector(&row[P1..]), vector(&row[P2..]));
            let normal = p1.cross(p2).normalize();
            let radius = 1e-3;
            let (along, across) = (minv * (p2 - p1), minv * normal * radius);
            let area = along.cross(across);
            let mut sum = 0.0;
            for panel in 0..100 {
                let from = 0.01 * f64::from(panel);
                visit(&POINTS_16, from, from + 0.01, |s, weight| {
                    for side in [-1.0, 1.0] {
                        // Two Gauss points across the strip.
                        let q = minv * p1 + s * along + side / 3f64.sqrt() * across;
                        sum += weight * q.z.max(0.0) * area.dot(q).abs() / q.length_squared().powi(2);
                    }
                });
            }
            let strip = sum / (core::f64::consts::PI * radius);
            // Second order in radius/distance (0.1 at the least), stretched by up to 100 by Minv; kinks at the horizon.
            let value = truth.values()[0];
            assert!((strip - value).abs() <= 2e-3 * value.max(1e-3), "{row:?}: {strip} for {value}");
        });
    }

    /// Swapped ends are the same light, scaled scenes divide the answer, a split light is the sum of its parts.
    #[test]
    fn identities() {
        for scenario in ["ggx", "near", "horizon", "long"] {
            each(scenario, 2_000, |row, truth| {
                let value = truth.values()[0];
                let mut swapped = row.to_vec();
                swapped[P1..].rotate_left(3);
                let other = truth_of(&swapped).values()[0];
                assert!((other - value).abs() <= 416.0 * EPS * value, "{row:?}: {other} for {value}");
                let doubled: Vec<f32> =
                    row.iter().enumerate().map(|(i, v)| if i < P1 { *v } else { 2.0 * v }).collect();
                assert_eq!(truth_of(&doubled).values()[0], 0.5 * value, "{row:?}");
                // A middle that f32 holds exactly: coordinates on a grid of 2^-8.
                let mut snapped = row.to_vec();
                for slot in &mut snapped[P1..] {
                    *slot = (*slot * 256.0).round() / 256.0;
                }
                if snapped[P1..].iter().any(|v| v.abs() > 8192.0) {
                    return;
                }
                let middle: Vec<f32> = (0..3).map(|i| 0.5 * (snapped[P1 + i] + snapped[P2 + i])).collect();
                let whole = truth_of(&snapped).values()[0];
                let (mut first, mut second) = (snapped.clone(), snapped.clone());
                first[P2..].copy_from_slice(&middle);
                second[P1..P2].copy_from_slice(&middle);
                let parts = truth_of(&first).values()[0] + truth_of(&second).values()[0];
                assert!((parts - whole).abs() <= 640.0 * EPS * whole, "{snapped:?}: {parts} for {whole}");
            });
        }
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for scenario in ["ggx", "horizon", "long"] {
            let mut worst: f64 = 0.0;
            let scenario = LtcLine.scenario(scenario).unwrap();
            Stream::new(5, "sensitivity").visit(0, 4_000, |_, draw| {
                let mut row = [0.0; 15];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-17);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let change = (truth_of(&changed).values()[0] - before.values()[0]).abs() / step;
                let sensitivity = before.sensitivities()[0];
                // First order only: what a step changes by a hundredth is left out.
                if sensitivity * step < 0.01 * before.values()[0] {
                    worst = worst.max(change / sensitivity);
                }
            });
            // 1.2: second-order terms, and the rounding of the changed inputs, 2^-7 of a step. 0.3: all signs at their worst are rare.
            assert!((0.3..=1.2).contains(&worst), "{}: {worst}", scenario.name);
        }
    }

    #[test]
    fn degenerate_lights_are_exactly_dark() {
        let minv = [1.0, 0.0, 0.25, 0.0, 2.0, 0.0, 0.5, 0.0, 1.0];
        for (p1, p2) in [
            ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]),
            ([1.0, 2.0, 3.0], [2.0, 4.0, 6.0]),
            ([1.0, 2.0, 3.0], [-0.5, -1.0, -1.5]),
            ([1.0, 2.0, 3.0], [0.0, 0.0, 0.0]),
            ([1.0, 2.0, -3.0], [3.0, 1.0, -1.0]),
        ] {
            let row: Vec<f32> = minv.into_iter().chain(p1).chain(p2).collect();
            let truth = truth_of(&row);
            assert_eq!(truth.values(), [0.0], "{row:?}");
            assert_eq!(truth.worst_bound(), 0.0, "{row:?}");
        }
    }
}
