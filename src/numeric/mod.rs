//! Pure mathematics: spacing of floating-point formats, exact sums, twofold numbers, cubics, eigenvalues.

pub mod cubic;
pub mod exact;
pub mod spacing;
pub mod symmetric3;
pub mod twofold;
