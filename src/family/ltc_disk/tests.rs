use std::f64::consts::TAU;

use glam::DVec2;

use super::*;
use crate::family::problem::CERTIFIED;
use crate::numeric::graded_cone::Agreement;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::sample::Stream;

fn truth_of(input: &[f32]) -> Truth {
    let mut truth = Truth::new(LtcDisk.outputs());
    LtcDisk.oracle(input, &mut truth);
    truth
}

fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32], &Truth)) {
    let scenario = LtcDisk.scenario(scenario).unwrap();
    Stream::new(11, scenario.name).visit(0, count, |_, draw| {
        let mut row = [0.0; 18];
        (scenario.draw)(draw, &mut row);
        visit(&row, &truth_of(&row));
    });
}

#[test]
fn every_truth_is_certified_and_a_share() {
    for scenario in LtcDisk.scenarios() {
        let (mut lit, mut escalated) = (0, 0);
        each(scenario.name, 20_000, |row, truth| {
            let value = truth.values()[0];
            assert!(row.iter().all(|v| v.is_finite()), "{row:?}");
            assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
            assert!((0.0..=1.0).contains(&value), "{row:?}: {truth:?}");
            assert!(truth.sensitivities()[0] >= 0.0, "{row:?}: {truth:?}");
            lit += u32::from(value > 0.0);
            escalated += u32::from(truth.escalated());
        });
        // Escalation is for slivers above the horizon; most lights of a scenario are seen.
        assert!(lit > 5_000 && escalated < 10_000, "{}: {lit} lit, {escalated} escalated", scenario.name);
    }
}

/// The contour of the visible part, walked in the light's own parameter with Gauss's 3-point rule on short steps:
/// no eigensystem, no antiderivative.
fn by_contour(row: &[f32]) -> f64 {
    const STEPS: usize = 4000;
    let [c, a, b] = images(row);
    let side = c.dot(a.cross(b)).signum();
    let swing = libm::hypot(a.z, b.z);
    if c.z <= -swing {
        return 0.0;
    }
    let top = libm::atan2(b.z, a.z);
    let half = if c.z >= swing { TAU / 2.0 } else { libm::acos(-c.z / swing) };
    let point = |t: f64| c + a * t.cos() + b * t.sin();
    let step = 2.0 * half / STEPS as f64;
    let mut sum = 0.0;
    for i in 0..STEPS {
        for (node, weight) in [(-0.6f64.sqrt(), 5.0), (0.0, 8.0), (0.6f64.sqrt(), 5.0)] {
            let t = top - half + step * (i as f64 + 0.5 * (1.0 + node));
            let (p, speed) = (point(t), b * t.cos() - a * t.sin());
            sum += weight * p.cross(speed).z / p.length_squared();
        }
    }
    sum *= side * step / 18.0;
    let (p, q) = (point(top + half), point(top - half));
    if c.z < swing {
        sum += libm::atan2((p.x * q.y - p.y * q.x).abs(), p.x * q.x + p.y * q.y);
    }
    sum / TAU
}

/// 1e-9: the rule's error in the scenarios that do not come close to the light's plane.
#[test]
fn agrees_with_quadrature_of_the_contour() {
    for scenario in ["ggx", "facing", "far", "horizon", "needle"] {
        each(scenario, 200, |row, truth| {
            let (value, expected) = (truth.values()[0], by_contour(row));
            assert!((value - expected).abs() <= 1e-9, "{scenario} {row:?}: {value} for {expected}");
        });
    }
}

#[test]
fn a_disk_straight_above_is_its_sine_squared() {
    let mut row = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 1.5, 0.0, 0.0, 0.0, 1.5, 0.0];
    assert!((truth_of(&row).values()[0] - 0.36).abs() < 1e-15);
    // The other winding, and the light turned to its side, where half of it remains: integral over the half cap.
    row[16] = -1.5;
    assert!((truth_of(&row).values()[0] - 0.36).abs() < 1e-15);
    let side = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 1.5];
    let angle = libm::atan(0.75);
    let expected = (angle - angle.sin() * angle.cos()) / core::f64::consts::PI;
    assert!((truth_of(&side).values()[0] - expected).abs() < 1e-15);
}

