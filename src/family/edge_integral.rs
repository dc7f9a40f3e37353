//! One edge's share of a polygon's vector irradiance: the integral along the arc from a to b.
//!
//! ```text
//! edge = theta/(2 pi) n,   n = (a x b)/|a x b|,   theta = atan2(|a x b|, a.b)
//! ```
//!
//! The truth is that of the vectors as given, of any length. Parallel vectors have the edge 0, and so has a zero
//! vector, which is no direction. Exactly opposite ones have a length of 1/2 and no plane: the answer is 0, the mean of
//! all half circles, and any finite vector counts as right.
//!
//! Products of two f32 are exact in f64, so every component of a x b is one rounding away from exact, however nearly
//! parallel or opposite the two are: plain f64 always does, with a relative error below 12 EPS.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::spacing::EPS;
use crate::sample::{Draw, ggx, landmarks};

pub(super) struct EdgeIntegral;

/// Decades of an angle that goes to zero.
const ANGLES: &[f64] = &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 2.0];

impl Problem for EdgeIntegral {
    fn name(&self) -> &'static str {
        "edge_integral"
    }

    fn summary(&self) -> &'static str {
        "One edge's share of a polygon's vector irradiance: angle times unit normal, over 2 pi"
    }

    fn inputs(&self) -> &'static [Field] {
        const { &[Field::new("a", Type::Vec3), Field::new("b", Type::Vec3)] }
    }

    /// 1e-4 of the hemisphere's irradiance is a tenth of a step of 10 bits at white.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("edge", Type::Vec3, Quantity::VectorIrradiance, 1e-4).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "scene",
                summary: "edges of rectangles of 0.2 to 4 m, 0.3 to 10 m away, under an inverse GGX matrix of roughness 0.1 to 1",
                draw: scene,
            },
            Scenario {
                name: "near",
                summary: "theta log-uniform in 1e-7..1: dot products round to 1",
                draw: |draw, row| {
                    let theta = draw.log_uniform(1e-7, 1.0);
                    arc(draw, theta, row);
                },
            },
            Scenario {
                name: "antipodal",
                summary: "pi - theta log-uniform in 1e-7..1: the point is close to the edge itself",
                draw: |draw, row| {
                    let theta = PI - draw.log_uniform(1e-7, 1.0);
                    arc(draw, theta, row);
                },
            },
            Scenario {
                name: "right_angle",
                summary: "theta within 1e-8..1e-1 (log-uniform) of pi/2, either side: where forms by the sign of a.b change",
                draw: |draw, row| {
                    let theta = FRAC_PI_2 + draw.sign() * draw.log_uniform(1e-8, 1e-1);
                    arc(draw, theta, row);
                },
            },
            Scenario {
                name: "edge",
                summary: "equal, opposite, along an axis, off by last bits, of lengths 1 +- 1e-6, zero",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "theta",
                summary: "angle between a and b; at 0 they are parallel",
                edges: ANGLES,
                coordinate: |input, _| angle(input),
            },
            Landmark {
                name: "pi_minus_theta",
                summary: "what the angle lacks to pi; at 0 they are opposite and the point lies on the edge",
                edges: ANGLES,
                coordinate: |input, _| {
                    let (a, b) = vectors(input);
                    f64::atan2(a.cross(b).length(), -a.dot(b))
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let (a, b) = vectors(input);
        let cross = a.cross(b);
        let (sine, cosine) = (cross.length(), a.dot(b));
        if sine == 0.0 {
            let sensitivity = match cosine {
                // First order about parallel vectors: a x b itself, whose components are differences of two products.
                c if c > 0.0 => TwoProducts::new(a, b).change() / (TAU * c),
                0.0 => 0.0,
                _ => f64::INFINITY,
            };
            truth.vector(0, DVec3::ZERO, 0.0, sensitivity);
            return;
        }
        let theta = f64::atan2(sine, cosine);
        let normal = cross / sine;
        let edge = theta / TAU * normal;

        // A change of a within the plane changes theta; one along the normal tilts the plane about b, by that change
        // over the sine of the angle.
        let (a, b) = (a.normalize(), b.normalize());
        let along = |v: DVec3| normal.cross(v).abs().dot(v.abs());
        let out = |v: DVec3| normal.abs().dot(v.abs());
        let tilt = (out(a) + out(b)) / a.cross(b).length();
        let sensitivity = libm::hypot(along(a) + along(b), theta * tilt) / TAU;
        truth.vector(0, edge, 12.0 * EPS * theta / TAU, sensitivity);
    }
}

