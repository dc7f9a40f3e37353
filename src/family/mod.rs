//! The problems: one file each, and the slice that lists them.

mod cone_axes;
mod ellipse_axes;
mod problem;
mod sym3_eigen;

pub use problem::{
    CERTIFIED, Landmark, MAX_COMPONENTS, MAX_OUTPUTS, Output, Problem, Quantity, Relation, Scenario, Truth,
};

/// Every family, sorted by name.
pub static FAMILIES: &[&dyn Problem] =
    &[&cone_axes::ConeAxes, &ellipse_axes::EllipseAxes, &sym3_eigen::Sym3Eigen];

/// The family of that name.
pub fn find(name: &str) -> Option<&'static dyn Problem> {
    FAMILIES.iter().copied().find(|family| family.name() == name)
}
