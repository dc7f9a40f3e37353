use glam::DMat3;

use super::*;
use crate::family::CERTIFIED;
use crate::sample::{Draw, Stream};

fn truth_of(input: &[f32]) -> Truth {
    let mut truth = Truth::new(RayEllipse.outputs());
    RayEllipse.oracle(input, &mut truth);
    truth
}

fn each(scenario: &str, count: usize, mut visit: impl FnMut(&mut Draw, &[f32], &Truth)) {
    let scenario = RayEllipse.scenario(scenario).unwrap();
    Stream::new(11, scenario.name).visit(0, count, |_, draw| {
        let mut row = [0.0; 15];
        (scenario.draw)(draw, &mut row);
        assert!(row.iter().all(|value| value.is_finite()), "{}: {row:?}", scenario.name);
        visit(draw, &row, &truth_of(&row));
    });
}

fn misses(truth: &Truth) -> bool {
    RayEllipse.is_miss(truth.values())
}

#[test]
fn every_hit_satisfies_the_equation() {
    for scenario in RayEllipse.scenarios() {
        let mut hits = 0;
        each(scenario.name, 10_000, |_, row, truth| {
            assert!(truth.worst_bound() <= CERTIFIED && truth.margin() >= 0.0, "{row:?}: {truth:?}");
            if misses(truth) {
                assert_eq!(truth.values(), [MISS, 0.0, 0.0]);
                return;
            }
            hits += 1;
            let Ray { o, d, c, u, v, .. } = Ray::new(row);
            let [t, lambda, gamma] = [T, LAMBDA, GAMMA].map(|output| truth.output(output)[0]);
            let (there, place) = (o + t * d, c + lambda * u + gamma * v);
            // The parts' own certainty, and a few roundings of this check.
            let parts = o.abs() + c.abs() + t * d.abs() + (lambda * u).abs() + (gamma * v).abs();
            let off = (there - place).abs();
            assert!(off.cmple(2.0 * RELATIVE * parts).all(), "{row:?}: {off}");
            assert!(t >= 0.0 && libm::hypot(lambda, gamma) <= 1.0 + 2.0 * RELATIVE, "{row:?}: {truth:?}");
        });
        assert!(hits > 500, "{}: only {hits} hits of 10000", scenario.name);
    }
}

/// A miss's line, seen through the inverse of the matrix, leaves the ellipse, comes from behind, or has no inverse.
#[test]
fn every_miss_has_its_reason() {
    for scenario in ["scene", "border", "needle", "at_plane"] {
        let mut count = 0;
        each(scenario, 10_000, |_, row, truth| {
            let Ray { o, d, c, u, v, .. } = Ray::new(row);
            let matrix = DMat3::from_cols(-d, u, v);
            // Rows of the adjugate over the determinant: a glam routine with its own order of operations.
            let solution = matrix.inverse() * (o - c);
            let radius = libm::hypot(solution.y, solution.z);
            let inside = solution.x >= 0.0 && radius <= 1.0;
            // 1e-12: what f64 makes of the same configuration is certain beyond it in these scenarios.
            if truth.margin() > 1e-12 {
                assert_eq!(misses(truth), !inside, "{row:?}: {solution}");
                count += u32::from(!inside);
            }
        });
        assert!(count > 1_000, "{scenario}: {count} misses");
    }
}

