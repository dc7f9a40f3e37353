//! The contour integral of (q x dq).z/|q|^2 along an arc of an ellipse, in closed form and in either precision.
//!
//! Only directions count, so the ellipse q = C + cos t X + sin t Y is taken in the principal frame (W1, W2, W3) of its cone
//! (see [`super::clipped_ellipse`]), where its direction is p(u) = (sqrt(e1) cos u, sqrt(e3) sin u, sqrt(l)) and the integral
//! is elementary for any pair of ends. Frame and eigenvalues come from the ellipse itself, so that a far or small one
//! loses nothing: with N = X x Y, l is the positive root of
//!
//! ```text
//! l^3 + (|X|^2 + |Y|^2 - |C|^2) l^2 + (|N|^2 - |C x X|^2 - |C x Y|^2) l - (N.C)^2
//! ```
//!
//! and W3 has the direction of l^2 C + l (X x (C x X) + Y x (C x Y)) + N (N.C). Source: ours.

use core::f64::consts::{FRAC_1_PI, TAU};

use glam::DVec3;

use super::cubic::positive_root;
use super::double_double::Real;
use super::gauss_legendre::{POINTS_8, POINTS_16};
use super::half_turn::sin_cos;

/// Three components.
pub type Vector<T> = [T; 3];

/// An ellipse C + cos t X + sin t Y.
#[derive(Clone, Copy, Debug)]
pub struct Ellipse<T> {
    pub center: Vector<T>,
    pub cos: Vector<T>,
    pub sin: Vector<T>,
    /// The determinant [C, X, Y], better known than from the three.
    pub volume: T,
}

/// Its cone.
#[derive(Clone, Copy, Debug)]
pub struct Cone<T> {
    axes: [Vector<T>; 3],
    e1: T,
    e3: T,
    l: T,
    /// The apex lies in the ellipse's plane, as far as T can tell.
    flat: bool,
}

/// An integral, and what its error is a few roundings of.
#[derive(Clone, Copy, Debug)]
pub struct Term<T> {
    pub value: T,
    pub size: f64,
}

/// An arc's ends in the principal frame: half its sum and half its difference, of u from low to high.
struct Span<T> {
    low: [T; 2],
    high: [T; 2],
    middle: [T; 2],
    half: [T; 2],
}

impl<T: Real> Ellipse<T> {
    /// The point with this cosine and sine of t.
    pub fn at(&self, [cos, sin]: [T; 2]) -> Vector<T> {
        [0, 1, 2].map(|k| self.center[k] + (self.cos[k] * cos + self.sin[k] * sin))
    }

    pub fn cone(&self) -> Cone<T> {
        let (c, x, y) = (self.center, self.cos, self.sin);
        let (cx, cy, n) = (cross(c, x), cross(c, y), cross(x, y));
        let c2 = dot(x, x) + dot(y, y) - dot(c, c);
        let c1 = dot(n, n) - dot(cx, cx) - dot(cy, cy);
        let c0 = self.volume * self.volume;
        let mut l = T::from(positive_root(c2.to_f64(), c1.to_f64(), c0.to_f64()));
        if T::ROUNDOFF < f64::ROUNDOFF && l.to_f64() > 0.0 {
            // Each squares the error of f64's root.
            for _ in 0..3 {
                let value = ((l + c2) * l + c1) * l - c0;
                let slope = (l * T::from(3.0) + c2 * T::from(2.0)) * l + c1;
                l = l - value / slope;
            }
        }
        let (xx, yy) = (cross(x, cx), cross(y, cy));
        let w3 = normalized([0, 1, 2].map(|k| l * l * c[k] + l * (xx[k] + yy[k]) + n[k] * self.volume));

        // Any basis across, turned to the axes of what is left of X X^T + Y Y^T - C C^T.
        let sizes = w3.map(|v| v.to_f64().abs());
        let least = (0..3).fold(0, |least, k| if sizes[k] < sizes[least] { k } else { least });
        let b1 = normalized([0, 1, 2].map(|k| T::from(f64::from(k == least)) - w3[k] * w3[least]));
        let b2 = cross(w3, b1);
        let flat = |v: Vector<T>| [dot(b1, v), dot(b2, v)];
        let ([c_1, c_2], [x_1, x_2], [y_1, y_2]) = (flat(c), flat(x), flat(y));
        let half = T::from(0.5);
        let s11 = x_1 * x_1 + y_1 * y_1 - c_1 * c_1;
        let s22 = x_2 * x_2 + y_2 * y_2 - c_2 * c_2;
        let s12 = x_1 * x_2 + y_1 * y_2 - c_1 * c_2;
        let tau = half * (s11 - s22);
        let h = (tau * tau + s12 * s12).sqrt();
        let e1 = half * (s11 + s22) + h;
        let (one, zero) = (T::from(1.0), T::from(0.0));
        let (cos, sin) = if !(h.to_f64() > 0.0) {
            (one, zero)
        } else if tau.to_f64() >= 0.0 {
            let cos = (half * (one + tau / h)).sqrt();
            (cos, half * s12 / (h * cos))
        } else {
            let sin = (half * (one - tau / h)).sqrt();
            (half * s12 / (h * sin), sin)
        };
        let w1 = [0, 1, 2].map(|k| cos * b1[k] + sin * b2[k]);
        let w2 = [0, 1, 2].map(|k| cos * b2[k] - sin * b1[k]);
        let degenerate = !(l.to_f64() > 0.0 && e1.to_f64() > 0.0);
        let e3 = if degenerate { zero } else { c0 / (l * e1) };
        let e3 = if e3.to_f64() > e1.to_f64() { e1 } else { e3 };
        // Below this, roundings turn u about.
        let flat =
            degenerate || e3.to_f64() <= T::ROUNDOFF * e1.to_f64() || l.to_f64() <= T::ROUNDOFF * e1.to_f64();
        Cone { axes: [w1, w2, w3], e1, e3, l, flat }
    }

