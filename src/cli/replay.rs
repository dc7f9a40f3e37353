//! `rootq replay`: recorded failures, evaluated again.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, anyhow, bail};
use clap::Args;
use serde_json::json;

use super::draft::{deliver, draft, is_dash};
use super::machine::DeviceArguments;
use super::progress::bar;
use super::selection;
use super::shader::ShaderArguments;
use crate::case::replay::Now;
use crate::case::{self, Answer, Origin, Replay, Story, amber, glsl, origin};
use crate::catalog::Catalog;
use crate::device::{Device, Error, vulkan::VulkanDevice};
use crate::family::Problem;
use crate::record::RecordedFailure;
use crate::report;

/// Options of `rootq replay`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq replay run/                                    do they still fail here?\n  \
    rootq replay run/ --device nvidia --variant talk2017  one variant's, on another device\n  \
    rootq replay run/ --failure 17                        everything about one\n  \
    rootq replay run/ --failure 17 --amber bug.amber --glsl bug.comp\n\n\
The Amber script (github.com/google/amber) holds the shader's SPIR-V, the exact inputs and what to expect: it fails on a\n\
driver with the fault and passes on a right one. The GLSL is one compute shader with the inputs in it, for a report.")]
pub(super) struct Arguments {
    /// Run folder, or a failures.parquet of run, audit, hunt or minimize
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Tell everything about this one, by its number in the list
    #[arg(long, value_name = "K")]
    failure: Option<usize>,
    /// Only failures of this variant; with --failure, other variants to show beside it [default: all]
    #[arg(long, value_name = "V")]
    variant: Vec<String>,
    /// Only failures of this scenario; may be given again [default: all]
    #[arg(long, value_name = "S", conflicts_with = "failure")]
    scenario: Vec<String>,
    /// Write the failure as an Amber script; '-' is standard output, in the place of the story
    #[arg(long, value_name = "FILE", requires = "failure")]
    amber: Option<PathBuf>,
    /// Write the failure as a self-contained GLSL compute shader; '-' likewise
    #[arg(long, value_name = "FILE", requires = "failure")]
    glsl: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArguments,
    /// Everything as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    shaders: ShaderArguments,
}

pub(super) fn replay(arguments: &Arguments, stop: &AtomicBool) -> Result<()> {
    let origin = Origin::read(&arguments.run)?;
    let mut catalog = Catalog::embedded()?;
    arguments.shaders.bring(&mut catalog, None)?;
    match arguments.failure {
        Some(number) => one(arguments, &origin, &catalog, number),
        None => all(arguments, &origin, &catalog, stop),
    }
}

/// The recorded failure of that number, from 1.
pub(super) fn pick(origin: &Origin, number: usize) -> Result<&RecordedFailure> {
    let there = origin.failures.len();
    let at = number.checked_sub(1).and_then(|at| origin.failures.get(at));
    at.ok_or_else(|| match there {
        0 => anyhow!("{} holds no failure at all", origin.path.display()),
        _ => anyhow!("{} has no failure {number}: they go from 1 to {there}", origin.path.display()),
    })
}

/// A program for one recorded variant, or why there can be none on this device.
pub(super) fn program(
    origin: &Origin,
    catalog: &Catalog,
    device: &VulkanDevice,
    problem: &dyn Problem,
    variant: &str,
) -> Result<Result<<VulkanDevice as Device>::Program, String>> {
    let module = match origin.kernel(catalog, problem, variant) {
        Ok(module) => module,
        Err(lost) => return Ok(Err(lost.to_string())),
    };
    if let Some(note) = module.note {
        eprintln!("note: {note}");
    }
    match device.program(&module.safe) {
        Ok(program) => Ok(Ok(program)),
        Err(error @ (Error::NotSupported { .. } | Error::InvalidKernel { .. })) => Ok(Err(error.to_string())),
        Err(error) => Err(error.into()),
    }
}

fn all(arguments: &Arguments, origin: &Origin, catalog: &Catalog, stop: &AtomicBool) -> Result<()> {
    let chosen = select(arguments, origin)?;
    if chosen.is_empty() {
        eprintln!("{} holds no failures: nothing to replay", origin.path.display());
        if arguments.json {
            super::print("{\"groups\": [], \"failures\": []}\n")?;
        }
        return Ok(());
    }
    let machine = arguments.device.open()?;
    let here = origin::device(machine.device.facts());
    eprintln!("device: {here}");
    let mut now: Vec<Result<Now, String>> = chosen.iter().map(|_| Err(String::new())).collect();
    let mut ids: Vec<String> = chosen.iter().map(|(_, failure)| failure.id()).collect();
    ids.sort();
    ids.dedup();
    let bar = bar(chosen.len() as u64, "replay", "{human_pos} of {human_len}");
    for id in &ids {
        if stop.load(Ordering::Relaxed) {
            bail!("interrupted");
        }
        let places: Vec<usize> = (0..chosen.len()).filter(|place| chosen[*place].1.id() == *id).collect();
        let first = chosen[places[0]].1;
        match program(origin, catalog, &machine.device, first.problem, &first.variant)? {
            Ok(program) => {
                let inputs: Vec<f32> =
                    places.iter().flat_map(|place| chosen[*place].1.failure.inputs.iter().copied()).collect();
                let answers = case::evaluate(&machine.device, &program, first.problem, &inputs)?;
                for (place, answer) in places.iter().zip(&answers) {
                    now[*place] = Ok(Now::new(chosen[*place].1, answer));
                }
            }
            Err(why) => {
                eprintln!("skipped {id}: {why}");
                for place in &places {
                    now[*place] = Err(why.clone());
                }
            }
        }
        bar.inc(places.len() as u64);
    }
    bar.finish_and_clear();
    machine.check_validation()?;

    let replay = Replay::new(chosen.iter().zip(now).map(|((number, failure), now)| (*number, *failure, now)));
    let recorded_on = origin.device();
    if arguments.json {
        let value = json!({
            "recorded_on": recorded_on,
            "device": here,
            "groups": replay.groups,
            "failures": replay.failures,
        });
        return super::print(&format!("{value:#}\n"));
    }
    if let Some(device) = recorded_on {
        eprintln!("recorded on: {device}");
    }
    super::print(&report::replay(&replay, super::colour()))
}

