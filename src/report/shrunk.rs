//! A minimized configuration, before and after.

use std::fmt::Write;

use comfy_table::{Cell, Color};

use super::numbers::short;
use super::table;
use crate::case::Shrunk;
use crate::record::decimal_f32;

/// Inputs and outputs side by side, and what could not be simplified.
pub fn shrunk(shrunk: &Shrunk, colour: bool) -> String {
    let Shrunk { before, after, .. } = shrunk;
    let mut text = format!(
        "{}/{} is {} on {}\n{} steps over {} configurations: cost of reading {} -> {}\n\n",
        shrunk.family,
        shrunk.variant,
        after.told.verdict.name(),
        shrunk.device,
        shrunk.steps,
        shrunk.evaluations,
        before.cost,
        after.cost
    );
    let header = ["input", "before", "after", "hexadecimal", "bits before", "bits after", "why not simpler"];
    let mut table = table::table(&header, colour);
    for ((before, after), kept) in before.inputs.iter().zip(&after.inputs).zip(&shrunk.kept) {
        let now = Cell::new(decimal_f32(after.value));
        table.add_row(vec![
            Cell::new(&before.column),
            Cell::new(decimal_f32(before.value)),
            if before.bits == after.bits { now } else { now.fg(Color::Green) },
            Cell::new(&after.hex),
            Cell::new(&before.bits),
            Cell::new(&after.bits),
            Cell::new(kept.words()),
        ]);
    }
    text.push_str(&table::lines(&table));
    text.push('\n');
    let header = ["output", "truth before", "before", "truth after", "after", "bits before", "bits after"];
    let mut table = table::table(&header, colour);
    for (row, (was, is)) in before.told.outputs.iter().zip(&after.told.outputs).enumerate() {
        table.add_row(vec![
            was.column.clone(),
            format!("{:.9e}", before.truth[row]),
            decimal_f32(was.value),
            format!("{:.9e}", after.truth[row]),
            decimal_f32(is.value),
            was.bits.clone(),
            is.bits.clone(),
        ]);
    }
    text.push_str(&table::lines(&table));
    text.push('\n');
    let size = |error: f64| short(Some(error).filter(|error| error.is_finite()));
    for (position, output) in shrunk.outputs.iter().enumerate() {
        _ = writeln!(
            text,
            "{output}: error {} -> {}, ULP {} -> {}",
            size(before.told.errors[position]),
            size(after.told.errors[position]),
            size(before.told.ulps[position]),
            size(after.told.ulps[position])
        );
    }
    if shrunk.kept.iter().any(|kept| kept.unfair > 0) {
        text.push_str(
            "unfair: the oracle is not certain of it, or no variant is right on it that was right before.\n",
        );
    }
    text
}