/// a x b by the magnitudes of its products.
struct TwoProducts(DVec3);

impl TwoProducts {
    fn new(a: DVec3, b: DVec3) -> Self {
        let (a, b) = (a.abs(), b.abs());
        TwoProducts(DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x))
    }

    /// The most by which a x b changes, as a length, when every component of a and b changes by its own magnitude.
    fn change(&self) -> f64 {
        2.0 * self.0.length()
    }
}

fn vectors(input: &[f32]) -> (DVec3, DVec3) {
    let vector = |i: usize| DVec3::new(f64::from(input[i]), f64::from(input[i + 1]), f64::from(input[i + 2]));
    (vector(0), vector(3))
}

fn angle(input: &[f32]) -> f64 {
    let (a, b) = vectors(input);
    f64::atan2(a.cross(b).length(), a.dot(b))
}

fn store(row: &mut [f32], a: DVec3, b: DVec3) {
    for (slot, value) in row.iter_mut().zip(a.to_array().into_iter().chain(b.to_array())) {
        *slot = value as f32;
    }
}

/// Two unit vectors an angle apart, in any orientation.
fn arc(draw: &mut Draw, theta: f64, row: &mut [f32]) {
    let frame = draw.frame();
    let (sin, cos) = libm::sincos(theta);
    store(row, frame.x_axis, cos * frame.x_axis + sin * frame.y_axis);
}

fn scene(draw: &mut Draw, row: &mut [f32]) {
    let minv = ggx::minv(draw.uniform(0.1, 1.0), draw.uniform(0.05, 1.0));
    let mut centre = draw.log_uniform(0.3, 10.0) * draw.direction();
    centre.z = centre.z.abs();
    let frame: DMat3 = draw.frame();
    let (x, y) = (0.5 * draw.log_uniform(0.2, 4.0), 0.5 * draw.log_uniform(0.2, 4.0));
    let corner = |sign: f64| minv * (centre + sign * x * frame.x_axis + y * frame.y_axis);
    store(row, unit(corner(-1.0)), unit(corner(1.0)));
}

