//! The text around a variant's function: tables and result struct before it, buffers and `main()` after it.
//!
//! No binding is written by hand anywhere else; devices share only the constants of [`super::kernel`].

pub(super) mod glsl;
pub(super) mod hlsl;
pub(super) mod wgsl;

use super::{Signature, Type};

/// What the generated `main()` does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Main {
    /// One evaluation a configuration.
    Evaluate,
    /// As many evaluations in registers as the push constants say, each after the last.
    ///
    /// Every input is multiplied by 1 or by 1 - 2^-24, whichever a bit of all results of the last evaluation says. So no
    /// evaluation can begin before the last one has ended, or be left out; an input stays or becomes its neighbour towards
    /// zero, which keeps it in any domain that holds 0 or ends with a bound on the magnitude; zero stays zero; and
    /// results that are not finite are bits like others. `precise`, lest the factor be taken out of a homogeneous
    /// function and most of the work out of the loop.
    Repeat,
}

/// What the first index of a matrix counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MatrixOrder {
    Columns,
    Rows,
}

/// The components of the result `r`, in column order.
fn results(signature: &Signature, order: MatrixOrder) -> Vec<String> {
    let mut values = Vec::new();
    for field in &signature.results {
        let value = if signature.results.len() == 1 { "r".to_owned() } else { format!("r.{}", field.name) };
        values.extend((0..field.ty.components()).map(|component| match (field.ty, order) {
            (Type::Float, _) => value.clone(),
            (Type::Mat3, MatrixOrder::Columns) => format!("{value}[{}][{}]", component / 3, component % 3),
            (Type::Mat3, MatrixOrder::Rows) => format!("{value}[{}][{}]", component % 3, component / 3),
            (Type::Vec2 | Type::Vec3 | Type::Vec4, _) => format!("{value}[{component}]"),
        }));
    }
    values
}
