//! `rootq hunt`: the worst configuration that a scenario can draw.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use clap::Args;
use serde_json::json;

use super::Outcome;
use super::count;
use super::machine::{DeviceArguments, Machine};
use super::progress::bar;
use super::run::{Prepared, host, prepare, program};
use super::selection;
use super::shader::ShaderArguments;
use crate::audit::Fingerprint;
use crate::device::Device;
use crate::family::Scenario;
use crate::hunt::{self, Budget, Hunted, Plan};
use crate::record::{self, Evidence, Folder};
use crate::report;

/// Options of `rootq hunt`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq hunt ellipse_axes/naive                     a minute for all scenarios\n  \
    rootq hunt 'ltc_disk/secular_*' --seconds 600 --scenario ggx\n  \
    rootq hunt --shader my.comp --family ltc_disk     your shader\n  \
    rootq hunt sin/native --evaluations 1M --seed 7   the same again finds the same")]
pub(super) struct Arguments {
    /// Variants to hunt: FAMILY/VARIANT, FAMILY or a glob such as 'ellipse_axes/cross*'
    #[arg(value_name = "SELECT", required_unless_present = "shader")]
    select: Vec<String>,
    /// Time for the whole hunt, shared out evenly among variants and scenarios; what is found then depends on
    /// how far the machine comes [default: 60]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    seconds: Option<f64>,
    /// Instead of a time: evaluations by the search of each variant and scenario, with as many random ones
    /// beside it; K, M and G are allowed. The same seed then finds the same
    #[arg(long, value_name = "N", value_parser = count::parse, allow_hyphen_values = true, conflicts_with = "seconds")]
    evaluations: Option<u64>,
    /// Only this scenario; may be given again [default: all]
    #[arg(long, value_name = "NAME")]
    scenario: Vec<String>,
    /// Seed of the search, and of the random configurations beside it, which are those of an audit with this seed
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    device: DeviceArguments,
    #[command(flatten)]
    shaders: ShaderArguments,
    /// Run folder to write [default: bench_results/<device>/hunt-<date>-<commit>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a run that --out holds already
    #[arg(long)]
    force: bool,
    /// What was found as JSON instead of tables
    #[arg(long)]
    json: bool,
}

const DEFAULT_SECONDS: f64 = 60.0;

pub(super) fn hunt(arguments: &Arguments, stop: &AtomicBool) -> Result<Outcome> {
    let (start, started) = (Instant::now(), jiff::Timestamp::now());
    if arguments.seconds.is_some_and(|seconds| !(seconds > 0.0 && seconds <= 86_400.0)) {
        bail!("--seconds must be above 0 and at most 86400");
    }
    let selected = arguments.shaders.select(&arguments.select)?;
    selection::check_scenarios(&selected, &arguments.scenario)?;
    let machine = arguments.device.open()?;
    let facts = machine.device.facts().clone();
    let target = arguments.out.clone().unwrap_or_else(|| {
        let date = format!("hunt-{}", started.strftime("%Y-%m-%d"));
        record::default_path(&facts.name, &date, env!("ROOTQ_REVISION"))
    });
    let mut folder = Folder::create(&target, arguments.force)?;

    eprintln!("device: {} ({} {})", facts.name, facts.driver, facts.driver_info);
    let mut families = selected
        .into_iter()
        .map(|selected| prepare(selected, &machine.device))
        .collect::<Result<Vec<_>>>()?;
    families.iter().for_each(|family| family.keep_modules(&mut folder));
    let mut clock = Clock::new(arguments, &families);
    let mut evidence = Vec::new();
    for family in &mut families {
        for scenario in selection::scenarios(family.selected.problem, &arguments.scenario) {
            for at in 0..family.audited.len() {
                if stop.load(Ordering::Relaxed) {
                    break;
                }
                one(family, at, scenario, &machine, arguments.seed, &mut clock, stop, &mut evidence)?;
            }
            family.record.scenarios.push(record::Scenario {
                name: scenario.name.to_owned(),
                summary: scenario.summary.to_owned(),
                inputs: None,
                oracle: None,
                rankings: Vec::new(),
            });
        }
    }
    machine.check_validation()?;
    if stop.load(Ordering::Relaxed) && evidence.is_empty() {
        bail!("interrupted");
    }

    let run = record::Run {
        schema: record::SCHEMA,
        program: program(),
        command: std::env::args().collect(),
        started: started.to_string(),
        seconds: start.elapsed().as_secs_f64(),
        host: host(),
        device: facts,
        settings: record::Settings {
            seed: arguments.seed,
            configurations: arguments.evaluations.unwrap_or(0),
            chunk: hunt::BATCH,
            max_failures: crate::audit::Verdict::ALL.len(),
        },
        ceilings: None,
        families: families.into_iter().map(|family| family.record).collect(),
    };
    let folder = folder.finish(&run, &evidence)?;
    super::print(&if arguments.json { as_json(&run)? } else { report::hunt(&run, super::colour()) })?;
    let interrupted = stop.load(Ordering::Relaxed);
    let how = if interrupted { "interrupted; what was found so far" } else { "run folder" };
    eprintln!("{how}: {} ({:.0} s)", folder.display(), run.seconds);
    Ok(if interrupted { Outcome::Interrupted } else { Outcome::Clean })
}

