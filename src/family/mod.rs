//! The problems: one file each, and the slice that lists them.

mod ellipse_axes;
<<<<<<< HEAD
mod ltc_disk;
=======
mod horizon_sphere;
>>>>>>> lut
mod problem;

pub use problem::{
    CERTIFIED, Landmark, MAX_COMPONENTS, MAX_OUTPUTS, Output, Problem, Quantity, Relation, Scenario, Truth,
};

/// Every family, sorted by name.
<<<<<<< HEAD
pub static FAMILIES: &[&dyn Problem] = &[&ellipse_axes::EllipseAxes, &ltc_disk::LtcDisk];
=======
pub static FAMILIES: &[&dyn Problem] = &[&ellipse_axes::EllipseAxes, &horizon_sphere::HorizonSphere];
>>>>>>> lut

/// The family of that name.
pub fn find(name: &str) -> Option<&'static dyn Problem> {
    FAMILIES.iter().copied().find(|family| family.name() == name)
}
