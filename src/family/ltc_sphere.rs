//! Irradiance of a sphere light under a linearly transformed cosine, the horizon included.
//!
//! A sphere of centre c and radius r covers the directions of the cone with the dual quadric r^2 I - c c^T, rational in
//! the inputs, and Minv takes it to Minv (r^2 I - c c^T) Minv^T: `numeric::clipped_ellipse` does the rest. Its determinant
//! is -r^4 (|c|^2 - r^2) det(Minv)^2 with both factors rounded once.
//!
//! From inside or on the sphere every direction is lit: the answer is 1. A sphere without radius, a singular Minv and a
//! light below the horizon give exactly 0.

use glam::{DMat3, DVec3};

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Type};
use crate::numeric::ball::{Ball, Middle};
use crate::numeric::big;
use crate::numeric::clipped_ellipse::{Changes, Cone};
use crate::numeric::conjugate_cone::{self, ConjugateCone, Seen, Silhouette};
use crate::numeric::double_double::DoubleDouble;
use crate::numeric::graded_cone::{GradedCone, Irradiance, Known};
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::numeric::twofold::Twofold;
use crate::numeric::{exact, exact3};
use crate::sample::{Draw, ggx, landmarks};

pub(super) struct LtcSphere;

const MINV: usize = 0;
const CENTER: usize = 9;
const RADIUS: usize = 12;