/// A light under a diagonal Minv.
fn diagonal(m: [f32; 3], light: [f32; 9]) -> [f32; 18] {
    let mut row = [0.0; 18];
    (row[MINV], row[MINV + 4], row[MINV + 8]) = (m[0], m[1], m[2]);
    row[CENTER..].copy_from_slice(&light);
    row
}

/// Needles whose cone is 2^100 times as long as wide: quadrature with 60 digits, tools/truths/ltc_disk.py.
#[test]
fn needles_beyond_the_digits_of_the_quadric() {
    let lights = [
        (
            diagonal(
                [-0.9999973, -2147481700.0, 1.084214e-19],
                [
                    1.1754956e-38,
                    -1.1754887e-38,
                    -4.6565987e-10,
                    -1.23e-43,
                    -1.0842103e-19,
                    1.0000068e-7,
                    -1.0000067e-7,
                    0.9999971,
                    2147487000.0,
                ],
            ),
            0.146035383453987,
        ),
        (
            diagonal(
                [-9999965000.0, -9999997000.0, -1.9999901],
                [
                    4.656629e-10,
                    5.9e-44,
                    0.49999747,
                    -1.1920925e-7,
                    1.0842045e-19,
                    -1.0000019,
                    2147474300.0,
                    9.2233424e18,
                    9.2233237e18,
                ],
            ),
            1.77307012609179e-7,
        ),
        (
            diagonal(
                [-9.99994e-8, -9.9999376e-8, 1.00000045e-20],
                [
                    1.0000045e-7,
                    9.999979e-8,
                    1.1920983e-7,
                    -9.2233253e18,
                    -2147499300.0,
                    9999954000.0,
                    -2.0000234,
                    -1.1754906e-38,
                    9.9999816e-8,
                ],
            ),
            1.15526741259534e-26,
        ),
    ];
    for (row, expected) in lights {
        let truth = truth_of(&row);
        assert!((truth.values()[0] / expected - 1.0).abs() < 1e-13, "{truth:?} for {expected}");
        assert!(truth.worst_bound() <= CERTIFIED, "{truth:?}");
    }
}

fn compare(agreement: &mut Agreement, row: &[f32], truth: &Truth) {
    let (value, sensitivity) = (truth.values()[0], truth.sensitivities()[0]);
    let (minv, light) = (exact3::columns(&row[MINV..]), exact3::columns(&row[CENTER..]));
    agreement.add(
        value,
        sensitivity,
        jumps(&minv, &light, value),
        graded(minv, light, Known::default()),
        row,
    );
}

/// f64 with its tests against any precision, which has formulas of its own for the gradient's frame and sums.
#[test]
fn both_arithmetics_agree() {
    for scenario in LtcDisk.scenarios() {
        let mut agreement = Agreement::default();
        each(scenario.name, 400, |row, truth| compare(&mut agreement, row, truth));
        agreement.check(scenario.name);
    }
}

/// Where determinants leave the range of f64, and far from it.
#[test]
fn no_exponents_are_too_large_or_small() {
    let mut agreement = Agreement::default();
    Stream::new(12, "exponents").visit(0, 2_000, |_, draw| {
        let row: [f32; 18] = std::array::from_fn(|_| landmarks::any_exponent(draw));
        compare(&mut agreement, &row, &truth_of(&row));
    });
    agreement.check("exponents");
}

/// f64's axes, which are off by a rounding of their length, would say 1.581e-21 of these changes: difference quotients of the
/// closed form with 1500 digits.
#[test]
fn rounded_axes_do_not_count_as_known() {
    let row = [
        3.4958625e-33,
        5.219958e21,
        115900100000000.0,
        -1.6601457e-24,
        -4.5e-44,
        1.0560752e17,
        3.9069758e31,
        -2.528725e-15,
        0.0,
        9070971000000.0,
        0.0,
        -7.9687274e-14,
        0.00026630584,
        6.3296754e-25,
        7.350116,
        -4.6638417e-14,
        407900.03,
        2.1618946e-5,
    ];
    let truth = truth_of(&row);
    assert!((truth.values()[0] / 1.225_041_321_857_796_7e-22 - 1.0).abs() < 1e-12, "{truth:?}");
    assert!((truth.sensitivities()[0] / 1.225_023_299_03e-21 - 1.0).abs() < 0.01, "{truth:?}");
}

