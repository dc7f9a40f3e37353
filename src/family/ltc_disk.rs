//! Irradiance of a disk or elliptic light under a linearly transformed cosine, the horizon included.
//!
//! The light is C + V1 cos t + V2 sin t and its inside; it emits on both sides. Minv takes it to where the material's
//! lobe is a cosine, and the result is the irradiance there of the part above the horizon, as a share of the full
//! hemisphere's. The image is an ellipse again, whose cone gives it in closed form (`numeric::clipped_ellipse`).
//!
//! Products of two f32 are exact in f64, so the image is known to 2^-104, and the volume [C, V1, V2] of the image is
//! det Minv times that of the light, each rounded once. Lights seen edge-on, without area or under a singular Minv
//! give exactly 0, also where the point lies on the light itself, and so do lights below the horizon.

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::ball::{Ball, Middle};
use crate::numeric::big::{self, Big};
use crate::numeric::clipped_ellipse::{Changes, Cone};
use crate::numeric::conjugate_cone::{self, ConjugateCone, Seen, Vector};
use crate::numeric::double_double::DoubleDouble;
use crate::numeric::graded_cone::{GradedCone, Irradiance, Known};
use crate::numeric::{exact, exact3};
use crate::sample::{Draw, ggx, landmarks};

mod jumps;

use jumps::jumps;

pub(super) struct LtcDisk;

const MINV: usize = 0;
const CENTER: usize = 9;