impl Problem for LtcSphere {
    fn name(&self) -> &'static str {
        "ltc_sphere"
    }

    fn summary(&self) -> &'static str {
        "Irradiance of a sphere light under a linearly transformed cosine, clipped by the horizon"
    }

    fn inputs(&self) -> &'static [Field] {
        const {
            &[
                Field::new("minv", Type::Mat3),
                Field::new("center", Type::Vec3),
                Field::new("radius", Type::Float),
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
                summary: "spheres of 5 cm to 1 m up to 5 m away over a floor of GGX roughness 0.1 to 1, seen from 0 to 85 degrees",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.1, 1.0), draw.uniform(0.087, 1.0));
                    let direction = draw.direction();
                    let radius = draw.log_uniform(0.05, 1.0);
                    let center = (radius + draw.log_uniform(0.05, 5.0))
                        * DVec3::new(direction.x, direction.y, direction.z.abs());
                    store(row, minv, center, radius);
                },
            },
            Scenario {
                name: "diffuse",
                summary: "the same spheres under the plain cosine: their disks face the point up to rounding",
                draw: |draw, row| {
                    let direction = draw.direction();
                    let radius = draw.log_uniform(0.05, 1.0);
                    let center = (radius + draw.log_uniform(0.05, 5.0))
                        * DVec3::new(direction.x, direction.y, direction.z.abs());
                    store(row, DMat3::IDENTITY, center, radius);
                },
            },
            Scenario {
                name: "grazing",
                summary: "spheres over a floor of roughness 0.05 to 0.5 seen at cosines 1e-3 to 0.1",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.05, 0.5), draw.log_uniform(1e-3, 0.1));
                    let radius = draw.log_uniform(0.05, 1.0);
                    let height = radius + draw.uniform(0.0, 2.0);
                    let center = DVec3::new(draw.uniform(-8.0, 8.0), draw.uniform(-2.0, 2.0), height);
                    store(row, minv, center, radius);
                },
            },
            Scenario {
                name: "far",
                summary: "spheres 10 to 1e5 radii away, roughness 0.3 to 1",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.3, 1.0), draw.uniform(0.1, 1.0));
                    let radius = draw.log_uniform(0.01, 10.0);
                    let direction = draw.direction();
                    let center = radius
                        * draw.log_uniform(10.0, 1e5)
                        * DVec3::new(direction.x, direction.y, direction.z.abs());
                    store(row, minv, center, radius);
                },
            },
            Scenario {
                name: "near_surface",
                summary: "the point 1e-5 to 0.1 radii off the sphere, roughness 0.3 to 1",
                draw: |draw, row| {
                    let minv = ggx::minv(draw.uniform(0.3, 1.0), draw.uniform(0.1, 1.0));
                    let radius = draw.log_uniform(0.1, 10.0);
                    let center = radius * (1.0 + draw.log_uniform(1e-5, 0.1)) * draw.direction();
                    store(row, minv, center, radius);
                },
            },
            Scenario {
                name: "horizon",
                summary: "spheres that the floor cuts, plain cosine or roughness 0.2 to 1",
                draw: |draw, row| {
                    let minv = if draw.sign() < 0.0 {
                        DMat3::IDENTITY
                    } else {
                        ggx::minv(draw.uniform(0.2, 1.0), draw.uniform(0.1, 1.0))
                    };
                    let (cos, sin) = draw.angle();
                    let distance = draw.log_uniform(1.01, 30.0);
                    let height = draw.uniform(-1.0, 1.0);
                    let along = libm::sqrt(distance * distance - height * height);
                    store(row, minv, DVec3::new(along * cos, along * sin, height), 1.0);
                },
            },
            Scenario {
                name: "edge",
                summary: "from inside and on the surface, no radius, singular matrices, touching the horizon, any scale",
                draw: edge,
            },
        ]
    }

    fn landmarks(&self) -> &'static [Landmark] {
        &[
            Landmark {
                name: "distance",
                summary: "distance of the centre over the radius, before Minv",
                edges: &[1.0, 1.000_01, 1.001, 1.1, 2.0, 10.0, 1e2, 1e3, 1e4],
                coordinate: |input, _| {
                    exact3::vector(&input[CENTER..]).length() / f64::from(input[RADIUS]).abs()
                },
            },
            Landmark {
                name: "elevation",
                summary: "height of the centre over the reach of the sphere's image, after Minv; cut in -1..1",
                edges: &[-1.0, -0.99, -0.5, 0.0, 0.5, 0.99, 1.0, 1.01, 2.0, 10.0],
                coordinate: |input, _| {
                    let minv = exact3::columns(&input[MINV..]);
                    let row = DVec3::from_array(minv.map(|column| column.z));
                    let center = exact3::vector(&input[CENTER..]);
                    row.dot(center) / (row.length() * f64::from(input[RADIUS]).abs())
                },
            },
        ]
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let minv = exact3::columns(&input[MINV..]);
        let center = exact3::vector(&input[CENTER..]);
        let radius = f64::from(input[RADIUS]);
        let outside = exact::sum(&outside(center, radius));
        if radius == 0.0 {
            return truth.scalar(0, 0.0, 0.0, 0.0);
        }
        if outside <= 0.0 {
            let near = -outside < 8.0 * UNIT_ROUNDOFF * radius * radius;
            return truth.scalar(0, 1.0, 0.0, if near { f64::INFINITY } else { 0.0 });
        }

        let determinant = exact3::determinant(minv[0], minv[1], minv[2]);
        let unit = |largest: f64| libm::ldexp(1.0, -libm::frexp(largest).1);
        let (by_matrix, by_length) = (
            unit(minv.iter().fold(0.0, |m, c| c.abs().max_element().max(m))),
            unit(center.abs().max_element()),
        );
        let (m, c, r) = (minv.map(|column| column * by_matrix), center * by_length, radius * by_length);
        let (r2, cc) = (Twofold::product(r, r), exact3::square(&c.to_array().map(Twofold::from)));
        let own: [Twofold; 6] = std::array::from_fn(|i| if i < 3 { r2 - cc[i] } else { -cc[i] });
        let determinant = determinant * by_matrix * by_matrix * by_matrix;
        let minus_det = determinant * determinant * (r * r * r * r) * (outside * by_length * by_length);
        let matrix = DMat3::from_cols(m[0], m[1], m[2]);
        let towards = DVec3::from_array(exact3::transformed(&m, c).map(|component| component.value()));
        let cone = Cone { dual: exact3::congruence(&m, &own), minus_det, towards };
        let size = DMat3::from_cols(m[0].abs(), m[1].abs(), m[2].abs());
        let (of_center, of_radius) = (size * c.abs(), size * DVec3::splat(r));
        let terms = of_center * of_center + of_radius * of_radius;
        if determinant == 0.0 {
            let below = cone.dual[2].value() < 0.0 && cone.towards.z < 0.0;
            return truth.scalar(0, 0.0, 0.0, if below { 0.0 } else { f64::INFINITY });
        }
        let found = cone.irradiance(terms).and_then(|light| {
            let by_own = matrix.transpose() * light.gradient * matrix;
            let by_minv = 2.0 * light.gradient * matrix * exact3::symmetric(&own);
            let (mut of_minv, mut of_light) = (Changes::default(), Changes::default());
            (0..3).for_each(|k| of_minv.add(by_minv.col(k) * m[k]));
            of_light.add(-2.0 * (by_own * c) * c);
            let trace = by_own.x_axis.x + by_own.y_axis.y + by_own.z_axis.z;
            of_light.add(DVec3::new(2.0 * r * r * trace, 0.0, 0.0));
            Some((light, of_minv.size(of_light, light.off(terms))?))
        });
        let Some((light, sensitivity)) = found else {
            truth.escalate();
            if exact3::height(&minv, center) <= 0.0
                && exact::sum(level(&minv, center, radius).as_flattened()) <= 0.0
            {
                return truth.scalar(0, 0.0, 0.0, 0.0);
            }
            let known = Known::default()
                .or(|_| conjugate::<f64>(&minv, center, radius))
                .or(|_| conjugate::<DoubleDouble>(&minv, center, radius));
            let light = known.or_else(|known| graded(minv, center, radius, known));
            return truth.scalar(0, light.value, light.bound, light.sensitivity);
        };
        if light.escalated {
            truth.escalate();
        }
        truth.scalar(0, light.value, light.bound, sensitivity);
    }
}

