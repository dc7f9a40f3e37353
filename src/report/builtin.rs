//! The cells of a builtin's table: whether it keeps the specification, how far off it is at worst, and at which input.

use comfy_table::{Cell, Color};

use super::numbers::{percent, short};
use crate::audit::Verdict;
use crate::numeric::spacing::f32_spacing;
use crate::record::{Audit, Family, Specimen, decimal_f32};

/// The quantity's name in records.
const QUANTITY: &str = "builtin";

pub(super) fn is_builtin(family: &Family) -> bool {
    family.outputs.iter().all(|output| output.quantity == QUANTITY)
}

pub(super) const HEADER: [&str; 9] = [
    "specification",
    "broken",
    "non-finite",
    "unspecified",
    "worst ULP",
    "of",
    "at",
    "nearest the limit",
    "at",
];

pub(super) fn cells(audit: &Audit) -> Vec<Cell> {
    let rate = |verdict: Verdict| audit.verdicts.get(&verdict).map_or_else(|| "0".to_owned(), percent);
    let (word, colour) =
        if audit.failed.count == 0 { ("keeps", Color::Green) } else { ("breaks", Color::Red) };
    let mut cells = vec![
        Cell::new(word).fg(colour),
        Cell::new(percent(&audit.failed)),
        Cell::new(rate(Verdict::NonFinite)),
        Cell::new(rate(Verdict::Unspecified)),
    ];
    let extremes = audit.outputs[0].extremes.as_ref();
    match extremes.and_then(|extremes| extremes.ulp.as_ref()) {
        Some(worst) => {
            let size = worst.truth.iter().map(|truth| truth * truth).sum::<f64>().sqrt();
            let spacing = f32_spacing(if worst.truth.len() == 1 { worst.truth[0] } else { size });
            cells.push(Cell::new(short(Some(worst.size))));
            cells.push(Cell::new(short(worst.limit.map(|limit| limit / spacing))));
            cells.push(Cell::new(place(worst)));
        }
        None => cells.extend(std::iter::repeat_with(|| Cell::new("")).take(3)),
    }
    match extremes.and_then(|extremes| extremes.share.as_ref()) {
        Some(worst) => {
            cells.push(Cell::new(short(Some(worst.size))));
            cells.push(Cell::new(place(worst)));
        }
        None => cells.extend(std::iter::repeat_with(|| Cell::new("")).take(2)),
    }
    cells
}

/// The inputs in nine digits, which read back to the same bits.
fn place(specimen: &Specimen) -> String {
    let inputs: Vec<String> = specimen.inputs.iter().map(|value| decimal_f32(*value)).collect();
    inputs.join(" ")
}

pub(super) const LEGEND: &str = "\
specification: whether every result is within what Vulkan permits; broken: those that are not. unspecified: inputs for\n\
which Vulkan promises nothing, which are left out of the rest. worst ULP .. of: the error in units in the last place, and\n\
the permitted one there. nearest the limit: the largest share of the permitted error; at: the inputs.\n";
