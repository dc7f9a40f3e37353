//! Irradiance of a quad under a linearly transformed cosine: the light's corners times Minv, clipped to z > 0.
//!
//! The light is its contour p0 p1 p2 p3, planar up to rounding, and emits on both sides: the truth is the absolute value
//! of the sum over the edges of the clipped contour (`numeric::polygon_irradiance`). It is 0 below the horizon, for a
//! quad without area and for one seen edge-on. Where the point lies exactly on the light - in its plane and within it,
//! on an edge or at a corner - the limit depends on the side, so the inputs do not define a value.
//!
//! The corners are sums of three exact products, rounded once. f64 then does unless the edges' contributions cancel.
//! Flat contours are told by their exact determinants, and edges through the point by exact cross products. What is left are
//! lights of a millionth of the hemisphere and less that are near or thin, and points very close to an edge or, within the
//! light's outline, to its plane: those are summed in double-double, and in as many digits as it takes where that does not do.

use glam::DVec3;

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::big;
use crate::numeric::line_integral::{matrix, vector};
use crate::numeric::polygon_irradiance::of_pairs;
use crate::numeric::products::{self, Pairs};
use crate::numeric::{exact, exact3};

mod scenarios;

pub(super) struct LtcPolygon;

/// Columns of Minv and of the corners among the inputs.
const MINV: usize = 0;
const CORNERS: usize = 9;

impl Problem for LtcPolygon {
    fn name(&self) -> &'static str {
        "ltc_polygon"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of a quad light under a linearly transformed cosine, clipped to the horizon"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("minv", Type::Mat3),
                Field::new("p0", Type::Vec3),
                Field::new("p1", Type::Vec3),
                Field::new("p2", Type::Vec3),
                Field::new("p3", Type::Vec3),
            ]
        }
    }

    /// 1e-4 of the hemisphere's irradiance is a tenth of a step of 10 bits at white.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("irradiance", Type::Float, Quantity::Irradiance, 1e-4).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        scenarios::ALL
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "distance",
                summary: "distance of the light's centre over its longer diagonal; small: the light is all around",
                edges: &[0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1e3, 1e4],
                coordinate: |input, _| {
                    let [a, b, c, d] = lights(input);
                    (0.25 * (a + b + c + d)).length() / (c - a).length().max((d - b).length())
                },
            },
            Landmark {
                name: "height",
                summary: "height of the point over the light's plane, over the light's longer diagonal; at 0 it touches",
                edges: &[1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0],
                coordinate: |input, _| {
                    let [a, b, c, d] = lights(input);
                    let (x, y) = (c - a, d - b);
                    let normal = x.cross(y);
                    (a.dot(normal) / normal.length()).abs() / x.length().max(y.length())
                },
            },
            Landmark {
                name: "elevation",
                summary: "sine of the elevation of the transformed light's centre; at 0 the horizon cuts it",
                edges: &[-0.5, -0.1, -0.01, 0.0, 0.01, 0.1, 0.5, 0.9],
                coordinate: |input, _| {
                    let [a, b, c, d] = transformed(input).map(|q| products::rounded(&q));
                    let centre = a + b + c + d;
                    centre.z / centre.length()
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let corners = lights(input);
        let alike = core::array::from_fn(|first| corners[first] == corners[(first + 1) % 4]);
        let pairs = transformed(input);
        let mut found = of_pairs(&pairs, alike);
        if !found.is_certain() {
            if flat(input) {
                // All edges lie in one plane with the origin. Outside the outline their angles cancel.
                found.touched |= found.value.abs() > 1e-9 || found.bound >= 1.0;
                found.value = 0.0;
                found.bound = 0.0;
            } else if passes(&corners, &pairs) {
                found.touched = true;
            } else {
                found = found.finer(&pairs, alike).refined(|| {
                    corners.map(|p| big::mapped(&exact3::columns(&input[MINV..]), &big::vector(p)))
                });
            }
        }
        if found.escalated {
            truth.escalate();
        }
        if found.touched {
            truth.scalar(0, found.value.abs(), 0.0, f64::INFINITY);
            return;
        }
        // The sum of the angles of a light all around may round up.
        let value = found.value.abs().min(1.0);
        truth.scalar(0, value, found.bound, sensitivity(input, &found.gradient));
    }
}

/// The change of the irradiance when every component of Minv and of the corners changes by its own magnitude.
fn sensitivity(input: &[f32], gradient: &[DVec3; 4]) -> f64 {
    let (minv, corners) = (exact3::columns(&input[MINV..]), lights(input));
    let mut change = 0.0;
    for (column, entries) in minv.iter().enumerate() {
        let slope: DVec3 = corners.iter().zip(gradient).map(|(p, g)| *g * p[column]).sum();
        change += slope.abs().dot(entries.abs());
        change += corners.iter().zip(gradient).map(|(p, g)| (entries.dot(*g) * p[column]).abs()).sum::<f64>();
    }
    change
}

fn lights(input: &[f32]) -> [DVec3; 4] {
    core::array::from_fn(|corner| vector(&input[CORNERS + 3 * corner..]))
}

/// Minv times the corners.
fn transformed(input: &[f32]) -> [Pairs; 4] {
    let minv = matrix(input);
    lights(input).map(|p| products::transform_pairs(&minv, &[p]))
}

/// Whether an edge with an end above the horizon passes through the origin, exactly: products of two f32 are, and Minv takes it
/// there again.
fn passes(corners: &[DVec3; 4], transformed: &[Pairs; 4]) -> bool {
    let is_above = |[.., (height, _)]: &Pairs| *height > 0.0;
    (0..4).any(|first| {
        let last = (first + 1) % 4;
        let (a, b) = (corners[first], corners[last]);
        (is_above(&transformed[first]) || is_above(&transformed[last]))
            && a.cross(b) == DVec3::ZERO
            && a.dot(b) <= 0.0
    })
}

/// Whether the transformed corners lie in one plane with the origin, exactly.
fn flat(input: &[f32]) -> bool {
    let (minv, corners) = (exact3::columns(&input[MINV..]), lights(input));
    let flat = |a: DVec3, b: DVec3, c: DVec3| {
        let positive = [[a.x, b.y, c.z], [a.y, b.z, c.x], [a.z, b.x, c.y]];
        let negative = [[-a.z, b.y, c.x], [-a.y, b.x, c.z], [-a.x, b.z, c.y]];
        let mut terms = [0.0; 12];
        for (pair, [x, y, z]) in terms.chunks_exact_mut(2).zip(positive.into_iter().chain(negative)) {
            // The product of two f32 is exact, and of three the sum of a rounded one and its error.
            let high = x * y * z;
            pair.copy_from_slice(&[high, (x * y).mul_add(z, -high)]);
        }
        exact::sum(&terms) == 0.0
    };
    let [a, b, c, d] = corners;
    flat(minv[0], minv[1], minv[2]) || (flat(a, b, c) && flat(a, b, d) && flat(a, c, d) && flat(b, c, d))
}

#[cfg(test)]
mod tests;
