//! `rootq pick`: which variant of a family to ship, from recorded runs.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use clap::{Args, ValueEnum};

use super::{Outcome, selection};
use crate::bench::Setting;
use crate::decide::{self, Constraints, Quantile};
use crate::record::{self, Recorded};
use crate::report;

/// Options of `rootq pick`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq pick ltc_disk                                    newest run of each device in bench_results/\n  \
    rootq pick ltc_disk lavapipe/ nvidia/ --no-non-finite  these runs\n  \
    rootq pick ellipse_axes --max-error 1e-3 --quantile p999 --scenario aspect")]
pub(super) struct Arguments {
    /// Family to pick from
    family: String,
    /// Run folders, one a device [default: for each device the newest below bench_results/ that holds the family]
    #[arg(value_name = "RUN")]
    runs: Vec<PathBuf>,
    /// Only devices whose name contains one of these, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    devices: Vec<String>,
    /// Largest error of any output, in its own measure, at --quantile
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    max_error: Option<f64>,
    /// Which part of the errors --max-error means: p50, p90, p99, p999 or worst
    #[arg(long, value_name = "QUANTILE", default_value = "worst", value_parser = quantile)]
    quantile: Quantile,
    /// Largest share of configurations that are wrong by the variant's own fault, in any scenario
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    max_failed: Option<f64>,
    /// Nothing that is NaN or infinite
    #[arg(long)]
    no_non_finite: bool,
    /// Only this scenario counts; may be given again [default: all]
    #[arg(long, value_name = "NAME")]
    scenario: Vec<String>,
    /// Which times count
    #[arg(long, value_enum, default_value_t = Times::Auto)]
    times: Times,
    /// The choice with all figures as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Times {
    /// Arithmetic with independent inputs where every run has it, else streaming
    Auto,
    /// One evaluation a configuration, inputs from memory
    Streaming,
    /// Many evaluations in registers, independent inputs
    Arithmetic,
    /// Many evaluations in registers, the same inputs side by side
    Coherent,
}

pub(super) fn pick(arguments: &Arguments) -> Result<Outcome> {
    for (name, limit) in [("--max-error", arguments.max_error), ("--max-failed", arguments.max_failed)] {
        if limit.is_some_and(|limit| !(limit >= 0.0)) {
            bail!("{name} must not be negative");
        }
    }
    let family = selection::family(&arguments.family)?.name();
    let runs = if arguments.runs.is_empty() {
        newest(Path::new("bench_results"), family)?
    } else {
        arguments.runs.iter().map(|path| record::read(path)).collect::<Result<_, _>>()?
    };
    let known: Vec<String> = runs.iter().map(|run| run.run.device.name.clone()).collect();
    let wanted = |run: &&Recorded| {
        let name = run.run.device.name.to_lowercase();
        arguments.devices.is_empty()
            || arguments.devices.iter().any(|part| name.contains(&part.to_lowercase()))
    };
    let runs: Vec<&Recorded> = runs.iter().filter(wanted).collect();
    if runs.is_empty() {
        bail!("no run on a device named '{}'; there are: {}", arguments.devices.join(","), known.join(", "));
    }
    let constraints = Constraints {
        max_error: arguments.max_error,
        quantile: arguments.quantile,
        max_failed: arguments.max_failed,
        no_non_finite: arguments.no_non_finite,
        scenarios: arguments.scenario.clone(),
        setting: setting(arguments.times, &runs, family),
    };
    let choice = decide::pick(family, &runs, &constraints).map_err(|message| anyhow!(message))?;
    let text = if arguments.json {
        format!("{}\n", serde_json::to_string_pretty(&choice)?)
    } else {
        report::pick(&choice, super::colour())
    };
    super::print(&text)?;
    // A choice that nothing satisfies is a claim that does not hold.
    Ok(if choice.found { Outcome::Clean } else { Outcome::Violated })
}

fn quantile(text: &str) -> Result<Quantile, String> {
    let names = || Quantile::ALL.map(Quantile::name).join(", ");
    let found = Quantile::ALL.into_iter().find(|quantile| quantile.name() == text);
    found.ok_or_else(|| format!("there are: {}", names()))
}

fn setting(times: Times, runs: &[&Recorded], family: &str) -> Setting {
    let has = |run: &&Recorded| {
        let families = run.run.families.iter().filter(|recorded| recorded.name == family);
        let mut results = families.flat_map(|family| &family.variants).flat_map(|variant| &variant.results);
        results.any(|result| result.timing_in(Setting::DIVERGENT).is_some())
    };
    match times {
        Times::Streaming => Setting::STREAMING,
        Times::Arithmetic => Setting::DIVERGENT,
        Times::Coherent => Setting::COHERENT,
        Times::Auto if runs.iter().all(has) => Setting::DIVERGENT,
        Times::Auto => Setting::STREAMING,
    }
}

/// For each device the newest run below `folder` that audited the family.
fn newest(folder: &Path, family: &str) -> Result<Vec<Recorded>> {
    let none = || anyhow!("no audit of {family} below {}; 'rootq run {family}' makes one", folder.display());
    let mut newest: std::collections::BTreeMap<String, Recorded> = std::collections::BTreeMap::new();
    for device in std::fs::read_dir(folder).map_err(|_| none())?.flatten() {
        let Ok(runs) = std::fs::read_dir(device.path()) else { continue };
        for entry in runs.flatten() {
            let recorded = match record::read(&entry.path()) {
                Ok(recorded) => recorded,
                Err(record::Error::NoRun { .. }) => continue,
                Err(error) => return Err(error.into()),
            };
            let results = recorded.run.families.iter().filter(|recorded| recorded.name == family);
            let mut results =
                results.flat_map(|family| &family.variants).flat_map(|variant| &variant.results);
            if !results.any(|result| result.audit.is_some()) {
                continue;
            }
            let name = recorded.run.device.name.clone();
            // RFC 3339 in UTC sorts by time.
            if newest.get(&name).is_none_or(|other| other.run.started < recorded.run.started) {
                newest.insert(name, recorded);
            }
        }
    }
    if newest.is_empty() {
        return Err(none());
    }
    Ok(newest.into_values().collect())
}
