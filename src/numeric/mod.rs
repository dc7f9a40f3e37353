//! Pure mathematics: spacing of floating-point formats, exact sums and products, quadrature, cubics, and the
//! integrals that several families share.

pub mod ball;
pub mod big;
pub mod binary16;
pub mod clipped_cone;
pub mod clipped_ellipse;
pub mod clipped_sphere;
pub mod cone_solid_angle;
pub mod conjugate_cone;
pub mod cubic;
pub mod cylinder_silhouette;
pub mod disk_rectangle;
pub mod double_double;
pub mod elliptic_arc;
pub mod exact;
pub mod exact3;
pub mod gauss_legendre;
pub mod graded_cone;
pub mod graded_polygon;
pub mod half_turn;
pub mod line_integral;
pub mod plane_rectangle;
pub mod polygon_irradiance;
pub mod products;
pub mod rotation;
pub mod slim_silhouette;
pub mod spacing;
pub mod symmetric3;
pub mod twofold;
pub mod visible_segment;
pub mod vulkan_limits;
