//! Pure mathematics: spacing of floating-point formats, exact sums, integrals of spheres.

pub mod binary16;
pub mod clipped_sphere;
pub mod exact;
pub mod spacing;
