//! Pure mathematics: spacing of floating-point formats, exact sums, double-double numbers, irradiance of polygons.

pub mod double_double;
pub mod exact;
pub mod polygon_irradiance;
pub mod spacing;
