use super::*;
use crate::family::CERTIFIED;
use crate::sample::Stream;

fn truth_of(input: &[f32]) -> Truth {
    let mut truth = Truth::new(LtcPolygon.outputs());
    LtcPolygon.oracle(input, &mut truth);
    truth
}

fn value_of(input: &[f32]) -> f64 {
    truth_of(input).output(0)[0]
}

fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32], &Truth)) {
    let scenario = LtcPolygon.scenario(scenario).unwrap();
    Stream::new(11, scenario.name).visit(0, count, |_, draw| {
        let mut row = [0.0; 21];
        (scenario.draw)(draw, &mut row);
        visit(&row, &truth_of(&row));
    });
}

#[test]
fn every_truth_is_certified_and_a_share() {
    for scenario in LtcPolygon.scenarios() {
        let (mut escalated, mut touched, mut worst) = (0, 0, 0.0f64);
        each(scenario.name, 20_000, |row, truth| {
            worst = worst.max(truth.worst_bound());
            assert!(truth.worst_bound() <= CERTIFIED, "{}: {row:?}: {truth:?}", scenario.name);
            let value = truth.output(0)[0];
            assert!((0.0..=1.0).contains(&value), "{row:?}: {truth:?}");
            assert!(!truth.sensitivities()[0].is_nan(), "{row:?}: {truth:?}");
            escalated += u32::from(truth.escalated());
            touched += u32::from(truth.sensitivities()[0].is_infinite());
        });
        println!("{}: {escalated} escalated, {touched} touched, worst {worst}", scenario.name);
    }
}

/// Random points of the quad in f64, weighted by cos cos'/(pi r^2): no contour, no clipping, no edges.
#[test]
fn is_the_integral_over_the_light() {
    each("ggx", 60, |row, truth| {
        let minv = matrix(row);
        let [a, b, c, d] = lights(row).map(|p| minv * p);
        // Bilinear, so the corners are met although they are planar only up to rounding.
        const CELLS: u32 = 400;
        let mut sum = 0.0;
        let mut nearest = f64::INFINITY;
        for i in 0..CELLS {
            for j in 0..CELLS {
                let (s, t) =
                    ((f64::from(i) + 0.5) / f64::from(CELLS), (f64::from(j) + 0.5) / f64::from(CELLS));
                let point = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * d + s * c);
                let along = (1.0 - t) * (b - a) + t * (c - d);
                let up = (1.0 - s) * (d - a) + s * (c - b);
                let r2 = point.length_squared();
                nearest = nearest.min(r2.sqrt() / along.length().max(up.length()));
                sum += point.z.max(0.0) * point.dot(along.cross(up)) / (r2 * r2);
            }
        }
        let sum = (sum / f64::from(CELLS * CELLS) / core::f64::consts::PI).abs();
        let value = truth.output(0)[0];
        // The midpoint rule: a square of the cell over the distance, and a kink at the horizon.
        let cell = 1.0 / f64::from(CELLS) / nearest;
        assert!((sum - value).abs() <= 2.0 * cell * cell + 1e-9, "{row:?}: {sum} {value} {cell}");
    });
}

/// A light cut in two sums to the whole; so do its two triangles, and winding and turning about z change nothing.
#[test]
fn splitting_sums() {
    for scenario in ["ggx", "horizon", "far", "needle"] {
        each(scenario, 2_000, |row, truth| {
            let with = |corners: [DVec3; 4]| {
                let mut row = row.to_vec();
                for (slot, value) in row[9..].iter_mut().zip(corners.iter().flat_map(|p| p.to_array())) {
                    *slot = value as f32;
                }
                row
            };
            let corner = lights(row);
            let [a, b, c, d] = corner;
            let whole = truth.output(0)[0];
            let triangles = value_of(&with([a, b, c, a])) + value_of(&with([a, c, d, a]));
            // Corners planar up to rounding, 2^-24 of them: triangles may even face the point from either side.
            let planar = 2f64.powi(-22) * truth.sensitivities()[0];
            assert!((triangles - whole).abs() <= planar + 1e-9 * whole, "{row:?}: {triangles} {whole}");
            assert!((value_of(&with([b, c, d, a])) - whole).abs() <= 2f64.powi(-35) * whole);
            assert!((value_of(&with([d, c, b, a])) - whole).abs() <= 2f64.powi(-35) * whole);
            let (left, right) = ((0.5 * (a + b)).as_vec3().as_dvec3(), (0.5 * (c + d)).as_vec3().as_dvec3());
            let halves = value_of(&with([a, left, right, d])) + value_of(&with([left, b, c, right]));
            assert!((halves - whole).abs() <= planar + 1e-9 * whole, "{row:?}: {halves} {whole}");
        });
    }
}

/// Minv and the light scaled by powers of two, and the light turned half round about z: the very same irradiance.
#[test]
fn scale_changes_nothing() {
    each("ggx", 2_000, |row, truth| {
        let scaled: Vec<f32> =
            row.iter().enumerate().map(|(i, v)| if i < 9 { v * 0.125 } else { v * 1024.0 }).collect();
        assert_eq!(value_of(&scaled), truth.output(0)[0]);
    });
}

#[test]
fn exact_zeros_and_undefined_values() {
    let mut zeros = 0;
    each("edge", 20_000, |row, truth| {
        let value = truth.output(0)[0];
        let above = transformed(row).iter().any(|corner| corner[2].0 > 0.0);
        assert!(above || value == 0.0, "{row:?}");
        if flat(row) {
            assert_eq!(value, 0.0, "{row:?}");
            zeros += u32::from(truth.sensitivities()[0].is_finite());
        }
    });
    assert!(zeros > 1_000, "{zeros}");
}

/// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
#[test]
fn sensitivities_cover_real_changes() {
    for name in ["ggx", "grazing", "far", "needle", "horizon", "inside_out"] {
        let mut worst: f64 = 0.0;
        let scenario = LtcPolygon.scenario(name).unwrap();
        Stream::new(5, "sensitivity").visit(0, 3_000, |_, draw| {
            let mut row = [0.0; 21];
            (scenario.draw)(draw, &mut row);
            let before = truth_of(&row);
            let (value, sensitivity) = (before.output(0)[0], before.sensitivities()[0]);
            let step = 2f64.powi(-14);
            // No more words are left than 48 less what the scenario took: two a row of signs.
            let mut bits = u64::from(draw.word());
            let changed: Vec<f32> = row
                .iter()
                .map(|v| {
                    bits =
                        bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    let sign = if bits >> 63 == 0 { 1.0 } else { -1.0 };
                    (f64::from(*v) * (1.0 + sign * step)) as f32
                })
                .collect();
            let after = value_of(&changed);
            // First order only: not where the light turns its other side, goes under, or is about to touch.
            if sensitivity * step < 0.05 * value.min(0.1) {
                worst = worst.max((after - value).abs() / step / sensitivity);
            }
        });
        // 1.1: second order. 0.2: all of 21 signs at their worst are rare.
        assert!((0.2..=1.1).contains(&worst), "{name}: {worst}");
    }
}
