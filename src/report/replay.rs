//! Replayed failures: counts by variant and scenario, and one failure in full.

use std::fmt::Write;

use comfy_table::{Cell, Color};

use super::numbers::short;
use super::table;
use crate::audit::Verdict;
use crate::case::evaluate::Number;
use crate::case::replay::{Fate, Group, Replay, Replayed};
use crate::case::story::{Exact, Story, Told};
use crate::record::decimal_f32;

/// More failures than this are only counted.
const LISTED: usize = 40;
/// More groups than this are told by variant, whatever the scenario.
const GROUPS: usize = 60;

/// What became of the failures, and each of them if they are few.
pub fn replay(replay: &Replay, colour: bool) -> String {
    let merged = replay.groups.len() > GROUPS;
    let groups = if merged { &by_variant(&replay.groups) } else { &replay.groups };
    let header =
        ["failures", "variant", "scenario", "recorded as", "same verdict", "other", "no longer", "same bits"];
    let mut table = table::table(&header, colour);
    for group in groups {
        let verdicts: Vec<String> =
            group.verdicts.iter().map(|(verdict, count)| format!("{count} {}", verdict.name())).collect();
        let mut cells = vec![
            Cell::new(if merged { format!("{} ..", group.first) } else { range(group.first, group.last) }),
            Cell::new(format!("{}/{}", group.family, group.variant)),
            Cell::new(&group.scenario),
            Cell::new(verdicts.join(", ")),
        ];
        match &group.skipped {
            Some(_) => cells.extend(std::iter::repeat_with(|| Cell::new("-")).take(4)),
            None => {
                cells.push(Cell::new(group.same_verdict));
                cells.push(told(group.other_verdict, Color::Yellow));
                cells.push(told(group.passes, Color::Green));
                let bits = Cell::new(group.same_bits);
                cells.push(if group.same_bits == group.failures { bits } else { bits.fg(Color::Yellow) });
            }
        }
        table.add_row(cells);
    }
    let mut text = table::lines(&table);
    if replay.failures.len() <= LISTED {
        text.push('\n');
        text.push_str(&list(&replay.failures, colour));
    }
    let sum = |of: fn(&Group) -> u64| replay.groups.iter().map(of).sum::<u64>();
    let lost = replay.failures.iter().filter(|failure| failure.now.is_none()).count();
    _ = writeln!(
        text,
        "\n{} failures: {} fail again with the same verdict, {} with another, {} no longer; outputs of {} have the same bits.",
        replay.failures.len(),
        sum(|group| group.same_verdict),
        sum(|group| group.other_verdict),
        sum(|group| group.passes),
        sum(|group| group.same_bits),
    );
    if lost > 0 {
        _ = writeln!(text, "{lost} were not evaluated (-).");
    }
    text.push_str("'--failure K' tells everything of one");
    if replay.failures.len() > LISTED {
        text.push_str("; '--variant V' and '--scenario S' narrow the list down until each is shown");
    }
    text.push_str(".\n");
    text
}

fn told(count: u64, colour: Color) -> Cell {
    if count == 0 { Cell::new(0) } else { Cell::new(count).fg(colour) }
}

fn range(first: usize, last: usize) -> String {
    if first == last { first.to_string() } else { format!("{first}-{last}") }
}

fn by_variant(groups: &[Group]) -> Vec<Group> {
    let mut merged: Vec<(Group, usize)> = Vec::new();
    for group in groups {
        let same =
            |(one, _): &&mut (Group, usize)| one.family == group.family && one.variant == group.variant;
        let Some((one, scenarios)) = merged.iter_mut().find(same) else {
            merged.push((group.clone(), 1));
            continue;
        };
        *scenarios += 1;
        one.first = one.first.min(group.first);
        one.last = one.last.max(group.last);
        one.failures += group.failures;
        one.same_verdict += group.same_verdict;
        one.other_verdict += group.other_verdict;
        one.passes += group.passes;
        one.same_bits += group.same_bits;
        for (verdict, count) in &group.verdicts {
            match one.verdicts.iter_mut().find(|(known, _)| known == verdict) {
                Some((_, sum)) => *sum += count,
                None => one.verdicts.push((*verdict, *count)),
            }
        }
        one.skipped = one.skipped.take().or_else(|| group.skipped.clone());
    }
    let named = |(mut group, scenarios): (Group, usize)| {
        if scenarios > 1 {
            group.scenario = format!("({scenarios} of them)");
        }
        group
    };
    merged.into_iter().map(named).collect()
}

fn list(failures: &[Replayed], colour: bool) -> String {
    let header = ["K", "variant", "scenario", "index", "recorded", "error", "now", "error", "bits"];
    let mut table = table::table(&header, colour);
    for failure in failures {
        let mut cells = vec![
            Cell::new(failure.failure),
            Cell::new(format!("{}/{}", failure.family, failure.variant)),
            Cell::new(&failure.scenario),
            Cell::new(failure.index),
            Cell::new(failure.recorded.name()),
            Cell::new(errors(&failure.recorded_errors)),
        ];
        match &failure.now {
            Some(now) => {
                cells.push(verdict(now.verdict, now.fate));
                cells.push(Cell::new(errors(&now.errors)));
                cells.push(Cell::new(if now.same_bits { "same" } else { "other" }));
            }
            None => cells.extend(["-", "", ""].map(Cell::new)),
        }
        table.add_row(cells);
    }
    table::lines(&table)
}

/// One an output.
fn errors(errors: &[f64]) -> String {
    let errors: Vec<String> = errors.iter().map(|error| size(*error)).collect();
    errors.join(" ")
}