    /// The integral from `start` to `end`, two points of the ellipse with t growing by `sweep` < 2 pi.
    pub fn arc(&self, cone: &Cone<T>, start: Vector<T>, end: Vector<T>, sweep: f64) -> Term<T> {
        if cone.flat {
            return in_plane(start, end);
        }
        let Span { low, high, middle: [cos0, sin0], half: [cos_d, sin_d] } =
            self.span(cone, start, end, sweep);
        let &Cone { axes, e1, e3, l, .. } = cone;
        let (one, two) = (T::from(1.0), T::from(2.0));
        let (a, b, c) = (e1.sqrt(), e3.sqrt(), l.sqrt());
        let (big, small, k) = (l + e1, l + e3, e1 - e3);
        let q = |[cos, sin]: [T; 2]| big * cos * cos + small * sin * sin;
        let d = two * cos0 * sin_d / (q(low) * q(high)).sqrt();
        let z = d * (k * big).sqrt();
        // f/g where both vanish together.
        let ratio = |f: T, g: T| if g.to_f64().abs() > 1e-150 { f / g } else { one };
        let ix = -(b * c * d * ratio(z.asinh(), z));
        let g = two * sin0 * sin_d / small;
        let y = g * (k * small).sqrt();
        let x = one + k / small * (cos0 * cos0 - sin_d * sin_d);
        let angle = if y.to_f64().abs() > 1e-150 { y.atan2(x) / y } else { one / x };
        let iy = -(a * c * g * angle);
        let iz = a * b / (big * small).sqrt() * self.turn(cone, &low, &high, &[cos_d, sin_d]);
        let terms = [axes[0][2] * ix, axes[1][2] * iy, axes[2][2] * iz];
        let size = terms.iter().map(|term| term.to_f64().abs()).sum::<f64>();
        let value = terms[0] + terms[1] + terms[2];
        // The frame is off by a rounding, which moves the ends along the rim by as much, stretched where it is narrow.
        let skew = |[cos, sin]: [T; 2]| (cos * sin).to_f64().abs();
        let stretch = 1.0 + skew(low).max(skew(high)) * (e1 / e3).to_f64().sqrt();
        let size = size + 0.125 * sin_d.to_f64() * stretch;
        Term { value: if self.volume.to_f64() < 0.0 { -value } else { value }, size }
    }

    /// The integral once around, with t growing.
    pub fn whole(&self, cone: &Cone<T>) -> Term<T> {
        if cone.flat {
            // Inside or outside of the ellipse nothing but the plane decides; no caller asks.
            return Term { value: T::from(0.0), size: 1.0 };
        }
        let &Cone { axes, e1, e3, l, .. } = cone;
        let value = axes[2][2] * (e1 * e3 / ((l + e1) * (l + e3))).sqrt() * T::TAU;
        let size = value.to_f64().abs();
        Term { value: if self.volume.to_f64() < 0.0 { -value } else { value }, size }
    }

    /// The difference of tan w = sqrt((l + e3)/(l + e1)) tan u over an arc, in 0..2 pi.
    fn turn(&self, cone: &Cone<T>, low: &[T; 2], high: &[T; 2], [cos_d, sin_d]: &[T; 2]) -> T {
        let (big, small) = (cone.l + cone.e1, cone.l + cone.e3);
        let turn = ((big * small).sqrt() * T::from(2.0) * *sin_d * *cos_d)
            .atan2(big * low[0] * high[0] + small * low[1] * high[1]);
        if cos_d.to_f64() < 0.0 { turn + T::TAU } else { turn }
    }

