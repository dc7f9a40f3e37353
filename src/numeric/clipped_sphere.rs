//! Irradiance of a sphere that the horizon cuts, without cancellation.
//!
//! A uniform sphere of half angle sigma is seen in a direction whose cosine with the normal is c. With s = sin^2 sigma,
//! its irradiance (the full hemisphere's being 1) is 0 for c <= -sin sigma, c s for c >= sin sigma, and between
//!
//! ```text
//! pi E = c s psi + atan(r/C) - C r       r = sqrt(s - c^2), C = cos sigma, psi = atan2(r, -C c)
//! ```
//!
//! (J. M. Snyder, Area Light Sources for Real-Time Graphics, 1996, with the angles eliminated). The three terms cancel
//! for small spheres and near the rim. With t = r/C and p = t/|c|, whose arc tangents are half the angles under which
//! the visible part of the rim is seen, and g(x) = atan x - x/(1 + x^2), they regroup into
//!
//! ```text
//! E = max(c, 0) s + G        pi G = g(t) - |c| s g(p) >= 0
//! ```
//!
//! where G is what lies beyond the horizon: the clipped part, for c >= 0, or all that is seen, for c < 0. What still
//! cancels in pi G is written in three ways, none of which loses more than a factor of 50:
//!
//! ```text
//! p < 1/2:        |c|^3 C^2 sum over k >= 2 of (-1)^k 2/(4 k^2 - 1) (1 + c^2 + ... + c^(2k-4)) p^(2k+1)
//! |c| < 1/2:      g(t) - |c| s g(p)
//! otherwise:      (1 - |c| s) g(p) - (g(p) - g(t)), the second difference by those of its terms
//! ```

use super::spacing::EPS;

use std::f64::consts::FRAC_1_PI;

/// Irradiance and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClippedSphere {
    /// Irradiance, 0..1.
    pub irradiance: f64,
    /// Absolute error bound of the irradiance.
    pub bound: f64,
    /// dE/dc.
    pub by_cosine: f64,
    /// dE/ds; infinite at s = 1 where the horizon cuts the sphere.
    pub by_sin2: f64,
}

/// The sphere of cosine `c` in -1..=1 and squared sine of the half angle `s` in 0..=1; values outside count as the
/// nearer end.
///
/// Domain: c and s f32 values, or f64 ones of at most 26 significant bits, so that c^2 is exact: then every difference
/// below is of exact terms, and the relative error is at most 1e-13, exactly 0 where nothing is seen, and none where
/// the horizon cuts nothing. Other f64 values: as good, but within some EPS of c^2 = s.
pub fn clipped_sphere(c: f64, s: f64) -> ClippedSphere {
    let (c, s) = (c.clamp(-1.0, 1.0), s.clamp(0.0, 1.0));
    let a = c.abs();
    // The sign of a difference of two f64 is exact.
    let r2 = s - c * c;
    if r2 <= 0.0 {
        let (c, s) = if c > 0.0 { (c, s) } else { (0.0, 0.0) };
        return ClippedSphere { irradiance: c * s, bound: 0.0, by_cosine: s, by_sin2: c };
    }
    let cos2 = 1.0 - s;
    let (r, cos) = (r2.sqrt(), cos2.sqrt());
    // 1 - c^2 = C^2 + r^2, from its factors.
    let q2 = (1.0 - a) * (1.0 + a);
    let (beyond, beyond_bound) = beyond_horizon(a, s, r, cos, q2);
    let irradiance = if c > 0.0 { c * s + beyond } else { beyond };
    let psi = r.atan2(-cos * c);
    ClippedSphere {
        irradiance,
        bound: beyond_bound + EPS * irradiance,
        by_cosine: FRAC_1_PI * (s * psi + cos * c * r / q2),
        by_sin2: FRAC_1_PI * (c * psi + r / cos),
    }
}

