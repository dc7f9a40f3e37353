//! Irradiance of a thin rectangle p1 +- side, p2 +- side under a linearly transformed cosine.
//!
//! Truth is the rectangle (the parallelogram, if side is not across), emitting on both sides, after Minv and above the
//! horizon: the family measures line lights against the strip that they stand for.
//!
//! It is a quad like any other (`polygon_irradiance`), its corners rounded once. What cancels is the width of a narrow or
//! distant strip and what a horizon along its edge leaves of it: those are summed in double-double, and in as many digits as
//! it takes where that does not do (`graded_polygon`). Independently, with q(s, v) = Minv (p1 + s (p2 - p1) + v side),
//!
//! ```text
//! E = (1/pi) |det Minv| |[p2, side, p1]| integral over v in -1..1 of J(v)      J = integral over s of max(q.z, 0)/|q|^4
//! ```
//!
//! where nothing cancels, and v takes few lines along a narrow strip: this also is how tests check it, and how strong the
//! kink is of a strip that is seen exactly edge-on.
//!
//! Degenerate strips (no area, seen edge-on, a singular Minv) are exactly dark.

use core::f64::consts::FRAC_1_PI;

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::big;
use crate::numeric::gauss_legendre::{self, POINTS_8};
use crate::numeric::line_integral::{Visible, matrix, vector};
use crate::numeric::polygon_irradiance::of_pairs;
use crate::numeric::products::{self, Pairs, norm};
use crate::sample::{Draw, ggx, landmarks};

pub(super) struct LtcStrip;

const P1: usize = 9;
const P2: usize = 12;
const SIDE: usize = 15;

impl Problem for LtcStrip {
    fn name(&self) -> &'static str {
        "ltc_strip"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of a thin rectangular light under a linearly transformed cosine: what line lights approximate"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("minv", Type::Mat3),
                Field::new("p1", Type::Vec3),
                Field::new("p2", Type::Vec3),
                Field::new("side", Type::Vec3),
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
                summary: "strips of half-length 0.1..2 and half width 0.001..0.3 over a floor, GGX of alpha 0.2",
                draw: |draw, row| strip(draw, 0.2, row),
            },
            Scenario {
                name: "ggx_alpha_01",
                summary: "the same, GGX of alpha 0.1",
                draw: |draw, row| strip(draw, 0.1, row),
            },
            Scenario {
                name: "ggx_alpha_05",
                summary: "the same, GGX of alpha 0.5",
                draw: |draw, row| strip(draw, 0.5, row),
            },
            Scenario {
                name: "edge",
                summary: "no area, edge-on, on and below the horizon, touching the point, any scale, landmark neighbours",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "thickness",
                summary: "half width over the distance of the axis; the approximation is for small ones",
                edges: &[1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0],
                coordinate: |input, _| {
                    norm(vector(&input[SIDE..])) / distance(vector(&input[P1..]), vector(&input[P2..]))
                },
            },
            Landmark {
                name: "distance_over_length",
                summary: "distance of the middle over the length",
                edges: &[0.3, 1.0, 3.0, 10.0, 30.0, 100.0],
                coordinate: |input, _| {
                    let (p1, p2) = (vector(&input[P1..]), vector(&input[P2..]));
                    0.5 * norm(p1 + p2) / norm(p2 - p1)
                },
            },
            Landmark {
                name: "width_over_lobe",
                summary: "half width over the distance of the axis, over the lobe's width across: large for sharp lobes",
                edges: &[1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0],
                coordinate: |input, _| {
                    let thickness =
                        norm(vector(&input[SIDE..])) / distance(vector(&input[P1..]), vector(&input[P2..]));
                    thickness / lobe_width(&matrix(input))
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let minv = matrix(input);
        let (p1, p2, side) = (vector(&input[P1..]), vector(&input[P2..]), vector(&input[SIDE..]));
        let corners = [(p1, -side), (p2, -side), (p2, side), (p1, side)];
        let pairs = corners.map(|(p, offset)| products::transform_pairs(&minv, &[p, offset]));
        let mapped = pairs.map(|q| products::rounded(&q));
        if mapped.iter().all(|q| q.z <= 0.0) {
            truth.scalar(0, 0.0, 0.0, 0.0);
            return;
        }
        let cofactors = products::cofactors(&minv);
        let determinant = products::dot(minv.x_axis, &cofactors[0]);
        let volume = products::dot(p2, &products::cross(side, p1));
        if determinant == 0.0 || volume == 0.0 {
            let change = if holds_origin(p1, p2, side) {
                f64::INFINITY
            } else {
                growth(&minv, p1, p2, side) * across(&mapped, &areas(&cofactors, p1, p2, side))
            };
            truth.scalar(0, 0.0, 0.0, finite(FRAC_1_PI * change));
            return;
        }

        let found = of_pairs(&pairs, [false; 4]).finer(&pairs, [false; 4]).refined(|| {
            let columns = [minv.x_axis, minv.y_axis, minv.z_axis];
            corners.map(|(p, offset)| {
                let ([x, y, z], [u, v, w]) = (big::vector(p), big::vector(offset));
                big::mapped(&columns, &[x + u, y + v, z + w])
            })
        });
        if found.escalated {
            truth.escalate();
        }
        let value = found.value.abs().min(1.0);
        truth.scalar(0, value, found.bound, sensitivity(&minv, &corners, &found.gradient));
    }
}