impl Problem for LtcDisk {
    fn name(&self) -> &'static str {
        "ltc_disk"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of a disk or ellipse light under a linearly transformed cosine, clipped by the horizon"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("minv", Type::Mat3),
                Field::new("center", Type::Vec3),
                Field::new("v1", Type::Vec3),
                Field::new("v2", Type::Vec3),
            ]
        }
    }

    /// 1e-4 of the hemisphere is a tenth of a step of 10 bits.
    fn outputs(&self) -> &'static [Output] {
        const { &[Output::new("irradiance", Type::Float, Quantity::Irradiance, 1e-4).headline()] }
    }

    fn scenarios(&self) -> &'static [Scenario] {
        &[
            Scenario {
                name: "ggx",
                summary: "disks of 10 cm to 2 m up to 5 m away over a floor of GGX roughness 0.1 to 1, seen from 0 to 85 degrees",
                draw: |draw, row| {
                    let roughness = draw.uniform(0.1, 1.0);
                    let cos = draw.uniform(0.087, 1.0);
                    let center =
                        DVec3::new(draw.uniform(-4.0, 4.0), draw.uniform(-4.0, 4.0), draw.uniform(0.2, 4.0));
                    let radius = draw.log_uniform(0.1, 2.0);
                    let frame = draw.frame();
                    store(
                        row,
                        ggx::minv(roughness, cos),
                        center,
                        radius * frame.x_axis,
                        radius * frame.y_axis,
                    );
                },
            },
            Scenario {
                name: "grazing",
                summary: "the same floor of roughness 0.05 to 0.5 seen at cosines 1e-3 to 0.1: matrices sheared to needles",
                draw: |draw, row| {
                    let roughness = draw.uniform(0.05, 0.5);
                    let cos = draw.log_uniform(1e-3, 0.1);
                    let center =
                        DVec3::new(draw.uniform(-8.0, 8.0), draw.uniform(-2.0, 2.0), draw.uniform(0.0, 2.0));
                    let radius = draw.log_uniform(0.1, 2.0);
                    let frame = draw.frame();
                    store(
                        row,
                        ggx::minv(roughness, cos),
                        center,
                        radius * frame.x_axis,
                        radius * frame.y_axis,
                    );
                },
            },
            Scenario {
                name: "facing",
                summary: "disks that face the point after Minv, as every sphere light is; a quarter of them exactly",
                draw: facing,
            },
            Scenario {
                name: "far",
                summary: "disks 10 to 1e5 radii away, any orientation, roughness 0.3 to 1",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.3, 1.0), draw.uniform(0.1, 1.0));
                    let radius = draw.log_uniform(0.01, 10.0);
                    let direction = draw.direction();
                    let center = radius
                        * draw.log_uniform(10.0, 1e5)
                        * DVec3::new(direction.x, direction.y, direction.z.abs());
                    let frame = draw.frame();
                    store(row, minv, center, radius * frame.x_axis, radius * frame.y_axis);
                },
            },
            Scenario {
                name: "near_plane",
                summary: "the point 1e-6 to 0.1 radii off the light's plane, up to 2 radii from its centre",
                draw: |draw, row| {
                    let frame = draw.frame();
                    let (cos, sin) = draw.angle();
                    let foot = draw.uniform(0.0, 2.0);
                    let height = draw.log_uniform(1e-6, 0.1);
                    let center = frame * DVec3::new(foot * cos, foot * sin, height);
                    image(draw, row, 0.5, center, frame.x_axis, frame.y_axis);
                },
            },
            Scenario {
                name: "needle",
                summary: "ellipses of aspect 10 to 1e4 after Minv, given by any conjugate pair, 0.5 to 20 lengths away",
                draw: |draw, row| {
                    let frame = draw.frame();
                    let (cos, sin) = draw.angle();
                    let (a, b) = (frame.x_axis, frame.y_axis / draw.log_uniform(10.0, 1e4));
                    let direction = draw.direction();
                    let center =
                        draw.log_uniform(0.5, 20.0) * DVec3::new(direction.x, direction.y, direction.z.abs());
                    image(draw, row, 0.5, center, cos * a + sin * b, cos * b - sin * a);
                },
            },
            Scenario {
                name: "horizon",
                summary: "ellipses whose rim the horizon cuts after Minv, 0.3 to 30 lengths away",
                draw: |draw, row| {
                    let frame = draw.frame();
                    let (a, b) = (frame.x_axis, frame.y_axis * draw.uniform(0.1, 1.0));
                    let swing = libm::hypot(a.z, b.z);
                    let (cos, sin) = draw.angle();
                    let distance = draw.log_uniform(0.3, 30.0);
                    let center = DVec3::new(distance * cos, distance * sin, draw.uniform(-1.0, 1.0) * swing);
                    image(draw, row, 0.2, center, a, b);
                },
            },
            Scenario {
                name: "inside_out",
                summary: "the point under the light: its foot within the rim, 0.01 to 1 radii from the plane",
                draw: |draw, row| {
                    let frame = draw.frame();
                    let (cos, sin) = draw.angle();
                    let foot = libm::sqrt(draw.unit());
                    let side = if frame.z_axis.z < 0.0 { -1.0 } else { 1.0 };
                    let center =
                        frame * DVec3::new(foot * cos, foot * sin, side * draw.log_uniform(0.01, 1.0));
                    image(draw, row, 0.3, center, frame.x_axis, frame.y_axis);
                },
            },
            Scenario {
                name: "edge",
                summary: "zero, parallel and edge-on lights, singular and extreme matrices, mixed scales, landmark neighbours",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "aspect",
                summary: "major over minor length after Minv",
                edges: &[1.000_001, 1.001, 1.1, 3.0, 10.0, 1e2, 1e3, 1e4, 1e6],
                coordinate: |input, _| {
                    let [_, v1, v2] = images(input);
                    let sum = v1.length_squared() + v2.length_squared();
                    let h = libm::hypot(0.5 * (v1.length_squared() - v2.length_squared()), v1.dot(v2));
                    (0.5 * sum + h) / v1.cross(v2).length()
                },
            },
            Landmark {
                name: "distance",
                summary: "distance of the centre over the major length, after Minv",
                edges: &[0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 1e2, 1e3, 1e4],
                coordinate: |input, _| {
                    let [center, v1, v2] = images(input);
                    let sum = v1.length_squared() + v2.length_squared();
                    let h = libm::hypot(0.5 * (v1.length_squared() - v2.length_squared()), v1.dot(v2));
                    center.length() / libm::sqrt(0.5 * sum + h)
                },
            },
            Landmark {
                name: "elevation",
                summary: "height of the centre over the rim's reach, after Minv; the horizon cuts the rim in -1..1",
                edges: &[-1.0, -0.99, -0.5, 0.0, 0.5, 0.99, 1.0, 1.01, 2.0, 10.0],
                coordinate: |input, _| {
                    let [center, v1, v2] = images(input);
                    center.z / libm::hypot(v1.z, v2.z)
                },
            },
            Landmark {
                name: "height",
                summary: "height of the point over the light's plane, over the major length, after Minv",
                edges: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0],
                coordinate: |input, _| {
                    let [center, v1, v2] = images(input);
                    let sum = v1.length_squared() + v2.length_squared();
                    let h = libm::hypot(0.5 * (v1.length_squared() - v2.length_squared()), v1.dot(v2));
                    let n = v1.cross(v2);
                    n.dot(center).abs() / (n.length() * libm::sqrt(0.5 * sum + h))
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let minv = exact3::columns(&input[MINV..]);
        let light = exact3::columns(&input[CENTER..]);
        let images = light.map(|v| exact3::transformed(&minv, v));
        let scale = exact3::scale_to_one(&images);
        let [c, a, b] = images.map(|v| v.map(|component| component.scaled(scale)));
        let of_minv = exact3::determinant(minv[0], minv[1], minv[2]);
        let of_light = exact3::determinant(light[0], light[1], light[2]);
        let volume = of_minv * of_light * scale * scale * scale;

        let (cc, aa, bb) = (exact3::square(&c), exact3::square(&a), exact3::square(&b));
        let dual = [0, 1, 2, 3, 4, 5].map(|i| aa[i] + bb[i] - cc[i]);
        let towards = DVec3::from_array(c.map(|component| component.value()));
        if of_minv == 0.0 || of_light == 0.0 {
            // Seen edge-on, and where the point may be on the light: any irradiance is a rounding away.
            let below = dual[2].value() < 0.0 && towards.z < 0.0;
            return truth.scalar(0, 0.0, 0.0, if below { 0.0 } else { f64::INFINITY });
        }
        let size = minv.map(|column| scale * column.abs());
        let reach = light.map(|v| size[0] * v.x.abs() + size[1] * v.y.abs() + size[2] * v.z.abs());
        let terms = reach.into_iter().map(|reach| reach * reach).sum();
        let image = [c, a, b].map(|v| DVec3::from_array(v.map(|component| component.value())));
        let found = (Cone { dual, minus_det: volume * volume, towards }).irradiance(terms);
        let found = found.and_then(|seen| {
            Some((seen, sensitivity(seen.gradient, &minv, &light, &image, scale, seen.off(terms))?))
        });
        let Some((seen, sensitivity)) = found else {
            truth.escalate();
            if exact3::height(&minv, light[0]) <= 0.0
                && exact::sum(level(&minv, &light).as_flattened()) <= 0.0
            {
                return truth.scalar(0, 0.0, 0.0, jumps(&minv, &light, 0.0));
            }
            let known = Known::default()
                .or(|_| conjugate::<f64>(&minv, &light))
                .or(|_| conjugate::<DoubleDouble>(&minv, &light));
            let seen = known.or_else(|known| graded(minv, light, known));
            let jumps = jumps(&minv, &light, seen.value);
            return truth.scalar(0, seen.value, seen.bound, seen.sensitivity + jumps);
        };
        if seen.escalated {
            truth.escalate();
        }
        truth.scalar(0, seen.value, seen.bound, sensitivity + jumps(&minv, &light, seen.value));
    }
}

