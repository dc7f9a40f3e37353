//! The problems: one file each, and the slice that lists them.

mod ellipse_axes;
mod ltc_cylinder;
mod ltc_line;
mod ltc_strip;
mod problem;

pub use problem::{
    CERTIFIED, Landmark, MAX_COMPONENTS, MAX_OUTPUTS, Output, Problem, Quantity, Relation, Scenario, Truth,
};

/// Every family, sorted by name.
pub static FAMILIES: &[&dyn Problem] =
    &[&ellipse_axes::EllipseAxes, &ltc_cylinder::LtcCylinder, &ltc_line::LtcLine, &ltc_strip::LtcStrip];

/// The family of that name.
pub fn find(name: &str) -> Option<&'static dyn Problem> {
    FAMILIES.iter().copied().find(|family| family.name() == name)
}