#[test]
fn dark_lights_are_exactly_dark() {
    let mut dark = 0;
    each("edge", 20_000, |row, truth| {
        let [c, a, b] = exact3::columns(&row[CENTER..]);
        if exact3::determinant(c, a, b) == 0.0 {
            assert_eq!(truth.values()[0], 0.0, "{row:?}");
            dark += 1;
        }
    });
    assert!(dark > 3_000, "{dark}");
}

/// Scaling a light by a power of two leaves every bit.
#[test]
fn the_unit_of_length_does_not_matter() {
    each("horizon", 2_000, |row, truth| {
        let mut scaled = row.to_vec();
        scaled[CENTER..].iter_mut().for_each(|v| *v *= 1024.0);
        let other = truth_of(&scaled);
        assert_eq!(truth.values(), other.values(), "{row:?}");
        assert_eq!(truth.sensitivities(), other.sensitivities(), "{row:?}");
    });
}

/// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
#[test]
fn sensitivities_cover_real_changes() {
    for scenario in ["ggx", "far", "horizon", "inside_out", "near_plane", "needle"] {
        let mut worst: f64 = 0.0;
        let scenario = LtcDisk.scenario(scenario).unwrap();
        Stream::new(5, "sensitivity").visit(0, 3_000, |_, draw| {
            let mut row = [0.0; 18];
            (scenario.draw)(draw, &mut row);
            let before = truth_of(&row);
            let step = 2f64.powi(-18);
            let changed: Vec<f32> =
                row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
            let change = (truth_of(&changed).values()[0] - before.values()[0]).abs() / step;
            let sensitivity = before.sensitivities()[0];
            let volume = |row: &[f32]| {
                let [c, a, b] = images(row);
                c.dot(a.cross(b))
            };
            let moved = (volume(&changed) / volume(&row) - 1.0).abs();
            // First order only: leave out what changes by more than a twentieth of itself, or crosses the plane.
            if sensitivity * step < 0.05 * before.values()[0] && moved < 0.05 {
                worst = worst.max(change / sensitivity);
            }
        });
        // 1.15: second order at this step, and the rim's quadrature. 0.3: all signs at their worst are rare.
        assert!((0.3..=1.15).contains(&worst), "{}: {worst}", scenario.name);
    }
}

/// A point a few roundings off the light sees the other half space if those go the other way, which its sensitivity must
/// say; one beside the light sees nothing from either side.
#[test]
fn the_side_of_the_light_is_a_rounding_away() {
    let mut flips = 0;
    Stream::new(9, "side").visit(0, 2_000, |index, draw| {
        let frame = draw.frame();
        let (cos, sin) = draw.angle();
        let foot = draw.uniform(0.0, 2.0);
        let height = draw.sign() * draw.log_uniform(1e-9, 1e-6);
        let mut row = [0.0; 18];
        let center = frame * DVec3::new(foot * cos, foot * sin, height);
        store(&mut row, ggx::minv(0.5, 0.5), center, frame.x_axis, frame.y_axis);
        let before = truth_of(&row);
        let mut jump: f64 = 0.0;
        Stream::new(9, "roundings").visit(16 * index as u64, 16, |_, draw| {
            let rounded: Vec<f32> = row
                .iter()
                .map(|v| (f64::from(*v) * (1.0 + draw.sign() * 2.0 * UNIT_ROUNDOFF)) as f32)
                .collect();
            jump = jump.max((truth_of(&rounded).values()[0] - before.values()[0]).abs());
        });
        if (foot - 1.0).abs() > 0.01 && jump > 0.1 {
            // Two roundings an input, where the judge lays four to the problem.
            assert!(4.0 * UNIT_ROUNDOFF * before.sensitivities()[0] >= jump, "{row:?}: {jump} {before:?}");
            flips += 1;
        }
        if foot > 1.01 {
            assert!(UNIT_ROUNDOFF * before.sensitivities()[0] < 1e-3, "{row:?}: {before:?}");
        }
    });
    // Between 1e-9 and 1e-7, within the light: a third of all, and the side turns for some of those.
    assert!(flips > 100, "{flips}");
}

