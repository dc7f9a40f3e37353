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

use super::gauss_legendre::{POINTS_16, visit};
use super::twofold::Twofold;

/// The closed form does while its bound is at most this share of the value, 1.5e-11.
const ACCURACY: f64 = 1.0 / (1u64 << 36) as f64;

/// Where the minors of S are this share of its square, they have 2^-54 of themselves by its twofold entries.
const ADJUGATE: f64 = 1.0 / (1u64 << 46) as f64;

/// f32 ends at 1e-45.
const FAINT: f64 = 1e-52;

/// What products below f64's range may make of an irradiance.
const UNDERFLOW: f64 = 1e-80;

/// f64's unit roundoff, 2^-53.
const EPS: f64 = f64::EPSILON / 2.0;

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
    /// G with dE = sum of G_ij dS_ij, to a few percent: a trapezoid or Gauss sum along the rim.
    pub gradient: DMat3,
}

impl Irradiance {
    const NOTHING: Irradiance =
        Irradiance { value: 0.0, bound: 0.0, escalated: false, gradient: DMat3::ZERO };
}

/// The principal frame: eigenvalues, and the heights of the axes.
pub(super) struct Principal {
    pub(super) e1: f64,
    pub(super) e3: f64,
    pub(super) l: f64,
    /// (l + e1)(l + e3).
    pub(super) gap: f64,
    pub(super) axes: DMat3,
}

