//! Pure mathematics: spacing of floating-point formats, exact sums, cones of light.

pub mod clipped_ellipse;
pub mod exact;
pub mod exact3;
pub mod spacing;
pub mod twofold;