/// What the square of the centre's distance less that of the radius adds up from.
fn outside(center: DVec3, radius: f64) -> [f64; 4] {
    let squares = center * center;
    [squares.x, squares.y, squares.z, -radius * radius]
}

/// What S_zz adds up from: the square of the sphere's reach less that of its centre's height.
fn level(minv: &[DVec3; 3], center: DVec3, radius: f64) -> [[f64; 12]; 4] {
    let up = minv.map(|column| column.z);
    let [x, y, z] = up.map(|up| exact3::square_of_sum(&[up * radius, 0.0, 0.0], 1.0));
    let height = [up[0] * center.x, up[1] * center.y, up[2] * center.z];
    [x, y, z, exact3::square_of_sum(&height, -1.0)]
}

/// The same in the silhouette's own frame.
fn conjugate<M: Middle>(minv: &[DVec3; 3], center: DVec3, radius: f64) -> Option<Known> {
    let outside = Ball::<M>::sum(&outside(center, radius), 0.0);
    let silhouette = Silhouette::new(center, radius, outside);
    let square = silhouette.distance * silhouette.distance;
    // The disk's dual quadric is so many times the sphere's.
    let scale = square / outside;
    let szz = Ball::sum(level(minv, center, radius).as_flattened(), 0.0) * scale;
    let seen = ConjugateCone::of_sphere(minv, &silhouette, szz).irradiance()?;
    let known = |seen: &Seen<M>| known(seen, &silhouette, scale, minv, radius);
    Some(known(&seen).or(|found| Some(known(&seen.by_lines(found)?))))
}

/// What that tells of the irradiance and of its changes; `scale` is the disk's dual quadric over the sphere's.
fn known<M: Middle>(
    seen: &Seen<M>,
    silhouette: &Silhouette<M>,
    scale: Ball<M>,
    minv: &[DVec3; 3],
    radius: f64,
) -> Known {
    let Silhouette { center: c, distance, radius: of_disk, across: [u1, u2] } = *silhouette;
    let square = distance * distance;
    let [of_center, of_1, of_2] = seen.images;
    let by_center = seen.by(&of_center);
    let (by_square, by_radius) = (Ball::ONE / square, Ball::ONE / of_disk);
    let r2 = Ball::exact(radius) * Ball::exact(radius);
    let (mut sum, mut trace) = (Ball::ZERO, Ball::ZERO);
    for j in 0..3 {
        // The column in the principal frame, and what of the sphere's images belongs to it.
        let column = [0, 1, 2]
            .map(|i| of_center[i] * c[j] * by_square + (of_1[i] * u1[j] + of_2[i] * u2[j]) * by_radius);
        let own = [0, 1, 2].map(|i| r2 * column[i] - of_center[i] * c[j]);
        let by_column = seen.in_world(&seen.by(&own));
        for (entry, by_entry) in conjugate_cone::vector(minv[j]).iter().zip(by_column) {
            sum = sum + (*entry * by_entry).abs();
        }
        trace = trace + conjugate_cone::dot(&column, &seen.by(&column));
        sum = sum + (c[j] * conjugate_cone::dot(&column, &by_center)).abs();
    }
    sum = sum + (r2 * trace).abs();
    seen.with_sensitivity((sum << 1) * scale)
}

