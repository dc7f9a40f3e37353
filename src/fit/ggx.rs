//! Isotropic GGX microfacet reflection with height-correlated Smith masking (Walter et al. 2007; Heitz 2014).

use glam::DVec3;

use core::f64::consts::PI;

/// The smallest alpha that is fitted: below it the lobe is a mirror's, as in the published fit.
pub(super) const MIN_ALPHA: f64 = 1e-5;

/// GGX of one roughness seen from one direction, without its Fresnel factor. The viewer is in the xz plane.
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    alpha: f64,
    view: DVec3,
    /// sqrt(1 + alpha^2 tan^2) of the viewer, 1 + 2 Lambda.
    masking: f64,
}

/// The lobe in one direction.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    /// BRDF times cosine, 1/sr.
    pub value: f64,
    /// Density, 1/sr, with which [`Ggx::sample`] finds the direction; not zero below the horizon.
    pub density: f64,
}

impl Ggx {
    /// `roughness` = sqrt(alpha), 0..1, and the viewer's cosine, 0..1. As in the published fit alpha is at least 1e-5 and
    /// the viewer at most 1.57 rad off the normal.
    pub fn new(roughness: f64, cos_theta: f64) -> Self {
        let alpha = (roughness * roughness).max(MIN_ALPHA);
        let cos = cos_theta.max(libm::cos(1.57));
        let view = DVec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
        Ggx { alpha, view, masking: smith(alpha, cos) / cos }
    }

    /// Width of the distribution of slopes.
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Direction to the viewer.
    pub fn view(&self) -> DVec3 {
        self.view
    }

    /// BRDF times cosine, and sampling density, towards the unit vector `light`.
    ///
    /// With h = view + light, unnormalised: D = |h|^4 / (pi alpha^2 (hz^2 + (hx^2 + hy^2)/alpha^2)^2), which needs neither
    /// the normalised half vector nor slopes, and view . h = |h|^2/2.
    #[inline]
    pub fn eval(&self, light: DVec3) -> Value {
        let alpha2 = self.alpha * self.alpha;
        let h = self.view + light;
        let across = h.x * h.x + h.y * h.y;
        let h2 = across + h.z * h.z;
        let stretched = alpha2 * h.z * h.z + across;
        let distribution = alpha2 * h2 * h2 / (PI * stretched * stretched);
        let z = light.z;
        // G2/(1 + Lambda_v + Lambda_l) with both Lambdas over the same denominator; zero below the horizon.
        let shadowing = 2.0 * z / (self.masking * z + smith(self.alpha, z));
        let value = if z > 0.0 { distribution * shadowing / (4.0 * self.view.z) } else { 0.0 };
        Value { value, density: distribution * h.z.abs() / (2.0 * h2) }
    }

    /// The direction that mirrors the viewer at the micronormal of slopes alpha * (x, y).
    #[inline]
    pub fn sample(&self, x: f64, y: f64) -> DVec3 {
        self.mirror(DVec3::new(self.alpha * x, self.alpha * y, 1.0))
    }

    /// The direction that mirrors the viewer at a visible micronormal, and the share of its light that is not shadowed:
    /// BRDF times cosine over the density of such directions. With a uniform angle, given as (cosine, sine), and `rest`
    /// uniform in 0..1, normals are found as often as they are visible (Dupuy and Benyoub 2023).
    pub fn sample_visible(&self, (cos, sin): (f64, f64), rest: f64) -> (DVec3, f64) {
        let view = DVec3::new(self.alpha * self.view.x, 0.0, self.view.z).normalize();
        // The height of the point on the unit sphere's cap above -view, plus view's.
        let sum = rest * (1.0 + view.z);
        let z = sum - view.z;
        let r = (1.0 - z * z).max(0.0).sqrt();
        let cap = DVec3::new(r * cos + view.x, r * sin, sum);
        let light = self.mirror(DVec3::new(self.alpha * cap.x, self.alpha * cap.y, cap.z));
        // G2/G1 = (1 + Lambda_v)/(1 + Lambda_v + Lambda_l).
        let share = (1.0 + self.masking) * light.z / (self.masking * light.z + smith(self.alpha, light.z));
        (light, share.max(0.0))
    }

    /// The intervals of `rest`, as (start, length), in which [`Ggx::sample_visible`] finds light above the horizon.
    ///
    /// At 0 the normal is horizontal and light comes from below; between, it may rise and set more than once.
    pub fn lit(&self, angle: (f64, f64), intervals: &mut Vec<(f64, f64)>) {
        let above = |rest: f64| self.sample_visible(angle, rest).0.z > 0.0;
        intervals.clear();
        let (mut last, mut start) = (0.0, None);
        for step in -40..=40 {
            // Evenly in the logarithm at both ends, down to 1e-13: scales go down to alpha^2.
            let rest = 1.0 / (1.0 + libm::exp(-0.75 * f64::from(step)));
            if above(rest) != start.is_some() {
                let (mut low, mut high) = (last, rest);
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    if above(middle) == start.is_some() { low = middle } else { high = middle }
                }
                match start.take() {
                    None => start = Some(high),
                    Some(start) => intervals.push((start, high - start)),
                }
            }
            last = rest;
        }
        if let Some(start) = start {
            intervals.push((start, 1.0 - start));
        }
    }

    fn mirror(&self, normal: DVec3) -> DVec3 {
        let twice = 2.0 * normal.dot(self.view) / normal.length_squared();
        twice * normal - self.view
    }
}

/// cos * (1 + 2 Lambda): sqrt(cos^2 + alpha^2 sin^2).
#[inline]
fn smith(alpha: f64, cos: f64) -> f64 {
    let cos2 = cos * cos;
    (cos2 + alpha * alpha * (1.0 - cos2)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_textbook_form_agrees() {
        for (roughness, cos_theta) in [(1.0, 1.0), (0.7, 0.4), (0.3, 0.9), (0.5, 0.05)] {
            let ggx = Ggx::new(roughness, cos_theta);
            let (alpha, v) = (roughness * roughness, ggx.view());
            for (x, y) in [(0.0, 0.0), (0.3, 0.2), (-0.4, 0.8), (1.5, -0.1)] {
                let l = ggx.sample(x, y);
                assert!((l.length() - 1.0).abs() < 1e-14);
                let h = (v + l).normalize();
                let tan2 = |z: f64| (1.0 - z * z) / (z * z);
                let lambda = |z: f64| 0.5 * ((1.0 + alpha * alpha * tan2(z)).sqrt() - 1.0);
                let d =
                    1.0 / (PI * alpha * alpha * h.z.powi(4) * (1.0 + tan2(h.z) / (alpha * alpha)).powi(2));
                let density = (d * h.z / (4.0 * v.dot(h))).abs();
                let value = if l.z > 0.0 { d / (1.0 + lambda(v.z) + lambda(l.z)) / (4.0 * v.z) } else { 0.0 };
                let got = ggx.eval(l);
                // Some dozen roundings on either side.
                assert!((got.value - value).abs() <= 1e-13 * value, "{got:?} {value}");
                assert!((got.density - density).abs() <= 1e-13 * density, "{got:?} {density}");
            }
        }
    }

    #[test]
    fn reciprocal() {
        // f(v, l) = f(l, v): the value holds the light's cosine.
        let (a, b) = (Ggx::new(0.6, 0.8), Ggx::new(0.6, 0.3));
        let there = a.eval(b.view()).value / b.view().z;
        let back = b.eval(a.view()).value / a.view().z;
        assert!((there - back).abs() < 1e-14 * there);
    }
}
