//! Pure mathematics: spacing of floating-point formats, exact sums, integrals of spheres and of elliptic cones.

pub mod binary16;
pub mod clipped_ellipse;
pub mod clipped_sphere;
pub mod exact;
pub mod exact3;
pub mod spacing;
pub mod twofold;
