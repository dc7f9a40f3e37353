//! Irradiance from the part of an elliptic cone above the horizon, exactly.
//!
//! The cone is given by its dual quadric S, a symmetric matrix with eigenvalues e1 >= e3 > 0 > -l: planes through the
//! apex with normal n touch the cone where n^T S n = 0. An ellipse with centre C and conjugate semi-axes V1, V2 has
//! S = V1 V1^T + V2 V2^T - C C^T, and a linear map M takes S to M S M^T. The eigenvector of -l is the mean direction
//! W3, those of e1 and e3 are the principal axes W1, W2, and the rim is p(u) = (sqrt(e1) cos u, sqrt(e3) sin u, sqrt(l))
//! in the frame (W1, W2, W3). With A = l + e1, B = l + e3, k = e1 - e3 and q = |p|^2, Stokes' theorem gives
//!
//! ```text
//! E = (1/2pi) [ W1.z Ix + W2.z Iy + W3.z Iz + dphi ]        over the arc of u that is above the horizon
//! Ix = integral of -sqrt(e3 l) cos u / q     Iy = integral of -sqrt(e1 l) sin u / q     Iz = integral of sqrt(e1 e3) / q
//! ```
//!
//! with dphi the azimuth between the two horizon crossings u0 +- d, along which the contour is closed. The differences
//! of the antiderivatives over that arc follow from the addition theorems without cancellation:
//!
//! ```text
//! Ix = -sqrt(e3 l) D asinh(z)/z            D = 2 cos u0 sin d / sqrt(q1 q2)     z = D sqrt(k A)
//! Iy = -sqrt(e1 l) G atan2(y, x)/y         G = 2 sin u0 sin d / B               y = G sqrt(k B)
//!                                          x = 1 + (k/B)(cos^2 u0 - sin^2 d)
//! Iz = sqrt(e1 e3/(A B)) atan2(sqrt(A B) sin 2d, A cos u1 cos u2 + B sin u1 sin u2)   in 0..2pi
//! ```
//!
//! Source: ours (Stokes' theorem on the cosine's vector potential, as for polygons: Lambert 1760).

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::exact3;
use super::graded_cone::PERCENT;
use super::spacing::EPS;
use super::twofold::Twofold;
use super::visible_segment::Segment;

/// The closed form does while its bound is at most this share of the value, 1.5e-11.
const ACCURACY: f64 = 1.0 / (1u64 << 36) as f64;

/// What S's entries are off by, of their terms.
const TWOFOLD: f64 = exact3::SQUARES;

/// S_zz has a sign, and 2^-42 of itself, where it is this share of its terms.
const SIGN: f64 = 1.0 / (1u64 << 56) as f64;

/// The most that may remain of that in an eigenvalue or an axis.
const NOISE: f64 = 1.0 / (1u64 << 42) as f64;

/// Where the horizon cuts the rim between angles 2^-30 apart, it takes 2^-150 of a round cone, and 2^-50 of any that is no
/// longer than [`NOISE`] allows.
const TOUCH: f64 = 1.0 / (1u64 << 60) as f64;

/// The gradient has digits where no eigenvalue is below this share of the largest, 2^22 times the square of what rounding an axis
/// leaves of the others.
const GRADED: f64 = 1.0 / (1u128 << 84) as f64;

/// The mean direction's side of the apex is that of any vector inside, by this margin.
const SIDE: f64 = 1.0 / (1u64 << 40) as f64;

/// What rounded axes leave of a gradient's entries, of the largest.
const AXES: f64 = 8.0 * EPS;

/// What may remain of changes that cancel.
const REMAINDER: f64 = 1.0 / (1u64 << 12) as f64;

/// Below this a disturbance of the rim's heights, of what is above the horizon, acts to first order.
const SLIGHT: f64 = 1.0 / (1u64 << 10) as f64;