/// (p1 - side) x (p2 - side) after Minv, and its like for the other edges, around the contour.
fn areas(cofactors: &[Pairs; 3], p1: DVec3, p2: DVec3, side: DVec3) -> [DVec3; 4] {
    let (axis, from, to) = (products::cross(p1, p2), products::cross(p1, side), products::cross(side, p2));
    let map = |terms: &[(f64, &Pairs)]| products::cofactors_times(cofactors, &products::sum(terms));
    [
        map(&[(1.0, &axis), (-1.0, &from), (-1.0, &to)]),
        -map(&[(2.0, &to)]),
        -map(&[(1.0, &axis), (1.0, &from), (1.0, &to)]),
        -map(&[(2.0, &from)]),
    ]
}

/// The integral of J over v in -1..1, where that is smooth: few digits of it, or all of them for narrow strips.
fn across(mapped: &[DVec3; 4], areas: &[DVec3; 4]) -> f64 {
    let mut sum = 0.0;
    gauss_legendre::visit(&POINTS_8, -1.0, 1.0, |v, weight| {
        let (low, high) = (0.5 * (1.0 - v), 0.5 * (1.0 + v));
        let (a, b) = (low * mapped[0] + high * mapped[3], low * mapped[1] + high * mapped[2]);
        // (p1 + v side) x (p2 + v side) is linear in v.
        if let Some(line) = Visible::new(a, b, low * areas[0] - high * areas[2]) {
            sum += weight * (line.cosine_integral() / line.length_product());
        }
    });
    sum
}

/// The sum over all inputs of |derivative times input|.
fn sensitivity(minv: &DMat3, corners: &[(DVec3, DVec3); 4], by_corner: &[DVec3; 4]) -> f64 {
    let transposed = minv.transpose();
    let points = corners.map(|(p, _)| p);
    let back = by_corner.map(|by| transposed * by);
    let mut sum = (back[0] + back[3]).abs().dot(points[0].abs())
        + (back[1] + back[2]).abs().dot(points[1].abs())
        + (back[2] + back[3] - back[0] - back[1]).abs().dot(corners[2].1.abs());
    for column in 0..3 {
        let by_column: DVec3 =
            by_corner.iter().zip(corners).map(|(by, (p, offset))| (p[column] + offset[column]) * *by).sum();
        sum += by_column.abs().dot(minv.col(column).abs());
    }
    finite(sum)
}

/// Where |det| |volume| vanishes the value has a kink: by how much that factor may grow.
fn growth(minv: &DMat3, p1: DVec3, p2: DVec3, side: DVec3) -> f64 {
    let absolute = |a: DVec3, b: DVec3, c: DVec3| 3.0 * a.abs().dot(products::cross_terms(b, c));
    minv.determinant().abs() * absolute(p1, p2, side)
        + p1.dot(p2.cross(side)).abs() * absolute(minv.x_axis, minv.y_axis, minv.z_axis)
}

/// Whether a strip whose plane holds the point holds the point itself, where rounding decides between 0 and a half.
fn holds_origin(p1: DVec3, p2: DVec3, side: DVec3) -> bool {
    let along = p2 - p1;
    let normal = along.cross(side);
    let area = normal.length_squared();
    let s = -p1.cross(side).dot(normal) / area;
    let v = -along.cross(p1).dot(normal) / area;
    let slack = 1e-6;
    (-slack..=1.0 + slack).contains(&s) && v.abs() <= 1.0 + slack
}

