//! A comparison of two runs: for the terminal, as Markdown, as annotations of a GitHub job.

use std::fmt::Write;

use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{Cell, Color};

use super::numbers::percent;
use super::table;
use crate::decide::{Breach, Change, Comparison, Row, Side};

/// What a table is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Terminal { colour: bool },
    Markdown,
}

/// The comparison and what breaks the gate's rules; `all` shows rows without a change too.
pub fn compare(comparison: &Comparison, breaches: Option<&[Breach]>, all: bool, form: Form) -> String {
    let mut text = String::new();
    for (name, side) in [("A", &comparison.a), ("B", &comparison.b)] {
        _ = writeln!(text, "{}{name}: {}", bullet(form), told(side));
    }
    if form == Form::Markdown {
        text.push('\n');
    }
    let [accuracy, times] = comparison.counts();
    for (what, counts) in [("accuracy", accuracy), ("time", times)] {
        let changes = [Change::Worse, Change::Better, Change::Same, Change::CannotTell];
        let counts =
            changes.map(|change| format!("{} {}", counts.get(&change).unwrap_or(&0), change.words()));
        _ = writeln!(text, "{}{what}: {}", bullet(form), counts.join(", "));
    }
    let identical = comparison.rows.iter().filter_map(|row| row.bits).filter(|bits| bits.identical()).count();
    let with_bits = comparison.rows.iter().filter(|row| row.bits.is_some()).count();
    if with_bits > 0 {
        _ = writeln!(text, "{}bits: {identical} of {with_bits} rows identical to the last one", bullet(form));
    }
    let mut rows: Vec<&Row> = comparison.rows.iter().filter(|row| all || row.changed()).collect();
    rows.sort_by_key(|row| gravest(row));
    if rows.is_empty() {
        text.push_str("\nNothing got better or worse.\n");
    } else {
        text.push('\n');
        text.push_str(&rows_table(&rows, form));
    }
    for (what, rows) in [("only in A", &comparison.only_a), ("only in B", &comparison.only_b)] {
        list(&mut text, what, rows);
    }
    text.push('\n');
    for note in &comparison.notes {
        _ = writeln!(text, "{}note: {note}", bullet(form));
    }
    if comparison.rows.iter().any(|row| !row.times.is_empty()) {
        _ = writeln!(
            text,
            "{}times count as different beyond {:.0} % and their sampling error; --time-tolerance sets another limit",
            bullet(form),
            100.0 * comparison.drift
        );
    }
    if let Some(breaches) = breaches {
        text.push_str(&gate(breaches, form));
    }
    text
}

fn bullet(form: Form) -> &'static str {
    if form == Form::Markdown { "- " } else { "" }
}

fn told(side: &Side) -> String {
    let Side { path, device, driver, revision, started, seed, configurations } = side;
    let day = started.split('T').next().unwrap_or(started);
    format!(
        "{path} ({device}, {driver}; rootq {revision} of {day}; seed {seed}, {configurations} a scenario)"
    )
}

fn gravest(row: &Row) -> Change {
    let accuracy = row.accuracy.as_ref().map(|accuracy| accuracy.change);
    accuracy.into_iter().chain(row.times.iter().map(|time| time.change)).min().unwrap_or(Change::Same)
}

fn rows_table(rows: &[&Row], form: Form) -> String {
    let audited = rows.iter().any(|row| row.accuracy.is_some());
    let timed = rows.iter().any(|row| !row.times.is_empty());
    let mut header = vec!["variant", "scenario"];
    if audited {
        header.extend(["accuracy", "failed A", "failed B", "other bits"]);
    }
    if timed {
        header.extend(["time", "ns A", "ns B", "ratio", "regime"]);
    }
    header.push("why");
    let colour = matches!(form, Form::Terminal { colour: true });
    let mut table = table::table(&header, colour);
    for row in rows {
        // One line for the accuracy and the first time, one more for each further time.
        for line in 0..row.times.len().max(1) {
            let first = line == 0;
            let mut cells = if first {
                vec![Cell::new(row.id()), Cell::new(&row.scenario)]
            } else {
                vec![Cell::new(""); 2]
            };
            if audited {
                match row.accuracy.as_ref().filter(|_| first) {
                    Some(accuracy) => {
                        cells.push(graded(accuracy.change));
                        cells.extend(accuracy.failed.iter().map(|rate| Cell::new(percent(rate))));
                        cells.push(Cell::new(bits(row)));
                    }
                    None => cells.extend(vec![Cell::new(""); 4]),
                }
            }
            if timed {
                match row.times.get(line) {
                    Some(time) => {
                        cells.push(graded(time.change));
                        cells.extend(time.ns.map(|ns| Cell::new(format!("{ns:.2}"))));
                        cells.push(Cell::new(format!("{:.3}", time.ratio)));
                        cells.push(Cell::new(time.setting.name()));
                    }
                    None => cells.extend(vec![Cell::new(""); 5]),
                }
            }
            let why = row.accuracy.as_ref().filter(|_| first).map_or("", |accuracy| accuracy.reason.as_str());
            cells.push(Cell::new(why));
            table.add_row(cells);
        }
    }
    if form == Form::Markdown {
        table.load_style(ASCII_MARKDOWN);
    }
    table::lines(&table)
}