/// One nappe of an elliptic cone with its apex at the origin.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// The dual quadric: xx, yy, zz, xy, xz, yz. Entries of magnitude about 1 at most (scale is free).
    pub dual: [Twofold; 6],
    /// -det S > 0 within 4 roundings, however much a determinant of the entries would cancel.
    pub minus_det: f64,
    /// Any vector inside the nappe.
    pub towards: DVec3,
}

/// What a cone gives, as a share of the full hemisphere's irradiance.
#[derive(Clone, Copy, Debug)]
pub struct Irradiance {
    pub value: f64,
    /// Absolute error bound of `value`.
    pub bound: f64,
    /// Whether the closed form cancelled too much, and quadrature of a positive integrand took its place.
    pub escalated: bool,
    /// G with dE = sum of G_ij dS_ij, to a percent.
    pub gradient: DMat3,
}

impl Irradiance {
    const NOTHING: Irradiance =
        Irradiance { value: 0.0, bound: 0.0, escalated: false, gradient: DMat3::ZERO };

    /// What roundings of the gradient's axes may make of all changes, x dE/dx for Minv's and the light's components, where the terms of
    /// S_xx, S_yy and S_zz add up to `terms` in absolute value.
    pub fn off(&self, terms: DVec3) -> f64 {
        // Every entry is off by some roundings of the largest. A term of S changes by four times itself with all that it has, and
        // its other entries have no more terms than twice those of the diagonal.
        let [x, y, z] = self.gradient.to_cols_array_2d().map(|column| DVec3::from_array(column).abs());
        AXES * x.max(y).max(z).max_element() * (4.0 * 3.0 * terms.element_sum())
    }
}

/// First-order changes x dE/dx of an irradiance by some inputs x: of all Minv, say, or all of the light.
#[derive(Clone, Copy, Debug, Default)]
pub struct Changes {
    sum: f64,
    absolute: f64,
}

impl Changes {
    /// Adds those of three inputs.
    pub fn add(&mut self, changes: DVec3) {
        self.sum += changes.element_sum();
        self.absolute += changes.abs().element_sum();
    }

    /// The sum of all in absolute value with those of the light, or `None` where their digits are lost: where they may be `off` by
    /// more than a percent. The irradiance depends on neither's scale, and so the sums with signs are rounding.
    pub fn size(self, light: Changes, off: f64) -> Option<f64> {
        let size = self.absolute + light.absolute;
        let known = off <= PERCENT * size;
        (known && self.sum.abs() <= REMAINDER * size && light.sum.abs() <= REMAINDER * size).then_some(size)
    }
}

/// The principal frame: eigenvalues, and the heights of the axes.
pub(super) struct Principal {
    pub(super) e1: f64,
    pub(super) e3: f64,
    pub(super) l: f64,
    /// (l + e1)(l + e3).
    pub(super) gap: f64,
    pub(super) axes: DMat3,
    /// Whether the needle's long axis W1 is better than a unit vector's roundings.
    refined: bool,
}

impl Cone {
    /// The irradiance on a plane with normal +z; nothing where the cone is below. `None` where this arithmetic may not do, by
    /// tests on what it found, and where the cone is flat or `minus_det` leaves the range of f64: [`super::graded_cone`] then does.
    ///
    /// `terms` has what the terms of S_xx, S_yy and S_zz add up to in absolute value.
    pub fn irradiance(&self, terms: DVec3) -> Option<Irradiance> {
        let (szz, size) = (self.dual[2].value(), terms.element_sum());
        let unsure = szz.abs() <= SIGN * terms.z;
        let below = szz < 0.0 && self.towards.z <= 0.0;
        if below && !unsure {
            return Some(Irradiance::NOTHING);
        }
        // Products below that leave the range of f64.
        if !(self.minus_det > 1e-200) || (unsure && self.towards.z <= 0.0) {
            return None;
        }
        // No entry of the diagonal is larger than the largest eigenvalue, and the lesser of the others is at most the root of
        // their product.
        let largest = self.dual[..3].iter().fold(0.0f64, |largest, entry| largest.max(entry.value().abs()));
        if self.minus_det < GRADED * GRADED * (largest * largest * largest) {
            return None;
        }
        let principal = self.principal(self.minors());
        let Principal { e1, e3, l, gap, axes, .. } = principal;
        // What the entries' error is of the minors that W3 comes from, and of e1.
        let noise = TWOFOLD * (size * size / gap + size / e1);
        let side = axes.z_axis.dot(self.towards);
        let graded = !(e3.min(l) >= GRADED * e1.max(l));
        if !(noise <= NOISE) || graded || !(side > SIDE * self.towards.length()) {
            return None;
        }
        let middle = l * axes.z_axis.z * axes.z_axis.z;
        let light = if szz + TWOFOLD * terms.z <= TOUCH * middle {
            principal.whole(noise)
        } else if unsure {
            None
        } else {
            principal.clipped(szz, noise)
        };
        light.filter(|light| light.bound <= ACCURACY * light.value)
    }