/// In the light's plane half of all directions are a rounding from nothing at the rim; not so above it, nor further in.
#[test]
fn the_rim_is_a_rounding_away() {
    let mut jumps = 0;
    Stream::new(10, "rim").visit(0, 2_000, |index, draw| {
        let (cos, sin) = draw.angle();
        let off = draw.sign() * draw.log_uniform(1e-9, 1e-3);
        let height = draw.log_uniform(1e-12, 1e-3);
        let mut row = [0.0; 18];
        // A plane whose points are f32's: one of the coordinates is the height.
        let (x, y) = draw.angle();
        let (a, b) = (DVec2::new(x, y), DVec2::new(-y, x));
        let center = (1.0 + off) * (cos * a + sin * b);
        let turned = |v: DVec2, z: f64| DVec3::new(v.x, v.y, z);
        store(&mut row, DMat3::IDENTITY, turned(center, height), turned(a, 0.0), turned(b, 0.0));
        let before = truth_of(&row);
        let mut jump: f64 = 0.0;
        Stream::new(10, "roundings").visit(16 * index as u64, 16, |_, draw| {
            let rounded: Vec<f32> = row
                .iter()
                .map(|v| (f64::from(*v) * (1.0 + draw.sign() * 2.0 * UNIT_ROUNDOFF)) as f32)
                .collect();
            jump = jump.max((truth_of(&rounded).values()[0] - before.values()[0]).abs());
        });
        let explained = UNIT_ROUNDOFF * before.sensitivities()[0];
        if jump > 0.1 {
            assert!(4.0 * explained >= jump, "{row:?}: {jump} {before:?}");
            jumps += 1;
        }
        if height > 1e-4 || off.abs() > 1e-4 {
            assert!(explained < 0.01, "{row:?}: {before:?}");
        }
    });
    assert!(jumps > 100, "{jumps}");
}

/// Heights whose squares f64 does not hold beside those of the rest: S_zz came out as 0, and the light as uncut.
#[test]
fn low_lights_beside_long_needles_are_cut() {
    let power = |exponent: i32| libm::ldexp(1.0, exponent) as f32;
    let u = power(-147);
    let mut row = [0.0; 18];
    (row[0], row[4], row[8]) = (1.5 * power(127), power(-149), power(-149));
    (row[10], row[11], row[12]) = (u, u, power(127));
    (row[16], row[17]) = (0.5 * u, 1.25 * u);
    let value = truth_of(&row).values()[0];
    let exact = graded(exact3::columns(&row), exact3::columns(&row[CENTER..]), Known::default()).value;
    assert!((exact - 0.222_650).abs() < 1e-6 && (value - exact).abs() <= 1e-15, "{value} for {exact}");
}

/// The closed form's roundings add up to eleven of its terms here: its value with 2500 digits.
#[test]
fn bounds_cover_roundings() {
    let row = [
        78339410.0,
        -92.43549,
        -38515.438,
        -1.6451707e-12,
        5389646000.0,
        -6.255307e-10,
        5.2515275e-05,
        430270.7,
        -4670759400.0,
        204524830.0,
        -2.3582717e-07,
        1239.3158,
        -0.2226539,
        -90658.27,
        -7.606773e-16,
        -0.00033972925,
        -30238.219,
        65133000.0,
    ];
    let truth = truth_of(&row);
    let off = (truth.values()[0] - 9.606_301_398_665_999e-3).abs();
    // Bounds are told in spacings of f32.
    assert!(off <= truth.worst_bound() * libm::ldexp(1.0, -30), "{truth:?}: {off:e}");
}