/// The same in any precision.
fn graded(minv: [DVec3; 3], center: DVec3, radius: f64, known: Known) -> Irradiance {
    let (c, r) = (big::vector(center), big::exact(radius));
    let r2 = &r * &r;
    let cc = big::square(&c);
    let own = std::array::from_fn(|i| if i < 3 { &r2 - &cc[i] } else { -&cc[i] });
    GradedCone { minv, own, center }.irradiance(known, |by_own| {
        let trace = &by_own[0] + &by_own[1] + &by_own[2];
        big::moved(by_own, &c) + big::abs((trace << 1) * &r2)
    })
}

fn store(row: &mut [f32], minv: DMat3, center: DVec3, radius: f64) {
    let values = [minv.to_cols_array().as_slice(), &center.to_array(), &[radius]].concat();
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let identity = DMat3::IDENTITY;
    let kind = draw.below(9);
    let direction = draw.direction();
    let (a, b) = (draw.direction(), draw.direction());
    match kind {
        // Inside, exactly on the surface (a Pythagorean centre), no radius, no sphere at all.
        0 => store(row, identity, draw.unit() * direction, 1.0),
        1 => store(row, identity, draw.sign() * DVec3::new(2.0, 3.0, 6.0), 7.0),
        2 => store(row, identity, direction, 0.0),
        3 => store(row, identity, DVec3::ZERO, if draw.sign() > 0.0 { 1.0 } else { 0.0 }),
        // Touching the horizon from above and from below.
        4 => store(row, identity, DVec3::new(4.0 * direction.x, 4.0 * direction.y, draw.sign()), 1.0),
        5 => store(row, DMat3::from_cols(a, a, b), 2.0 * direction, 1.0),
        6 => {
            let scale = libm::exp2(f64::from(draw.below(81)) - 40.0);
            store(row, identity, 2.0 * scale * direction, scale);
        }
        7 => {
            let minv = DMat3::from_cols(
                draw.log_uniform(1e-4, 1e4) * a,
                draw.log_uniform(1e-4, 1e4) * b,
                draw.log_uniform(1e-4, 1e4) * DVec3::Z,
            );
            store(row, minv, draw.log_uniform(1.0, 1e3) * direction, 1.0);
        }
        _ => {
            row.fill(0.0);
            for at in [MINV, MINV + 4, MINV + 8, CENTER, CENTER + 1, CENTER + 2, RADIUS] {
                row[at] = landmarks::near_landmark(draw);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::problem::CERTIFIED;
    use crate::numeric::graded_cone::Agreement;
    use crate::sample::Stream;

    fn truth_of(input: &[f32]) -> Truth {
        let mut truth = Truth::new(LtcSphere.outputs());
        LtcSphere.oracle(input, &mut truth);
        truth
    }

    /// A centre straight above, whose height is what 2^-60 leaves of its terms: quadrature with 50 digits.
    #[test]
    fn heights_that_cancel_have_their_sign() {
        let tiny = |exponent: i32| libm::ldexp(1.0, exponent) as f32;
        let row = [0.0, 1.0, 1.0, 1.0, -tiny(-61), 1.0, 1.0, tiny(-61), 1.0, tiny(-60), 1.0, -1.0, tiny(-61)];
        let truth = truth_of(&row);
        assert!((truth.values()[0] - 0.385_618).abs() < 1e-6, "{truth:?}");
    }

    /// f64's axes, which are off by a rounding of their length, would say 9.332e-4 of these changes: difference quotients of the closed
    /// form with 1500 digits.
    #[test]
    fn rounded_axes_do_not_count_as_known() {
        let row = [
            8.538447e-29,
            -2183765.3,
            -51420.08,
            -1.7133418e18,
            0.0,
            2.2288472e18,
            0.0,
            -3.7017914e-17,
            -732958850.0,
            4.6194377e-35,
            0.0,
            -3e-45,
            -2.12469e-40,
        ];
        let truth = truth_of(&row);
        assert!((truth.values()[0] / 2.333_027_542_690_409e-4 - 1.0).abs() < 1e-12, "{truth:?}");
        assert!((truth.sensitivities()[0] / 1.039_863_581_43e-3 - 1.0).abs() < 0.01, "{truth:?}");
    }

    #[test]
    fn every_truth_is_certified_and_a_share() {
        for scenario in LtcSphere.scenarios() {
            let mut lit = 0;
            Stream::new(11, scenario.name).visit(0, 20_000, |_, draw| {
                let mut row = [0.0; 13];
                (scenario.draw)(draw, &mut row);
                let truth = truth_of(&row);
                assert!(row.iter().all(|v| v.is_finite()), "{row:?}");
                assert!(truth.worst_bound() <= CERTIFIED, "{row:?}: {truth:?}");
                assert!((0.0..=1.0).contains(&truth.values()[0]), "{row:?}: {truth:?}");
                assert!(truth.sensitivities()[0] >= 0.0, "{row:?}: {truth:?}");
                lit += u32::from(truth.values()[0] > 0.0);
            });
            assert!(lit > 5_000, "{}: {lit}", scenario.name);
        }
    }

    /// Under the plain cosine the clipped sphere has a closed form of its own.
    #[test]
    fn agrees_with_the_clipped_sphere() {
        let scenario = LtcSphere.scenario("diffuse").unwrap();
        let mut cut = 0;
        Stream::new(3, scenario.name).visit(0, 5_000, |_, draw| {
            let mut row = [0.0; 13];
            (scenario.draw)(draw, &mut row);
            let center = exact3::vector(&row[CENTER..]);
            let radius = f64::from(row[RADIUS]);
            let (z, s) = (center.z / center.length(), radius * radius / center.length_squared());
            let expected = if z * z >= s {
                z.max(0.0) * s
            } else {
                cut += 1;
                let (g, c) = (libm::sqrt(s - z * z), libm::sqrt(1.0 - s));
                (z * s * libm::atan2(g, -z * c) - c * g + libm::atan2(g, c)) / core::f64::consts::PI
            };
            let value = truth_of(&row).values()[0];
            assert!((value - expected).abs() < 1e-14, "{row:?}: {value} for {expected}");
        });
        assert!(cut > 500, "{cut}");
    }

    fn compare(agreement: &mut Agreement, row: &[f32]) {
        let truth = truth_of(row);
        let value = truth.values()[0];
        // Of no size, or looked at from within.
        if row[RADIUS] == 0.0 || value == 1.0 {
            return;
        }
        let center = exact3::vector(&row[CENTER..]);
        let exact = graded(exact3::columns(&row[MINV..]), center, f64::from(row[RADIUS]), Known::default());
        agreement.add(value, truth.sensitivities()[0], 0.0, exact, row);
    }

    /// f64 with its tests against any precision.
    #[test]
    fn both_arithmetics_agree() {
        for scenario in LtcSphere.scenarios() {
            let mut agreement = Agreement::default();
            Stream::new(4, scenario.name).visit(0, 400, |_, draw| {
                let mut row = [0.0; 13];
                (scenario.draw)(draw, &mut row);
                compare(&mut agreement, &row);
            });
            agreement.check(scenario.name);
        }
    }

    /// Where determinants leave the range of f64, and far from it.
    #[test]
    fn no_exponents_are_too_large_or_small() {
        let mut agreement = Agreement::default();
        Stream::new(12, "exponents").visit(0, 2_000, |_, draw| {
            let row: [f32; 13] = std::array::from_fn(|_| landmarks::any_exponent(draw));
            compare(&mut agreement, &row);
        });
        agreement.check("exponents");
    }

    #[test]
    fn sensitivities_cover_real_changes() {
        for name in ["ggx", "far", "horizon", "near_surface"] {
            let mut worst: f64 = 0.0;
            let scenario = LtcSphere.scenario(name).unwrap();
            Stream::new(5, "sensitivity").visit(0, 3_000, |_, draw| {
                let mut row = [0.0; 13];
                (scenario.draw)(draw, &mut row);
                let before = truth_of(&row);
                let step = 2f64.powi(-18);
                let changed: Vec<f32> =
                    row.iter().map(|v| (f64::from(*v) * (1.0 + draw.sign() * step)) as f32).collect();
                let change = (truth_of(&changed).values()[0] - before.values()[0]).abs() / step;
                let sensitivity = before.sensitivities()[0];
                let off = exact3::vector(&row[CENTER..]).length() / f64::from(row[RADIUS]) - 1.0;
                // First order only: not where the answer or the height over the surface changes by a twentieth.
                if sensitivity * step < 0.05 * before.values()[0] && off > 80.0 * step {
                    worst = worst.max(change / sensitivity);
                }
            });
            // 1.15: second order at this step, and the rim's quadrature. 0.3: all signs at their worst are rare.
            assert!((0.3..=1.15).contains(&worst), "{name}: {worst}");
        }
    }
}
