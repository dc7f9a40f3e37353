//! Pure mathematics: spacing of floating-point formats, exact sums.

pub mod exact;
pub mod spacing;
