//! Terminal tables.

use std::fmt::Write;

use comfy_table::presets::NOTHING;
use comfy_table::{Attribute, Cell, CellAlignment, Color, ContentArrangement, Table};

use super::builtin;
use super::numbers::{percent, short};
use super::timing;
use crate::audit::Verdict;
use crate::device::Facts;
use crate::record::{Audit, Family, Rate, Result, Run, Variant};

/// Devices, one a row.
pub fn devices(devices: &[Facts], colour: bool) -> String {
    let mut table = table(&["", "name", "kind", "driver", "Vulkan", "memory", "uuid"], colour);
    for facts in devices {
        table.add_row([
            Cell::new(facts.index),
            Cell::new(&facts.name),
            Cell::new(&facts.kind),
            Cell::new(format!("{} {}", facts.driver, facts.driver_info)),
            Cell::new(&facts.api_version),
            Cell::new(if facts.unified_memory { "shared" } else { "staged" }),
            Cell::new(&facts.uuid),
        ]);
    }
    lines(&table)
}

/// A run: for each family one table a scenario, and one over all scenarios where there are several.
pub fn run(run: &Run, colour: bool) -> String {
    let mut text = String::new();
    for family in &run.families {
        for (position, scenario) in family.scenarios.iter().enumerate() {
            _ = writeln!(text, "\n{} . {}: {}", family.name, scenario.name, scenario.summary);
            text.push_str(&scenario_table(family, position, colour));
        }
        if family.scenarios.len() > 1 {
            let first = &family.scenarios[0].name;
            let audited = has(family, |result| result.audit.is_some());
            let timed = has(family, |result| result.timings().next().is_some());
            let shown = match (audited, timed) {
                (true, true) => format!("failed, by scenario, and times on '{first}'"),
                (true, false) => "failed, by scenario".to_owned(),
                _ => format!("times on '{first}'"),
            };
            _ = writeln!(text, "\n{}: {shown}", family.name);
            text.push_str(&overview(family, colour));
        }
        for variant in &family.variants {
            if let Some(reason) = &variant.skipped {
                _ = writeln!(text, "skipped {}/{}: {reason}", family.name, variant.name);
            }
        }
    }
    text.push_str(&legend(run));
    text
}

pub(super) fn results<'a>(
    family: &'a Family,
    scenario: &'a str,
) -> impl Iterator<Item = (&'a Variant, &'a Result)> {
    family.variants.iter().filter_map(move |variant| {
        variant.results.iter().find(|result| result.scenario == scenario).map(|result| (variant, result))
    })
}

fn scenario_table(family: &Family, scenario: usize, colour: bool) -> String {
    let scenario = &family.scenarios[scenario];
    let headline: Vec<usize> =
        family.outputs.iter().enumerate().filter(|(_, output)| output.headline).map(|(at, _)| at).collect();
    let audited = results(family, &scenario.name).any(|(_, result)| result.audit.is_some());
    let timed = results(family, &scenario.name).any(|(_, result)| result.timings().next().is_some());
    let told: Vec<Verdict> = TOLD_IF_ANY
        .into_iter()
        .filter(|verdict| {
            has(family, |result| {
                result.audit.as_ref().is_some_and(|audit| audit.verdicts.contains_key(verdict))
            })
        })
        .collect();
    let mut header = vec!["variant".to_owned()];
    let is_builtin = builtin::is_builtin(family);
    if audited && is_builtin {
        header.extend(builtin::HEADER.map(str::to_owned));
    } else if audited {
        header.extend(["failed", "non-finite", "ill-cond."].map(str::to_owned));
        header.extend(told.iter().map(|verdict| verdict.name().replace('_', " ")));
        for output in headline.iter().map(|at| &family.outputs[*at]) {
            header.push(format!("{} off > {}", output.name, tolerance(output.tolerance, &output.quantity)));
            header.extend(["p99", "worst", "worst ULP"].map(str::to_owned));
        }
    }
    if timed && !audited {
        return timing::table(family, scenario, colour);
    }
    if timed {
        header.extend(timing::SHORT_HEADER.map(str::to_owned));
    }
    let mut table = table(&header, colour);
    for (variant, result) in results(family, &scenario.name) {
        let mut row = vec![Cell::new(&variant.name)];
        if let Some(audit) = &result.audit {
            row.extend(if is_builtin { builtin::cells(audit) } else { audit_cells(audit, &told, &headline) });
        }
        if timed {
            row.extend(timing::short_cells(result));
        }
        table.add_row(row);
    }
    right_align(&mut table);
    lines(&table) + &timing::ranking(scenario)
}

/// Verdicts with a column of their own in families where they occur: what no error's size tells.
const TOLD_IF_ANY: [Verdict; 2] = [Verdict::NotEnclosing, Verdict::Missed];

