//! The choice of a variant, for the terminal.

use std::fmt::Write;

use comfy_table::{Cell, Color};

use super::numbers::{percent, short};
use super::table;
use crate::decide::{Candidate, Choice};

/// The reason, and one row a variant, the best first.
pub fn pick(choice: &Choice, colour: bool) -> String {
    let mut text = String::new();
    _ = writeln!(text, "{}\n", choice.reason);
    let error = format!("{} error", choice.quantile.name());
    let mut header = vec!["", "variant", "front", "failed", "not finite", error.as_str(), "cost"];
    let names: Vec<String> = (1..=choice.devices.len()).map(|number| format!("ns [{number}]")).collect();
    header.extend(names.iter().map(String::as_str));
    header.push("what it lacks");
    let mut table = table::table(&header, colour);
    for (position, candidate) in choice.candidates.iter().enumerate() {
        let chosen = position == 0 && choice.found;
        let Candidate { variant, failed, worst_non_finite, worst_error, cost, ns, on_front, lost, .. } =
            candidate;
        let name = if chosen { Cell::new(variant).fg(Color::Green) } else { Cell::new(variant) };
        let mut cells = vec![
            Cell::new(if chosen { "*" } else { "" }),
            name,
            Cell::new(if *on_front { "yes" } else { "" }),
            Cell::new(percent(failed)),
            Cell::new(percent(&worst_non_finite.value)),
            Cell::new(short(Some(worst_error.value.error).filter(|error| error.is_finite()))),
            Cell::new(cost.map_or_else(String::new, |cost| format!("{cost:.2}"))),
        ];
        cells.extend(ns.iter().map(|ns| Cell::new(ns.map_or_else(String::new, |ns| format!("{ns:.2}")))));
        let lacks = if position == 0 { candidate.breaks.join("; ") } else { lost.clone() };
        cells.push(Cell::new(lacks));
        table.add_row(cells);
    }
    text.push_str(&table::lines(&table));
    _ = writeln!(
        text,
        "\nfront: no other variant is at least as good in failures, error and time, and better in one. failed: of all\n\
         configurations; not finite, {error}: in the worst scenario on the worst device. cost: time over the fastest's,\n\
         the geometric mean over devices; closer than {:.1} % is not told apart.",
        100.0 * choice.noise
    );
    for (number, (seen, on)) in choice.devices.iter().zip(&choice.timed_on).enumerate() {
        let on = on.as_ref().map_or_else(String::new, |scenario| format!(", times of {scenario}"));
        _ = writeln!(text, "[{}] {}: {}{on}", number + 1, seen.device, seen.path);
    }
    if !choice.left_out.is_empty() {
        _ = writeln!(text, "not counted, as some run lacks them: {}", choice.left_out.join(", "));
    }
    text
}
