//! Times in tables: the columns, what is said of each ranking, and how to read both.

use std::fmt::Write;

use comfy_table::Cell;

use super::numbers::short;
use super::table::{lines, results, right_align, table as plain_table};
use crate::bench::{Bound, Ceilings, Rank, Ranking, Setting, Stop, Timing};
use crate::device::Clock;
use crate::record::{Family, Result, Run, Scenario, Variant};

/// Columns of times beside an audit's.
pub(super) const SHORT_HEADER: [&str; 3] = ["ns", "arith. ns", "rank"];

/// The cells below [`SHORT_HEADER`].
pub(super) fn short_cells(result: &Result) -> Vec<Cell> {
    let streaming = result.timing_in(Setting::STREAMING);
    let arithmetic = result.timing_in(Setting::DIVERGENT);
    let ranked = deciding(result).and_then(|timing| timing.rank);
    vec![
        Cell::new(streaming.map(median).unwrap_or_default()),
        Cell::new(arithmetic.map(median).unwrap_or_default()),
        Cell::new(ranked.map(places).unwrap_or_default()),
    ]
}

/// The time by which variants are ranked: arithmetic with divergent inputs, if it was taken.
fn deciding(result: &Result) -> Option<&Timing> {
    result.timing_in(Setting::DIVERGENT).or_else(|| result.timings().last())
}

fn median(timing: &Timing) -> String {
    nanoseconds(timing.ns.median)
}

/// Three digits or more, and never a false zero.
fn nanoseconds(ns: f64) -> String {
    match ns {
        _ if ns >= 100.0 => format!("{ns:.0}"),
        _ if ns >= 1.0 => format!("{ns:.2}"),
        _ if ns >= 0.001 => format!("{ns:.4}"),
        _ => format!("{ns:.1e}"),
    }
}

/// One place, or the first and last of several.
fn places(rank: Rank) -> String {
    if rank.first == rank.last { rank.first.to_string() } else { format!("{}-{}", rank.first, rank.last) }
}

/// One scenario's times in full, the fastest first, the null kernel at the end.
pub(super) fn table(family: &Family, scenario: &Scenario, colour: bool) -> String {
    let settings: Vec<Setting> = [Setting::STREAMING, Setting::COHERENT, Setting::DIVERGENT]
        .into_iter()
        .filter(|setting| {
            results(family, &scenario.name).any(|(_, result)| result.timing_in(*setting).is_some())
        })
        .collect();
    let streams = settings.contains(&Setting::STREAMING);
    let repeats = settings.contains(&Setting::DIVERGENT);
    let mut header = vec!["variant"];
    if streams {
        header.extend(["streaming", "M/s", "of copy", "bound"]);
    }
    if repeats {
        header.extend(["coherent", "divergent", "of ops"]);
    }
    header.extend(["quartiles", "ratio", "95 %", "rank"]);
    let mut table = plain_table(&header, colour);

    let mut rows: Vec<(&Variant, &Result)> = results(family, &scenario.name).collect();
    let ns = |result: &Result| deciding(result).map_or(f64::INFINITY, |timing| timing.ns.median);
    rows.sort_by(|(_, a), (_, b)| ns(a).total_cmp(&ns(b)));
    for (variant, result) in rows {
        let mut row = vec![variant.name.clone()];
        if let Some(timing) = result.timing_in(Setting::STREAMING) {
            row.push(median(timing));
            row.push(short(Some(timing.per_second() * 1e-6)));
            row.push(timing.share.map_or_else(String::new, |share| percent(share.bandwidth)));
            row.push(timing.bound.map_or("", bound).to_owned());
        }
        if let Some(timing) = result.timing_in(Setting::DIVERGENT) {
            row.push(result.timing_in(Setting::COHERENT).map(median).unwrap_or_default());
            row.push(median(timing));
            row.push(of_operations(variant, timing));
        }
        if let Some(timing) = deciding(result) {
            row.push(format!("{}..{}", nanoseconds(timing.ns.lower), nanoseconds(timing.ns.upper)));
            row.push(timing.ratio.map_or_else(String::new, |ratio| format!("{:.3}", ratio.median)));
            row.push(
                timing.ratio.map_or_else(String::new, |ratio| format!("{:.3}..{:.3}", ratio.low, ratio.high)),
            );
            row.push(timing.rank.map(places).unwrap_or_default());
        }
        table.add_row(row.into_iter().map(Cell::new).collect::<Vec<_>>());
    }
    let null =
        |setting| scenario.ranking(setting).map_or_else(String::new, |r| nanoseconds(r.null_ns.median));
    let mut row = vec!["(null)".to_owned()];
    if streams {
        row.extend([null(Setting::STREAMING)].into_iter().chain(std::iter::repeat_n(String::new(), 3)));
    }
    if repeats {
        row.extend([null(Setting::COHERENT), null(Setting::DIVERGENT)]);
    }
    table.add_row(row.into_iter().map(Cell::new).collect::<Vec<_>>());
    right_align(&mut table);
    lines(&table) + &rankings(scenario)
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent < 9.95 { format!("{percent:.1} %") } else { format!("{percent:.0} %") }
}

