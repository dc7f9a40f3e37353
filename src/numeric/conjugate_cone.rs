//! The irradiance from an ellipse of which vectors are known, however its cone is graded.
//!
//! The dual quadric S = A A^T + B B^T - C C^T of an ellipse's semi-axes A, B and centre C forgets the short ones where
//! lengths differ by more than the root of its precision. Here the cone is taken apart in the ellipse's own frame (along A,
//! across it, normal), where every coordinate is known relatively: what is across is area over length, and the centre's
//! distances from A and from the plane are moment and volume over what they belong to. With l the one positive root of
//!
//! ```text
//! (alpha l + beta)/((l + h1)(l + h2)) + z^2/l = 1          h1, h2: eigenvalues of H = A A^T + B B^T
//! alpha = x^2 + y^2     beta = (x, y) adj(H) (x, y)          z: the centre over the plane
//! ```
//!
//! W3 is along ((H + l)^-1 (x, y), z/l). The hyperbolic rotation that takes C to W3 sqrt(l) takes A and B to conjugate
//! semi-axes across W3 that have the same S; one rotation in their plane makes them the principal ones. All in [`Ball`]s: what
//! rounding and the vectors' own errors leave of the result is known with it.
//!
//! Source: ours; the one-sided rotation that keeps small axes is Hestenes's (1958).

use glam::{DMat3, DVec3};

use super::ball::{Ball, Middle};
use super::clipped_cone::{Number, Principal};
use super::exact3;
use super::graded_cone::{Known, PERCENT};
use super::products;
use super::twofold::Twofold;
use super::visible_segment::{Integral, Segment};

/// Three coordinates.
pub type Vector<M> = [Ball<M>; 3];

/// An ellipse as it is from the origin, not in a plane with it. Of any scale, and any scales within.
#[derive(Clone, Copy, Debug)]
pub struct ConjugateCone<M> {
    /// C, A, B: centre and conjugate semi-axes.
    pub images: [Vector<M>; 3],
    /// A x B, C x A and C x B.
    pub products: [Vector<M>; 3],
    /// [C, A, B].
    pub volume: Ball<M>,
    /// A.z^2 + B.z^2 - C.z^2.
    pub szz: Ball<M>,
}

/// The disk that covers a sphere.
#[derive(Clone, Copy, Debug)]
pub struct Silhouette<M> {
    pub center: Vector<M>,
    pub distance: Ball<M>,
    pub radius: Ball<M>,
    /// Unit vectors across the centre's direction and each other.
    pub across: [Vector<M>; 2],
}

impl<M: Middle> Silhouette<M> {
    /// Of a sphere of f32 values; `outside` is the centre's distance squared less the radius squared.
    pub fn new(center: DVec3, radius: f64, outside: Ball<M>) -> Self {
        let c = vector(center);
        let distance = dot(&c, &c).sqrt();
        let size = center.abs();
        let i = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        // Every component is a product: none is less known than the others.
        let (mut u1, mut u2) = ([Ball::ZERO; 3], [Ball::ZERO; 3]);
        let level = c[i].hypot(c[j]);
        (u1[i], u1[j]) = (-c[j] / level, c[i] / level);
        let by = Ball::ONE / (level * distance);
        (u2[i], u2[j], u2[k]) = (-c[k] * c[i] * by, -c[k] * c[j] * by, level / distance);
        let radius = distance * Ball::exact(radius).abs() / outside.sqrt();
        Silhouette { center: c, distance, radius, across: [u1, u2] }
    }
}

/// What is seen of it.
#[derive(Clone, Copy, Debug)]
pub struct Seen<M> {
    /// The irradiance as a share of the full hemisphere's.
    value: Ball<M>,
    /// C, A and B in the principal frame.
    pub images: [Vector<M>; 3],
    /// The principal axes.
    axes: [Vector<M>; 3],
    cone: Principal<Ball<M>>,
    szz: Ball<M>,
    /// G with dE = sum of G_ij dS_ij in their frame: xx, yy, zz, xy, xz, yz.
    gradient: [Ball<M>; 6],
}