    /// The ends of an arc, ordered by u: its points turn with t where `volume` > 0.
    fn span(&self, cone: &Cone<T>, start: Vector<T>, end: Vector<T>, sweep: f64) -> Span<T> {
        let roots = [cone.e1.sqrt(), cone.e3.sqrt()];
        let place = |q: Vector<T>| {
            // The centre's part is the same for both ends; what differs is small and keeps its digits.
            let off = difference(q, self.center);
            let [x, y] = [0, 1].map(|k| (dot(cone.axes[k], off) + dot(cone.axes[k], self.center)) / roots[k]);
            let size = (x * x + y * y).sqrt();
            [x / size, y / size]
        };
        let (start, end) = (place(start), place(end));
        let (low, high) = if self.volume.to_f64() < 0.0 { (end, start) } else { (start, end) };
        let sum = [low[0] + high[0], low[1] + high[1]];
        let step = [high[0] - low[0], high[1] - low[1]];
        let length = |v: [T; 2]| (v[0] * v[0] + v[1] * v[1]).sqrt();
        let (of_sum, of_step) = (length(sum), length(step));
        let half = T::from(0.5);
        let turned = (low[0] * high[1] - low[1] * high[0]).to_f64();
        // The sign is lost where the ends meet, after nothing or once around.
        let beyond = if of_step.to_f64() < 1e-3 { sweep > 0.5 * TAU } else { turned < 0.0 };
        let sign = T::from(if beyond { -1.0 } else { 1.0 });
        let middle = if of_sum.to_f64() > of_step.to_f64() {
            [sign * sum[0] / of_sum, sign * sum[1] / of_sum]
        } else {
            [step[1] / of_step, -step[0] / of_step]
        };
        Span { low, high, middle, half: [sign * half * of_sum, half * of_step] }
    }
}

impl Ellipse<f64> {
    /// The integrals of D, D cos t and D sin t along an arc, or all around if `ends` is `None`, to a few percent: D is the
    /// derivative of the irradiance by the contour's point there.
    ///
    /// Moving a contour changes the irradiance by -(1/pi) q.z/|q|^4 (q x dq), which in w is smooth.
    pub fn derivatives(&self, cone: &Cone<f64>, ends: Option<(DVec3, DVec3, f64)>) -> [DVec3; 3] {
        let mut moments = [DVec3::ZERO; 3];
        if cone.flat {
            return moments;
        }
        let &Cone { axes, e1, e3, l, .. } = cone;
        let (big, small) = (libm::sqrt(l + e1), libm::sqrt(l + e3));
        let (from, turn) = match ends {
            None => (0.0, TAU),
            Some((start, end, sweep)) => {
                let span = self.span(cone, start.to_array(), end.to_array(), sweep);
                let turn = self.turn(cone, &span.low, &span.high, &span.half);
                (libm::atan2(small * span.low[1], big * span.low[0]), turn)
            }
        };
        let [w1, w2, w3] = axes.map(DVec3::from_array);
        let [c, x, y] = [self.center, self.cos, self.sin].map(DVec3::from_array);
        let (a, b, root_l) = (libm::sqrt(e1), libm::sqrt(e3), libm::sqrt(l));
        let n = x.cross(y);
        let (by_x, by_y) = (y.cross(n) / n.length_squared(), n.cross(x) / n.length_squared());
        let sign = if self.volume < 0.0 { FRAC_1_PI } else { -FRAC_1_PI };
        let scale = sign / (big * small * self.volume);
        let rule = if turn < 4.0 { &POINTS_8[..] } else { &POINTS_16[..] };
        // Everything is linear in (cos u, sin u, 1).
        let ([p1, p2, p3], turned) =
            ([a * w1, b * w2, root_l * w3], [root_l * b * w1, root_l * a * w2, a * b * w3]);
        let heights = [n.dot(p1), n.dot(p2), n.dot(p3)];
        // cos w/big and sin w/small at w = middle -+ offset, by the sines of both.
        let half_turn = 0.5 * turn;
        let (sin_m, cos_m) = (from + half_turn).sin_cos();
        let (cos_m, sin_m, cross_cos, cross_sin) = (cos_m / big, sin_m / small, cos_m / small, sin_m / big);
        for &(abscissa, weight) in rule {
            let (sin_o, cos_o) = sin_cos(abscissa * half_turn);
            for sin_o in [sin_o, -sin_o] {
                let cos = cos_m * cos_o - cross_sin * sin_o;
                let sin = sin_m * cos_o + cross_cos * sin_o;
                // |p| is the root's inverse, for p of these multiples of it.
                let inverse2 = cos * cos + sin * sin;
                let root = 1.0 / inverse2.sqrt();
                let (cos, sin) = (cos * root, sin * root);
                let p = cos * p1 + sin * p2 + p3;
                let height = heights[0] * cos + heights[1] * sin + heights[2];
                let off = (self.volume / height) * p - c;
                let by = (scale * half_turn * weight * p.z * height * inverse2)
                    * (turned[2] - cos * turned[0] - sin * turned[1]);
                moments[0] += by;
                moments[1] += off.dot(by_x) * by;
                moments[2] += off.dot(by_y) * by;
            }
        }
        moments
    }
}