fn size(error: f64) -> String {
    short(Some(error).filter(|error| error.is_finite()))
}

fn verdict(verdict: Verdict, fate: Fate) -> Cell {
    let cell = Cell::new(verdict.name());
    match fate {
        Fate::Same => cell,
        Fate::Other => cell.fg(Color::Yellow),
        Fate::Passes => cell.fg(Color::Green),
    }
}

/// One failure in full.
pub fn story(story: &Story, colour: bool) -> String {
    let mut text = format!(
        "failure {}: {}/{}, scenario {}, configuration {}\n",
        story.failure, story.family, story.variant, story.scenario, story.index
    );
    if let Some(device) = &story.recorded_on {
        _ = writeln!(text, "recorded on {device}");
    }
    _ = writeln!(text, "replayed on {}\n", story.device);
    text.push_str(&numbers("input", &story.inputs, colour));
    text.push('\n');
    text.push_str(&exact(&story.truth, colour));
    text.push('\n');

    let mut table = table::table(
        &["variant", "output", "decimal", "hexadecimal", "bits", "error", "ULP", "verdict"],
        colour,
    );
    let outputs: Vec<&str> = story.truth.outputs.iter().map(|output| output.output.as_str()).collect();
    add(&mut table, "(recorded)", &story.recorded, &outputs);
    for teller in &story.variants {
        match (&teller.told, &teller.skipped) {
            (Some(told), _) => add(&mut table, &teller.variant, told, &outputs),
            (None, why) => {
                let why = why.as_deref().unwrap_or("not evaluated");
                table.add_row(vec![Cell::new(&teller.variant), Cell::new(format!("({why})"))]);
            }
        }
    }
    text.push_str(&table::lines(&table));
    let bits = match story.same_bits {
        Some(true) => "; the outputs have the recorded bits",
        Some(false) => "; the outputs have other bits than recorded",
        None => "",
    };
    let fate = story.fate.map_or("could not be evaluated", Fate::words);
    _ = writeln!(text, "\n{}/{} {fate}{bits}.", story.family, story.variant);
    text
}

fn numbers(title: &str, numbers: &[Number], colour: bool) -> String {
    let mut table = table::table(&[title, "decimal", "hexadecimal", "bits"], colour);
    for number in numbers {
        let Number { column, value, hex, bits } = number;
        table.add_row(vec![
            Cell::new(column),
            Cell::new(decimal_f32(*value)),
            Cell::new(hex),
            Cell::new(bits),
        ]);
    }
    table::lines(&table)
}

fn exact(truth: &Exact, colour: bool) -> String {
    let mut table = table::table(&["truth", "exact value"], colour);
    for (column, value) in truth.columns.iter().zip(&truth.values) {
        table.add_row(vec![column.clone(), format!("{value:.16e}")]);
    }
    let mut text = table::lines(&table);
    let did = if truth.escalated { "plain f64 did not do" } else { "plain f64 did" };
    let certain = if truth.certified { "certified" } else { "NOT certified" };
    _ = writeln!(text, "certain to {} f32 spacings ({certain}; {did})", size(truth.bound));
    for output in &truth.outputs {
        _ = writeln!(
            text,
            "{}: tolerance {}; rounding the inputs explains an absolute error of {}",
            output.output,
            short(Some(output.tolerance)),
            size(output.explained)
        );
    }
    if truth.margin.is_finite() {
        _ = writeln!(text, "a relative change of the inputs by {} turns hit and miss", size(truth.margin));
    }
    if !truth.as_recorded {
        text.push_str("the record has another truth: the oracle has changed since\n");
    }
    text
}

fn add(table: &mut comfy_table::Table, name: &str, told: &Told, outputs: &[&str]) {
    let mut output = 0;
    for (row, number) in told.outputs.iter().enumerate() {
        let of = |column: &str, name: &str| {
            column == name || column.strip_prefix(name).is_some_and(|rest| rest.starts_with('_'))
        };
        // Errors belong to an output, whose columns are consecutive: they stand beside the first.
        let first = row == 0 || !of(&number.column, outputs[output]);
        if row > 0 && first {
            output += 1;
        }
        let beside = |values: &[f64]| if first { size(values[output]) } else { String::new() };
        table.add_row(vec![
            Cell::new(if row == 0 { name } else { "" }),
            Cell::new(&number.column),
            Cell::new(decimal_f32(number.value)),
            Cell::new(&number.hex),
            Cell::new(&number.bits),
            Cell::new(beside(&told.errors)),
            Cell::new(beside(&told.ulps)),
            Cell::new(if row == 0 { told.verdict.name() } else { "" }),
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_groups_are_told_by_variant() {
        let group = |variant: &str, scenario: &str, first| Group {
            family: "f".to_owned(),
            variant: variant.to_owned(),
            scenario: scenario.to_owned(),
            first,
            last: first + 1,
            failures: 2,
            verdicts: vec![(Verdict::Inaccurate, 2)],
            same_verdict: 1,
            other_verdict: 0,
            passes: 1,
            same_bits: 1,
            skipped: None,
        };
        let merged = by_variant(&[group("a", "s", 1), group("b", "s", 3), group("a", "t", 5)]);
        assert_eq!(merged.len(), 2);
        assert_eq!((merged[0].first, merged[0].last, merged[0].failures), (1, 6, 4));
        assert_eq!(merged[0].verdicts, [(Verdict::Inaccurate, 4)]);
        assert_eq!((merged[0].scenario.as_str(), merged[1].scenario.as_str()), ("(2 of them)", "s"));
    }
}
