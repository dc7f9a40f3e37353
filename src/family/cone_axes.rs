//! The cone over an ellipse: its mean direction and the tangents of its half angles (3D eigensystem).
//!
//! The ellipse lies across z in its own frame, semi-axes hx, hy along x and y, centre c. Its cone's dual is the matrix
//! S = diag(hx^2, hy^2, 0) - c c^T with eigenvalues s1 >= s2 >= 0 > -lambda: the axis is the eigenvector of -lambda, on
//! the light's side, and the squared tangents are s1/lambda and s2/lambda. lambda is the one positive root of
//!
//! ```text
//! x^3 + c2 x^2 + c1 x - c0     c2 = hx^2 + hy^2 - |c|^2     c1 = hx^2 hy^2 - hx^2 (cy^2 + cz^2) - hy^2 (cx^2 + cz^2)
//!                              c0 = (hx hy cz)^2
//! ```
//!
//! and moves by at most twice the relative error of these coefficients. Squares of f32 are exact in f64 and products of
//! two such squares exact as pairs, so each coefficient is summed exactly and rounded once, and no escalation is ever
//! needed. With p = cx^2/(hx^2 + lambda), q = cy^2/(hy^2 + lambda), r = cz^2/lambda, whose sum is 1, the rest is sums of
//! positive terms:
//!
//! ```text
//! axis ~ (cx/(hx^2 + lambda), cy/(hy^2 + lambda), cz/lambda)
//! s1 + s2 = hx^2 (q + r) + hy^2 (p + r)     s1 s2 = hx^2 hy^2 r
//! s1 - s2 = hypot(hx^2 (q + r) - hy^2 (p + r), 2 hx hy sqrt(p q))
//! ```
//!
//! lambda = 0 says that the origin lies in the light, or on its rim: a half space is seen, and nothing is defined. The
//! stated answer is the axis +z and tangents of f64's largest number for infinity, but any that are not NaN will do.

use glam::DVec3;

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::cubic::{POSITIVE_ROOT_BOUND, positive_root};
use crate::numeric::exact;
use crate::numeric::spacing::EPS;
use crate::numeric::twofold::two_product;
use crate::sample::{Draw, landmarks};

pub(super) struct ConeAxes;

const AXIS: usize = 0;
const TAN_MAJOR: usize = 1;
const TAN_MINOR: usize = 2;