    /// The adjugate of S by its minors.
    pub fn minors(&self) -> [Twofold; 6] {
        let [x, y, z, xy, xz, yz] = self.dual;
        [
            y * z - yz * yz,
            x * z - xz * xz,
            x * y - xy * xy,
            xz * yz - xy * z,
            xy * yz - xz * y,
            xy * xz - yz * x,
        ]
    }

    pub(super) fn principal(&self, adjugate: [Twofold; 6]) -> Principal {
        let [xx, yy, zz, xy, xz, yz] = self.dual;
        let [axx, ayy, azz, axy, axz, ayz] = adjugate;
        let c2 = xx + yy + zz;
        let l = positive_root(c2, axx + ayy + azz, self.minus_det);
        // The adjugate of S + l: (l + e1)(l + e3) W3 W3^T.
        let (axx, ayy, azz) = (axx + (yy + zz + l) * l, ayy + (xx + zz + l) * l, azz + (xx + yy + l) * l);
        let (axy, axz, ayz) = (axy - xy * l, axz - xz * l, ayz - yz * l);
        let gap = (axx + ayy + azz).value();
        let (dx, dy, dz) = (axx.value(), ayy.value(), azz.value());
        let column = if dx >= dy && dx >= dz {
            DVec3::new(dx, axy.value(), axz.value())
        } else if dy >= dz {
            DVec3::new(axy.value(), dy, ayz.value())
        } else {
            DVec3::new(axz.value(), ayz.value(), dz)
        };
        let w3 = column.normalize();
        let w3 = if w3.dot(self.towards) < 0.0 { -w3 } else { w3 };
        let (b1, b2) = w3.any_orthonormal_pair();
        let times = |b: DVec3| {
            [xx * b.x + xy * b.y + xz * b.z, xy * b.x + yy * b.y + yz * b.z, xz * b.x + yz * b.y + zz * b.z]
        };
        let dot = |v: [Twofold; 3], b: DVec3| v[0] * b.x + v[1] * b.y + v[2] * b.z;
        let (s1, s2) = (times(b1), times(b2));
        let (s11, s22, s12) = (dot(s1, b1), dot(s2, b2), dot(s1, b2).value());
        let tau = 0.5 * (s11 - s22).value();
        let h = libm::hypot(tau, s12);
        let e1 = 0.5 * (c2 + l).value() + h;
        let l = l.value();
        let (cos, sin) = if h == 0.0 {
            (1.0, 0.0)
        } else if tau >= 0.0 {
            let cos = libm::sqrt(0.5 * (1.0 + tau / h));
            (cos, 0.5 * s12 / (h * cos))
        } else {
            let sin = libm::sqrt(0.5 * (1.0 - tau / h));
            (0.5 * s12 / (h * sin), sin)
        };
        let mut axes = DMat3::from_cols(cos * b1 + sin * b2, cos * b2 - sin * b1, w3);
        // The heights of the axes decide where the horizon cuts a needle. By S W1 = e1 W1 the small components of W1 have
        // e3 + l over e1 less rounding than those of a unit vector, W3 has all its digits, and W2 is across both.
        let refined = e1 > l && h > 0.3 * e1;
        if refined {
            let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| row.map(|entry| entry.value()));
            let w1 = &mut axes.x_axis;
            for (i, row) in rows.iter().enumerate() {
                if w1[i].abs() < 0.5 {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    w1[i] = (row[j] * w1[j] + row[k] * w1[k]) / (e1 - row[i]);
                }
            }
            let across = w3.cross(axes.x_axis);
            axes.y_axis = if across.dot(axes.y_axis) < 0.0 { -across } else { across };
        }
        Principal { e1, e3: (self.minus_det / l / e1).min(e1), l, gap, axes, refined }
    }
}