/// What S_zz adds up from: the square of the rim's reach less that of the centre's height.
fn level(minv: &[DVec3; 3], light: &[DVec3; 3]) -> [[f64; 12]; 3] {
    let [c, a, b] = light.map(|v| [minv[0].z * v.x, minv[1].z * v.y, minv[2].z * v.z]);
    [(a, 1.0), (b, 1.0), (c, -1.0)].map(|(products, sign)| exact3::square_of_sum(&products, sign))
}

/// The same in the light's own frame.
fn conjugate<M: Middle>(minv: &[DVec3; 3], light: &[DVec3; 3]) -> Option<Known> {
    let szz = Ball::<M>::sum(level(minv, light).as_flattened(), 0.0);
    let seen = ConjugateCone::of_ellipse(minv, light, szz).irradiance()?;
    Some(known(&seen, minv, light).or(|known| Some(self::known(&seen.by_lines(known)?, minv, light))))
}

/// What that tells of the irradiance and of its changes.
fn known<M: Middle>(seen: &Seen<M>, of_minv: &[DVec3; 3], of_light: &[DVec3; 3]) -> Known {
    let [minv, light] = [of_minv, of_light].map(|vectors| vectors.map(conjugate_cone::vector));
    let [center, v1, v2] = seen.images;
    // In the principal frame, Minv's columns and what of the images belongs to them: sums that may cancel, and so come first, before
    // the gradient, which is not known as well as they.
    let columns = minv.map(|column| seen.in_frame(&column));
    let own = [0, 1, 2]
        .map(|j| [0, 1, 2].map(|i| v1[i] * light[1][j] + v2[i] * light[2][j] - center[i] * light[0][j]));
    let found = seen.with_sensitivity(change(seen, &minv, &light, &columns, &own));
    if found.sensitivity.is_some() {
        return found;
    }
    // Both are also what the inverses of light and matrix say, by their cofactors.
    let [dual_c, dual_a, dual_b] = conjugate_cone::duals::<M>(of_light);
    let columns = [0, 1, 2].map(|j| {
        [0, 1, 2].map(|i| columns[j][i].or(center[i] * dual_c[j] + v1[i] * dual_a[j] + v2[i] * dual_b[j]))
    });
    let duals = conjugate_cone::duals(of_minv).map(|dual| seen.in_frame(&dual));
    let values = seen.eigenvalues();
    let own = [0, 1, 2].map(|j| [0, 1, 2].map(|i| own[j][i].or(values[i] * duals[j][i])));
    seen.with_sensitivity(change(seen, &minv, &light, &columns, &own))
}