fn finite(sensitivity: f64) -> f64 {
    if sensitivity.is_nan() { f64::INFINITY } else { sensitivity }
}

/// The distance of a segment from the origin.
fn distance(a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let s = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    norm(if s.is_nan() { a } else { a + s * along })
}

/// The lobe's width across the plane of incidence over its length: alpha, about.
fn lobe_width(minv: &DMat3) -> f64 {
    let cofactors =
        [minv.y_axis.cross(minv.z_axis), minv.z_axis.cross(minv.x_axis), minv.x_axis.cross(minv.y_axis)];
    let column = |k: usize| DVec3::from_array(cofactors.map(|c| c[k]));
    column(1).length() / column(2).length()
}

fn store(row: &mut [f32], minv: DMat3, points: [DVec3; 3]) {
    let values = minv.to_cols_array().into_iter().chain(points.into_iter().flat_map(|p| p.to_array()));
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

fn strip(draw: &mut Draw, alpha: f64, row: &mut [f32]) {
    let minv = ggx::minv(libm::sqrt(alpha), draw.uniform(0.02, 1.0));
    let center = DVec3::new(draw.uniform(-5.0, 5.0), draw.uniform(-5.0, 5.0), draw.uniform(0.1, 4.0));
    let frame = draw.frame();
    let half = draw.log_uniform(0.1, 2.0) * frame.x_axis;
    let side = draw.log_uniform(1e-3, 0.3) * frame.y_axis;
    store(row, minv, [center - half, center + half, side]);
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(10);
    let minv =
        if draw.sign() > 0.0 { DMat3::IDENTITY } else { ggx::minv(draw.uniform(0.3, 1.0), draw.unit()) };
    let point = |draw: &mut Draw| {
        let p = draw.log_uniform(0.1, 10.0) * draw.direction();
        // Rounded first, so that what follows is exact in f32 where it says so.
        DVec3::from_array(p.with_z(p.z.abs()).to_array().map(|c| f64::from(c as f32)))
    };
    let (p1, p2, side) = (point(draw), point(draw), point(draw));
    match kind {
        0 => store(row, minv, [p1, p1, side]),
        1 => store(row, minv, [p1, p2, DVec3::ZERO]),
        // Edge-on: the point lies in the strip's plane, exactly; then next to it.
        2 => store(row, minv, [p1, p2, if draw.sign() > 0.0 { p1 } else { p2 }]),
        3 => store(row, minv, [p1, p2, 0.1 * p1 + draw.log_uniform(1e-6, 0.1) * side]),
        4 => store(row, DMat3::IDENTITY, [p1, p2, side].map(|p| p.with_z(0.0))),
        5 => store(row, DMat3::IDENTITY, [p1.with_z(-11.0), p2.with_z(-12.0), side.with_z(0.5)]),
        6 => store(row, DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0)), [p1, p2, side]),
        // The point a little below the strip's middle: nearly a half space.
        7 => {
            let height = draw.log_uniform(1e-6, 0.1);
            let (p, q) = (p1.with_z(0.0), DVec3::new(-p1.y, p1.x, 0.0));
            store(row, minv, [height * DVec3::Z - p, height * DVec3::Z + p, q]);
        }
        8 => {
            let scale = libm::exp2(f64::from(draw.below(81)) - 40.0);
            store(row, minv, [p1, p2, 0.3 * side].map(|p| scale * p));
        }
        _ => {
            store(row, minv, [p1, p2, 0.3 * side]);
            let slot = P1 + draw.below(9) as usize;
            row[slot] = landmarks::near_landmark(draw);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(LtcStrip.outputs());
        LtcStrip.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut check: impl FnMut(&[f32], &Truth)) {
        let scenario = LtcStrip.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 18];
            (scenario.draw)(draw, &mut row);
            check(&row, &truth_of(&row));
        });
    }

    #[test]
    fn every_truth_is_certified_and_a_share_of_the_hemisphere() {
        for scenario in LtcStrip.scenarios() {
            let mut positive = 0;
            each(scenario.name, 20_000, |row, truth| {
                assert!(row.iter().all(|v| v.is_finite()), "{row:?}");
                let value = truth.values()[0];
                assert!((0.0..=1.0).contains(&value), "{row:?}: {truth:?}");
                assert!(!truth.sensitivities()[0].is_nan(), "{row:?}: {truth:?}");
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                positive += u32::from(value > 0.0);
            });
            assert!(positive > 3_000, "{}: {positive} strips above the horizon", scenario.name);
        }
    }

    /// Whether [`across`] is good to rounding: the horizon meets the two long edges alike, and half the width is a fifth of the
    /// axis's distance or less, where the integrand's nearest singularity lies at 5 half widths, rho = 9.9, rho^-16 = 1e-16.
    fn is_narrow(mapped: &[DVec3; 4]) -> bool {
        let alike = |a: DVec3, b: DVec3| (a.z >= 0.0 && b.z >= 0.0) || (a.z <= 0.0 && b.z <= 0.0);
        let (a, b) = (0.5 * (mapped[0] + mapped[3]), 0.5 * (mapped[1] + mapped[2]));
        alike(mapped[0], mapped[3])
            && alike(mapped[1], mapped[2])
            && 0.5 * norm(mapped[3] - mapped[0]) <= 0.2 * distance(a, b)
    }

    /// Lines across are independent of the contour, and nothing cancels in them.
    #[test]
    fn lines_across_agree_with_the_contour() {
        for scenario in ["ggx_alpha_01", "ggx_alpha_05"] {
            let mut compared = 0;
            each(scenario, 5_000, |row, truth| {
                let minv = matrix(row);
                let (p1, p2, side) = (vector(&row[P1..]), vector(&row[P2..]), vector(&row[SIDE..]));
                let mapped = [(p1, -side), (p2, -side), (p2, side), (p1, side)]
                    .map(|(p, offset)| products::transform_sum(&minv, &[p, offset]));
                if truth.values()[0] == 0.0 || !is_narrow(&mapped) {
                    return;
                }
                let cofactors = products::cofactors(&minv);
                let lines = across(&mapped, &areas(&cofactors, p1, p2, side));
                let volume = products::dot(p2, &products::cross(side, p1));
                let value = FRAC_1_PI * (products::dot(minv.x_axis, &cofactors[0]) * volume).abs() * lines;
                // What the family promises.
                assert!((value / truth.values()[0] - 1.0).abs() < 3e-11, "{row:?}: {value} for {truth:?}");
                compared += 1;
            });
            assert!(compared > 2_000, "{compared}");
        }
    }

    #[test]
    fn swaps_scales_and_splits() {
        each("ggx_alpha_05", 2_000, |row, truth| {
            let value = truth.values()[0];
            // What the family promises.
            let slack = 3e-11 * value;
            let mut swapped = row.to_vec();
            swapped[P1..SIDE].rotate_left(3);
            assert!((truth_of(&swapped).values()[0] - value).abs() <= slack, "{row:?}");
            let mut mirrored = row.to_vec();
            mirrored[SIDE..].iter_mut().for_each(|v| *v = -*v);
            assert!((truth_of(&mirrored).values()[0] - value).abs() <= slack, "{row:?}");
            let doubled: Vec<f32> =
                row.iter().enumerate().map(|(i, v)| if i < P1 { *v } else { 2.0 * v }).collect();
            assert_eq!(truth_of(&doubled).values()[0], value, "{row:?}");
        });
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for scenario in ["ggx_alpha_01", "ggx_alpha_05"] {
            let mut worst: f64 = 0.0;
            let scenario = LtcStrip.scenario(scenario).unwrap();
            Stream::new(5, "sensitivity").visit(0, 4_000, |_, draw| {
                let mut row = [0.0; 18];
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

    #[test]
    fn degenerate_strips_are_exactly_dark_and_a_wide_one_fills_the_hemisphere() {
        let row = |p1: [f32; 3], p2: [f32; 3], side: [f32; 3]| -> Vec<f32> {
            let minv = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
            minv.into_iter().chain(p1).chain(p2).chain(side).collect()
        };
        for dark in [
            row([1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [1.0, 0.0, 0.0]),
            row([1.0, 2.0, 3.0], [2.0, 2.0, 3.0], [0.0, 0.0, 0.0]),
            row([1.0, 2.0, 3.0], [2.0, 2.0, 3.0], [3.0, 4.0, 6.0]),
            row([1.0, 2.0, -3.0], [2.0, 2.0, -3.0], [0.0, 1.0, 1.0]),
        ] {
            assert_eq!(truth_of(&dark).values(), [0.0], "{dark:?}");
        }
        let wide = row([-1e6, 0.0, 1.0], [1e6, 0.0, 1.0], [0.0, 1e6, 0.0]);
        assert!((truth_of(&wide).values()[0] - 1.0).abs() < 1e-11);
    }
}
