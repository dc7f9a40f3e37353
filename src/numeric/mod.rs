//! Pure mathematics: spacing of floating-point formats, exact sums, cubics.

pub mod cubic;
pub mod exact;
pub mod spacing;
