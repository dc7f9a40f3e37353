//! Pure mathematics: spacing of floating-point formats, exact sums and products, quadrature, cubics, and the
//! integrals that several families share.

pub mod binary16;
pub mod clipped_ellipse;
pub mod clipped_sphere;
pub mod cubic;
pub mod exact;
pub mod exact3;
pub mod gauss_legendre;
pub mod line_integral;
pub mod products;
pub mod spacing;
pub mod twofold;
