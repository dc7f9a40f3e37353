//! Pure mathematics: spacing of floating-point formats, exact sums and products, quadrature, cubics, and the
//! integrals that several families share.

pub mod cubic;
pub mod exact;
pub mod gauss_legendre;
pub mod line_integral;
pub mod products;
pub mod spacing;
