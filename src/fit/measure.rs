//! How far a transformed cosine is from a GGX lobe, and the moments of that lobe.

use glam::DVec3;

use super::ggx::Ggx;
use super::ltc::Ltc;

use core::f64::consts::{PI, TAU};

/// Strata a side of the error's sample sets, as published.
const ERROR_STRATA: usize = 32;

/// Angles of a whole turn, and heights at each, where the moments are evaluated. Magnitudes are then within 1e-5, or
/// 5e-4 where smooth surfaces are seen at grazing angles (cosine below 0.3).
const MOMENT_NODES: (usize, usize) = (64, 32);

/// Midpoints of the strata of a square, mapped to slopes and to cosine directions.
///
/// Both lobes are symmetric in y, and so are the strata in their angle: only those with y > 0 are kept, which gives the
/// same sums at half the cost.
#[derive(Clone, Debug)]
pub struct Strata {
    /// Slopes, in units of alpha, of GGX-distributed micronormals.
    slopes: Vec<(f64, f64)>,
    /// Cosine-distributed directions.
    cosines: Vec<DVec3>,
    /// Cosine and sine of angles of half a turn.
    angles: Vec<(f64, f64)>,
    /// Nodes and weights on (0, 1).
    heights: Vec<(f64, f64)>,
}

/// What a lobe integrates to.
#[derive(Clone, Copy, Debug)]
pub struct Moments {
    /// Directional albedo without Fresnel.
    pub magnitude: f64,
    /// The same, each direction weighted with Schlick's (1 - cos)^5.
    pub fresnel: f64,
    /// Unit vector along the value-weighted mean direction, in the xz plane.
    pub axis: DVec3,
}

/// The distance between two lobes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The published measure: the integral of |GGX - LTC|^3 over directions, sr^-2. It grows as alpha^-4.
    pub error: f64,
    /// L3 norm of the difference over that of GGX, the same estimate for both: comparable between roughnesses.
    pub relative: f64,
}

impl Default for Strata {
    fn default() -> Self {
        Strata::new(ERROR_STRATA, MOMENT_NODES)
    }
}

impl Strata {
    /// `error` strata a side, a multiple of 4; for the moments an even number of angles, and of heights.
    pub fn new(error: usize, (angles, heights): (usize, usize)) -> Self {
        let mut cosines = Vec::new();
        midpoints(error, |(cos, sin), u| {
            // The height of a uniform point on the unit disk's hemisphere.
            let (z, r) = (libm::sqrt(u), libm::sqrt(1.0 - u));
            cosines.push(DVec3::new(r * cos, r * sin, z));
        });
        let mut slopes = Vec::new();
        midpoints(error, |(cos, sin), u| {
            let r = libm::sqrt(u / (1.0 - u));
            slopes.push((r * cos, r * sin));
        });
        let angles = (0..angles / 2)
            .map(|angle| {
                let (sin, cos) = libm::sincos(TAU * (angle as f64 + 0.5) / angles as f64);
                (cos, sin)
            })
            .collect();
        Strata { slopes, cosines, angles, heights: double_exponential(heights) }
    }

    /// Magnitude, Fresnel term and mean direction of a lobe.
    ///
    /// Where published samples of the normals' distribution leave magnitudes wrong by up to 7 %, this integrates over
    /// those visible normals that mirror the viewer above the horizon: by the tanh-sinh rule in height, evenly in angle.
    pub fn moments(&self, ggx: &Ggx) -> Moments {
        let (mut magnitude, mut fresnel, mut sum) = (0.0, 0.0, DVec3::ZERO);
        let mut lit = Vec::new();
        for &angle in &self.angles {
            ggx.lit(angle, &mut lit);
            for &(start, length) in &lit {
                for &(node, weight) in &self.heights {
                    let (light, share) = ggx.sample_visible(angle, start + length * node);
                    let share = share * weight * length / self.angles.len() as f64;
                    let rest = 1.0 - (ggx.view() + light).normalize().dot(ggx.view());
                    magnitude += share;
                    fresnel += share * (rest * rest) * (rest * rest) * rest;
                    sum += share * light;
                }
            }
        }
        Moments { magnitude, fresnel, axis: DVec3::new(sum.x, 0.0, sum.z).normalize() }
    }