fn audit_cells(audit: &Audit, told: &[Verdict], headline: &[usize]) -> Vec<Cell> {
    let verdict = |verdict: Verdict| audit.verdicts.get(&verdict).map_or_else(|| "0".to_owned(), percent);
    let mut cells = vec![
        graded(&audit.failed),
        Cell::new(verdict(Verdict::NonFinite)),
        Cell::new(verdict(Verdict::IllConditioned)),
    ];
    cells.extend(told.iter().map(|told| Cell::new(verdict(*told))));
    for output in headline.iter().map(|at| &audit.outputs[*at]) {
        cells.push(Cell::new(percent(&output.beyond)));
        cells.push(Cell::new(short(output.error.p99)));
        let worst = audit.worst(output);
        cells.push(Cell::new(short(worst.map(|worst| worst.error))));
        cells.push(Cell::new(short(worst.map(|worst| worst.ulp))));
    }
    cells
}

fn has(family: &Family, what: impl Fn(&Result) -> bool) -> bool {
    family.variants.iter().flat_map(|variant| &variant.results).any(what)
}

fn overview(family: &Family, colour: bool) -> String {
    let audited = has(family, |result| result.audit.is_some());
    let timed = has(family, |result| result.timings().next().is_some());
    let mut header = vec!["variant".to_owned()];
    if audited {
        header.extend(family.scenarios.iter().map(|scenario| scenario.name.clone()));
    }
    if timed {
        header.extend(timing::SHORT_HEADER.map(str::to_owned));
    }
    let mut table = table(&header, colour);
    for variant in family.variants.iter().filter(|variant| variant.skipped.is_none()) {
        let result = |name: &str| variant.results.iter().find(|result| result.scenario == name);
        let mut row = vec![Cell::new(&variant.name)];
        for scenario in family.scenarios.iter().filter(|_| audited) {
            let audit = result(&scenario.name).and_then(|result| result.audit.as_ref());
            row.push(audit.map_or_else(|| Cell::new(""), |audit| graded(&audit.failed)));
        }
        if let Some(result) = result(&family.scenarios[0].name).filter(|_| timed) {
            row.extend(timing::short_cells(result));
        }
        table.add_row(row);
    }
    right_align(&mut table);
    lines(&table)
}

/// Green for none, yellow up to one in a hundred, red beyond.
fn graded(rate: &Rate) -> Cell {
    let colour = match rate.rate {
        0.0 => Color::Green,
        low if low <= 0.01 => Color::Yellow,
        _ => Color::Red,
    };
    Cell::new(percent(rate)).fg(colour)
}

fn tolerance(tolerance: f64, quantity: &str) -> String {
    match quantity {
        "magnitude" | "scalar" | "solid_angle" | "vector" => format!("{} %", 100.0 * tolerance),
        "unit_vector" => format!("{} mrad", 1e3 * tolerance),
        _ => format!("{tolerance}"),
    }
}

fn legend(run: &Run) -> String {
    let mut text = String::new();
    let audits = || {
        let variants = run.families.iter().flat_map(|family| &family.variants);
        variants.flat_map(|variant| &variant.results).filter_map(|result| result.audit.as_ref())
    };
    text.push('\n');
    if let Some(audit) = audits().next() {
        _ = writeln!(
            text,
            "failed: wrong by the variant's own fault. ill-cond.: beyond tolerance, but no further than rounding the\n\
             inputs would explain. off > t: error beyond t or not finite, whoever is to blame. 7x: seven of {}; 0: none,\n\
             so with 95 % confidence at most {:.0e} of all. p99: an upper bound, at most a quarter too high. worst: of all;\n\
             inf where any is not finite.",
            audit.configurations,
            3.0 / audit.configurations as f64
        );
        let occurs = |verdict| audits().any(|audit| audit.verdicts.contains_key(&verdict));
        if occurs(Verdict::NotEnclosing) {
            text.push_str(
                "not enclosing: the box leaves out a part, however small, of what it must enclose.\n",
            );
        }
        if occurs(Verdict::Missed) {
            text.push_str(
                "missed: a miss for a hit or a hit for a miss, beyond what rounding the inputs would explain. Errors are of\n\
                 what both hit.\n",
            );
        }
    }
    if run.families.iter().any(builtin::is_builtin) && audits().next().is_some() {
        text.push_str(builtin::LEGEND);
    }
    text.push_str(&timing::legend(run));
    let oracle = run
        .families
        .iter()
        .flat_map(|family| &family.scenarios)
        .filter_map(|scenario| scenario.oracle.as_ref());
    let (escalated, uncertified) =
        oracle.fold((0, 0), |(e, u), oracle| (e + oracle.escalations, u + oracle.uncertified));
    if escalated + uncertified > 0 {
        _ = writeln!(
            text,
            "oracle: {escalated} configurations needed more than f64, {uncertified} stayed uncertified."
        );
    }
    _ = writeln!(text, "device: {} ({} {})", run.device.name, run.device.driver, run.device.driver_info);
    text
}

pub(super) fn table<T: ToString>(header: &[T], colour: bool) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    if colour {
        table.enforce_styling();
    } else {
        table.force_no_tty();
    }
    table.set_header(header.iter().map(|name| Cell::new(name.to_string()).add_attribute(Attribute::Bold)));
    table
}

pub(super) fn right_align(table: &mut Table) {
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
}

pub(super) fn lines(table: &Table) -> String {
    let mut text = String::new();
    for line in table.lines() {
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