impl Problem for ConeAxes {
    fn name(&self) -> &'static str {
        "cone_axes"
    }

    fn summary(&self) -> &'static str {
        "Mean direction and half angles of the cone over an ellipse (3D eigensystem)"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("half_x", Type::Float),
                Field::new("half_y", Type::Float),
                Field::new("center", Type::Vec3),
            ]
        }
    }

    /// The axis looks up the horizon's table and the tangents scale the light: 0.1 % and 1 mrad show in 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const {
            &[
                Output::new("axis", Type::Vec3, Quantity::UnitVector { sign_free: false }, 1e-3).headline(),
                Output::new("tan_major", Type::Float, Quantity::Magnitude, 1e-3),
                Output::new("tan_minor", Type::Float, Quantity::Magnitude, 1e-3).headline(),
            ]
        }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "elliptic lights of 5 cm to 5 m, semi-axes 1:1 to 5:1, centres 0.2 to 20 m off in any direction",
                draw: |draw, row| {
                    let (hx, hy) = semi_axes(draw, 0.05, 5.0, 5.0);
                    let center = draw.log_uniform(0.2, 20.0) * draw.direction();
                    store(row, hx, hy, center.with_z(center.z.abs()));
                },
            },
            Scenario {
                name: "facing",
                summary: "discs that face the point: a double root; half of them off by 1e-8..1e-2 in shape and place",
                draw: facing,
            },
            Scenario {
                name: "far",
                summary: "lights of aspect 1 to 5, log-uniform 10 to 1e5 radii away in any direction",
                draw: |draw, row| {
                    let (hx, hy) = semi_axes(draw, 0.05, 5.0, 5.0);
                    let center = hx.max(hy) * draw.log_uniform(10.0, 1e5) * draw.direction();
                    store(row, hx, hy, center.with_z(center.z.abs()));
                },
            },
            Scenario {
                name: "near_plane",
                summary: "height log-uniform 1e-5..1e-1 of the radius, up to two semi-axes from the centre, aspect 1 to 5",
                draw: |draw, row| {
                    let (hx, hy) = semi_axes(draw, 0.05, 5.0, 5.0);
                    let (cos, sin) = draw.angle();
                    let offset = draw.uniform(0.0, 2.0);
                    let height = hx.max(hy) * draw.log_uniform(1e-5, 1e-1);
                    store(row, hx, hy, DVec3::new(hx * offset * cos, hy * offset * sin, height));
                },
            },
            Scenario {
                name: "needle",
                summary: "aspect log-uniform 1 to 1e4, centres 0.1 to 10 major semi-axes off in any direction",
                draw: |draw, row| {
                    let (hx, hy) = semi_axes(draw, 0.05, 5.0, 1e4);
                    let center = hx.max(hy) * draw.log_uniform(0.1, 10.0) * draw.direction();
                    store(row, hx, hy, center.with_z(center.z.abs()));
                },
            },
            Scenario {
                name: "edge",
                summary: "centre exactly on the axis, in the plane, on the rim; zero and equal semi-axes; landmark neighbours",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "size",
                summary: "tangent of the major half angle: small for far lights, large near the light's plane",
                edges: &[1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4],
                coordinate: |_, truth| truth.output(TAN_MAJOR)[0],
            },
            Landmark {
                name: "roundness",
                summary: "tan_major/tan_minor - 1; 0 is a double root",
                edges: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e3],
                coordinate: |_, truth| truth.output(TAN_MAJOR)[0] / truth.output(TAN_MINOR)[0] - 1.0,
            },
            Landmark {
                name: "height",
                summary: "height of the point above the light's plane over the longer semi-axis",
                edges: &[1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4],
                coordinate: |input, _| {
                    f64::from(input[4]).abs() / f64::from(input[0]).max(f64::from(input[1]))
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let [hx, hy, x, y, z] = std::array::from_fn(|i| f64::from(input[i]));
        let cone = Cone { h2: [hx * hx, hy * hy], c2: [x * x, y * y, z * z] };
        let lambda = cone.lambda();
        if lambda == 0.0 {
            truth.unit_vector(AXIS, DVec3::Z, 0.0, f64::INFINITY);
            truth.scalar(TAN_MAJOR, f64::MAX, 0.0, f64::INFINITY);
            truth.scalar(TAN_MINOR, f64::MAX, 0.0, f64::INFINITY);
            return;
        }
        let Solution { weights, far, tan_major, tan_minor } = cone.solve(lambda);

        let along = DVec3::new(x * far[0], y * far[1], z);
        let axis = along.normalize();
        // Five roundings a component beside those of lambda, which each component passes on at most once.
        let turn = POSITIVE_ROOT_BOUND + 8.0 * EPS;
        // A tangent is the root of a ratio of sums of products of lambda and the weights: at most four times over.
        let relative = 4.0 * POSITIVE_ROOT_BOUND + 16.0 * EPS;

        let mut axis_change = 0.0;
        let mut tangent_changes = [0.0; 2];
        for change in Change::of_each_input(weights, far) {
            let turned =
                DVec3::new(along.x * change.axis[0], along.y * change.axis[1], along.z * change.axis[2]);
            axis_change += turned.cross(axis).length() / along.length();
            let of_tangents = cone.tangent_changes(weights, lambda, &change);
            for (sum, change) in tangent_changes.iter_mut().zip(of_tangents) {
                *sum += change.abs();
            }
        }
        truth.unit_vector(AXIS, axis, turn, axis_change);
        truth.scalar(TAN_MAJOR, tan_major, relative * tan_major, tangent_changes[0] * tan_major);
        truth.scalar(TAN_MINOR, tan_minor, relative * tan_minor, tangent_changes[1] * tan_minor);
    }
}

/// Squares of the semi-axes and of the centre's components, exact.
struct Cone {
    h2: [f64; 2],
    c2: [f64; 3],
}

/// What follows from lambda.
struct Solution {
    /// p, q, r.
    weights: [f64; 3],
    /// lambda/(hx^2 + lambda) and lambda/(hy^2 + lambda).
    far: [f64; 2],
    tan_major: f64,
    tan_minor: f64,
}

impl Cone {
    /// lambda within [`POSITIVE_ROOT_BOUND`]; exactly 0 where the origin lies in the light.
    fn lambda(&self) -> f64 {
        let Cone { h2: [a, b], c2: [x, y, z] } = *self;
        let pair = two_product;
        let ((ab, ab_), (ay, ay_), (az, az_), (bx, bx_), (bz, bz_)) =
            (pair(a, b), pair(a, y), pair(a, z), pair(b, x), pair(b, z));
        let c2 = exact::sum(&[a, b, -x, -y, -z]);
        let c1 = exact::sum(&[ab, ab_, -ay, -ay_, -az, -az_, -bx, -bx_, -bz, -bz_]);
        positive_root(c2, c1, ab * z)
    }

