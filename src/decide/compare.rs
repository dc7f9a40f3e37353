//! Two runs, row by row: what got better, worse, stayed the same, or cannot be told.

use std::collections::BTreeMap;

use serde::Serialize;

use super::accuracy::{self, AccuracyChange, BitsChange};
use super::time::{self, Allowance, Common, TimeChange};
use super::{Change, accuracy::quantile_of_normal};
use crate::bench::{Setting, Timing};
use crate::record::{Family, Recorded, Result, Run, Scenario, Variant};

/// What two runs of the same thing may differ by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tolerances {
    /// Probability that a comparison of two runs of the same thing reports any difference, by sampling error alone; it
    /// is divided among the tests that are made (Bonferroni).
    pub level: f64,
    /// Share by which the times of two runs of the same thing may differ; `None`: 0.1, on a software device 0.25.
    pub drift: Option<f64>,
}

impl Default for Tolerances {
    fn default() -> Self {
        Tolerances { level: 0.05, drift: None }
    }
}

/// One of the two runs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Side {
    pub path: String,
    pub device: String,
    pub driver: String,
    pub revision: String,
    pub started: String,
    pub seed: u64,
    pub configurations: u64,
}

/// The whole comparison.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    pub a: Side,
    pub b: Side,
    /// Share by which times may differ before that counts.
    pub drift: f64,
    /// Where given, B's machine as a whole took so many times A's time, and ratios are relative to that.
    pub common: Common,
    pub rows: Vec<Row>,
    /// `family/variant . scenario` in one run only.
    pub only_a: Vec<String>,
    pub only_b: Vec<String>,
    /// What a reader must know besides.
    pub notes: Vec<String>,
}

/// One variant on one scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub family: String,
    pub variant: String,
    pub scenario: String,
    /// The variant's file in the source tree.
    pub file: String,
    /// Absent where a run has no audit of it.
    pub accuracy: Option<AccuracyChange>,
    /// Absent unless both runs had the same configurations and kept fingerprints.
    pub bits: Option<BitsChange>,
    pub times: Vec<TimeChange>,
}

impl Row {
    /// `family/variant`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.family, self.variant)
    }

    /// Whether anything about it is worse or better.
    pub fn changed(&self) -> bool {
        let differs = |change| matches!(change, Change::Worse | Change::Better);
        self.accuracy.as_ref().is_some_and(|accuracy| differs(accuracy.change))
            || self.times.iter().any(|time| differs(time.change))
    }
}

impl Comparison {
    /// How many rows have each change of accuracy, and how many times each change.
    pub fn counts(&self) -> [BTreeMap<Change, usize>; 2] {
        let mut counts = [BTreeMap::new(), BTreeMap::new()];
        for row in &self.rows {
            if let Some(accuracy) = &row.accuracy {
                *counts[0].entry(accuracy.change).or_default() += 1;
            }
            for time in &row.times {
                *counts[1].entry(time.change).or_default() += 1;
            }
        }
        counts
    }
}

/// What belongs together in a run.
struct Cell<'a> {
    family: &'a Family,
    scenario: &'a Scenario,
    variant: &'a Variant,
    result: &'a Result,
}

type Key = (String, String, String);

fn cells(run: &Run) -> BTreeMap<Key, Cell<'_>> {
    let mut cells = BTreeMap::new();
    for family in &run.families {
        for variant in &family.variants {
            for result in &variant.results {
                let Some(scenario) = family.scenarios.iter().find(|s| s.name == result.scenario) else {
                    continue;
                };
                let key = (family.name.clone(), variant.name.clone(), result.scenario.clone());
                cells.insert(key, Cell { family, scenario, variant, result });
            }
        }
    }
    cells
}

/// By how much times of two runs of the same thing may differ, unless the caller knows better.
///
/// On a software device every process has other threads, pages and neighbours: a twentieth was seen between runs on an
/// idle machine, a fifth on one that others use. A GPU with its clocks left alone stays within a tenth.
fn drift_of(run: &Run) -> f64 {
    if run.device.kind == "cpu" { 0.25 } else { 0.1 }
}