/// Sensitivities that two precisions have lost alike: difference quotients of the closed form with 2500 digits.
#[test]
fn lost_sensitivities_are_not_taken() {
    let mut row = [0.0; 18];
    for (at, value) in [
        (0, 1.4551915e-11),
        (4, 7.275958e-12),
        (6, 1.6370477e-38),
        (8, 9.444733e+21),
        (9, 1.9342813e+25),
        (11, 9.536743e-07),
        (12, 1.47335e-40),
        (16, 1.4757395e+20),
    ] {
        row[at] = value;
    }
    let found = graded(exact3::columns(&row), exact3::columns(&row[CENTER..]), Known::default());
    assert!((found.sensitivity / 2.26342e-73 - 1.0).abs() < 0.01, "{found:?}");
}

/// Powers of two and their likes, whose digits end long before those of what is left of them: the closed form with 400 digits
/// and its difference quotients.
#[test]
fn roundings_that_agree_are_no_digits() {
    let lights = [
        (
            diagonal(
                [-1.1921009e-7, 1.999993, -1.1754969e-38],
                [
                    -1.1754866e-38,
                    -0.99999946,
                    1.0842099e-19,
                    1.0000054e-7,
                    1.0842134e-19,
                    1.9999987,
                    -1.1921021e-7,
                    -0.0010000098,
                    4.656642e-10,
                ],
            ),
            2.0835497406149954e-91,
            12.0000080002,
        ),
        (
            diagonal(
                [2147471900.0, -9.999983e-5, 9.999925e-21],
                [
                    9.223463e18,
                    1.1920973e-7,
                    4.656639e-10,
                    -0.0009999977,
                    -9.223369e18,
                    0.000100000485,
                    1.000009,
                    -0.00010000002,
                    -1.0842064e-19,
                ],
            ),
            2.730835581422452e-134,
            12.0,
        ),
        (
            [
                8.971348e-37,
                -3.0321655e16,
                -8.7e-44,
                3.2277003e20,
                1.9595256e-12,
                -1.4016338e23,
                -5.8308156e-6,
                0.0,
                -54424.348,
                2.3836583e-31,
                -6.528805e20,
                -2.1689504e-9,
                0.0,
                2.7847398e20,
                7.354292e-17,
                -4.354575e16,
                -4.57604e-23,
                1.1841997e-14,
            ],
            2.4707193899722162e-62,
            13.3342841733,
        ),
        (
            [
                1.8035621e33,
                3.2419494e-15,
                0.0,
                -2.5305579e20,
                3.6665222e-7,
                0.0,
                0.0,
                -9.2241676e-20,
                1.3789796e-35,
                0.0,
                4.0853094e-5,
                0.0,
                1.8067391e-6,
                0.0,
                2.8734753e-34,
                4.638643e31,
                0.0,
                30609.754,
            ],
            1.7349731341784278e-115,
            14.5403855988,
        ),
    ];
    for (row, value, share) in lights {
        let truth = truth_of(&row);
        let of_oracle = (truth.values()[0], truth.sensitivities()[0]);
        let big = graded(exact3::columns(&row), exact3::columns(&row[CENTER..]), Known::default());
        for found in [of_oracle.0, big.value] {
            assert!((found / value - 1.0).abs() <= 2e-12, "{row:?}: {found:e} for {value:e}");
        }
        let off = |sensitivity: f64| sensitivity / value / share - 1.0;
        assert!(off(big.sensitivity).abs() <= 0.01, "{row:?}: {big:?}");
        // Of what f32 has no digits of, a bound may do.
        let is_bound = of_oracle.1 < f64::from(f32::MIN_POSITIVE) && off(of_oracle.1) >= -0.01;
        assert!(off(of_oracle.1).abs() <= 0.01 || is_bound, "{row:?}: {of_oracle:?}");
    }
}

/// Squares of heights that add up to more partial sums than most sums have.
#[test]
fn heights_may_have_any_exponents() {
    let row = [
        1.0,
        0.0,
        1.8240435e19,
        0.0,
        1.0,
        3.9126138e-23,
        0.0,
        0.0,
        1.4743266e28,
        -1.5910317e21,
        2.1411371e24,
        -10.697266,
        2.1444759e-20,
        6.5635094e-17,
        1.5682e27,
        -9.8607613e-32,
        1.5556965e-30,
        -2.968773e-29,
    ];
    assert!(truth_of(&row).worst_bound() <= CERTIFIED);
}