    fn solve(&self, lambda: f64) -> Solution {
        let Cone { h2: [a, b], c2: [x, y, z] } = *self;
        let [p, q, r] = [x / (a + lambda), y / (b + lambda), z / lambda];
        let (f, g) = (a * (q + r), b * (p + r));
        let difference = libm::hypot(f - g, 2.0 * libm::sqrt(a * p) * libm::sqrt(b * q));
        let s1 = 0.5 * (f + g + difference);
        let root = libm::sqrt(lambda);
        let tan_major = libm::sqrt(s1) / root;
        // sqrt(s2/lambda) with s2 = a b r / s1.
        let tan_minor = if s1 > 0.0 { libm::sqrt(a * r) * libm::sqrt(b / s1) / root } else { 0.0 };
        Solution {
            weights: [p, q, r],
            far: [lambda / (a + lambda), lambda / (b + lambda)],
            tan_major,
            tan_minor: tan_minor.min(tan_major),
        }
    }

    /// Relative changes of both tangents for one relative change of an input.
    fn tangent_changes(&self, weights: [f64; 3], lambda: f64, change: &Change) -> [f64; 2] {
        let [a, b] = self.h2.map(|h2| h2 / lambda);
        let [p, q, r] = weights;
        let [dp, dq, dr] = [p * change.weights[0], q * change.weights[1], r * change.weights[2]];
        // Logarithmic changes of hx^2/lambda and hy^2/lambda.
        let [ea, eb] = change.semi_axes.map(|of_h2| of_h2 - change.lambda);
        let (f, g, e) = (a * (q + r), b * (p + r), 2.0 * libm::sqrt(a * p) * libm::sqrt(b * q));
        let (df, dg) = (f * ea + a * (dq + dr), g * eb + b * (dp + dr));
        let de = 0.5 * e * (ea + eb + change.weights[0] + change.weights[1]);
        let difference = libm::hypot(f - g, e);
        let d_difference = if difference > 0.0 {
            ((f - g) * (df - dg) + e * de) / difference
        } else {
            // A double root splits either way.
            libm::hypot(df - dg, de)
        };
        let t1 = 0.5 * (f + g + difference);
        if t1 == 0.0 {
            return [0.0; 2];
        }
        let (middle, split) = (0.5 * (df + dg) / t1, 0.5 * d_difference / t1);
        let product = ea + eb + change.weights[2];
        if difference > 0.0 {
            [0.5 * (middle + split), 0.5 * (product - middle - split)]
        } else {
            [0.5 * (middle.abs() + split); 2]
        }
    }
}

/// Logarithmic derivatives for one input.
struct Change {
    lambda: f64,
    /// Of hx^2 and hy^2.
    semi_axes: [f64; 2],
    /// Of p, q, r.
    weights: [f64; 3],
    /// Of the axis's components before it is normalised, each up to the same term.
    axis: [f64; 3],
}

impl Change {
    /// One for each of hx, hy, cx, cy, cz.
    fn of_each_input([p, q, r]: [f64; 3], far: [f64; 2]) -> [Change; 5] {
        let near = far.map(|far| 1.0 - far);
        let slope = p * far[0] + q * far[1] + r;
        std::array::from_fn(|input| {
            let two = |of: usize| if input == of { 2.0 } else { 0.0 };
            let [ha, hb, x, y, z] = [two(0), two(1), two(2), two(3), two(4)];
            let lambda = (p * (x - near[0] * ha) + q * (y - near[1] * hb) + r * z) / slope;
            // Logarithms of hx^2 + lambda and hy^2 + lambda.
            let [poles_x, poles_y] = [near[0] * ha + far[0] * lambda, near[1] * hb + far[1] * lambda];
            Change {
                lambda,
                semi_axes: [ha, hb],
                weights: [x - poles_x, y - poles_y, z - lambda],
                axis: [0.5 * x - poles_x, 0.5 * y - poles_y, 0.5 * z - lambda],
            }
        })
    }
}