/// The failures that --variant and --scenario leave, with their numbers.
fn select<'a>(arguments: &Arguments, origin: &'a Origin) -> Result<Vec<(usize, &'a RecordedFailure)>> {
    let is = |failure: &RecordedFailure, name: &String| *name == failure.variant || *name == failure.id();
    for name in &arguments.variant {
        if !origin.failures.iter().any(|failure| is(failure, name)) {
            let known = origin
                .failures
                .iter()
                .map(|failure| if name.contains('/') { failure.id() } else { failure.variant.clone() });
            bail!("no failure of variant '{name}' was recorded{}", near(name, known));
        }
    }
    for name in &arguments.scenario {
        if !origin.failures.iter().any(|failure| failure.scenario == *name) {
            let known = origin.failures.iter().map(|failure| failure.scenario.clone());
            bail!("no failure of scenario '{name}' was recorded{}", near(name, known));
        }
    }
    let wanted = |failure: &RecordedFailure| {
        (arguments.variant.is_empty() || arguments.variant.iter().any(|name| is(failure, name)))
            && (arguments.scenario.is_empty() || arguments.scenario.contains(&failure.scenario))
    };
    let numbered = origin.failures.iter().enumerate().map(|(at, failure)| (at + 1, failure));
    Ok(numbered.filter(|(_, failure)| wanted(failure)).collect())
}

fn near(name: &str, known: impl Iterator<Item = String>) -> String {
    let mut known: Vec<String> = known.collect();
    known.sort();
    selection::suggestion(name, known.into_iter())
}

fn one(arguments: &Arguments, origin: &Origin, catalog: &Catalog, number: usize) -> Result<()> {
    let recorded = pick(origin, number)?;
    let problem = recorded.problem;
    let mut names = vec![recorded.variant.clone()];
    if arguments.variant.is_empty() {
        names.extend(catalog.family(problem.name()).map(|variant| variant.name.clone()));
    } else {
        for name in &arguments.variant {
            let own = *name == recorded.variant || *name == recorded.id();
            names.push(if own {
                recorded.variant.clone()
            } else {
                selection::variant(catalog, problem, name)?.name
            });
        }
    }
    let mut seen: Vec<String> = Vec::new();
    names.retain(|name| {
        let new = !seen.contains(name);
        seen.push(name.clone());
        new
    });
    let machine = arguments.device.open()?;
    let here = origin::device(machine.device.facts());
    eprintln!("device: {here}");
    let mut answers: Vec<(String, Result<Answer, String>)> = Vec::new();
    for name in names {
        let answer = match program(origin, catalog, &machine.device, problem, &name)? {
            Ok(program) => {
                let mut answers =
                    case::evaluate(&machine.device, &program, problem, &recorded.failure.inputs)?;
                answers.pop().ok_or_else(|| "the device gave no answer".to_owned())
            }
            Err(why) => Err(why),
        };
        answers.push((name, answer));
    }
    machine.check_validation()?;
    let story = Story::new(number, recorded, origin.device(), here, &answers);
    let exports = export(arguments, origin, catalog, recorded, &story, &answers)?;
    for (path, text) in &exports {
        let file = draft(path)?;
        file.as_file().write_all(text.as_bytes())?;
        deliver(file, path)?;
        if !is_dash(path) {
            eprintln!("written: {}", path.display());
        }
    }
    if exports.iter().any(|(path, _)| is_dash(path)) {
        return Ok(());
    }
    if arguments.json {
        return super::print(&format!("{:#}\n", json!(story)));
    }
    super::print(&report::story(&story, super::colour()))
}

/// The files that are asked for, all of them or none.
fn export(
    arguments: &Arguments,
    origin: &Origin,
    catalog: &Catalog,
    recorded: &RecordedFailure,
    story: &Story,
    answers: &[(String, Result<Answer, String>)],
) -> Result<Vec<(PathBuf, String)>> {
    let mut exports = Vec::new();
    if arguments.amber.is_none() && arguments.glsl.is_none() {
        return Ok(exports);
    }
    let (problem, id) = (recorded.problem, recorded.id());
    // Where it does not run here, what was seen is what was recorded.
    let seen = match answers.first() {
        Some((_, Ok(answer))) => answer.clone(),
        _ => Answer::from(&recorded.failure),
    };
    if let Some(path) = &arguments.amber {
        let module = origin.kernel(catalog, problem, &recorded.variant)?;
        let script = amber::script(problem, &module.kernel, recorded, story, &seen);
        exports.push((path.clone(), script.map_err(|why| anyhow!("no Amber script of {id}: {why}"))?));
    }
    if let Some(path) = &arguments.glsl {
        let variant = catalog.family(problem.name()).find(|variant| variant.name == recorded.variant);
        let snippet = glsl::snippet(problem, variant, story, &seen);
        exports.push((path.clone(), snippet.map_err(|why| anyhow!("no GLSL of {id}: {why}"))?));
    }
    if exports.iter().filter(|(path, _)| is_dash(path)).count() > 1 {
        bail!("only one of --amber and --glsl can go to standard output");
    }
    Ok(exports)
}