/// The one positive root of l^3 + c2 l^2 + c1 l - c0, whose three roots are real.
///
/// Newton descends to it from Laguerre's bound on the roots, where the cubic is convex; two steps in twofold arithmetic
/// take out what the rounding of c1 and c2 left.
fn positive_root(c2: Twofold, c1: Twofold, c0: f64) -> Twofold {
    let (b, c) = (c2.value(), c1.value());
    let spread = libm::sqrt((b * b - 3.0 * c).max(0.0));
    let mut l = (2.0 * spread - b) / 3.0 + 1e-15 * (b.abs() + libm::sqrt(c.abs()));
    // A root of ratio 2^-100 to the others takes about 100 halvings; most take 3 steps.
    for _ in 0..300 {
        let value = ((l + b) * l + c) * l - c0;
        let slope = (3.0 * l + 2.0 * b) * l + c;
        let step = value / slope;
        if !(step > 4.0 * EPS * l) || !(slope > 0.0) {
            break;
        }
        l = if step < l { l - step } else { 0.5 * l };
    }
    let mut root = Twofold::from(l);
    for _ in 0..2 {
        let value = ((root + c2) * root + c1) * root - Twofold::from(c0);
        let slope = (root * 3.0 + c2 * 2.0) * root + c1;
        let step = value.value() / slope.value();
        if !(step.abs() < 0.5 * root.value()) {
            break;
        }
        root = root - Twofold::from(step);
    }
    root
}

impl Principal {
    /// A cone that is above the horizon.
    fn whole(&self, noise: f64) -> Option<Irradiance> {
        let &Principal { e1, e3, gap, axes, .. } = self;
        let height = axes.z_axis.z;
        let value = (libm::sqrt(e1 * e3 / gap) * height).min(1.0);
        let bound = (24.0 * EPS + noise + noise / height) * value;
        let gradient = self.gradient(&Integrals::around(self))?;
        (height > 0.0).then_some(Irradiance { value, bound, escalated: false, gradient })
    }

