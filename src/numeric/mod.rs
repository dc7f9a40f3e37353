//! Pure mathematics: spacing of floating-point formats, exact sums, double-double numbers, integrals of spheres and
//! polygons.

pub mod binary16;
pub mod clipped_sphere;
pub mod double_double;
pub mod exact;
pub mod polygon_irradiance;
pub mod spacing;