/// G of the module's formulas and its error bound, for 0 <= a = |c| < sin sigma, r > 0.
///
/// Each operand is good to a few EPS, and each bound counts 64 of them on the terms of its sum.
fn beyond_horizon(a: f64, s: f64, r: f64, cos: f64, q2: f64) -> (f64, f64) {
    let cos2 = cos * cos;
    // tan and sin-cos product of the two angles: x = tangent/(1 + tangent^2) needs no quotient that overflows.
    let g_t = arc_excess(r, cos, r * cos / q2);
    if r < 0.5 * cos * a {
        let p = r / (cos * a);
        let sum = rim_series(p, a * a);
        let value = a * a * a * cos2 * p.powi(5) * sum * FRAC_1_PI;
        return (value, 64.0 * EPS * value);
    }
    let g_p = arc_excess(r, cos * a, r * cos * a / (s * q2));
    if a < 0.5 {
        let subtracted = a * s * g_p;
        return (FRAC_1_PI * (g_t - subtracted), FRAC_1_PI * 64.0 * EPS * (g_t + subtracted));
    }
    let d = 1.0 - a;
    // 1 - a s, atan p - atan t, and p/(1 + p^2) - t/(1 + t^2), none of which subtracts anything but exact terms and
    // C^2 a - r^2, whose factor is smaller than the rest.
    let share = d + a * (1.0 - s);
    let angles = (r * d * cos).atan2(cos2 * a + r * r);
    let products = r * cos * (cos2 * a - r * r) / (s * (1.0 + a) * (1.0 + a) * d);
    let value = share * g_p - (angles - products);
    let size = share * g_p + angles + r * cos * (cos2 * a + r * r) / (s * (1.0 + a) * (1.0 + a) * d);
    (FRAC_1_PI * value, FRAC_1_PI * 64.0 * EPS * size)
}

/// g = atan x - x/(1 + x^2) of x = y/w >= 0, where `product` is x/(1 + x^2): relative error below 64 EPS.
fn arc_excess(y: f64, w: f64, product: f64) -> f64 {
    if y < 0.5 * w {
        // Sum of (-1)^(k+1) 2k/(2k+1) x^(2k+1): 28 terms leave less than 2^-56 of it at x = 1/2.
        let x = y / w;
        let z = x * x;
        let mut sum = 0.0;
        for k in (1..=28).rev() {
            let k = f64::from(k);
            sum = 2.0 * k / (2.0 * k + 1.0) - z * sum;
        }
        return x * z * sum;
    }
    y.atan2(w) - product
}

/// The sum over k >= 2 of (-1)^k 2/(4 k^2 - 1) (1 + z + ... + z^(k-2)) p^(2k-4), for p < 1/2 and z = c^2 in 0..1.
fn rim_series(p: f64, z: f64) -> f64 {
    let p2 = p * p;
    // Terms fall by a factor of 4 (k - 1)/(k - 2) or better: 32 of them leave less than 2^-56 of the first.
    let (mut power, mut geometric, mut sum) = (1.0, 1.0, 0.0);
    for k in 2..34 {
        let k = f64::from(k);
        sum += 2.0 / (4.0 * k * k - 1.0) * geometric * power;
        power *= -p2;
        geometric = 1.0 + z * geometric;
    }
    sum
}

/// The horizon-clipped sphere's irradiance over its form factor, row-major on a `side` x `side` grid: column i has the
/// cosine 2 i/(side - 1) - 1, row j the form factor s = j/(side - 1), the length of the sphere's vector irradiance.
/// Row 0 holds the limit max(c, 0).
///
/// Indexed as in E. Heitz and S. Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, 2017.
pub fn table_by_form_factor(side: usize) -> Vec<f32> {
    table(side, |v| v)
}

/// The same with the solid angle over the hemisphere's, 1 - cos sigma = j/(side - 1), for row j.
///
/// E/s has a root of 1 - s in it, which no table in s follows near s = 1; in cos sigma it is smooth. Bilinear
/// interpolation of 64 x 64 texels is off by at most 1.4e-3, where in s it is by 2.0e-2.
pub fn table_by_solid_angle(side: usize) -> Vec<f32> {
    table(side, |v| v * (2.0 - v))
}