    /// The part of a cone that the horizon cuts; `szz` = S_zz > 0.
    fn clipped(&self, szz: f64, noise: f64) -> Option<Irradiance> {
        let &Principal { e1, e3, l, refined, axes, .. } = self;
        let heights = DVec3::new(axes.x_axis.z, axes.y_axis.z, axes.z_axis.z);
        let (a, b, c) = (libm::sqrt(e1), libm::sqrt(e3), libm::sqrt(l));
        let (up, across, middle) = (heights.x * a, heights.y * b, heights.z * c);
        // Height along the rim: middle + swing cos(u - u0), zero at u0 +- d; swing^2 - middle^2 is S_zz.
        let swing = libm::sqrt(middle * middle + szz);
        let level = libm::sqrt(up * up + across * across);
        let (cos0, sin0) = (up / level, across / level);
        let (cos_d, sin_d) = (-middle / swing, libm::sqrt(szz) / swing);
        let (big, small, k) = (l + e1, l + e3, e1 - e3);
        let mean = libm::sqrt(big * small);

        // How far off the heights may be, and what this is of the rim's in the unit of its narrow bends.
        let steep = if refined { (e3 + l) / e1 } else { 1.0 };
        let off = DVec3::new(
            4.0 * EPS * (heights.x.abs() + steep) + noise,
            4.0 * EPS + noise,
            4.0 * EPS * heights.z.abs() + noise,
        );
        let disturbed = off.dot(DVec3::new(a, b, c)) / swing * (1.0 + big / mean);
        if !((level - swing).abs() <= ACCURACY * swing) || !(disturbed <= SLIGHT * sin_d * sin_d) {
            return None;
        }

        let (cos1, sin1) = (cos0 * cos_d + sin0 * sin_d, sin0 * cos_d - cos0 * sin_d);
        let (cos2, sin2) = (cos0 * cos_d - sin0 * sin_d, sin0 * cos_d + cos0 * sin_d);
        let q = |cos: f64, sin: f64| big * cos * cos + small * sin * sin;
        let (q1, q2) = (q(cos1, sin1), q(cos2, sin2));
        // The integrals of cos/q, sin/q and 1/q.
        let d = 2.0 * cos0 * sin_d / libm::sqrt(q1 * q2);
        let z = d * libm::sqrt(k * big);
        let of_cos = d * if z.abs() > 1e-9 { libm::asinh(z) / z } else { 1.0 };
        let g = 2.0 * sin0 * sin_d / small;
        let y = g * libm::sqrt(k * small);
        // cos^2 u0 - sin^2 d = cos^2 d - sin^2 u0, whichever has the smaller terms.
        let squares =
            if sin0.abs() < 0.5 { (cos_d - sin0) * (cos_d + sin0) } else { (cos0 - sin_d) * (cos0 + sin_d) };
        let x = 1.0 + k / small * squares;
        let of_sin = g * if y.abs() > 1e-9 * x { libm::atan2(y, x) / y } else { 1.0 / x };
        let turn = libm::atan2(mean * 2.0 * sin_d * cos_d, big * cos1 * cos2 + small * sin1 * sin2);
        let turn = if cos_d < 0.0 { turn + TAU } else { turn };
        let of_one = turn / mean;
        // Half the sum and half the difference of the rim's points at the two crossings.
        let area = sin_d * libm::sqrt(l * (e3 * cos0 * cos0 + e1 * sin0 * sin0) + e1 * e3 * cos_d * cos_d);
        let dot = cos_d * cos_d * (e1 * cos0 * cos0 + e3 * sin0 * sin0) + l
            - sin_d * sin_d * (e1 * sin0 * sin0 + e3 * cos0 * cos0);
        let dphi = libm::atan2(2.0 * area, dot);

        let contour = DVec3::new(-b * c * of_cos, -a * c * of_sin, a * b * of_one);
        let value = ((heights.dot(contour) + dphi) / TAU).clamp(0.0, 1.0);
        let terms = (heights * contour).abs().element_sum() + dphi.abs();
        // To first order the irradiance changes with the heights alone: the rim's ends are on the horizon.
        let bound = ((24.0 * EPS + 4.0 * noise) * terms + off.dot(contour.abs())) / TAU;
        let gradient = self.gradient(&Integrals::along(
            (big, small),
            [of_cos, of_sin, of_one],
            [[cos1, sin1, q1], [cos2, sin2, q2]],
        ))?;
        if bound <= ACCURACY * value {
            return Some(Irradiance { value, bound, escalated: false, gradient });
        }
        let segment = Segment {
            e1,
            e3,
            l,
            middle: (cos0, sin0),
            half: (cos_d, sin_d),
            ends: [(cos1, sin1), (cos2, sin2)],
            // All of them are in `disturbed`.
            off: (0.0, 0.0, [0.0; 2]),
        };
        // Poles closer to the segment than f64 tells angles apart: nothing is promised.
        let (sum, error) = segment.irradiance()?;
        let scale = a * b * c * swing / PI;
        let value = scale * sum;
        let bound = scale * error + (64.0 * EPS + 4.0 * noise + 4.0 * disturbed) * value;
        // As many more digits as the closed form lost the gradient lost of its axes.
        let lost = terms / value;
        let known = e3.min(l) >= GRADED * lost * lost * e1.max(l);
        known.then_some(Irradiance { value, bound, escalated: true, gradient })
    }

