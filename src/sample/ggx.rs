//! Inverse LTC matrices of the GGX material.

use glam::DMat3;

/// Minv, column-major, of a GGX material of `roughness` (alpha = roughness^2, in 0..1) seen at `cos_theta` in 0..1:
/// it takes directions in the shading frame (normal +z, viewer in the xz plane) to where the lobe is a cosine.
pub fn minv(roughness: f64, cos_theta: f64) -> DMat3 {
    // Provisional: isotropic width of the lobe, sheared towards the mirror direction, until the fitted table is in.
    let alpha = (roughness * roughness).max(1e-3);
    let sin = libm::sqrt(1.0 - cos_theta * cos_theta);
    let frame = DMat3::from_cols_array(&[cos_theta, 0.0, -sin, 0.0, 1.0, 0.0, sin, 0.0, cos_theta]);
    (frame * DMat3::from_diagonal(glam::DVec3::new(alpha, alpha, 1.0))).inverse()
}