fn bound(bound: Bound) -> &'static str {
    match bound {
        Bound::Memory => "memory",
        Bound::Loop => "loop",
        Bound::Compute => "compute",
    }
}

/// The share of the operations' ceilings; `>` where loops make the count too low, `<` where branches make it too high.
fn of_operations(variant: &Variant, timing: &Timing) -> String {
    let Some(share) = timing.share else {
        return String::new();
    };
    if timing.bound == Some(Bound::Loop) {
        return "loop".to_owned();
    }
    let operations = &variant.spirv.operations;
    let sign = match (operations.loops > 0, operations.branches > 0) {
        (false, false) => "",
        (true, false) => ">",
        (false, true) => "<",
        (true, true) => "~",
    };
    format!("{sign}{}", percent(share.arithmetic))
}

/// What is to be known of the ranking that an audit's table shows: one line.
pub(super) fn ranking(scenario: &Scenario) -> String {
    scenario.ranking(Setting::DIVERGENT).or(scenario.rankings.last()).map_or_else(String::new, ranking_line)
}

/// The same of each ranking.
fn rankings(scenario: &Scenario) -> String {
    scenario.rankings.iter().map(ranking_line).collect()
}

fn ranking_line(ranking: &Ranking) -> String {
    let Ranking { setting, reference, control, noise, stopped, rounds, discarded, .. } = ranking;
    let name = setting.name();
    let stopped = match stopped {
        Stop::Narrow => "intervals narrow",
        Stop::Time => "time up",
        Stop::Rounds => "rounds up",
    };
    let discarded =
        if *discarded > 0 { format!(", {discarded} throttled ones discarded") } else { String::new() };
    format!(
        "{name}: ratios to {reference}; against itself {:.3} ({:.3}..{:.3}), so up to {} is noise; {rounds} rounds \
         ({stopped}{discarded})\n",
        control.median,
        control.low,
        control.high,
        percent(*noise),
    )
}

/// How to read the times of a run; empty if it has none.
pub(super) fn legend(run: &Run) -> String {
    let mut text = String::new();
    let variants = run.families.iter().flat_map(|family| &family.variants);
    let Some(timing) =
        variants.flat_map(|variant| &variant.results).find_map(|result| result.timings().next())
    else {
        return text;
    };
    let clock = match timing.clock {
        Clock::DeviceTimestamps => "by device timestamps",
        Clock::HostFence => "by the host's clock (the device has no timestamps)",
    };
    _ = writeln!(
        text,
        "Times are median nanoseconds a configuration, {clock}. streaming (ns): one evaluation each, memory to memory;\n\
         M/s: millions of them a second. arith.: many in registers, each input perturbed by the last output; coherent: a\n\
         workgroup has one configuration, divergent (arith. ns): each invocation its own. Nothing is subtracted: (null) is\n\
         what loads, loop and stores take by themselves; where that is half of the time or more, the bound is memory (or\n\
         the loop), and such variants do not rank among themselves. quartiles, ratio and its 95 % interval, rank: by the\n\
         last time given. rank: the places that the noise leaves open; variants that cannot be told apart share places."
    );
    let rankings = || run.families.iter().flat_map(|family| &family.scenarios).flat_map(|s| &s.rankings);
    let comparisons: usize = rankings().map(|ranking| ranking.self_comparisons).sum();
    if comparisons > 0 {
        let false_positives: usize = rankings().map(|ranking| ranking.false_positives).sum();
        let share = false_positives as f64 / comparisons as f64;
        _ = writeln!(
            text,
            "Each variant's odd rounds against its even ones: told apart {false_positives} of {comparisons} times ({}).",
            percent(share)
        );
    }
    if let Some(ceilings) = &run.ceilings {
        text.push_str(&ceiling_lines(ceilings));
    }
    if run.device.kind == "cpu" {
        text.push_str("A software device: times rank only within the same machine and run.\n");
    }
    text
}

fn ceiling_lines(ceilings: &Ceilings) -> String {
    let giga = |ceiling: &crate::bench::Ceiling| {
        format!("{} ({})", short(Some(ceiling.per_second * 1e-9)), ceiling.kernel)
    };
    let Ceilings { copy, multiply_add, inverse_sqrt, divide, sine, exp2 } = ceilings;
    format!(
        "Ceilings of this run, 10^9 a second: bytes copied {}, f32 operations {},\n\
         inversesqrt {}, division {}, sin {}, exp2 {}.\n\
         of copy, of ops: shares of them, kinds of operations one after the other (above 100 % where units work at once);\n\
         operations counted from the text: > too low for loops, < too high for branches.\n",
        giga(copy),
        giga(multiply_add),
        giga(inverse_sqrt),
        giga(divide),
        giga(sine),
        giga(exp2),
    )
}