    /// G_ij = dE/dS_ij, from the integrals over the visible rim.
    ///
    /// A change dS moves the rim outward by n^T dS n / (2 |S n|) with n the unit normal of the tangent plane, and what
    /// it sweeps counts with its height: E changes by (1/pi) times the integral of height times that along the rim, as
    /// [`super::graded_cone`] has it in u.
    ///
    /// Nothing where less than a percent is known of it: no scale changes anything, so that tr(G S) is 0 where all three terms
    /// are positive, and what it is instead is what rounding left of slivers.
    fn gradient(&self, of: &Integrals) -> Option<DMat3> {
        let &Principal { e1, e3, l, axes, .. } = self;
        let (a, b, c) = (libm::sqrt(e1), libm::sqrt(e3), libm::sqrt(l));
        let (up, across, middle) = (axes.x_axis.z * a, axes.y_axis.z * b, axes.z_axis.z * c);
        let height = |of_cos: f64, of_sin: f64, of_one: f64| up * of_cos + across * of_sin + middle * of_one;
        let scale = a * b * c / TAU;
        let xx = scale / e1 * height(of.c - of.css, of.scc, of.cc);
        let yy = scale / e3 * height(of.css, of.s - of.scc, of.ss);
        let zz = scale / l * height(of.c, of.s, of.cc + of.ss);
        let xy = c / TAU * height(of.scc, of.css, of.cs);
        let xz = -b / TAU * height(of.cc, of.cs, of.c);
        let yz = -a / TAU * height(of.cs, of.ss, of.s);
        let remainder = (e1 * xx + e3 * yy - l * zz).abs();
        let local = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        (remainder <= REMAINDER * l * zz).then(|| axes * local * axes.transpose())
    }
}

/// Integrals over q^2 of cos^2, sin^2, cos sin, cos, cos sin^2, sin and sin cos^2 along the visible rim.
#[derive(Clone, Copy, Debug, Default)]
struct Integrals {
    cc: f64,
    ss: f64,
    cs: f64,
    c: f64,
    css: f64,
    s: f64,
    scc: f64,
}

impl Integrals {
    /// All around.
    fn around(cone: &Principal) -> Self {
        let (big, small) = (cone.l + cone.e1, cone.l + cone.e3);
        let half = PI / libm::sqrt(big * small);
        Integrals { cc: half / big, ss: half / small, ..Integrals::default() }
    }

    /// From the integrals over q of cos, sin and 1, and from cos, sin and q of both ends: see [`super::graded_cone`].
    fn along(
        (big, small): (f64, f64),
        [of_cos, of_sin, of_one]: [f64; 3],
        [[cos1, sin1, q1], [cos2, sin2, q2]]: [[f64; 3]; 2],
    ) -> Self {
        let k = big - small;
        let (by1, by2) = (1.0 / q1, 1.0 / q2);
        let both = sin2 * cos2 * by2 - sin1 * cos1 * by1;
        let (sin, cos) = (sin2 * by2 - sin1 * by1, cos2 * by2 - cos1 * by1);
        let (css, scc) = if k > 1e-4 * big {
            (0.5 / k * (sin - of_cos), 0.5 / k * (cos + of_sin))
        } else {
            // q is the same all around, but for k.
            let third = by1 * by2 / 3.0;
            let cubes = |from: f64, to: f64| third * (to - from) * (to * to + to * from + from * from);
            (cubes(sin1, sin2), cubes(cos2, cos1))
        };
        let (half_big, half_small) = (0.5 / big, 0.5 / small);
        Integrals {
            cc: half_big * (of_one + both),
            ss: half_small * (of_one - both),
            cs: 0.5 * (cos1 - cos2) * (cos1 + cos2) * by1 * by2,
            c: half_big * (of_cos + sin),
            css,
            s: half_small * (of_sin - cos),
            scc,
        }
    }
}