#[test]
fn stated_answers() {
    let row =
        |o: [f32; 3], d: [f32; 3], c: [f32; 3], u: [f32; 3], v: [f32; 3]| truth_of(&[o, d, c, u, v].concat());
    let (x, y, down) = ([2.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, -4.0]);
    let zero = [0.0; 3];
    let down_from = |at: [f32; 2]| row([at[0], at[1], 2.0], down, zero, x, y);
    assert_eq!(down_from([0.0, 0.0]).values(), [0.5, 0.0, 0.0]);
    assert_eq!(down_from([1.0, -0.25]).values(), [0.5, 0.5, -0.5]);
    // The border is a hit, the next number is not, and either is within rounding.
    assert_eq!(down_from([2.0, 0.0]).values(), [0.5, 1.0, 0.0]);
    assert_eq!(down_from([2.0, 0.0]).margin(), 0.0);
    assert!(misses(&down_from([2.0 + 2.0 * f32::EPSILON, 0.0])));
    // Away; on the plane itself; and by less than what rounding t away would be.
    assert!(misses(&row([0.0, 0.0, -1.0], down, zero, x, y)));
    assert_eq!(row(zero, down, zero, x, y).values(), [0.0, 0.0, 0.0]);
    assert_eq!(row([0.5, 0.0, 1e-30], down, zero, x, y).output(T), [0.25 * f64::from(1e-30f32)]);
    assert!(misses(&row([0.5, 0.0, -1e-30], down, zero, x, y)));
    // Parallel, within the plane, no direction, no extent, parallel axes.
    let parallel = row([0.0, 0.0, 1.0], [1.0, 1.0, 0.0], zero, x, y);
    assert!(misses(&parallel) && parallel.margin() > 0.01, "{parallel:?}");
    let within = row([-9.0, 0.0, 0.0], [1.0, 0.0, 0.0], zero, x, y);
    assert!(misses(&within));
    let still = row([0.0, 0.0, 1.0], zero, zero, x, y);
    assert!(misses(&still) && still.margin() == f64::INFINITY);
    let thread = row([0.0, 0.0, 1.0], down, zero, x, zero);
    assert!(misses(&thread) && thread.margin() == f64::INFINITY);
    assert!(misses(&row([0.0, 0.0, 1.0], down, zero, x, [4.0, 0.0, 0.0])));
    // t beyond f32 is out of reach; just within it is not.
    assert!(misses(&row([0.0, 0.0, 1.0], [0.0, 0.0, -1e-39], zero, x, y)));
    assert!(!misses(&row([0.0, 0.0, 1.0], [0.0, 0.0, -3e-39], zero, x, y)));
    // A hit in front of a miss in the same pixel wins by its t.
    assert!(RayEllipse.is_miss(&[f64::from(f32::MAX), 0.0, 0.0]) && !RayEllipse.is_miss(&[-1.0, 0.0, 0.0]));
}

/// Stated sensitivities and margins cover what random input changes really do, and not by orders of magnitude.
#[test]
fn sensitivities_and_margins_cover_real_changes() {
    let (mut worst, mut turned) = ([0.0f64; 3], 0);
    let step = libm::exp2(-14.0);
    for scenario in ["scene", "border", "needle", "at_plane", "grazing"] {
        each(scenario, 5_000, |draw, row, before| {
            // At most 13 of the 48 words are used by these scenarios: signs come from the bits of one more.
            let signs = draw.word();
            let sign = |i: usize| if signs >> i & 1 == 0 { 1.0 } else { -1.0 };
            let changed: Vec<f32> = row
                .iter()
                .enumerate()
                .map(|(i, v)| (f64::from(*v) * (1.0 + sign(i) * step)) as f32)
                .collect();
            let after = truth_of(&changed);
            if misses(before) != misses(&after) {
                // 1.2: second order, where a class is far from turning for the first.
                assert!(before.margin() <= 1.2 * step, "{row:?}: {before:?} but {after:?}");
                turned += u32::from(before.margin() > 0.2 * step);
            } else if !misses(before) {
                for (output, worst) in worst.iter_mut().enumerate() {
                    let sensitivity = before.sensitivities()[output];
                    let size = if output == T { before.output(T)[0] } else { 1.0 };
                    // First order only: leave out what changes by more than a hundredth.
                    if sensitivity * step < 0.01 * size {
                        let change = (after.output(output)[0] - before.output(output)[0]).abs();
                        *worst = worst.max(change / step / sensitivity);
                    }
                }
            }
        });
    }
    // 1.1: second order. 0.3: all signs at their worst are rare.
    assert!(worst.iter().all(|worst| (0.3..=1.1).contains(worst)), "{worst:?}");
    assert!(turned > 100, "{turned}");
}