/// Scaled by the largest component first: matrices of smooth materials have entries of 1e6.
fn unit(v: DVec3) -> DVec3 {
    let v = v / v.abs().max_element();
    v / libm::sqrt(v.dot(v))
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(8);
    let a = draw.direction();
    let sign = draw.sign();
    let axis = DVec3::AXES[draw.below(3) as usize];
    match kind {
        // Equal and exactly opposite, of whatever length rounding leaves; then along an axis, of length 1.
        0 => store(row, a, sign * a),
        1 => store(row, axis, sign * axis),
        2 => store(row, sign * axis, DVec3::AXES[draw.below(3) as usize]),
        // Off by up to four spacings a component, from equal and from opposite.
        3 | 4 => {
            store(row, a, sign * a);
            for slot in row[3..].iter_mut() {
                *slot = landmarks::neighbour(*slot, i64::from(draw.below(9)) - 4);
            }
        }
        // Unit up to the rounding of a few operations.
        5 => {
            let (p, q) = (1.0 + draw.uniform(-1e-6, 1e-6), 1.0 + draw.uniform(-1e-6, 1e-6));
            store(row, p * a, sign * q * a);
        }
        6 => {
            let b = draw.direction();
            if sign > 0.0 { store(row, DVec3::ZERO, b) } else { store(row, a, DVec3::ZERO) }
        }
        // In a coordinate plane: zeros among the components.
        _ => {
            let (cos, sin) = draw.angle();
            let other = axis.any_orthonormal_vector();
            store(row, axis, cos * axis + sin * other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::CERTIFIED;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(EdgeIntegral.outputs());
        EdgeIntegral.oracle(input, &mut truth);
        truth
    }

    fn edge_of(input: &[f32]) -> DVec3 {
        DVec3::from_slice(truth_of(input).output(0))
    }

    fn each(scenario: &str, count: usize, mut visit: impl FnMut(&[f32])) {
        let scenario = EdgeIntegral.scenario(scenario).unwrap();
        Stream::new(11, scenario.name).visit(0, count, |_, draw| {
            let mut row = [0.0; 6];
            (scenario.draw)(draw, &mut row);
            visit(&row);
        });
    }

    /// The line integral of p x dp / (2 pi |p|^2) along the chord, by Gauss's rule of 4 points on pieces that shrink
    /// towards the chord's point closest to the origin.
    fn quadrature(a: DVec3, b: DVec3) -> DVec3 {
        const NODES: [(f64, f64); 2] = [
            (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
            (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
        ];
        let (a, b) = (a.normalize(), b.normalize());
        let chord = b - a;
        let integrand = |t: f64| 1.0 / (a + t * chord).length_squared();
        let mut sum = 0.0;
        // By symmetry, twice the half from a to the middle, in pieces of half the remaining length and 8 parts each.
        let mut from = 0.0;
        for piece in 0..60 {
            let to = if piece == 59 { 0.5 } else { 0.5 - 0.5 * (0.5 - from) };
            for part in 0..8 {
                let width = (to - from) / 8.0;
                let (half, middle) = (0.5 * width, from + (f64::from(part) + 0.5) * width);
                for (node, weight) in NODES {
                    sum +=
                        half * weight * (integrand(middle - half * node) + integrand(middle + half * node));
                }
            }
            from = to;
        }
        a.cross(chord) * (2.0 * sum / TAU)
    }

    #[test]
    fn every_truth_is_certified_and_is_the_line_integral() {
        for scenario in EdgeIntegral.scenarios() {
            each(scenario.name, 2_000, |row| {
                let truth = truth_of(row);
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                let (a, b) = vectors(row);
                let edge = edge_of(row);
                assert!(edge.is_finite() && edge.length() <= 0.5, "{row:?}");
                // The chord passes the origin at cos(theta/2); normalising in f64 tells nothing below 1e-9 of it.
                if a.length() > 0.0 && b.length() > 0.0 && angle(row) < PI - 1e-6 {
                    let error = (quadrature(a, b) - edge).length();
                    // 1e-9 for the rule's own error; 1e-15/(pi - theta) for normalised corners, rounded in f64.
                    let allowed = 1e-9 * edge.length() + 1e-15 * (1.0 + 1.0 / (PI - angle(row)));
                    assert!(error <= allowed, "{row:?}: {error:e} > {allowed:e}");
                }
            });
        }
    }

    #[test]
    fn swapping_negates_and_splitting_sums() {
        each("scene", 5_000, |row| {
            let (a, b) = vectors(row);
            let swapped: Vec<f32> = row[3..].iter().chain(&row[..3]).copied().collect();
            assert_eq!(edge_of(&swapped), -edge_of(row));
            // A point of the plane of a and b, exact in f32 as a sum is not; so its distance to the plane counts.
            let middle = (a + b).as_vec3();
            if middle.length() > 0.1 {
                let first = edge_of(&[&row[..3], &middle.to_array()].concat());
                let second = edge_of(&[&middle.to_array(), &row[3..]].concat());
                // Rounding the middle moves it by 2^-24, and the two arcs with it.
                let error = (first + second - edge_of(row)).length();
                assert!(error <= 2f64.powi(-23), "{row:?}: {error}");
            }
        });
    }

    #[test]
    fn limits() {
        assert_eq!(edge_of(&[1.0, 0.0, 0.0, 1.0, 0.0, 0.0]), DVec3::ZERO);
        assert_eq!(edge_of(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0]), DVec3::ZERO);
        let opposite = truth_of(&[1.0, 0.0, 0.0, -1.0, 0.0, 0.0]);
        assert_eq!(opposite.sensitivities(), [f64::INFINITY]);
        assert_eq!(edge_of(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0]), DVec3::new(0.0, 0.0, 0.25));
        // Nearly opposite, by the smallest step there is: half the circle, in the plane that the step spans.
        let step = 2f32.powi(-149);
        assert_eq!(edge_of(&[1.0, 0.0, 0.0, -1.0, step, 0.0]), DVec3::new(0.0, 0.0, 0.5));
    }

    /// The stated sensitivities must cover what random input changes really do, and not by orders of magnitude.
    #[test]
    fn sensitivities_cover_real_changes() {
        for scenario in ["scene", "near", "antipodal", "right_angle"] {
            let mut worst: f64 = 0.0;
            let scenario = EdgeIntegral.scenario(scenario).unwrap();
            Stream::new(5, "sensitivity").visit(0, 5_000, |_, draw| {
                let mut row = [0.0; 6];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-14);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let change = edge_of(&changed) - edge_of(&row);
                // First order only: leave out edges that turn right over.
                if before.sensitivities()[0] * step < 0.01 {
                    worst = worst.max(change.length() / step / before.sensitivities()[0]);
                }
            });
            // 1.1: second order and the rounding of changed inputs, 2^-25 against a step of 2^-14. 0.3: all signs at
            // their worst are rare.
            assert!((0.3..=1.1).contains(&worst), "{}: {worst}", scenario.name);
        }
    }
}
