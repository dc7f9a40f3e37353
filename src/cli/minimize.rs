//! `rootq minimize`: a failing configuration that a person can read.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use serde_json::json;

use super::draft::is_dash;
use super::machine::{DeviceArguments, Machine};
use super::shader::ShaderArguments;
use super::{replay, selection};
use crate::audit::{Failure, Fingerprint, Verdict};
use crate::case::minimize::{Minimized, Outcome};
use crate::case::{self, Answer, Origin, Shrunk, origin};
use crate::catalog::Catalog;
use crate::device::{Device, vulkan::VulkanDevice};
use crate::family::{CERTIFIED, Problem};
use crate::record::configurations::Reader;
use crate::record::{self, Evidence};
use crate::report;

/// Options of `rootq minimize`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq minimize run/ --failure 17 --out small          then: rootq replay small --failure 1\n  \
    rootq minimize ellipse_axes/naive --inputs one.csv    a configuration of your own")]
#[command(group(clap::ArgGroup::new("start").required(true).args(["failure", "inputs"])))]
pub(super) struct Arguments {
    /// Run folder or failures.parquet, with --failure; FAMILY/VARIANT, with --inputs
    #[arg(value_name = "RUN")]
    target: String,
    /// Failure to minimize, by its number in 'rootq replay RUN'
    #[arg(long, value_name = "K")]
    failure: Option<usize>,
    /// CSV or Parquet with one configuration; '-' is CSV on standard input
    #[arg(long, value_name = "IN")]
    inputs: Option<PathBuf>,
    /// Folder, or file that ends in .parquet, for the minimized failure, which 'rootq replay' reads
    #[arg(long, value_name = "OUT")]
    out: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArguments,
    /// Everything as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    shaders: ShaderArguments,
}

/// Variants that were right on the configuration, of which one must stay right.
const WITNESSES: usize = 4;
/// The scenario under which a minimized failure is recorded.
const SCENARIO: &str = "minimized";

/// What is to be minimized.
struct Start {
    problem: &'static dyn Problem,
    variant: String,
    inputs: Vec<f32>,
    /// Configuration that it was, 0 for the user's own.
    index: u64,
    recorded: Option<Verdict>,
    origin: Origin,
}

pub(super) fn minimize(arguments: &Arguments, stop: &AtomicBool) -> Result<()> {
    let mut catalog = Catalog::embedded()?;
    arguments.shaders.bring(&mut catalog, None)?;
    let start = start(arguments, &catalog)?;
    let out = arguments.out.as_deref().map(Out::new).transpose()?;
    let (problem, id) = (start.problem, format!("{}/{}", start.problem.name(), start.variant));
    let machine = arguments.device.open()?;
    let here = origin::device(machine.device.facts());
    eprintln!("device: {here}");

    let mut shrinker = Shrinker::new(&start, &catalog, &machine, stop)?;
    let before = shrinker.answer(&start.inputs)?;
    let verdict = before.verdict;
    if !verdict.is_failure() {
        let was = start.recorded.map_or(String::new(), |was| format!(" (recorded: {})", was.name()));
        bail!("{id} does not fail here: its verdict is {}{was}; nothing to minimize", verdict.name());
    }
    if let Some(recorded) = start.recorded.filter(|recorded| *recorded != verdict) {
        eprintln!("note: recorded as {}, here it is {}", recorded.name(), verdict.name());
    }
    if !fair(problem, &start.inputs) {
        bail!(
            "the oracle does not certify the truth of this configuration: what is simpler could not be judged"
        );
    }
    shrinker.find_witnesses()?;
    let found = case::minimize(&problem.signature(), &start.inputs, |rows| shrinker.judge(rows, verdict))?;
    let after = shrinker.answer(&found.values)?;
    machine.check_validation()?;

    let shrunk = Shrunk::new(problem, &start.variant, here, (&start.inputs, &before), (&found, &after));
    let text = if arguments.json {
        format!("{:#}\n", json!(shrunk))
    } else {
        report::shrunk(&shrunk, super::colour())
    };
    let written = out.map(|out| out.write(&start, &found, &after)).transpose()?;
    super::print(&text)?;
    if let Some(path) = written {
        eprintln!("written: {0}; 'rootq replay {0} --failure 1' tells everything of it", path.display());
    }
    Ok(())
}

fn start(arguments: &Arguments, catalog: &Catalog) -> Result<Start> {
    if let Some(number) = arguments.failure {
        let origin = Origin::read(Path::new(&arguments.target))?;
        let recorded = replay::pick(&origin, number)?.clone();
        return Ok(Start {
            problem: recorded.problem,
            variant: recorded.variant,
            inputs: recorded.failure.inputs,
            index: recorded.failure.index,
            recorded: Some(recorded.failure.verdict),
            origin,
        });
    }
    let Some((family, variant)) = arguments.target.split_once('/') else {
        bail!("'{}' is no FAMILY/VARIANT, which --inputs goes with", arguments.target);
    };
    let problem = selection::family(family)?;
    let variant = selection::variant(catalog, problem, variant)?.name;
    let path = arguments.inputs.as_deref().unwrap_or(Path::new("-"));
    let columns = problem.signature().input_columns();
    let width = columns.len();
    let (mut reader, name) = if is_dash(path) {
        (Reader::standard_input(columns)?, "standard input".to_owned())
    } else {
        (Reader::open(path, problem.name(), columns)?, path.display().to_string())
    };
    let inputs = reader.batch(2)?;
    if inputs.len() != width {
        let there = if inputs.is_empty() { "none" } else { "several" };
        bail!("{name} must hold one configuration, and has {there}");
    }
    Ok(Start { problem, variant, inputs, index: 0, recorded: None, origin: Origin::default() })
}