fn store(row: &mut [f32], hx: f64, hy: f64, center: DVec3) {
    let values = [hx, hy, center.x, center.y, center.z];
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// Semi-axes with the longer one in `low..high`, aspect log-uniform in 1..`aspect`, in either order.
fn semi_axes(draw: &mut Draw, low: f64, high: f64, aspect: f64) -> (f64, f64) {
    let longer = draw.log_uniform(low, high);
    let shorter = longer / draw.log_uniform(1.0, aspect);
    if draw.sign() > 0.0 { (longer, shorter) } else { (shorter, longer) }
}

fn facing(draw: &mut Draw, row: &mut [f32]) {
    let radius = draw.log_uniform(0.05, 5.0);
    let distance = draw.log_uniform(0.1, 20.0);
    let [squeeze, x, y] = if draw.sign() > 0.0 {
        [0.0; 3]
    } else {
        std::array::from_fn(|_| draw.sign() * draw.log_uniform(1e-8, 1e-2))
    };
    store(row, radius, radius * (1.0 + squeeze), DVec3::new(x * distance, y * distance, distance));
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(10);
    let (hx, hy) = semi_axes(draw, 0.05, 5.0, 10.0);
    let center = draw.log_uniform(0.1, 10.0) * draw.direction();
    // Rounded first, so that what follows is exact in f32 where it says so.
    let [hx, hy] = [hx, hy].map(|h| f64::from(h as f32));
    match kind {
        0 => store(row, hx, hy, DVec3::new(0.0, 0.0, center.z)),
        1 => store(row, hx, hx, center),
        2 => store(row, hx, hx, DVec3::new(0.0, 0.0, center.z)),
        // In the plane, outside and inside alike.
        3 => store(row, hx, hy, center.with_z(0.0)),
        // On the rim or above it, exactly.
        4 => {
            let height = if draw.sign() > 0.0 { 0.0 } else { draw.log_uniform(1e-8, 1.0) };
            let on_x = draw.sign() > 0.0;
            store(row, hx, hy, if on_x { DVec3::new(hx, 0.0, height) } else { DVec3::new(0.0, -hy, height) });
        }
        5 => store(row, if draw.sign() > 0.0 { 0.0 } else { hx }, 0.0, center),
        6 => store(row, hx, hy, if draw.sign() > 0.0 { DVec3::ZERO } else { center.with_y(0.0) }),
        7 => {
            store(row, 0.0, 0.0, center);
            row[0] = landmarks::near_landmark(draw).abs();
            row[1] = landmarks::near_landmark(draw).abs();
        }
        8 => {
            store(row, hx, hy, center);
            let component = 2 + draw.below(3) as usize;
            row[component] = landmarks::near_landmark(draw);
        }
        _ => {
            row.fill_with(|| landmarks::near_landmark(draw));
            row[0] = row[0].abs();
            row[1] = row[1].abs();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(ConeAxes.outputs());
        ConeAxes.oracle(input, &mut truth);
        truth
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32], &Truth)) {
        let scenario = ConeAxes.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 5];
            (scenario.draw)(draw, &mut row);
            visit(&row, &truth_of(&row));
        });
    }

    fn results(truth: &Truth) -> (DVec3, f64, f64) {
        (DVec3::from_slice(truth.output(AXIS)), truth.output(TAN_MAJOR)[0], truth.output(TAN_MINOR)[0])
    }

    #[test]
    fn every_truth_is_certified_and_finite() {
        for scenario in ConeAxes.scenarios() {
            each(scenario.name, 20_000, |row, truth| {
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!(truth.values().iter().all(|value| value.is_finite()), "{row:?}: {truth:?}");
                assert!(truth.sensitivities().iter().all(|value| !value.is_nan()), "{row:?}: {truth:?}");
                let (axis, tan_major, tan_minor) = results(truth);
                assert!((axis.length() - 1.0).abs() <= 8.0 * EPS, "{row:?}");
                assert!(tan_major >= tan_minor && tan_minor >= 0.0, "{row:?}");
            });
        }
    }

    /// The definition: with W3 the axis and W1, W2 some frame across it, (p.W1/t1)^2 + (p.W2/t2)^2 = (p.W3)^2 for all
    /// points p of the rim. The frame is found from the rim itself: its gnomonic image is an ellipse about the origin,
    /// whose shortest and longest radii are the tangents.
    #[test]
    fn the_rim_seen_along_the_axis_is_a_centred_ellipse() {
        for scenario in ["scene", "facing", "needle"] {
            each(scenario, 500, |row, truth| {
                let (axis, tan_major, tan_minor) = results(truth);
                if tan_major > 1e3 {
                    return;
                }
                let across = axis.any_orthonormal_vector();
                let other = axis.cross(across);
                let [hx, hy, x, y, z] = std::array::from_fn(|i| f64::from(row[i]));
                let image = |angle: f64| {
                    let p = DVec3::new(x + hx * libm::cos(angle), y + hy * libm::sin(angle), z);
                    [p.dot(across) / p.dot(axis), p.dot(other) / p.dot(axis)]
                };
                // The conic u^2 A + 2 u v B + v^2 C = 1 through three points, and a fourth and fifth to check.
                let points: Vec<[f64; 2]> = (0..5).map(|k| image(1.0 + 1.2 * f64::from(k))).collect();
                let scale = tan_major;
                let rows: Vec<DVec3> = points
                    .iter()
                    .map(|[u, v]| DVec3::new(u * u, 2.0 * u * v, v * v) / (scale * scale))
                    .collect();
                let system = glam::DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
                let condition = system.inverse().to_cols_array().iter().fold(0.0f64, |m, v| m.max(v.abs()));
                let conic = system.inverse() * DVec3::ONE;
                // Rounding of the rim's points, through the inverse.
                let slack = 1e-13 * condition * (1.0 + tan_major * tan_major);
                for check in &rows[3..] {
                    assert!(
                        (check.dot(conic) - 1.0).abs() <= slack * conic.length(),
                        "{row:?} {check} {conic}"
                    );
                }
                let (mean, half) = (0.5 * (conic.x + conic.z), 0.5 * (conic.x - conic.z));
                let spread = libm::hypot(half, conic.y);
                // 1/t^2 are the conic's eigenvalues.
                let expected = [mean - spread, mean + spread];
                for (tangent, expected) in [tan_major, tan_minor].into_iter().zip(expected) {
                    let inverse_square = scale * scale / (tangent * tangent);
                    assert!(
                        (inverse_square - expected).abs() <= 16.0 * slack * (1.0 + conic.length()),
                        "{row:?} {inverse_square} {expected}"
                    );
                }
            });
        }
    }

    /// A disc on the axis and one in the plane have answers in closed form.
    #[test]
    fn closed_forms() {
        let (axis, tan_major, tan_minor) = results(&truth_of(&[0.75, 0.75, 0.0, 0.0, -3.0]));
        assert_eq!((axis, tan_major, tan_minor), (DVec3::NEG_Z, 0.25, 0.25));
        // From the plane a disc is a fan of half angle asin(r/d).
        let (axis, tan_major, tan_minor) = results(&truth_of(&[3.0, 3.0, 0.0, 5.0, 0.0]));
        assert!((axis - DVec3::Y).length() <= 4.0 * EPS);
        assert!((tan_major - 0.75).abs() <= 64.0 * EPS);
        assert_eq!(tan_minor, 0.0);
        // Inside it, and on its rim, there is no cone.
        for x in [0.0, 1.0, 3.0] {
            assert_eq!(truth_of(&[3.0, 3.0, x, 0.0, 0.0]).output(TAN_MINOR), [f64::MAX]);
        }
        // A segment.
        let (_, tan_major, tan_minor) = results(&truth_of(&[0.0, 1.0, 0.0, 0.0, 2.0]));
        assert_eq!((tan_major, tan_minor), (0.5, 0.0));
    }

    /// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
    #[test]
    fn sensitivities_cover_real_changes() {
        for name in ["scene", "near_plane", "needle"] {
            let mut worst = [0.0f64; 3];
            let scenario = ConeAxes.scenario(name).unwrap();
            Stream::new(5, "sensitivity").visit(0, 5_000, |_, draw| {
                let mut row = [0.0; 5];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-14);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let after = truth_of(&changed);
                for output in [TAN_MAJOR, TAN_MINOR] {
                    let value = before.output(output)[0];
                    let sensitivity = before.sensitivities()[output];
                    // First order only: leave out what changes by more than a hundredth.
                    if sensitivity * step < 0.01 * value {
                        let change = (after.output(output)[0] - value).abs() / step;
                        worst[output] = worst[output].max(change / sensitivity);
                    }
                }
                let turn = results(&before).0.cross(results(&after).0).length();
                let sensitivity = before.sensitivities()[AXIS];
                if sensitivity * step < 0.01 {
                    worst[AXIS] = worst[AXIS].max(turn / step / sensitivity);
                }
            });
            // 1.1: second-order terms. 0.5: all five signs are at their worst in one draw of sixteen.
            assert!(worst.iter().all(|worst| (0.5..=1.1).contains(worst)), "{name}: {worst:?}");
        }
    }
}
