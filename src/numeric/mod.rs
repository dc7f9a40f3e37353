//! Pure mathematics: spacing of floating-point formats, exact sums and products, quadrature, integrals along lines.

pub mod cylinder_silhouette;
pub mod exact;
pub mod gauss_legendre;
pub mod line_integral;
pub mod products;
pub mod spacing;