/// Row j/(side - 1) = v has the form factor `sin2(v)`.
fn table(side: usize, sin2: impl Fn(f64) -> f64) -> Vec<f32> {
    let last = (side - 1) as f64;
    let mut texels = Vec::with_capacity(side * side);
    for j in 0..side {
        let s = sin2(j as f64 / last);
        for i in 0..side {
            let c = 2.0 * i as f64 / last - 1.0;
            let ratio = if j == 0 { c.max(0.0) } else { clipped_sphere(c, s).irradiance / s };
            texels.push(ratio as f32);
        }
    }
    texels
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The irradiance as an integral over polar angles about the sphere's direction, of which the azimuths are done:
    /// midpoint rule in a variable whose Jacobian flattens both ends.
    fn by_quadrature(c: f64, s: f64, steps: u32) -> f64 {
        let (sigma, q) = (s.sqrt().asin(), (1.0 - c * c).sqrt());
        let inner = |alpha: f64| {
            let (sin, cos) = alpha.sin_cos();
            let azimuth = (-c * cos / (q * sin)).clamp(-1.0, 1.0).acos();
            2.0 * (c * cos * azimuth + q * sin * azimuth.sin()) * sin
        };
        // Kinks where the horizon begins and ends to cut: at |pi/2 - theta|.
        let kink = c.abs().asin().min(sigma);
        let mut sum = 0.0;
        for (from, to) in [(0.0, kink), (kink, sigma)].into_iter().filter(|(from, to)| from < to) {
            let h = 1.0 / f64::from(steps);
            for step in 0..steps {
                let u = (f64::from(step) + 0.5) * h;
                let x = u * u * (3.0 - 2.0 * u);
                sum += inner(from + (to - from) * x) * (to - from) * 6.0 * u * (1.0 - u) * h;
            }
        }
        sum * FRAC_1_PI
    }

    #[test]
    fn agrees_with_quadrature() {
        for c in [-0.97, -0.7, -0.31, -0.05, 0.0, 1e-3, 0.2, 0.55, 0.9] {
            for s in [1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.95, 0.999] {
                let (got, expected) = (clipped_sphere(c, s).irradiance, by_quadrature(c, s, 4000));
                // The midpoint rule with 4000 steps is good to about 1e-8 of the sphere's own irradiance.
                assert!((got - expected).abs() < 3e-8 * s, "{c} {s}: {got} for {expected}");
            }
        }
    }

    #[test]
    fn ends_are_exact() {
        assert_eq!(clipped_sphere(1.0, 1.0).irradiance, 1.0);
        assert_eq!(clipped_sphere(0.5, 0.25).irradiance, 0.125);
        assert_eq!(clipped_sphere(-0.5, 0.25).irradiance, 0.0);
        assert_eq!(clipped_sphere(0.3, 0.0).irradiance, 0.0);
        assert_eq!(clipped_sphere(1.5, 2.0).irradiance, 1.0);
        // Half of a hemisphere, whose normal lies in the horizon.
        assert!((clipped_sphere(0.0, 1.0).irradiance - 0.5).abs() < 1e-16);
    }

    /// The sphere of half angle pi/2 is a tilted hemisphere: (1 + c)/2.
    #[test]
    fn a_hemisphere_is_linear_in_its_cosine() {
        for bits in [0u32, 1, 0x3300_0000, 0x3f00_0000, 0x3f7f_ffff, 0x3f7f_fff0, 0x3f7f_0000] {
            let c = f64::from(f32::from_bits(bits));
            for c in [c, -c] {
                let expected = 0.5 * (1.0 + c);
                let got = clipped_sphere(c, 1.0);
                assert!((got.irradiance - expected).abs() <= 1e-14 * expected, "{c}: {got:?}");
                assert!((got.irradiance - expected).abs() <= got.bound, "{c}: {got:?}");
            }
        }
    }

    proptest! {
        /// E(c) - E(-c) = c s: the two sides of the horizon together see the whole sphere.
        #[test]
        fn both_sides_make_the_whole(c in -1.0f32..1.0, s in 0.0f32..1.0) {
            let (c, s) = (f64::from(c), f64::from(s));
            let (above, below) = (clipped_sphere(c, s), clipped_sphere(-c, s));
            prop_assert!((above.irradiance - below.irradiance - c * s).abs() <= above.bound + below.bound + 2.0 * EPS * s);
        }

        /// The three ways to write G meet.
        #[test]
        fn branches_agree_where_they_meet(a in 0.05f64..0.95, p in 0.55f64..10.0) {
            let beyond = |a: f64, p: f64| {
                let s = a * a * (1.0 + p * p) / (1.0 + a * a * p * p);
                let cos = (1.0 - s).sqrt();
                beyond_horizon(a, s, p * cos * a, cos, (1.0 - a) * (1.0 + a)).0
            };
            const STEP: f64 = 1e-12;
            let over_p = (beyond(a, 0.5 * (1.0 - STEP)), beyond(a, 0.5 * (1.0 + STEP)));
            let over_a = (beyond(0.5 * (1.0 - STEP), p), beyond(0.5 * (1.0 + STEP), p));
            for (below, above) in [over_p, over_a] {
                // G grows as the fifth power of p at most, which makes 1e-11 of the steps.
                prop_assert!((below - above).abs() <= 2e-11 * above, "{} {}", below, above);
            }
        }

        #[test]
        fn derivatives_are_those_of_the_value(c in -0.99f64..0.99, s in 0.01f64..0.98) {
            let h = 1e-5;
            let at = clipped_sphere(c, s);
            let by = |dc: f64, ds: f64| {
                (clipped_sphere(c + dc, s + ds).irradiance - clipped_sphere(c - dc, s - ds).irradiance) / (2.0 * h)
            };
            // The second derivative jumps at the rim, where r is the root of the distance: h^(1/2) at worst there.
            prop_assert!((by(h, 0.0) - at.by_cosine).abs() < 3e-3, "{} {}", by(h, 0.0), at.by_cosine);
            prop_assert!((by(0.0, h) - at.by_sin2).abs() < 3e-3, "{} {}", by(0.0, h), at.by_sin2);
        }
    }

    #[test]
    fn tables_have_their_corners() {
        for table in [table_by_form_factor(64), table_by_solid_angle(64)] {
            assert_eq!((table[0], table[63]), (0.0, 1.0));
            assert_eq!((table[63 * 64], table[64 * 64 - 1]), (0.0, 1.0));
            // The tilted hemisphere in the last row.
            assert!((table[63 * 64 + 21] - 1.0 / 3.0).abs() < 1e-7);
        }
    }

    /// What the documentation says of both tables' interpolation, on a lattice that avoids the texels.
    #[test]
    fn the_solid_angle_serves_a_table_better() {
        let (by_form_factor, by_solid_angle) = (table_by_form_factor(64), table_by_solid_angle(64));
        let interpolate = |table: &[f32], c: f64, v: f64| {
            let (x, y) = ((0.5 * c + 0.5) * 63.0, v * 63.0);
            let texel = |dx: usize, dy: usize| {
                f64::from(table[(y as usize + dy).min(63) * 64 + (x as usize + dx).min(63)])
            };
            let along = |dy| texel(0, dy) * (1.0 - x.fract()) + texel(1, dy) * x.fract();
            along(0) * (1.0 - y.fract()) + along(1) * y.fract()
        };
        let mut worst = [0.0f64; 2];
        for row in 0..400_000 {
            let along = |step: f64| (f64::from(row) * step).fract();
            let (c, v) = (2.0 * along(0.618_033_988_749_895) - 1.0, along(0.754_877_666_246_693));
            let s = v * (2.0 - v);
            let exact = clipped_sphere(c, s).irradiance;
            worst[0] = worst[0].max((s * interpolate(&by_form_factor, c, s) - exact).abs());
            worst[1] = worst[1].max((s * interpolate(&by_solid_angle, c, v) - exact).abs());
        }
        assert!((0.018..0.0205).contains(&worst[0]) && (0.0012..0.0014).contains(&worst[1]), "{worst:?}");
    }
}