/// An arc seen edge-on, from outside: the angle between its ends in its plane.
fn in_plane<T: Real>(start: Vector<T>, end: Vector<T>) -> Term<T> {
    let n = cross(start, difference(end, start));
    let size = dot(n, n).sqrt();
    if !(size.to_f64() > 0.0) {
        return Term { value: T::from(0.0), size: 0.0 };
    }
    let value = size.atan2(dot(start, end)) * n[2] / size;
    Term { value, size: value.to_f64().abs() }
}

pub fn dot<T: Real>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross<T: Real>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn difference<T: Real>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn normalized<T: Real>(v: Vector<T>) -> Vector<T> {
    // By a power of two first, so that no square leaves the range.
    let largest = v.iter().fold(0.0f64, |largest, c| largest.max(c.to_f64().abs()));
    let scale = T::from(libm::ldexp(1.0, -libm::frexp(largest).1));
    let v = v.map(|c| c * scale);
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::double_double::DoubleDouble;
    use crate::numeric::gauss_legendre::visit;
    use crate::numeric::products::norm;
    use crate::sample::Stream;

    /// The integrand itself by Gauss's rule on 64 panels: no cone, no antiderivative.
    fn quadrature(ellipse: &Ellipse<f64>, from: f64, to: f64) -> f64 {
        let [c, x, y] = [ellipse.center, ellipse.cos, ellipse.sin].map(DVec3::from_array);
        let mut sum = 0.0;
        for panel in 0..64 {
            let at = |k: i32| from + (to - from) * f64::from(k) / 64.0;
            visit(&POINTS_16, at(panel), at(panel + 1), |t, weight| {
                let q = c + t.cos() * x + t.sin() * y;
                sum += weight * q.cross(t.cos() * y - t.sin() * x).z / q.length_squared();
            });
        }
        sum
    }

    #[test]
    fn arcs_agree_with_quadrature_in_both_precisions() {
        let mut compared = 0;
        Stream::new(7, "arcs").visit(0, 400, |_, draw| {
            let frame = draw.frame();
            let center = draw.log_uniform(0.3, 30.0) * draw.direction();
            let (x, y) = (frame.x_axis, draw.uniform(0.1, 1.0) * (frame.y_axis + 0.3 * frame.x_axis));
            let ellipse = Ellipse {
                center: center.to_array(),
                cos: x.to_array(),
                sin: y.to_array(),
                volume: center.dot(x.cross(y)),
            };
            let (from, to) = (draw.uniform(-3.0, 0.0), draw.uniform(0.1, 3.0));
            let nearest = (0..1000)
                .map(|k| {
                    norm(ellipse.at([f64::cos(f64::from(k) * 0.01), f64::sin(f64::from(k) * 0.01)]).into())
                })
                .fold(f64::INFINITY, f64::min);
            // Panels are a tenth of a radian, and a pole nearer than that leaves digits.
            if nearest < 0.2 || ellipse.volume.abs() < 0.01 {
                return;
            }
            let cone = ellipse.cone();
            let ends = [from, to].map(|t| ellipse.at([t.cos(), t.sin()]));
            let arc = ellipse.arc(&cone, ends[0], ends[1], to - from);
            let expected = quadrature(&ellipse, from, to);
            // 36 roundings of what the term says, and of the ends, which lie that much off the rim.
            assert!(
                (arc.value - expected).abs() <= 4e-15 * (0.25 + arc.size),
                "{ellipse:?}: {arc:?} {expected}"
            );
            let whole = ellipse.whole(&cone);
            let around = quadrature(&ellipse, 0.0, TAU);
            assert!(
                (whole.value - around).abs() <= 4e-15 * (1.0 + whole.size),
                "{ellipse:?}: {whole:?} {around}"
            );

            let lift = |v: Vector<f64>| v.map(DoubleDouble::from);
            let [c, x, y] = [center.to_array(), ellipse.cos, ellipse.sin].map(lift);
            let fine = Ellipse { center: c, cos: x, sin: y, volume: dot(c, cross(x, y)) };
            let value = fine.arc(&fine.cone(), lift(ends[0]), lift(ends[1]), to - from).value.to_f64();
            assert!((value - expected).abs() <= 4e-15 * (0.25 + arc.size), "{ellipse:?}: {value} {expected}");
            compared += 1;
        });
        assert!(compared > 200, "{compared}");
    }
}