/// Compares run `b` with run `a`.
pub fn compare(a: &Recorded, b: &Recorded, tolerances: Tolerances) -> Comparison {
    let (cells_a, cells_b) = (cells(&a.run), cells(&b.run));
    let pairs: Vec<(&Key, [&Cell<'_>; 2])> =
        cells_a.iter().filter_map(|(key, cell)| Some((key, [cell, cells_b.get(key)?]))).collect();
    let drift = tolerances.drift.unwrap_or_else(|| drift_of(&a.run).max(drift_of(&b.run)));

    let timed = |[a, b]: [&Cell<'_>; 2]| {
        let times = a
            .result
            .timings()
            .filter_map(|time| Some([time.clone(), b.result.timing_in(time.setting)?.clone()]));
        times.collect::<Vec<_>>()
    };
    let all_times: Vec<_> = pairs.iter().flat_map(|(_, cells)| timed(*cells)).collect();
    // A software device shares its machine with everything else, so only what differs from the rest is a variant's.
    // Between two devices there is nothing to take out.
    let software = a.run.device.kind == "cpu" && a.run.device.name == b.run.device.name;
    let common = if software { Common::of(&all_times) } else { Common::default() };
    let audits = pairs.iter().filter_map(|(_, [cell, _])| cell.result.audit.as_ref());
    let tests = audits.map(|audit| accuracy::tests(audit.outputs.len())).sum::<usize>() + all_times.len();
    let level = tolerances.level / tests.max(1) as f64;
    let z = quantile_of_normal(level);

    let row = |(key, cells): &(&Key, [&Cell<'_>; 2])| {
        let [cell_a, cell_b] = *cells;
        let paired = cell_a.scenario.inputs.is_some() && cell_a.scenario.inputs == cell_b.scenario.inputs;
        let audits = cell_a.result.audit.as_ref().zip(cell_b.result.audit.as_ref());
        let bits = audits.filter(|_| paired).and_then(|(audit, _)| {
            Some(BitsChange::between(a.bits.get(*key)?, b.bits.get(*key)?, audit.configurations))
        });
        let allowance = |setting: Setting| {
            let rankings = cells.map(|cell| cell.scenario.ranking(setting));
            let noise = rankings.iter().flatten().fold(0.0, |noise: f64, ranking| noise.max(ranking.noise));
            let common = common.of_regime(setting.regime).unwrap_or(1.0);
            let [a, b] = rankings.map(|ranking| ranking.map(|ranking| ranking.null_ns.median));
            let null =
                if software { a.zip(b).map_or(0.0, |(a, b)| time::apart(b / a / common)) } else { 0.0 };
            Allowance { drift: drift.max(noise).max(null), z, common }
        };
        Row {
            family: cell_a.family.name.clone(),
            variant: cell_a.variant.name.clone(),
            scenario: cell_a.scenario.name.clone(),
            file: cell_b.variant.path(),
            accuracy: audits.map(|(a, b)| accuracy::accuracy([a, b], bits, paired, level)),
            bits,
            times: timed(*cells).iter().map(|[a, b]| time::time([a, b], allowance(a.setting))).collect(),
        }
    };
    let rows: Vec<Row> = pairs.iter().map(row).collect();
    let lacking = |these: &BTreeMap<Key, Cell<'_>>, those: &BTreeMap<Key, Cell<'_>>| {
        let keys = these.keys().filter(|key| !those.contains_key(*key));
        keys.map(|(family, variant, scenario)| format!("{family}/{variant} . {scenario}")).collect()
    };
    Comparison {
        a: side(a),
        b: side(b),
        drift,
        common,
        only_a: lacking(&cells_a, &cells_b),
        only_b: lacking(&cells_b, &cells_a),
        notes: notes(a, b, &pairs.iter().map(|(_, cells)| *cells).collect::<Vec<_>>(), common),
        rows,
    }
}

fn side(recorded: &Recorded) -> Side {
    let Run { device, program, started, settings, .. } = &recorded.run;
    Side {
        path: recorded.path.display().to_string(),
        device: device.name.clone(),
        driver: format!("{} {}", device.driver, device.driver_info).trim().to_owned(),
        revision: format!("{:.9}{}", program.revision, if program.dirty { " (modified)" } else { "" }),
        started: started.clone(),
        seed: settings.seed,
        configurations: settings.configurations,
    }
}

fn notes(a: &Recorded, b: &Recorded, pairs: &[[&Cell<'_>; 2]], common: Common) -> Vec<String> {
    let mut notes = Vec::new();
    let audited = |[a, b]: &&[&Cell<'_>; 2]| a.result.audit.is_some() && b.result.audit.is_some();
    let other_inputs =
        pairs.iter().filter(audited).filter(|[a, b]| a.scenario.inputs != b.scenario.inputs).count();
    if other_inputs > 0 {
        notes.push(format!(
            "{other_inputs} rows had other configurations in the two runs (seed, count or program differ): their rates \
             are compared as samples, their bits not at all"
        ));
    }
    let other_text = pairs.iter().filter(|[a, b]| a.variant.spirv.sha256 != b.variant.spirv.sha256).count();
    if other_text > 0 {
        notes.push(format!(
            "{other_text} rows are of variants whose SPIR-V differs: the shader changed, not only the device"
        ));
    }
    let clocks = pairs.iter().flat_map(|[a, b]| {
        let both = |time: &Timing| Some(time.clock != b.result.timing_in(time.setting)?.clock);
        a.result.timings().filter_map(both).collect::<Vec<_>>()
    });
    if clocks.filter(|other| *other).count() > 0 {
        notes.push("times were taken by different clocks in the two runs: they are not compared".to_owned());
    }
    let (host_a, host_b) = (&a.run.host, &b.run.host);
    for (what, common) in [("streaming", common.streaming), ("arithmetic", common.arithmetic)] {
        if let Some(common) = common {
            notes.push(format!(
                "all {what} times together: B took {common:.3} times A's; that is the machine's, and ratios are relative \
                 to it"
            ));
        }
    }
    if host_a != host_b {
        notes.push(
            "the runs come from different machines: times of software devices tell nothing then".to_owned(),
        );
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::decide::sample;

    #[test]
    fn every_run_agrees_with_itself() {
        let run = sample::run("gpu", &[("good", 0, 0, 1e-6, 10.0), ("bad", 400_000, 90_000, 0.5, 5.0)]);
        let told = compare(&run, &run, Tolerances::default());
        assert_eq!(told.rows.len(), 4);
        assert!(told.rows.iter().all(|row| row.accuracy.as_ref().unwrap().change == Change::Same));
        assert!(told.rows.iter().flat_map(|row| &row.times).all(|time| time.change == Change::Same));
        assert!(told.only_a.is_empty() && told.only_b.is_empty() && told.notes.is_empty());
    }

    #[test]
    fn changes_are_found_where_they_are() {
        let before = sample::run("gpu", &[("good", 0, 0, 1e-6, 10.0), ("gone", 0, 0, 1e-6, 5.0)]);
        let after = sample::run("gpu", &[("good", 0, 9, 1e-6, 20.0), ("new", 0, 0, 1e-6, 5.0)]);
        let told = compare(&before, &after, Tolerances::default());
        let changes = |row: &Row| (row.accuracy.as_ref().unwrap().change, row.times[0].change);
        assert!(told.rows.iter().all(|row| row.id() == "family/good"));
        assert!(told.rows.iter().all(|row| changes(row) == (Change::Worse, Change::Worse)));
        assert_eq!(told.only_a.len(), 2);
        assert_eq!(told.only_b[0], "family/new . one");
        let back = compare(&after, &before, Tolerances::default());
        assert!(back.rows.iter().all(|row| changes(row) == (Change::Better, Change::Better)));
    }

    /// Every time doubled on a software device is the machine; on a GPU it is the driver.
    #[test]
    fn a_software_devices_common_change_is_taken_out() {
        let variants: Vec<(String, f64)> = (1..=8).map(|k| (format!("v{k}"), f64::from(k))).collect();
        let run = |kind: &str, slower: f64| {
            let variants: Vec<_> =
                variants.iter().map(|(name, ns)| (name.as_str(), 0, 0, 1e-6, ns * slower)).collect();
            sample::run(kind, &variants)
        };
        let times = |kind: &str| {
            let told = compare(&run(kind, 1.0), &run(kind, 2.0), Tolerances::default());
            told.rows.iter().flat_map(|row| row.times.clone()).map(|time| time.change).collect::<Vec<_>>()
        };
        assert!(times("cpu").iter().all(|change| *change == Change::Same));
        assert!(times("discrete_gpu").iter().all(|change| *change == Change::Worse));
    }

    /// One variant's time doubled among others is its own; unless the null kernel's doubled as well.
    #[test]
    fn what_the_null_kernel_does_is_the_machines() {
        let run = |first: f64, null: f64| {
            let variants: Vec<(String, f64)> = (1..=8).map(|k| (format!("v{k}"), 10.0)).collect();
            let variants: Vec<_> = variants
                .iter()
                .map(|(name, ns)| (name.as_str(), 0, 0, 1e-6, if name == "v1" { ns * first } else { *ns }))
                .collect();
            let mut run = sample::run("cpu", &variants);
            for scenario in &mut run.run.families[0].scenarios {
                scenario.rankings = vec![sample::ranking(null)];
            }
            run
        };
        let change = |b: &Recorded| {
            let told = compare(&run(1.0, 1.0), b, Tolerances::default());
            let rows = told.rows.iter().filter(|row| row.variant == "v1");
            rows.flat_map(|row| row.times.clone()).map(|time| time.change).collect::<Vec<_>>()
        };
        assert_eq!(change(&run(2.0, 1.0)), [Change::Worse; 2]);
        assert!(change(&run(2.0, 2.2)).iter().all(|change| *change != Change::Worse));
    }

    #[test]
    fn one_bit_is_seen() {
        let (a, mut b) =
            (sample::run("gpu", &[("v", 0, 0, 1e-6, 1.0)]), sample::run("gpu", &[("v", 0, 0, 1e-6, 1.0)]));
        let told = compare(&a, &b, Tolerances::default());
        assert!(told.rows.iter().all(|row| row.bits.unwrap().identical()));
        b.bits.values_mut().for_each(|bits| bits.add(5, &[1.0]));
        let told = compare(&a, &b, Tolerances::default());
        assert!(told.rows.iter().all(|row| row.bits.unwrap().differing.round() == 1.0));
    }
}