    /// What of the error does not depend on the LTC.
    pub fn target(&self, ggx: Ggx) -> Target<'_> {
        let samples = self
            .slopes
            .iter()
            .map(|&(x, y)| {
                let light = ggx.sample(x, y);
                let value = ggx.eval(light);
                Sample { light, value: value.value, density: value.density }
            })
            .collect();
        Target { ggx, samples, cosines: &self.cosines }
    }
}

/// Nodes and weights of the tanh-sinh rule on (0, 1): the horizon's shadow starts at one end, within alpha of it.
fn double_exponential(count: usize) -> Vec<(f64, f64)> {
    // At 3 the nodes are 2e-14 from the ends.
    let step = 6.0 / count as f64;
    let node = |index: usize| {
        let t = (index as f64 + 0.5) * step - 3.0;
        let x = PI * libm::sinh(t);
        let node = 1.0 / (1.0 + libm::exp(-x));
        (node, step * PI * libm::cosh(t) * node / (1.0 + libm::exp(x)))
    };
    (0..count).map(node).collect()
}

/// Visits (cosine, sine) of the angle and the other coordinate of each midpoint in the half with positive sine.
fn midpoints(strata: usize, mut visit: impl FnMut((f64, f64), f64)) {
    let midpoint = |index: usize| (index as f64 + 0.5) / strata as f64;
    for angle in 0..strata / 2 {
        let (sin, cos) = libm::sincos(TAU * midpoint(angle));
        for other in 0..strata {
            visit((cos, sin), midpoint(other));
        }
    }
}

/// A GGX lobe, ready to be compared with many LTCs.
#[derive(Clone, Debug)]
pub struct Target<'a> {
    ggx: Ggx,
    samples: Vec<Sample>,
    cosines: &'a [DVec3],
}

#[derive(Clone, Copy, Debug)]
struct Sample {
    light: DVec3,
    value: f64,
    density: f64,
}

/// Partial sums, so that additions need not wait for each other; the order is fixed.
const LANES: usize = 8;