/// The sum over all inputs x of |x dE/dx|.
fn change<M: Middle>(
    seen: &Seen<M>,
    minv: &[Vector<M>; 3],
    light: &[Vector<M>; 3],
    columns: &[Vector<M>; 3],
    own: &[Vector<M>; 3],
) -> Ball<M> {
    let by_images = seen.images.map(|image| seen.by(&image));
    let mut sum = Ball::ZERO;
    for j in 0..3 {
        let by_column = seen.in_world(&seen.by(&own[j]));
        for (entry, by_entry) in minv[j].iter().zip(by_column) {
            sum = sum + (*entry * by_entry).abs();
        }
        for (vector, by) in light.iter().zip(&by_images) {
            sum = sum + (vector[j] * conjugate_cone::dot(&columns[j], by)).abs();
        }
    }
    sum << 1
}

/// The same in any precision.
fn graded(minv: [DVec3; 3], light: [DVec3; 3], known: Known) -> Irradiance {
    let vectors = light.map(big::vector);
    let [cc, aa, bb] = vectors.each_ref().map(big::square);
    let own = std::array::from_fn(|i| &aa[i] + &bb[i] - &cc[i]);
    GradedCone { minv, own, center: light[0] }.irradiance(known, |by_own| {
        vectors.iter().map(|v| big::moved(by_own, v)).fold(Big::ZERO, |sum, moved| sum + moved)
    })
}

/// The sum over all inputs x of |x dE/dx|, from dE/dS with S = a a^T + b b^T - c c^T of the scaled images; `None` where that
/// cancels, or may be `off` by too much.
fn sensitivity(
    gradient: DMat3,
    minv: &[DVec3; 3],
    light: &[DVec3; 3],
    image: &[DVec3; 3],
    scale: f64,
    off: f64,
) -> Option<f64> {
    let signs = [-2.0, 2.0, 2.0];
    let by_image = [0, 1, 2].map(|k| signs[k] * scale * (gradient * image[k]));
    let (mut of_minv, mut of_light) = (Changes::default(), Changes::default());
    for (column, entries) in minv.iter().enumerate() {
        let by_column: DVec3 = (0..3).map(|k| by_image[k] * light[k][column]).sum();
        of_minv.add(*entries * by_column);
    }
    for (vector, by_image) in light.iter().zip(by_image) {
        let by_vector = DVec3::from_array(minv.map(|column| column.dot(by_image)));
        of_light.add(*vector * by_vector);
    }
    of_minv.size(of_light, off)
}

/// Centre and conjugate semi-axes after Minv.
fn images(input: &[f32]) -> [DVec3; 3] {
    let minv = DMat3::from_cols_array(&std::array::from_fn(|i| f64::from(input[MINV + i])));
    exact3::columns(&input[CENTER..]).map(|v| minv * v)
}

