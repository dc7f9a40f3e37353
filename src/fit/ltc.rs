//! The linearly transformed cosine (Heitz, Dupuy, Hill, Neubelt 2016) with the symmetry of an isotropic material.

use glam::{DMat3, DVec3};

use core::f64::consts::FRAC_1_PI;

/// A clamped cosine lobe, transformed by a matrix of the form (a 0 b; 0 c 0; d 0 e) and scaled. Only the matrix up to a
/// factor matters.
#[derive(Clone, Copy, Debug)]
pub struct Ltc {
    matrix: DMat3,
    inverse: DMat3,
    determinant: f64,
    magnitude: f64,
}

impl Ltc {
    /// From the matrix that takes cosine directions to directions of the lobe, and the lobe's integral.
    pub fn new(matrix: DMat3, magnitude: f64) -> Self {
        Ltc { matrix, inverse: matrix.inverse(), determinant: matrix.determinant().abs(), magnitude }
    }

    /// In the frame (x, y, z) with y across the plane of symmetry and z = `axis`, the matrix with columns (m11, 0, m31),
    /// (0, m22, 0) and (m13, 0, 1); as published but for m31. The axis is a unit vector in the xz plane.
    pub fn in_frame(axis: DVec3, m11: f64, m22: f64, m13: f64, m31: f64, magnitude: f64) -> Self {
        let x = DVec3::new(axis.z, 0.0, -axis.x);
        Ltc::new(DMat3::from_cols(m11 * x + m31 * axis, m22 * DVec3::Y, m13 * x + axis), magnitude)
    }

    /// The inverse matrix, scaled so that its middle element is 1, which is what tables hold.
    pub fn minv(&self) -> DMat3 {
        self.inverse * (1.0 / self.inverse.y_axis.y)
    }

    /// The lobe's integral over all directions.
    pub fn magnitude(&self) -> f64 {
        self.magnitude
    }

    /// The lobe's value, 1/sr, towards the unit vector `direction`.
    ///
    /// With q = Minv direction: magnitude/pi max(0, qz) det(Minv)/|q|^4.
    #[inline]
    pub fn eval(&self, direction: DVec3) -> f64 {
        let q = self.sparse(&self.inverse, direction);
        let q2 = q.length_squared();
        let value = self.magnitude * FRAC_1_PI * q.z / (self.determinant * q2 * q2);
        if q.z > 0.0 { value } else { 0.0 }
    }

    /// The unit vector to which `cosine`, a unit vector, is transformed, and the lobe's value there.
    #[inline]
    pub fn transform(&self, cosine: DVec3) -> (DVec3, f64) {
        let p = self.sparse(&self.matrix, cosine);
        let p2 = p.length_squared();
        let p1 = p2.sqrt();
        (p / p1, self.magnitude * FRAC_1_PI * cosine.z * p1 * p2 / self.determinant)
    }

    /// The product without the terms that are zero by symmetry.
    #[inline]
    fn sparse(&self, matrix: &DMat3, v: DVec3) -> DVec3 {
        DVec3::new(
            matrix.x_axis.x * v.x + matrix.z_axis.x * v.z,
            matrix.y_axis.y * v.y,
            matrix.x_axis.z * v.x + matrix.z_axis.z * v.z,
        )
    }
}