impl Target<'_> {
    /// The lobe.
    pub fn ggx(&self) -> &Ggx {
        &self.ggx
    }

    /// The published measure, multiple importance sampling with the balance heuristic over both sample sets.
    pub fn error(&self, ltc: &Ltc) -> f64 {
        self.sum(ltc, |difference, _| difference)
    }

    /// The measure in both its forms.
    pub fn residual(&self, ltc: &Ltc) -> Residual {
        let error = self.error(ltc);
        let norm = self.sum(ltc, |_, ggx| ggx);
        Residual { error, relative: libm::cbrt(error / norm) }
    }

    fn sum(&self, ltc: &Ltc, of: impl Fn(f64, f64) -> f64) -> f64 {
        let per_magnitude = 1.0 / ltc.magnitude();
        let term = |ltc_value: f64, value: f64, density: f64| {
            let x = of((value - ltc_value).abs(), value);
            x * x * x / (ltc_value * per_magnitude + density)
        };
        let mut sums = [0.0; LANES];
        for cosines in self.cosines.chunks_exact(LANES) {
            for (sum, cosine) in sums.iter_mut().zip(cosines) {
                let (light, ltc_value) = ltc.transform(*cosine);
                let ggx = self.ggx.eval(light);
                *sum += term(ltc_value, ggx.value, ggx.density);
            }
        }
        for samples in self.samples.chunks_exact(LANES) {
            for (sum, sample) in sums.iter_mut().zip(samples) {
                *sum += term(ltc.eval(sample.light), sample.value, sample.density);
            }
        }
        sums.iter().sum::<f64>() / self.samples.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::ggx::{cos_theta, table};

    /// The integral over the sphere of a function symmetric in y, by midpoints in the azimuth and the root of the height:
    /// at the horizon shadows are as narrow as the viewer's cosine.
    fn sphere(nodes: usize, of: impl Fn(DVec3) -> f64) -> f64 {
        let mut sum = 0.0;
        for i in 0..nodes {
            let t = (i as f64 + 0.5) / nodes as f64;
            let z = t * t;
            let r = (1.0 - z * z).sqrt();
            for j in 0..nodes {
                let (sin, cos) = (PI * (j as f64 + 0.5) / nodes as f64).sin_cos();
                let weight = 2.0 * t * TAU / (nodes * nodes) as f64;
                sum += weight * of(DVec3::new(r * cos, r * sin, z));
                sum += weight * of(DVec3::new(r * cos, r * sin, -z));
            }
        }
        sum
    }

    fn cell(roughness: usize, angle: usize) -> (Ggx, Ltc) {
        let ggx = Ggx::new(roughness as f64 / 63.0, cos_theta(angle, 64));
        let cell = table().cells()[64 * roughness + angle];
        (ggx, Ltc::new(cell.matrix().inverse(), f64::from(cell.magnitude)))
    }

    #[test]
    fn the_table_s_lobes_integrate_to_their_magnitudes() {
        for (roughness, angle) in [(63, 0), (63, 63), (50, 30), (40, 63), (30, 10), (25, 50)] {
            let (_, ltc) = cell(roughness, angle);
            let integral = sphere(600, |light| ltc.eval(light)) / ltc.magnitude();
            // 1e-3: the kink where the lobe ends, and peaks of some ten nodes.
            assert!((integral - 1.0).abs() < 1e-3, "{roughness} {angle}: {integral}");
        }
    }

    #[test]
    fn the_table_s_magnitudes_are_white_furnace_albedos() {
        for (roughness, angle) in
            [(63, 0), (63, 30), (63, 63), (50, 40), (45, 63), (40, 0), (32, 20), (32, 55)]
        {
            let (ggx, _) = cell(roughness, angle);
            let cell = table().cells()[64 * roughness + angle];
            let magnitude = sphere(1000, |light| ggx.eval(light).value);
            let fresnel = sphere(1000, |light| {
                let cos = (ggx.view() + light).normalize().dot(ggx.view());
                ggx.eval(light).value * (1.0 - cos).powi(5)
            });
            // 5e-4 is what the table's own quadrature may be off at grazing angles; this one is ten times better.
            assert!((f64::from(cell.magnitude) - magnitude).abs() < 5e-4, "{roughness} {angle} {magnitude}");
            assert!((f64::from(cell.fresnel) - fresnel).abs() < 5e-4, "{roughness} {angle} {fresnel}");
        }
    }

    #[test]
    fn moments_have_converged() {
        let (usual, finer) = (Strata::default(), Strata::new(4, (256, 64)));
        for roughness in [0, 1, 4, 9, 20, 40, 63] {
            for angle in [0, 10, 30, 50, 60, 63] {
                let ggx = Ggx::new(f64::from(roughness) / 63.0, cos_theta(angle, 64));
                let (one, other) = (usual.moments(&ggx), finer.moments(&ggx));
                let bound = if ggx.view().z >= 0.3 { 1e-5 } else { 5e-4 };
                assert!(
                    (one.magnitude - other.magnitude).abs() < bound,
                    "{roughness} {angle} {one:?} {other:?}"
                );
                assert!((one.fresnel - other.fresnel).abs() < 5e-4, "{roughness} {angle} {one:?} {other:?}");
            }
        }
    }

    #[test]
    fn the_measure_is_the_integral_it_stands_for() {
        let strata = Strata::default();
        for (roughness, angle) in [(60, 10), (45, 30), (35, 20)] {
            let (ggx, ltc) = cell(roughness, angle);
            let residual = strata.target(ggx).residual(&ltc);
            let error = sphere(800, |l| (ggx.eval(l).value - ltc.eval(l)).abs().powi(3));
            let norm = sphere(800, |l| ggx.eval(l).value.powi(3));
            // The strata are 32 a side: a few per cent on the cubed difference.
            assert!(
                (residual.error / error - 1.0).abs() < 0.05,
                "{roughness} {angle} {residual:?} {error:e}"
            );
            let relative = (error / norm).cbrt();
            assert!((residual.relative / relative - 1.0).abs() < 0.03, "{residual:?} {relative}");
        }
    }

    #[test]
    fn a_lobe_is_at_no_distance_from_its_own_samples() {
        let (_, ltc) = cell(40, 30);
        for cosine in &Strata::default().cosines {
            let (light, value) = ltc.transform(*cosine);
            assert!((light.length() - 1.0).abs() < 1e-14);
            assert!((ltc.eval(light) - value).abs() < 1e-12 * value, "{cosine}");
        }
    }
}