impl Cone {
    /// The irradiance on a plane with normal +z; nothing where the cone is flat (`minus_det` is 0) or below.
    ///
    /// `adjugate` gives that of S, in the order of `dual`, from what S was made of. It is asked only where minors of S would
    /// cancel, beyond an aspect of 2^23 or so: entries of 106 bits hold nothing of what is 2^-106 of the largest.
    pub fn irradiance(&self, adjugate: impl FnOnce() -> [Twofold; 6]) -> Irradiance {
        let below = self.dual[2].value() <= 0.0 && self.towards.z <= 0.0;
        // With smaller products others leave the range of f64, and the irradiance is below 1e-80.
        if below || !(self.minus_det > 1e-200) {
            return Irradiance::NOTHING;
        }
        let mut principal = self.principal(self.minors());
        let size = principal.e1 + principal.l;
        // Also where that is not a number.
        if !(principal.gap > ADJUGATE * size * size) {
            principal = self.principal(adjugate());
        }
        if self.dual[2].value() <= 0.0 {
            let factor = libm::sqrt(self.minus_det / principal.l / principal.gap);
            let value = (factor * principal.axes.z_axis.z).min(1.0);
            let gradient = principal.gradient(0.0, TAU);
            return Irradiance { value, bound: 24.0 * EPS * value, escalated: false, gradient };
        }
        // Where S does not tell e1 from 0, this is the most that the whole cone may give, and beneath all of f32.
        let most = libm::sqrt(self.minus_det / principal.l) / principal.l;
        if most < FAINT && !(principal.e1 > ADJUGATE * principal.l) {
            return Irradiance { bound: most, ..Irradiance::NOTHING };
        }
        principal.clipped(self.dual[2].value())
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
        if e1 > l && h > 0.3 * e1 {
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
        Principal { e1, e3: (self.minus_det / l / e1).min(e1), l, gap, axes }
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
    /// The part of a cone that the horizon cuts; `szz` = S_zz > 0.
    fn clipped(&self, szz: f64) -> Irradiance {
        let &Principal { e1, e3, l, axes, .. } = self;
        let heights = DVec3::new(axes.x_axis.z, axes.y_axis.z, axes.z_axis.z);
        let (a, b, c) = (libm::sqrt(e1), libm::sqrt(e3), libm::sqrt(l));
        let (up, across, middle) = (heights.x * a, heights.y * b, heights.z * c);
        // Height along the rim: middle + swing cos(u - u0), zero at u0 +- d; swing^2 - middle^2 is S_zz.
        let swing = libm::sqrt(middle * middle + szz);
        let level = libm::hypot(up, across);
        let (cos0, sin0) = (up / level, across / level);
        let (cos_d, sin_d) = (-middle / swing, libm::sqrt(szz) / swing);
        let (big, small, k) = (l + e1, l + e3, e1 - e3);

        let (cos1, sin1) = (cos0 * cos_d + sin0 * sin_d, sin0 * cos_d - cos0 * sin_d);
        let (cos2, sin2) = (cos0 * cos_d - sin0 * sin_d, sin0 * cos_d + cos0 * sin_d);
        let q = |cos: f64, sin: f64| big * cos * cos + small * sin * sin;
        let (q1, q2) = (q(cos1, sin1), q(cos2, sin2));
        let d = 2.0 * cos0 * sin_d / libm::sqrt(q1 * q2);
        let z = d * libm::sqrt(k * big);
        let ix = -b * c * d * if z.abs() > 1e-9 { libm::asinh(z) / z } else { 1.0 };
        let g = 2.0 * sin0 * sin_d / small;
        let y = g * libm::sqrt(k * small);
        // cos^2 u0 - sin^2 d = cos^2 d - sin^2 u0, whichever has the smaller terms.
        let squares =
            if sin0.abs() < 0.5 { (cos_d - sin0) * (cos_d + sin0) } else { (cos0 - sin_d) * (cos0 + sin_d) };
        let x = 1.0 + k / small * squares;
        let iy = -a * c * g * if y.abs() > 1e-9 * x { libm::atan2(y, x) / y } else { 1.0 / x };
        let turn = libm::atan2(
            libm::sqrt(big * small) * 2.0 * sin_d * cos_d,
            big * cos1 * cos2 + small * sin1 * sin2,
        );
        let turn = if cos_d < 0.0 { turn + TAU } else { turn };
        let iz = a * b / libm::sqrt(big * small) * turn;
        // Half the sum and half the difference of the rim's points at the two crossings.
        let area = sin_d * libm::sqrt(l * (e3 * cos0 * cos0 + e1 * sin0 * sin0) + e1 * e3 * cos_d * cos_d);
        let dot = cos_d * cos_d * (e1 * cos0 * cos0 + e3 * sin0 * sin0) + l
            - sin_d * sin_d * (e1 * sin0 * sin0 + e3 * cos0 * cos0);
        let dphi = libm::atan2(2.0 * area, dot);

        let terms = [heights.x * ix, heights.y * iy, heights.z * iz, dphi];
        let value = (terms.iter().sum::<f64>() / TAU).clamp(0.0, 1.0);
        let bound = 8.0 * EPS / TAU * terms.iter().map(|term| term.abs()).sum::<f64>();
        let start = libm::atan2(libm::sqrt(small) * sin1, libm::sqrt(big) * cos1);
        let gradient = self.gradient(start, turn);
        if bound <= ACCURACY * value {
            return Irradiance { value, bound, escalated: false, gradient };
        }
        let (value, resolved) = self.area(swing, (cos0, sin0), (cos_d, sin_d));
        // Poles closer to the segment than f64 tells angles apart: nothing is promised.
        let bound = if resolved { 64.0 * EPS * value + UNDERFLOW } else { value };
        Irradiance { value, bound, escalated: true, gradient }
    }

    /// The same as an integral over the ellipse's visible segment: lines parallel to the horizon in closed form, across
    /// them by Gauss's rule. The integrand is positive, so nothing cancels.
    ///
    /// It is singular where a line or the rim passes through the apex, at complex angles that are known: panels are
    /// halved until they are far from them, and the answer says whether all are.
    fn area(&self, swing: f64, (cos0, sin0): (f64, f64), (cos_d, sin_d): (f64, f64)) -> (f64, bool) {
        let &Principal { e1, e3, l, .. } = self;
        let along = e1 * sin0 * sin0 + e3 * cos0 * cos0;
        let skew = sin0 * cos0 * (e3 - e1);
        let d = libm::atan2(sin_d, cos_d);
        let line = |sin: f64, cos: f64, height: f64| {
            // |p|^2 = (s^2 + delta)/along with s linear along the line.
            let delta = l * along + cos * cos * e1 * e3;
            let (s1, s2) = (skew * cos - along * sin, skew * cos + along * sin);
            let root = libm::sqrt(delta);
            let width = 2.0 * along * sin;
            let (q1, q2) = (s1 * s1 + delta, s2 * s2 + delta);
            // With the angles phi1, phi2 of its ends from its foot, and theta between them, the line has
            // (theta + sin theta cos(phi1 + phi2))/(2 delta^(3/2)); a cosine below 0 is -1 and a square.
            let theta = libm::atan2(root * width, delta + s1 * s2);
            let sum = if s1 * s2 <= delta {
                theta + root * width / q1 * ((delta - s1 * s2) / q2)
            } else {
                let cosines = libm::sqrt(delta / q1) + libm::sqrt(delta / q2);
                arc_over_chord(theta) + libm::tan(0.5 * theta) * cosines * cosines
            };
            height * sin * along / (2.0 * delta * root) * sum
        };
        let rim = libm::asinh(libm::sqrt((l + e3) / (e1 - e3)));
        let lines = libm::asinh(libm::sqrt(l * along / (e1 * e3)));
        let mut panels = PANELS;
        // From both ends, so that what is close to either is told from it.
        let poles = [(half_turn(cos0, sin0), rim), (half_turn(cos0, -sin0), rim), (0.5 * PI, lines)];
        let top = graded(0.0, 0.5 * d, &poles, HALVINGS, &mut panels, &|angle| {
            let (sin, cos) = libm::sincos(angle);
            line(sin, cos, 2.0 * libm::sin(0.5 * (d + angle)) * libm::sin(0.5 * (d - angle)))
        });
        let (cos1, sin1) = (cos0 * cos_d + sin0 * sin_d, cos0 * sin_d - sin0 * cos_d);
        let (cos2, sin2) = (cos0 * cos_d - sin0 * sin_d, sin0 * cos_d + cos0 * sin_d);
        let poles =
            [(half_turn(-cos2, sin2), rim), (half_turn(-cos1, sin1), rim), (half_turn(-cos_d, sin_d), lines)];
        let bottom = graded(0.0, 0.5 * d, &poles, HALVINGS, &mut panels, &|rest| {
            let (sin, cos) = libm::sincos(rest);
            let height = 2.0 * libm::sin(d - 0.5 * rest) * libm::sin(0.5 * rest);
            line(sin_d * cos - cos_d * sin, cos_d * cos + sin_d * sin, height)
        });
        let sum = top + bottom;
        (libm::sqrt(e1 * e3 * l) * swing / PI * sum, panels > 0)
    }

    /// G_ij = dE/dS_ij from the rim's part at the angles `start` .. `start + turn` of w, tan w = sqrt(B/A) tan u.
    ///
    /// A change dS moves the rim outward by n^T dS n / (2 |S n|) with n the unit normal of the tangent plane, and what
    /// it sweeps counts with its height: E changes by (1/pi) times the integral of height times that along the rim.
    fn gradient(&self, start: f64, turn: f64) -> DMat3 {
        let &Principal { e1, e3, l, axes, .. } = self;
        let (a, b, c) = (libm::sqrt(e1), libm::sqrt(e3), libm::sqrt(l));
        let (root_a, root_b) = (libm::sqrt(l + e1), libm::sqrt(l + e3));
        let (over_a, over_b) = (1.0 / root_a, 1.0 / root_b);
        let (over_1, over_2, over_3) = (1.0 / a, 1.0 / b, -1.0 / c);
        let (up, across, middle) = (axes.x_axis.z * a, axes.y_axis.z * b, axes.z_axis.z * c);
        let mut moments = [0.0; 6];
        let mut add = |cos: f64, sin: f64, weight: f64| {
            let (x, y) = (cos * over_a, sin * over_b);
            let inverse = libm::sqrt(x * x + y * y);
            let height = (up * x + across * y) / inverse + middle;
            let (m1, m2, m3) = (x * over_1, y * over_2, inverse * over_3);
            let products = [m1 * m1, m2 * m2, m3 * m3, m1 * m2, m1 * m3, m2 * m3];
            for (moment, product) in moments.iter_mut().zip(products) {
                *moment += weight * height * product;
            }
        };
        // Gauss's points lie in pairs about the middle.
        let (sin_middle, cos_middle) = libm::sincos(start + 0.5 * turn);
        for (abscissa, weight) in POINTS_16 {
            let (sin, cos) = libm::sincos(0.5 * turn * abscissa);
            let weight = 0.5 * turn * weight;
            add(cos_middle * cos - sin_middle * sin, sin_middle * cos + cos_middle * sin, weight);
            add(cos_middle * cos + sin_middle * sin, sin_middle * cos - cos_middle * sin, weight);
        }
        let scale = a * b * c / (TAU * root_a * root_b);
        let [xx, yy, zz, xy, xz, yz] = moments.map(|moment| moment * scale);
        let local = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        axes * local * axes.transpose()
    }
}

/// x - sin x for x in 0..pi/2, to a few roundings: below 1/2 by its series, whose next term is 2^-58 of the sum.
fn arc_over_chord(x: f64) -> f64 {
    if x > 0.5 {
        return x - libm::sin(x);
    }
    let square = x * x;
    let mut sum = 1.0;
    for k in (2..=7).rev() {
        let k = f64::from(k);
        sum = 1.0 - sum * square / (2.0 * k * (2.0 * k + 1.0));
    }
    x * square / 6.0 * sum
}

/// Halvings of a panel: a pole 2^-160 off the real axis is met where it lies next to an end at 0, about which f64 can say
/// as much; elsewhere its place is good to 2^-53.
const HALVINGS: u32 = 160;
/// Panels of an integral: three poles take at most four a halving each. More are asked for only where a segment is so
/// short that all of it seems to lie on a pole.
const PANELS: u32 = 3 * 4 * HALVINGS;

/// The angle of (x, y) or of (-x, -y), in -pi/2..pi/2.
fn half_turn(y: f64, x: f64) -> f64 {
    if x < 0.0 { libm::atan2(-y, -x) } else { libm::atan2(y, x) }
}

/// The integral of `f` over low..high within 0..pi, which is singular at the poles (x + k pi) + i y only, |x| <= pi/2.
///
/// A panel whose middle is 1.8 half lengths away from every pole has none within the ellipse of semi-axes' sum 3.3, and
/// 16 points are good to 3.3^-32 = 3e-17 of what is largest in that.
///
/// Takes no more than `panels`, and leaves how many are left: none, if they did not do.
fn graded(
    low: f64,
    high: f64,
    poles: &[(f64, f64)],
    halvings: u32,
    panels: &mut u32,
    f: &impl Fn(f64) -> f64,
) -> f64 {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let near = |&(x, y): &(f64, f64)| {
        let off = if middle - x > 0.5 * PI { middle - x - PI } else { middle - x };
        off * off + y * y < 3.24 * half * half
    };
    if halvings == 0 || *panels == 0 || !poles.iter().any(near) {
        let mut sum = 0.0;
        visit(&POINTS_16, low, high, |x, weight| sum += weight * f(x));
        return sum;
    }
    *panels -= 1;
    graded(low, middle, poles, halvings - 1, panels, f) + graded(middle, high, poles, halvings - 1, panels, f)
}