impl<M: Middle> Seen<M> {
    /// With the sum of all changes |x dE/dx|: what of either has not lost its digits.
    pub fn with_sensitivity(&self, sum: Ball<M>) -> Known {
        let value = self.value;
        Known {
            // No more than all of the hemisphere, within the bound.
            irradiance: (value > Ball::ZERO && value.relative() <= ACCURACY)
                .then(|| (value.value().min(1.0), value.error())),
            sensitivity: (sum.relative() <= PERCENT).then(|| sum.value()),
            most: sum.value() + sum.error(),
        }
    }

    /// The same by integrals of what is positive, for cones that the horizon cuts: what is not `known` already.
    pub fn by_lines(mut self, known: &Known) -> Option<Self> {
        let Cut { segment, unit, share, axes: [a, b, c], swing } = Cut::new(&self.cone, self.szz)?;
        let square = unit * unit;
        let within = |(value, error): Integral| Ball::within(value, error + share * value.abs()) / square;
        let pi = Ball::pi(53);
        if known.irradiance.is_none() {
            self.value = a * b * c * swing / pi * within(segment.irradiance()?);
        }
        if known.sensitivity.is_none() {
            // The tangent planes' normals are (cos u/a, sin u/b, -1/c).
            let scale = swing / (pi << 1);
            let by = [b * c / a, a * c / b, a * b / c, c, -b, -a];
            let rim = segment.rim()?.map(within);
            self.gradient = std::array::from_fn(|i| self.gradient[i].or(scale * by[i] * rim[i]));
        }
        Some(self)
    }

