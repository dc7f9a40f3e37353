//! What hunts found, for the terminal.

use std::fmt::Write;

use comfy_table::Cell;

use super::numbers::short;
use super::table;
use crate::family;
use crate::record::{Family, Find, Hunt, Run};

/// For each family one table a scenario, and below it the configurations that the searches found.
pub fn hunt(run: &Run, colour: bool) -> String {
    let mut text = String::new();
    for family in &run.families {
        for scenario in &family.scenarios {
            let hunts: Vec<(&str, &Hunt)> = table::results(family, &scenario.name)
                .filter_map(|(variant, result)| Some((variant.name.as_str(), result.hunt.as_ref()?)))
                .collect();
            if hunts.is_empty() {
                continue;
            }
            _ = writeln!(text, "\n{} . {}: {}", family.name, scenario.name, scenario.summary);
            text.push_str(&comparison(&hunts, colour));
            text.push_str(&finds(family, &hunts));
        }
        for variant in &family.variants {
            if let Some(reason) = &variant.skipped {
                _ = writeln!(text, "skipped {}/{}: {reason}", family.name, variant.name);
            }
        }
    }
    _ = write!(
        text,
        "\nworst: error over tolerance of what the variant is to blame for; inf: no finite error, as for NaN. Below 1: no\n\
         failure, but the nearest to one (error over tolerance, or over what rounding the inputs explains, whichever is\n\
         less). evaluations: by the search, and as many random ones; found: the search's at which it did.\n\
         device: {} ({} {})\n",
        run.device.name, run.device.driver, run.device.driver_info
    );
    text
}

/// A row for each failing verdict that either found; without any, one for what came nearest.
fn rows(hunt: &Hunt) -> Vec<(Option<&Find>, Option<&Find>)> {
    let mut all: Vec<_> = hunt.search.iter().chain(&hunt.random).map(|find| find.verdict).collect();
    all.sort_by(|one, other| other.cmp(one));
    all.dedup();
    if all.iter().any(|verdict| verdict.is_failure()) {
        all.retain(|verdict| verdict.is_failure());
        let of = |finds: &'_ [Find], verdict| finds.iter().position(|find| find.verdict == verdict);
        let pair = |verdict| {
            let at = |finds| of(finds, verdict);
            (at(&hunt.search).map(|at| &hunt.search[at]), at(&hunt.random).map(|at| &hunt.random[at]))
        };
        return all.into_iter().map(pair).collect();
    }
    vec![(hunt.search.last(), hunt.random.last())]
}

fn comparison(hunts: &[(&str, &Hunt)], colour: bool) -> String {
    let header = ["variant", "verdict", "worst random", "worst hunted", "ratio", "evaluations", "found"];
    let mut table = table::table(&header, colour);
    for (variant, hunt) in hunts {
        for (hunted, random) in rows(hunt) {
            let Some(either) = hunted.or(random) else { continue };
            let size = |find: Option<&Find>| find.map_or_else(|| "-".to_owned(), |find| short(find.size));
            let ratio = match (hunted.map(|find| find.size), random.map(|find| find.size)) {
                (Some(Some(hunted)), Some(Some(random))) => short(Some(hunted / random)),
                _ => "-".to_owned(),
            };
            table.add_row([
                Cell::new(variant),
                Cell::new(either.verdict.name()),
                Cell::new(size(random)),
                Cell::new(size(hunted)),
                Cell::new(ratio),
                Cell::new(hunt.evaluations),
                Cell::new(hunted.map_or_else(|| "-".to_owned(), |find| find.evaluation.to_string())),
            ]);
        }
    }
    table::right_align(&mut table);
    table::lines(&table)
}

/// What is written to a terminal's line, at most.
const WIDTH: usize = 118;

/// The inputs of the searches' finds, as decimals that read back to the same bits.
fn finds(family: &Family, hunts: &[(&str, &Hunt)]) -> String {
    let columns = family::find(&family.name).map(|problem| problem.signature().input_columns());
    let columns = columns.unwrap_or_default();
    let mut text = String::new();
    for (variant, hunt) in hunts {
        for find in rows(hunt).into_iter().filter_map(|(hunted, _)| hunted) {
            let mut line = format!("  {variant}, {}:", find.verdict.name());
            for (column, value) in columns.iter().zip(&find.inputs) {
                let cell = format!(" {column}={value:?}");
                if line.len() + cell.len() > WIDTH {
                    text.push_str(&line);
                    line = "\n   ".to_owned();
                }
                line.push_str(&cell);
            }
            _ = writeln!(text, "{line}");
        }
    }
    text
}
