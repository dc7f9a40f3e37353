//! The rotation that a quaternion of f32 components stands for.

use glam::{DMat3, DVec3};

use super::big::{self, Big};
use super::exact3;
use super::twofold::Twofold;

/// The rotation of q/|q|, to 2^-98.
#[derive(Clone, Copy, Debug)]
pub struct Rotation {
    pub columns: [exact3::Vector; 3],
    vector: DVec3,
    scalar: f64,
}

impl Rotation {
    /// From the four components, f32 values.
    pub fn new(q: &[f32]) -> Self {
        let largest = q.iter().fold(0.0f32, |largest, v| largest.max(v.abs()));
        // A power of two, so that squares stay in range; q = 0 is the identity.
        let scale = libm::ldexp(1.0, -libm::frexp(f64::from(largest)).1);
        let [x, y, z, mut w] = std::array::from_fn(|i| f64::from(q[i]) * scale);
        if largest == 0.0 {
            w = 1.0;
        }
        let p = Twofold::product;
        let norm = p(x, x) + p(y, y) + p(z, z) + p(w, w);
        let twice = norm.recip() * 2.0;
        let one = Twofold::from(1.0);
        let diagonal = |a: f64, b: f64| one - (p(a, a) + p(b, b)) * twice;
        let (plus, minus) = (
            |a: f64, b: f64, v: f64| (p(a, b) + p(v, w)) * twice,
            |a: f64, b: f64, v: f64| (p(a, b) - p(v, w)) * twice,
        );
        let columns = [
            [diagonal(y, z), plus(x, y, z), minus(x, z, y)],
            [minus(x, y, z), diagonal(x, z), plus(y, z, x)],
            [plus(x, z, y), minus(y, z, x), diagonal(x, y)],
        ];
        Rotation { columns, vector: DVec3::new(x, y, z), scalar: w }
    }

    /// The matrix, every entry rounded once.
    pub fn matrix(&self) -> DMat3 {
        let column = |k: usize| DVec3::from_array(self.columns[k].map(|component| component.value()));
        DMat3::from_cols(column(0), column(1), column(2))
    }

    /// The columns of |q|^2 R, and |q|^2, exactly but for q's power of two.
    pub fn exact(&self) -> ([big::Vector; 3], Big) {
        let [x, y, z] = big::vector(self.vector);
        let w = big::exact(self.scalar);
        let (xx, yy, zz, ww) = (&x * &x, &y * &y, &z * &z, &w * &w);
        let columns = [
            [&ww + &xx - &yy - &zz, (&x * &y + &z * &w) << 1, (&x * &z - &y * &w) << 1],
            [(&x * &y - &z * &w) << 1, &ww - &xx + &yy - &zz, (&y * &z + &x * &w) << 1],
            [(&x * &z + &y * &w) << 1, (&y * &z - &x * &w) << 1, &ww - &xx - &yy + &zz],
        ];
        (columns, ww + xx + yy + zz)
    }

    /// By which small vector the rotation turns for a relative change of each component of q by one: a change dq turns by
    /// 2 dq conj(q)/|q|^2.
    pub fn turns(&self) -> [DVec3; 4] {
        let (v, w) = (self.vector, self.scalar);
        let twice = 2.0 / (v.length_squared() + w * w);
        let of_axis = |axis: DVec3, q: f64| twice * q * (w * axis - axis.cross(v));
        [of_axis(DVec3::X, v.x), of_axis(DVec3::Y, v.y), of_axis(DVec3::Z, v.z), -twice * w * v]
    }

    /// The sum over q's components of |q_i dE/dq_i| for `product` = R D^2 R^T G with G = dE/dS: a turn by the small
    /// vector t changes E by the torque times t.
    pub fn sensitivity(&self, product: DMat3) -> f64 {
        let at = |row: usize, column: usize| product.col(column)[row];
        let torque = 2.0 * DVec3::new(at(1, 2) - at(2, 1), at(2, 0) - at(0, 2), at(0, 1) - at(1, 0));
        self.turns().into_iter().map(|turn| torque.dot(turn).abs()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_length_serves_and_none_is_the_identity() {
        let q = [0.5f32, -0.25, 0.75, 0.125];
        let unit = Rotation::new(&q).matrix();
        let expected = glam::DQuat::from_array(q.map(f64::from)).normalize();
        assert!(unit.abs_diff_eq(DMat3::from_quat(expected), 1e-15));
        assert!(Rotation::new(&q.map(|v| v * 3e30)).matrix().abs_diff_eq(unit, 1e-7));
        assert_eq!(Rotation::new(&[0.0; 4]).matrix(), DMat3::IDENTITY);
    }

    #[test]
    fn turns_are_what_changes_do() {
        let q = [0.5f32, -0.25, 0.75, 0.125];
        let rotation = Rotation::new(&q);
        let step = 2f32.powi(-12);
        for (k, turn) in rotation.turns().into_iter().enumerate() {
            let mut changed = q;
            changed[k] *= 1.0 + step;
            let between = Rotation::new(&changed).matrix() * rotation.matrix().transpose();
            let found = 0.5
                * DVec3::new(
                    between.y_axis.z - between.z_axis.y,
                    between.z_axis.x - between.x_axis.z,
                    between.x_axis.y - between.y_axis.x,
                );
            // Second order.
            assert!((found / f64::from(step) - turn).length() < 2e-3, "{k}: {found} {turn}");
        }
    }
}