    /// G v in the principal frame.
    pub fn by(&self, [x, y, z]: &Vector<M>) -> Vector<M> {
        let (x, y, z) = (*x, *y, *z);
        let [xx, yy, zz, xy, xz, yz] = self.gradient;
        [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
    }

    /// Those of the dual quadric.
    pub fn eigenvalues(&self) -> Vector<M> {
        [self.cone.e1, self.cone.e3, -self.cone.l]
    }

    /// A vector of the principal frame in the world's.
    pub fn in_world(&self, v: &Vector<M>) -> Vector<M> {
        mapped(&self.axes, v)
    }

    /// A vector of the world's frame in the principal one.
    pub fn in_frame(&self, v: &Vector<M>) -> Vector<M> {
        self.axes.map(|axis| dot(&axis, v))
    }
}

/// The bound that more digits are asked for at, as a share of the value.
const ACCURACY: f64 = 1.0 / (1u64 << 36) as f64;

/// What sums of exact products lose of their terms, 2^-102.
const PAIRS: f64 = 1.0 / (1u128 << 102) as f64;

/// What a length adds to others that are 2^60 times as much.
const NOTHING: isize = 60;

/// An ellipse is round where half the difference of e1 and e3 is below this power of 1/2 of their sum.
const ROUND: isize = 7;

/// Steps towards l, each of which has the digits of the one before twice.
const STEPS: usize = 64;

/// These very numbers.
pub fn vector<M: Middle>(v: DVec3) -> Vector<M> {
    v.to_array().map(Ball::exact)
}

pub fn dot<M: Middle>(a: &Vector<M>, b: &Vector<M>) -> Ball<M> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<M: Middle>(a: &Vector<M>, b: &Vector<M>) -> Vector<M> {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The rows of the inverse of the matrix of these columns, of f32 values.
pub fn duals<M: Middle>(columns: &[DVec3; 3]) -> [Vector<M>; 3] {
    let [a, b, c] = *columns;
    let by_volume = Ball::ONE / Ball::sum(&exact3::determinant_terms(a, b, c), 0.0);
    let cofactors = products::cofactors(&DMat3::from_cols(a, b, c));
    cofactors.map(|row| row.map(|minor| Ball::near(minor, 0.0) * by_volume))
}

/// The matrix of these columns times v.
fn mapped<M: Middle>(columns: &[Vector<M>; 3], v: &Vector<M>) -> Vector<M> {
    [0, 1, 2].map(|row| columns[0][row] * v[0] + columns[1][row] * v[1] + columns[2][row] * v[2])
}

fn scaled<M: Middle>(v: &Vector<M>, by: Ball<M>) -> Vector<M> {
    v.map(|component| component * by)
}

/// The ellipse in its own frame.
struct Local<M> {
    /// Unit vectors along A, across and normal.
    frame: [Vector<M>; 3],
    along: Ball<M>,
    shear: Ball<M>,
    across: Ball<M>,
    center: Vector<M>,
    /// adj(H) (x, y).
    turned: [Ball<M>; 2],
    sum: Ball<M>,
    product: Ball<M>,
    alpha: Ball<M>,
    beta: Ball<M>,
    kappa: Ball<M>,
    /// Of C, A and B in the world.
    heights: Vector<M>,
}

/// The principal frame.
struct Framed<M> {
    cone: Principal<Ball<M>>,
    /// Its axes in the ellipse's own frame.
    axes: [Vector<M>; 3],
    /// C, A and B in it.
    images: [Vector<M>; 3],
}

impl<M: Middle> ConjugateCone<M> {
    /// Of `light`, centre and conjugate semi-axes, under `minv`, all of f32 values; `szz` is known better than from their images.
    pub fn of_ellipse(minv: &[DVec3; 3], light: &[DVec3; 3], szz: Ball<M>) -> Self {
        let [c, a, b] = *light;
        let [of_minv, of_light] =
            [minv, light].map(|m| Ball::sum(&exact3::determinant_terms(m[0], m[1], m[2]), 0.0));
        let volume = of_minv * of_light;
        let cofactors = products::cofactors(&DMat3::from_cols(minv[0], minv[1], minv[2]));
        let product = |p: DVec3, q: DVec3| {
            let terms = products::cofactors_times_terms(&cofactors, &products::cross(p, q));
            terms.map(|terms| Ball::short_sum(&terms))
        };
        let image = |v: DVec3| {
            [0, 1, 2].map(|row| {
                let terms = [minv[0][row] * v.x, minv[1][row] * v.y, minv[2][row] * v.z];
                let sum = Twofold::sum3(terms[0], terms[1], terms[2]);
                let size = terms[0].abs() + terms[1].abs() + terms[2].abs();
                Ball::near((sum.hi, sum.lo), PAIRS * size)
            })
        };
        let products = [product(a, b), product(c, a), product(c, b)];
        ConjugateCone { images: light.map(image), products, volume, szz }
    }

    /// Of a sphere around `center`, from outside, by its silhouette: a disk about the same centre with half axes `radius` times those
    /// two unit vectors across. `radius` is the distance times the tangent of the angle that it is seen under.
    pub fn of_sphere(minv: &[DVec3; 3], silhouette: &Silhouette<M>, szz: Ball<M>) -> Self {
        let Silhouette { center, distance, radius, across: [u1, u2] } = silhouette;
        let matrix = DMat3::from_cols(minv[0], minv[1], minv[2]);
        let columns = minv.map(vector);
        let cofactors = products::cofactors(&matrix).map(|column| column.map(|minor| Ball::near(minor, 0.0)));
        let area = *radius * *radius;
        let [of_center, of_1, of_2] = [center, u1, u2].map(|v| mapped(&columns, v));
        let images = [of_center, scaled(&of_1, *radius), scaled(&of_2, *radius)];
        let moment = *distance * *radius;
        let [of_center, of_1, of_2] = [center, u1, u2].map(|v| mapped(&cofactors, v));
        let products = [scaled(&of_center, area / *distance), scaled(&of_2, moment), scaled(&of_1, -moment)];
        let volume = Ball::sum(&exact3::determinant_terms(minv[0], minv[1], minv[2]), 0.0) * area * *distance;
        ConjugateCone { images, products, volume, szz }
    }

    /// The irradiance on a plane with normal +z; nothing where this arithmetic does not do.
    pub fn irradiance(&self) -> Option<Seen<M>> {
        let [_, a, b] = &self.images;
        let first_is_longer = dot(a, a).is_above(dot(b, b));
        let local = self.local(first_is_longer);
        let l = local.root()?;
        let Framed { cone, axes, images: [center, longer, other] } = local.principal(l)?;
        let (value, rim) = cone.irradiance(&self.szz, 53)?;
        let gradient = cone.gradient(&rim, 53);
        let (a, b) =
            if first_is_longer { (longer, other) } else { (other.map(|component| -component), longer) };
        let axes = local.turned_up(&axes, cone.heights);
        Some(Seen { value, images: [center, a, b], axes, cone, szz: self.szz, gradient })
    }

    fn local(&self, first_is_longer: bool) -> Local<M> {
        let [c, a, b] = self.images;
        let [normal, of_a, of_b] = self.products;
        // A quarter turn of the pair leaves the ellipse.
        let (a, b, of_a, of_b) = if first_is_longer {
            (a, b, of_a, of_b)
        } else {
            (b, a.map(|component| -component), of_b, of_a.map(|component| -component))
        };
        let (along, area) = (dot(&a, &a).sqrt(), dot(&normal, &normal).sqrt());
        let (by_along, by_area) = (Ball::ONE / along, Ball::ONE / area);
        let across = area * by_along;
        let shear = dot(&a, &b) * by_along;
        // [A, C] and [B, C] in the plane.
        let (turn_a, turn_b) = (-dot(&normal, &of_a) * by_area, -dot(&normal, &of_b) * by_area);
        let (x, y) = (dot(&a, &c) * by_along, turn_a * by_along);
        let z = self.volume * by_area;
        let turn_b = turn_b.or(shear * y - across * x);
        let (e1, e3) = (scaled(&a, by_along), scaled(&normal, by_area));
        let e2 = cross(&e3, &e1);
        let by_across = Ball::ONE / across;
        let e2 = [0, 1, 2].map(|k| e2[k].or((b[k] - shear * e1[k]) * by_across));
        let turned = [-across * turn_b, along * turn_a + shear * turn_b];
        Local {
            frame: [e1, e2, e3],
            along,
            shear,
            across,
            center: [x, y, z],
            turned,
            sum: along * along + shear * shear + across * across,
            product: (along * across) * (along * across),
            alpha: x * x + y * y,
            beta: turn_a * turn_a + turn_b * turn_b,
            kappa: turned[0] * turned[0] + turned[1] * turned[1],
            heights: [c[2], a[2], b[2]],
        }
    }
}

impl<M: Middle> Local<M> {
    /// l: steps of which each has one pole for both, with their value and slope; the last one says how far off it is.
    fn root(&self) -> Option<Ball<M>> {
        let &Local { along, shear, across, center: [x, y, z], sum, product, alpha, beta, kappa, .. } = self;
        let height = z * z;
        let on = [along * x, shear * x + across * y];
        let gamma = on[0] * on[0] + on[1] * on[1];
        let [height_0, product_0, alpha_0, beta_0, kappa_0, gamma_0] =
            [height, product, alpha, beta, kappa, gamma].map(Ball::middle);
        let mut l = height_0 + alpha_0;
        for _ in 0..STEPS {
            let above = alpha_0 * l + beta_0;
            let slope = (alpha_0 * l + beta_0 + beta_0) * l + kappa_0;
            let next = if slope.is_zero() {
                height_0
            } else {
                let pole = ((gamma_0 * l + product_0 * alpha_0 + product_0 * alpha_0) * l
                    + beta_0 * product_0)
                    / slope;
                let strength = above * above / slope;
                // l^2 + (pole - strength - z^2) l - z^2 pole = 0.
                let half = (strength + height_0 - pole) >> 1;
                let length = (half * half + height_0 * pole).sqrt();
                if half.is_above(Ball::ZERO) { half + length } else { height_0 * pole / (length - half) }
            };
            let next = next.middle();
            let moving = ((next - l).abs() << 50).is_above(l);
            l = next;
            if !moving {
                break;
            }
        }
        // The sum falls with l, and is convex: between l and the root its slope is no flatter than where it is flatter.
        let square = (l + sum) * l + product;
        let (poles, plane) = ((alpha * l + beta) / square, height / l);
        let slope = ((alpha * l + beta + beta) * l + kappa) * l / (square * square) + plane;
        let off = (poles + plane - Ball::ONE).largest() / slope;
        let relative = off.largest();
        // At 1 + r times l the slope is at least that over (1 + r)^3.
        (relative < Ball::exact(1e-8)).then(|| l.widened(relative * Ball::exact(1.000_001)))
    }

    /// The principal frame of -l.
    fn principal(&self, l: Ball<M>) -> Option<Framed<M>> {
        let &Local { along, shear, across, center: [x, y, z], turned, sum, product, beta, kappa, .. } = self;
        let share = z * z / l;
        let square = (l + sum) * l + product;
        // e1 + e3 and e1 e3.
        let (both, least) = ((l * beta + kappa) / square + sum * share, product * share);

        let w = [(l * x + turned[0]) / square, (l * y + turned[1]) / square, z / l];
        let length = dot(&w, &w).sqrt();
        let w3 = scaled(&w, Ball::ONE / length);
        let root = l.sqrt();
        // What A and B have of W3, over sqrt(l), and the rotation that takes it from them.
        let (of_a, of_b) = (along * w3[0] / root, (shear * w3[0] + across * w3[1]) / root);
        let gamma = (Ball::ONE + of_a * of_a + of_b * of_b).sqrt();
        let from = Ball::ONE / (Ball::ONE + gamma);
        let u = [(of_a * along + of_b * shear) * from - x, of_b * across * from - y, -z];
        let a = across_axis([along + of_a * u[0], of_a * u[1], of_a * u[2]], &w3);
        let b = across_axis([shear + of_b * u[0], across + of_b * u[1], of_b * u[2]], &w3);

        let (tau, skew) = ((dot(&a, &a) - dot(&b, &b)) >> 1, dot(&a, &b));
        let h = tau.hypot(skew);
        let e1 = (both >> 1) + h;
        let e3 = least / e1;
        // Near a circle any turn of the pair does, to q = what its squares and product are then off by: G has no negative
        // eigenvalue, so 2 |Gxy q| <= (Gxx + Gyy) |q|, which is what e1 and e3 are widened by; and a little for h, rounded.
        let round = !(h << ROUND).is_above(both);
        let slack = if round { (tau.radius() + skew.radius()) / e3 * Ball::exact(1.125) } else { Ball::ZERO };
        let (e1, e3) = (e1.widened(slack), e3.widened(slack));
        let (tau, skew, h) = if round { (tau.middle(), skew.middle(), h.middle()) } else { (tau, skew, h) };
        let (cos, sin) = if h.is_zero() {
            (Ball::ONE, Ball::ZERO)
        } else {
            let half = |x: Ball<M>| ((Ball::ONE + x / h) >> 1).sqrt();
            if tau.is_above(Ball::ZERO) {
                let cos = half(tau);
                (cos, (skew >> 1) / (h * cos))
            } else {
                let sin = half(-tau);
                ((skew >> 1) / (h * sin), sin)
            }
        };
        let first: Vector<M> = [0, 1, 2].map(|k| cos * a[k] + sin * b[k]);
        let w1 = scaled(&first, Ball::ONE / dot(&first, &first).sqrt());
        let second: Vector<M> = [0, 1, 2].map(|k| cos * b[k] - sin * a[k]);
        let w2 = cross(&w3, &w1);
        // The root of e3 by the sense of this pair: a turn from A to B may go either way around W3.
        let sense = dot(&w2, &second);
        let r2 = if sense.is_above(Ball::ZERO) { e3.sqrt() } else { -e3.sqrt() };
        let certain = sense.relative() < 1.0;
        let w2 = if round { w2 } else { [0, 1, 2].map(|k| w2[k].or(second[k] / r2)) };
        // The rotations back, in units of the roots of the eigenvalues.
        let r1 = e1.sqrt();
        let (g1, g2) = (of_a * cos + of_b * sin, of_b * cos - of_a * sin);
        let images = [
            [r1 * g1, r2 * g2, root * gamma],
            [r1 * (cos + of_a * from * g1), r2 * (of_a * from * g2 - sin), root * of_a],
            [r1 * (sin + of_b * from * g1), r2 * (cos + of_b * from * g2), root * of_b],
        ];
        // Heights of the axes, or what the images' heights say of them: that of S W_k is its eigenvalue times that of W_k.
        let heights = self.frame.map(|axis| axis[2]);
        let [of_c, of_a, of_b] = self.heights;
        let said = |k: usize| images[1][k] * of_a + images[2][k] * of_b - images[0][k] * of_c;
        let [up, level, middle] = [w1, w2, w3].map(|axis| dot(&axis, &heights));
        let [up, level, middle] = [up.or(said(0) / e1), level.or(said(1) / e3), middle.or(-said(2) / l)];
        let turned = Ball::up_to(slack * up.hypot(level));
        let [up, level] = [up + turned, level + turned];
        // A low centre says how low the axis through it is.
        let [along_1, along_2, along_3] = images[0];
        let heights = [up, level, middle.or((of_c - along_1 * up - along_2 * level) / along_3)];
        let volume = along * across * z.abs();
        let cone = Principal { e1, e3, l, volume, heights };
        certain.then_some(Framed { cone, axes: [w1, w2, w3], images })
    }

    /// Principal axes in the world, whose heights are known.
    fn turned_up(&self, axes: &[Vector<M>; 3], heights: [Ball<M>; 3]) -> [Vector<M>; 3] {
        let [mut w1, mut w2, mut w3] = axes.map(|axis| mapped(&self.frame, &axis));
        for (axis, height) in [&mut w1, &mut w2, &mut w3].into_iter().zip(heights) {
            axis[2] = axis[2].or(height);
        }
        let (w1, w2) = (across_axis(w1, &w3), across_axis(w2, &w3));
        let w2 = across_axis(w2, &w1);
        [across_axis(w1, &w2), w2, across_axis(across_axis(w3, &w1), &w2)]
    }
}

/// A cone that the horizon cuts.
struct Cut<M> {
    /// What is above the horizon, in units of some square.
    segment: Segment,
    unit: Ball<M>,
    /// What lengths leave unknown of any integral, as a share of it.
    share: f64,
    /// The roots of e1, e3 and l.
    axes: [Ball<M>; 3],
    /// Half of what the heights of its rim differ by.
    swing: Ball<M>,
}

impl<M: Middle> Cut<M> {
    /// Nothing where lengths leave the range of f64.
    fn new(cone: &Principal<Ball<M>>, szz: Ball<M>) -> Option<Self> {
        let &Principal { e1, e3, l, heights: [z1, z2, z3], .. } = cone;
        if !(szz > Ball::ZERO) {
            return None;
        }
        let axes = [e1.sqrt(), e3.sqrt(), l.sqrt()];
        let (m1, m2, m3) = (e1 * z1 * z1, e3 * z2 * z2, l * z3 * z3);
        let m = (szz + m3).or(m1 + m2);
        let swing = m.sqrt();
        let (cos0, sin0) = (z1 * axes[0] / swing, z2 * axes[1] / swing);
        let (cos_d, sin_d) = (-(z3 * axes[2] / swing), szz.sqrt() / swing);
        // Of sums and differences of u0 and d that which is small is what their product says.
        let both = |sum: Ball<M>, difference: Ball<M>, product: Ball<M>| {
            let (sum, difference) = (sum.or(product / difference), difference.or(product / sum));
            (difference, sum)
        };
        let cosines = (m3 - m2).or(m1 - szz) / m;
        let sines = (m3 - m1).or(m2 - szz) / m;
        let (cos1, cos2) = both(cos0 * cos_d - sin0 * sin_d, cos0 * cos_d + sin0 * sin_d, cosines);
        let (sin1, sin2) = both(sin0 * cos_d + cos0 * sin_d, sin0 * cos_d - cos0 * sin_d, sines);

        // One of the two may be known to less than the angle is.
        let turn = |cos: Ball<M>, sin: Ball<M>| {
            let off = cos.error() * sin.value().abs() + sin.error() * cos.value().abs();
            let length = libm::hypot(cos.value(), sin.value());
            ((cos.value() / length, sin.value() / length), off)
        };
        let (middle, off_middle) = turn(cos0, sin0);
        let (half, off_half) = turn(cos_d, sin_d);
        let (first, off_first) = turn(cos1, sin1);
        let (second, off_second) = turn(cos2, sin2);
        // What is not told from 0 beside the rest: l of a cone whose middle is below the horizon, e3 of a needle.
        let (flat, slim) = (
            cos_d > Ball::ZERO && l < (e3 * cos_d * cos_d) >> NOTHING,
            e3 < (l * sin0 * sin0) >> NOTHING && e3 * cos0 * cos0 < (e1 * sin0 * sin0) >> NOTHING,
        );
        // No integral is of a higher order than the second in any eigenvalue, nor than the fifth in d.
        let share = 4.0 * (e1.relative() + e3.relative() + l.relative())
            + 6.0 * off_half / libm::atan2(half.1, half.0)
            + 8.0 * libm::ldexp(1.0, -(NOTHING as i32));
        let least = if flat || (e3 < l && !slim) { e3 } else { l };
        let most = if e1.is_above(l) { e1 } else { l };
        let unit = (most * least).sqrt().middle();
        let share_of = |x: Ball<M>, is_nothing: bool| if is_nothing { 0.0 } else { (x / unit).value() };
        let [e1, e3, l] = [share_of(e1, false), share_of(e3, slim), share_of(l, flat)];
        let segment = Segment {
            e1,
            e3,
            l,
            middle,
            half,
            ends: [first, second],
            off: (off_middle, off_half, [off_first, off_second]),
        };
        // Products of three squares are within f64's, and lines are no shorter.
        let e3_or_1 = if slim { 1.0 } else { e3 };
        let (l_or_1, least_cos) = if flat { (1.0, half.0) } else { (l, 1.0) };
        let in_range = [e1, e3_or_1, l_or_1, segment.along(), half.1, least_cos]
            .into_iter()
            .all(|x| (1e-99..1e99).contains(&x));
        (in_range && share < 1.0).then_some(Cut { segment, unit, share, axes, swing })
    }
}

/// v, which is across the unit vector `axis`: what lies along it most, from the rest, if that is better.
fn across_axis<M: Middle>(v: Vector<M>, axis: &Vector<M>) -> Vector<M> {
    let size = axis.map(Ball::abs);
    let most = (0..3).fold(0, |most, k| if size[k].is_above(size[most]) { k } else { most });
    let (i, j) = ((most + 1) % 3, (most + 2) % 3);
    let mut v = v;
    v[most] = v[most].or(-(v[i] * axis[i] + v[j] * axis[j]) / axis[most]);
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of radius r straight above at 1 under a Minv that stretches z by s: (r/s)^2/(1 + (r/s)^2), at any scale, and of
    /// every height what scale leaves of it.
    #[test]
    fn circles_of_any_size_are_their_sine_squared() {
        for exponent in [-120, -10, 0, 7, 100] {
            let s = libm::ldexp(1.0, exponent);
            let (minv, light) = ([DVec3::X, DVec3::Y, s * DVec3::Z], [DVec3::Z, DVec3::X, DVec3::Y]);
            let height = Ball::<f64>::exact(s);
            let cone = ConjugateCone::of_ellipse(&minv, &light, -(height * height));
            let seen = cone.irradiance().unwrap();
            let expected = 1.0 / (1.0 + s * s);
            let (value, bound) = seen.with_sensitivity(Ball::ZERO).irradiance.unwrap();
            assert!((value - expected).abs() <= bound, "{s}: {seen:?} {expected}");
            assert!(bound <= 1e-13 * expected, "{s}: {seen:?}");
            // E = aa/(aa + cc): dE/da over 2 a for each of two axes, and dE/dc.
            let [of_c, of_a, of_b] = seen.images.map(|image| seen.in_world(&seen.by(&image)));
            let slope = s * s * expected * expected;
            for (found, expected) in [(of_c[2], slope / s), (of_a[0], 0.5 * slope), (of_b[1], 0.5 * slope)] {
                assert!((found.value() / expected - 1.0).abs() < 1e-12, "{s}: {found:?} {expected}");
            }
        }
    }

    /// A light that the point is on has no frame, and one below the horizon no irradiance.
    #[test]
    fn what_is_not_seen_is_left_to_others() {
        let minv = [DVec3::X, DVec3::Y, DVec3::Z];
        let seen = |light: [DVec3; 3], szz: f64| {
            let cone = ConjugateCone::of_ellipse(&minv, &light, Ball::<f64>::exact(szz));
            cone.irradiance().and_then(|seen| seen.with_sensitivity(Ball::ONE).irradiance)
        };
        assert!(seen([DVec3::X, DVec3::X, DVec3::Y], 0.0).is_none());
        assert!(seen([-DVec3::Z, DVec3::X, DVec3::Y], -1.0).is_none());
    }
}
