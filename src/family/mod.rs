//! The problems: one file each, and the slice that lists them.

mod cone_axes;
mod disk_solid_angle;
mod edge_integral;
mod ellipse_axes;
mod ellipse_solid_angle;
mod ellipsoid_ellipse;
mod ellipsoid_scenes;
mod ellipsoid_solid_angle;
mod horizon_sphere;
mod latlong_solid_angle;
mod ltc_cylinder;
mod ltc_disk;
mod ltc_ellipsoid;
mod ltc_line;
mod ltc_polygon;
mod ltc_sphere;
mod ltc_strip;
mod pixel_cube;
mod pixel_ortho;
mod problem;
mod sym3_eigen;

pub use problem::{
    CERTIFIED, Landmark, MAX_COMPONENTS, MAX_OUTPUTS, Output, Problem, Quantity, Relation, Scenario, Truth,
};

/// Every family, sorted by name.
pub static FAMILIES: &[&dyn Problem] = &[
    &cone_axes::ConeAxes,
    &disk_solid_angle::DiskSolidAngle,
    &edge_integral::EdgeIntegral,
    &ellipse_axes::EllipseAxes,
    &ellipse_solid_angle::EllipseSolidAngle,
    &ellipsoid_ellipse::EllipsoidEllipse,
    &ellipsoid_solid_angle::EllipsoidSolidAngle,
    &horizon_sphere::HorizonSphere,
    &latlong_solid_angle::LatlongSolidAngle,
    &ltc_cylinder::LtcCylinder,
    &ltc_disk::LtcDisk,
    &ltc_ellipsoid::LtcEllipsoid,
    &ltc_line::LtcLine,
    &ltc_polygon::LtcPolygon,
    &ltc_sphere::LtcSphere,
    &ltc_strip::LtcStrip,
    &pixel_cube::PixelCube,
    &pixel_ortho::PixelOrtho,
    &sym3_eigen::Sym3Eigen,
];

/// The family of that name.
pub fn find(name: &str) -> Option<&'static dyn Problem> {
    FAMILIES.iter().copied().find(|family| family.name() == name)
}