/// What is left to spend, on how many hunts.
struct Clock {
    evaluations: Option<u64>,
    end: Instant,
    hunts: u32,
}

impl Clock {
    fn new(arguments: &Arguments, families: &[Prepared]) -> Self {
        let hunts = families.iter().map(|family| {
            family.audited.len() * selection::scenarios(family.selected.problem, &arguments.scenario).len()
        });
        Clock {
            evaluations: arguments.evaluations,
            end: Instant::now() + Duration::from_secs_f64(arguments.seconds.unwrap_or(DEFAULT_SECONDS)),
            hunts: hunts.sum::<usize>() as u32,
        }
    }

    /// The next hunt's budget, and the length of its progress bar: evaluations or milliseconds.
    fn next(&mut self) -> (Budget, u64) {
        if let Some(evaluations) = self.evaluations {
            return (Budget::Evaluations(evaluations), evaluations);
        }
        let now = Instant::now();
        let share = self.end.saturating_duration_since(now) / self.hunts.max(1);
        self.hunts = self.hunts.saturating_sub(1);
        (Budget::Until(now + share), share.as_millis() as u64)
    }
}

/// Hunts with one variant on one scenario, into the family's record.
#[allow(clippy::too_many_arguments, reason = "one call, from the loop over its arguments")]
fn one(
    family: &mut Prepared,
    at: usize,
    scenario: &'static Scenario,
    machine: &Machine,
    seed: u64,
    clock: &mut Clock,
    stop: &AtomicBool,
    evidence: &mut Vec<Evidence>,
) -> Result<()> {
    let problem = family.selected.problem;
    let variant = &mut family.record.variants[family.places[at]];
    let label = format!("{}/{} . {}", problem.name(), variant.name, scenario.name);
    let (budget, length) = clock.next();
    let plan = Plan { problem, scenario, seed, budget };
    let bar = bar(length, &label, "{prefix}  {eta} to go");
    let begin = Instant::now();
    let advance = |hunted: &Hunted| {
        let worst = hunted.search.worst_finite().map_or(0.0, |find| find.size);
        bar.set_prefix(format!("{} evaluations, worst {worst:.3e}", hunted.evaluations));
        bar.set_position(match budget {
            Budget::Evaluations(_) => hunted.evaluations,
            Budget::Until(_) => begin.elapsed().as_millis() as u64,
        });
    };
    let hunted = hunt::hunt(&machine.device, &family.audited[at], &plan, &advance, stop)?;
    bar.finish_and_clear();
    if hunted.evaluations == 0 {
        return Ok(());
    }
    evidence.push(Evidence {
        family: problem.name(),
        variant: variant.name.clone(),
        scenario: scenario.name,
        failures: hunted.search.failures.values().rev().map(|find| find.failure.clone()).collect(),
        bits: Fingerprint::default(),
    });
    variant.results.push(record::Result {
        scenario: scenario.name.to_owned(),
        audit: None,
        timing: None,
        arithmetic: Vec::new(),
        hunt: Some(record::hunt(&hunted)),
    });
    eprintln!("done: {label}");
    Ok(())
}

/// One object a hunt, with the record's own words.
fn as_json(run: &record::Run) -> Result<String> {
    let mut all = Vec::new();
    for family in &run.families {
        for variant in &family.variants {
            for result in &variant.results {
                all.push(json!({
                    "family": family.name,
                    "variant": variant.name,
                    "scenario": result.scenario,
                    "hunt": result.hunt,
                }));
            }
        }
    }
    Ok(serde_json::to_string_pretty(&all)? + "\n")
}
