//! The problems: one file each, and the slice that lists them.

mod acos;
mod asin;
mod atan;
mod atan2;
mod builtin;
mod cone_axes;
mod cos;
mod disk_solid_angle;
mod div;
mod edge_integral;
mod ellipse_axes;
mod ellipse_bounds;
mod ellipse_solid_angle;
mod ellipsoid_ellipse;
mod ellipsoid_scenes;
mod ellipsoid_solid_angle;
mod exp;
mod exp2;
mod fma;
mod horizon_sphere;
mod inversesqrt;
mod latlong_solid_angle;
mod length;
mod log;
mod log2;
mod ltc_cylinder;
mod ltc_disk;
mod ltc_ellipsoid;
mod ltc_line;
mod ltc_polygon;
mod ltc_sphere;
mod ltc_strip;
mod normalize;
mod orthonormal_basis;
mod pixel_cube;
mod pixel_ortho;
mod pow;
mod problem;
mod ray_ellipse;
mod sin;
mod sqrt;
mod sym3_eigen;
mod tan;

pub use problem::{
    CERTIFIED, Landmark, MAX_COMPONENTS, MAX_OUTPUTS, Output, Problem, Quantity, Relation, Scenario, Truth,
};

/// Every family, sorted by name.
pub static FAMILIES: &[&dyn Problem] = &[
    &acos::ACOS,
    &asin::ASIN,
    &atan::ATAN,
    &atan2::ATAN2,
    &cone_axes::ConeAxes,
    &cos::COS,
    &disk_solid_angle::DiskSolidAngle,
    &div::DIV,
    &edge_integral::EdgeIntegral,
    &ellipse_axes::EllipseAxes,
    &ellipse_bounds::EllipseBounds,
    &ellipse_solid_angle::EllipseSolidAngle,
    &ellipsoid_ellipse::EllipsoidEllipse,
    &ellipsoid_solid_angle::EllipsoidSolidAngle,
    &exp::EXP,
    &exp2::EXP2,
    &fma::FMA,
    &horizon_sphere::HorizonSphere,
    &inversesqrt::INVERSESQRT,
    &latlong_solid_angle::LatlongSolidAngle,
    &length::LENGTH,
    &log::LOG,
    &log2::LOG2,
    &ltc_cylinder::LtcCylinder,
    &ltc_disk::LtcDisk,
    &ltc_ellipsoid::LtcEllipsoid,
    &ltc_line::LtcLine,
    &ltc_polygon::LtcPolygon,
    &ltc_sphere::LtcSphere,
    &ltc_strip::LtcStrip,
    &normalize::NORMALIZE,
    &orthonormal_basis::OrthonormalBasis,
    &pixel_cube::PixelCube,
    &pixel_ortho::PixelOrtho,
    &pow::POW,
    &ray_ellipse::RayEllipse,
    &sin::SIN,
    &sqrt::SQRT,
    &sym3_eigen::Sym3Eigen,
    &tan::TAN,
];

/// The family of that name.
pub fn find(name: &str) -> Option<&'static dyn Problem> {
    FAMILIES.iter().copied().find(|family| family.name() == name)
}