fn store(row: &mut [f32], minv: DMat3, center: DVec3, v1: DVec3, v2: DVec3) {
    let values =
        [minv.to_cols_array().as_slice(), &center.to_array(), &v1.to_array(), &v2.to_array()].concat();
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// Stores the light whose image under some Minv is this one: the identity in half of all draws, else a GGX matrix of at
/// least this roughness.
fn image(draw: &mut Draw, row: &mut [f32], roughness: f64, center: DVec3, v1: DVec3, v2: DVec3) {
    let minv = if draw.sign() < 0.0 {
        DMat3::IDENTITY
    } else {
        ggx::minv(draw.uniform(roughness, 1.0), draw.uniform(0.1, 1.0))
    };
    let m = minv.inverse();
    store(row, minv, m * center, m * v1, m * v2);
}

fn facing(draw: &mut Draw, row: &mut [f32]) {
    let radius = draw.log_uniform(0.05, 5.0);
    let distance = radius * draw.log_uniform(0.5, 20.0);
    let frame = draw.frame();
    if draw.below(4) > 0 {
        let side = if frame.z_axis.z < 0.0 { -1.0 } else { 1.0 };
        image(draw, row, 0.2, side * distance * frame.z_axis, radius * frame.x_axis, radius * frame.y_axis);
        return;
    }
    // Exactly facing in f32: straight above, under a Minv that stretches x and y alike, or along a Pythagorean
    // direction whose frame has small integers.
    let (radius, distance) = (f64::from(radius as f32), f64::from(distance as f32));
    if draw.sign() < 0.0 {
        let stretch = libm::exp2(f64::from(draw.below(8)));
        let minv = DMat3::from_diagonal(DVec3::new(stretch, stretch, 1.0));
        store(row, minv, distance * DVec3::Z, radius * DVec3::X, radius * DVec3::Y);
    } else {
        // Few bits, so that multiples of 1, 2, 3, 6 are exact.
        let radius = libm::round(64.0 * radius) / 64.0;
        let distance = libm::round(64.0 * distance) / 64.0;
        let (x, y, z) = (DVec3::new(2.0, -3.0, 6.0), DVec3::new(6.0, -2.0, -3.0), DVec3::new(3.0, 6.0, 2.0));
        store(row, DMat3::IDENTITY, distance * z, radius * x, radius * y);
    }
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(12);
    let identity = DMat3::IDENTITY;
    let direction = draw.direction();
    let center =
        DVec3::from_array((draw.log_uniform(0.1, 10.0) * direction).to_array().map(|c| f64::from(c as f32)));
    let v1 = DVec3::from_array(draw.direction().to_array().map(|c| f64::from(c as f32)));
    let v2 = draw.direction();
    match kind {
        // No area: a zero axis, parallel axes, a light that is its centre.
        0 => store(row, identity, center, DVec3::ZERO, if draw.sign() > 0.0 { v2 } else { DVec3::ZERO }),
        1 => {
            store(row, identity, center, v1, draw.sign() * libm::exp2(f64::from(draw.below(21)) - 10.0) * v1)
        }
        // Edge-on, from outside and from the light itself.
        2 => store(row, identity, 4.0 * v1, v1, v2),
        3 => store(row, identity, if draw.sign() > 0.0 { 0.5 * v1 } else { DVec3::ZERO }, v1, v2),
        // The horizon exactly through the centre, touching the rim, and as the light's own plane.
        4 => store(row, identity, DVec3::new(center.x, center.y, 0.0), v1, v2),
        5 => store(
            row,
            identity,
            DVec3::new(center.x, center.y, draw.sign()),
            DVec3::Z,
            DVec3::new(v2.x, v2.y, 0.0),
        ),
        6 => store(
            row,
            identity,
            DVec3::new(center.x, center.y, 0.0),
            DVec3::new(v1.x, v1.y, 0.0),
            DVec3::new(v2.x, v2.y, 0.0),
        ),
        // Below the horizon.
        7 => store(row, identity, DVec3::new(center.x, center.y, -4.0), v1, v2),
        // A singular and an extreme matrix.
        8 => {
            let (a, b) = (draw.direction(), draw.direction());
            let minv = if draw.sign() > 0.0 {
                DMat3::from_cols(v1, 0.5 * v1, a)
            } else {
                DMat3::from_cols(draw.log_uniform(1e-6, 1e6) * v1, draw.log_uniform(1e-6, 1e6) * a, b)
            };
            store(row, minv, center, v1, v2);
        }
        // One scale far from 1, which changes nothing; then mixed scales.
        9 => {
            let scale = libm::exp2(f64::from(draw.below(81)) - 40.0);
            store(row, identity, scale * center, scale * v1, scale * v2);
        }
        10 => row.fill_with(|| (draw.sign() * draw.log_uniform(1e-12, 1e12)) as f32),
        _ => {
            row.fill(0.0);
            for at in [MINV, MINV + 4, MINV + 8].into_iter().chain(CENTER..CENTER + 9) {
                row[at] = landmarks::near_landmark(draw);
            }
        }
    }
}

#[cfg(test)]
mod tests;
