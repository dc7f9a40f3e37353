//! Where a disk's irradiance jumps: at its plane, within the rim, and over the rim in it.

use glam::{DMat3, DVec2, DVec3};

use crate::numeric::products;
use crate::numeric::spacing::UNIT_ROUNDOFF;

/// A jump that is further than 16 roundings of all inputs away is none.
const NEAR: f64 = 16.0 * UNIT_ROUNDOFF;

/// What changes of the inputs do of which no derivative knows: the irradiance's jumps where they take the point through the
/// light or, in its plane, over its rim, times how far a relative change of every input by one takes it, over how far away
/// that is; 0 where roundings do not take it there.
pub(super) fn jumps(minv: &[DVec3; 3], light: &[DVec3; 3], value: f64) -> f64 {
    let plane = volume_change(minv) + volume_change(light);
    let foot = Foot::new(minv, light);
    let mut sum = 0.0;
    // In its plane, the light is half of all directions to who is within, and nothing to others.
    if plane * NEAR > 1.0 && foot.radius < 1.0 {
        sum += (1.0 - 2.0 * value).abs() * plane;
    }
    let rim = foot.moves / (foot.radius - 1.0).abs();
    // Above the plane by no more than the roundings move it within, it goes over the rim at once.
    if rim * NEAR > 1.0 && foot.height.abs() < NEAR * foot.moves * foot.reach {
        let within = 0.5 * (1.0 + foot.height.signum() * foot.normal.z);
        sum += rim * if foot.radius < 1.0 { value } else { within };
    }
    sum
}

/// The relative change of a determinant for one of all its entries by one.
fn volume_change([a, b, c]: &[DVec3; 3]) -> f64 {
    let [of_a, of_b, of_c] = [b.cross(*c), c.cross(*a), a.cross(*b)];
    let sum = ((*a * of_a).abs() + (*b * of_b).abs() + (*c * of_c).abs()).element_sum();
    sum / a.dot(of_a).abs()
}

/// Where the point's foot is in the light's plane, after Minv.
struct Foot {
    /// Of the plane.
    normal: DVec3,
    /// Of the plane over the point, along the normal.
    height: f64,
    /// From the centre, in units of the light's own length in that direction.
    radius: f64,
    /// What a relative change of every input by one changes of that.
    moves: f64,
    /// A radius of one across the rim.
    reach: f64,
}

impl Foot {
    fn new(minv: &[DVec3; 3], [c, a, b]: &[DVec3; 3]) -> Self {
        // Cofactors map cross products, however the matrix is graded.
        let cofactors =
            DMat3::from_cols(minv[1].cross(minv[2]), minv[2].cross(minv[0]), minv[0].cross(minv[1]));
        let minv = DMat3::from_cols(minv[0], minv[1], minv[2]);
        let area = a.cross(*b);
        let normal = cofactors * area;
        let size = normal.length();
        let normal = normal / size;
        let weights = cofactors.transpose() * normal / size;
        let terms = |p: &DVec3, q: &DVec3| weights.abs().dot(products::cross_terms(*p, *q));
        let at = DVec2::new(weights.dot(c.cross(*b)), weights.dot(a.cross(*c)));
        let moved = 2.0 * (DVec2::new(terms(c, b), terms(a, c)) + at.abs() * terms(a, b));
        let radius = at.length();
        let tangent = minv * (at.x * *b - at.y * *a) / radius;
        Foot {
            normal,
            height: minv.determinant() * (c.dot(area) / size),
            radius,
            moves: at.abs().dot(moved) / radius,
            reach: size / tangent.length(),
        }
    }
}