fn bits(row: &Row) -> String {
    match row.bits {
        None => String::new(),
        Some(bits) if bits.identical() => "0".to_owned(),
        Some(bits) if bits.differing < 1000.0 => format!("about {:.0}", bits.differing),
        // The estimate is good to a fifth.
        Some(bits) => format!("about {:.1} %", 100.0 * bits.differing / bits.configurations as f64),
    }
}

fn graded(change: Change) -> Cell {
    let cell = Cell::new(change.words());
    match change {
        Change::Worse => cell.fg(Color::Red),
        Change::Better => cell.fg(Color::Green),
        Change::CannotTell => cell.fg(Color::Yellow),
        Change::Same => cell,
    }
}

/// The first few of what one run lacks.
fn list(text: &mut String, what: &str, rows: &[String]) {
    const SHOWN: usize = 8;
    if rows.is_empty() {
        return;
    }
    let more = if rows.len() > SHOWN { format!(" and {} more", rows.len() - SHOWN) } else { String::new() };
    _ = writeln!(text, "\n{what}: {}{more}", rows[..rows.len().min(SHOWN)].join(", "));
}

fn gate(breaches: &[Breach], form: Form) -> String {
    if breaches.is_empty() {
        return format!("{}gate: every rule is kept\n", bullet(form));
    }
    let mut text = format!("{}gate: {} breaches\n\n", bullet(form), breaches.len());
    let mut table = table::table(&["rule", "variant", "scenario", "what"], false);
    for Breach { rule, variant, scenario, what, .. } in breaches {
        table.add_row([Cell::new(rule), Cell::new(variant), Cell::new(scenario), Cell::new(what)]);
    }
    if form == Form::Markdown {
        table.load_style(ASCII_MARKDOWN);
    }
    text.push_str(&table::lines(&table));
    text
}

/// Workflow commands of GitHub Actions: an error a breach, a warning a row that got worse, a notice with the counts.
pub fn github(comparison: &Comparison, breaches: Option<&[Breach]>) -> String {
    let mut text = String::new();
    for Breach { rule, variant, scenario, file, what } in breaches.unwrap_or_default() {
        let title = format!("rootq gate: {variant}");
        annotate(&mut text, "error", file, &title, &format!("rule {rule}, {scenario}: {what}"));
    }
    for row in &comparison.rows {
        let title = format!("rootq: {} on {}", row.id(), row.scenario);
        if let Some(accuracy) = row.accuracy.as_ref().filter(|accuracy| accuracy.change == Change::Worse) {
            annotate(
                &mut text,
                "warning",
                &row.file,
                &title,
                &format!("accuracy is worse: {}", accuracy.reason),
            );
        }
        for time in row.times.iter().filter(|time| time.change == Change::Worse) {
            let [a, b] = time.ns;
            let message = format!(
                "time is worse: {a:.2} -> {b:.2} ns, ratio {:.3} ({})",
                time.ratio,
                time.setting.name()
            );
            annotate(&mut text, "warning", &row.file, &title, &message);
        }
    }
    let [accuracy, times] = comparison.counts();
    let of = |change| (accuracy.get(&change).unwrap_or(&0), times.get(&change).unwrap_or(&0));
    let ((worse, slower), (better, faster)) = (of(Change::Worse), of(Change::Better));
    let message = format!("accuracy: {worse} worse, {better} better; time: {slower} worse, {faster} better");
    annotate(&mut text, "notice", "", "rootq compare", &message);
    text
}

fn annotate(text: &mut String, kind: &str, file: &str, title: &str, message: &str) {
    /// Properties end at a comma or a colon, messages at a line's end.
    fn escape(text: &str, property: bool) -> String {
        let text = text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
        if property { text.replace(':', "%3A").replace(',', "%2C") } else { text }
    }
    let place = if file.is_empty() { String::new() } else { format!("file={},", escape(file, true)) };
    _ = writeln!(text, "::{kind} {place}title={}::{}", escape(title, true), escape(message, false));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn annotations_are_one_line_each() {
        let mut text = String::new();
        annotate(&mut text, "error", "glsl/a,b.comp", "x: y", "100 %\nworse");
        assert_eq!(text, "::error file=glsl/a%2Cb.comp,title=x%3A y::100 %25%0Aworse\n");
    }
}