/// Whether the oracle is certain of the truth, and that is a number.
fn fair(problem: &dyn Problem, inputs: &[f32]) -> bool {
    let truth = case::truth(problem, inputs);
    truth.worst_bound() <= CERTIFIED && truth.values().iter().all(|value| value.is_finite())
}

type Program = <VulkanDevice as Device>::Program;

/// The failing variant, and others that know the right answer.
struct Shrinker<'a> {
    start: &'a Start,
    problem: &'static dyn Problem,
    catalog: &'a Catalog,
    machine: &'a Machine,
    stop: &'a AtomicBool,
    program: Program,
    witnesses: Vec<Program>,
}

impl<'a> Shrinker<'a> {
    fn new(
        start: &'a Start,
        catalog: &'a Catalog,
        machine: &'a Machine,
        stop: &'a AtomicBool,
    ) -> Result<Self> {
        let problem = start.problem;
        let program = replay::program(&start.origin, catalog, &machine.device, problem, &start.variant)?;
        let program = program.map_err(|why| anyhow!(why))?;
        Ok(Shrinker { start, problem, catalog, machine, stop, program, witnesses: Vec::new() })
    }

    fn evaluate(&self, program: &Program, rows: &[f32]) -> Result<Vec<Answer>> {
        Ok(case::evaluate(&self.machine.device, program, self.problem, rows)?)
    }

    fn answer(&self, inputs: &[f32]) -> Result<Answer> {
        self.evaluate(&self.program, inputs)?.pop().ok_or_else(|| anyhow!("the device gave no answer"))
    }

    /// Finds the first other variants that are right at the start.
    fn find_witnesses(&mut self) -> Result<()> {
        let Start { problem, variant, inputs, origin, .. } = self.start;
        let others = self.catalog.family(problem.name()).filter(|other| other.name != *variant);
        for other in others {
            if self.witnesses.len() == WITNESSES {
                break;
            }
            let program = replay::program(origin, self.catalog, &self.machine.device, *problem, &other.name)?;
            if let Ok(program) = program
                && self.evaluate(&program, inputs)?.iter().all(|answer| answer.verdict == Verdict::Ok)
            {
                self.witnesses.push(program);
            }
        }
        Ok(())
    }

    /// What becomes of candidates. Where variants were right before, one of them must be right: a family's domain is what
    /// its variants are made for, and a failure outside it is nobody's.
    fn judge(&self, rows: &[Vec<f32>], verdict: Verdict) -> Result<Vec<Outcome>> {
        if self.stop.load(Ordering::Relaxed) {
            bail!("interrupted");
        }
        let flat: Vec<f32> = rows.iter().flatten().copied().collect();
        let answers = self.evaluate(&self.program, &flat)?;
        let mut right = vec![self.witnesses.is_empty(); rows.len()];
        for program in &self.witnesses {
            for (right, answer) in right.iter_mut().zip(self.evaluate(program, &flat)?) {
                *right |= answer.verdict == Verdict::Ok;
            }
        }
        let outcome = |((row, answer), right): ((&Vec<f32>, Answer), bool)| {
            if !right || !fair(self.problem, row) {
                Outcome::Unfair
            } else if answer.verdict == verdict {
                Outcome::Fails
            } else {
                Outcome::Other(answer.verdict)
            }
        };
        Ok(rows.iter().zip(answers).zip(right).map(outcome).collect())
    }
}

/// Where the minimized failure goes.
struct Out {
    file: PathBuf,
    /// To be created.
    folder: Option<PathBuf>,
}

impl Out {
    /// Makes sure, before any work is done, that nothing is in the way.
    fn new(path: &Path) -> Result<Out> {
        let is_file = path.extension().is_some_and(|extension| extension == "parquet");
        let out = if is_file {
            Out { file: path.to_owned(), folder: None }
        } else {
            Out { file: path.join("failures.parquet"), folder: Some(path.to_owned()) }
        };
        let occupied = match &out.folder {
            Some(folder) => folder.is_file() || folder.read_dir().is_ok_and(|mut all| all.next().is_some()),
            None => out.file.exists(),
        };
        if occupied {
            bail!("{} is there already; choose another --out", path.display());
        }
        Ok(out)
    }

    fn write(self, start: &Start, found: &Minimized, after: &Answer) -> Result<PathBuf> {
        let problem = start.problem;
        let failure = Failure {
            index: start.index,
            verdict: after.verdict,
            inputs: found.values.clone(),
            outputs: after.outputs.clone(),
            truth: case::truth(problem, &found.values).values().to_vec(),
            errors: after.errors.clone(),
            ulps: after.ulps.clone(),
        };
        let evidence = Evidence {
            family: problem.name(),
            variant: start.variant.clone(),
            scenario: SCENARIO,
            failures: vec![failure],
            bits: Fingerprint::default(),
        };
        if let Some(folder) = &self.folder {
            std::fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
            // A shader of the user's own goes with its failure.
            let own = start.origin.shader(problem, &start.variant);
            if let Some(own) = own.filter(|own| own.is_file())
                && let Some(name) = own.file_name()
            {
                let shaders = folder.join("shaders");
                std::fs::create_dir_all(&shaders)
                    .and_then(|()| std::fs::copy(&own, shaders.join(name)))
                    .with_context(|| format!("cannot copy {}", own.display()))?;
            }
        }
        record::write_failures(&self.file, &[evidence])?;
        Ok(self.folder.unwrap_or(self.file))
    }
}
