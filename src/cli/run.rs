//! `rootq run`, `audit` and `bench`: the same plan, both halves of it or one.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use clap::Args;

use super::count;
use super::machine::DeviceArguments;
use super::progress::bar;
use super::selection::{self, Selected};
use super::shader::ShaderArguments;
use super::timing::{Depth, Timed, Timer, TimingArguments};
use crate::audit::{self, MAX_CHUNK, Plan};
use crate::bench::{Ceilings, Regime};
use crate::catalog::{self, Compiled, Variant};
use crate::device::{self, Device, vulkan::VulkanDevice};
use crate::family::Scenario;
use crate::record::{self, Evidence, Folder};
use crate::report;

/// Which halves of a run a verb does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halves {
    Both,
    Audit,
    Bench,
}

/// What all three verbs take.
#[derive(Args, Debug)]
struct Common {
    /// Variants: FAMILY, FAMILY/VARIANT or a glob such as 'ellipse_axes/cross*' [default: all]
    #[arg(value_name = "SELECT")]
    select: Vec<String>,
    /// Seed of the random configurations
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    device: DeviceArguments,
    #[command(flatten)]
    shaders: ShaderArguments,
    /// Run folder to write [default: bench_results/<device>/<date>-<commit>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a run that --out holds already
    #[arg(long)]
    force: bool,
}

const MAX_FAILURES: usize = 100;

/// What an audit takes.
#[derive(Args, Debug)]
struct Precision {
    /// Configurations a scenario; K, M and G are allowed
    #[arg(short = 'n', value_name = "COUNT", default_value = "1M", value_parser = count::parse, allow_hyphen_values = true)]
    configurations: u64,
    /// Only this scenario; may be given again [default: all]
    #[arg(long, value_name = "NAME")]
    scenario: Vec<String>,
    /// Failures to keep a variant and scenario
    #[arg(long, value_name = "N", default_value_t = MAX_FAILURES)]
    max_failures: usize,
    /// Configurations a chunk, at most 2^20; changes no result
    #[arg(long, value_name = "COUNT", default_value_t = MAX_CHUNK as u64, value_parser = count::parse)]
    chunk: u64,
    /// Host threads for sampling, oracle and judge; changes no result [default: one a core]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

/// Options of `rootq run`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq run                                         every built-in variant, every scenario\n  \
    rootq run ellipse_axes --scenario aspect -n 4M    one family on one scenario\n  \
    rootq run --shader my.comp --family ltc_disk      your shader\n  \
    rootq run ltc_disk --shader my.hlsl               your shader beside all of the family")]
pub(super) struct RunArguments {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    precision: Precision,
    #[command(flatten)]
    timing: TimingArguments,
}

/// Options of `rootq audit`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq audit ellipse_axes --scenario aspect -n 4M  one family on one scenario\n  \
    rootq audit sin/native --exhaustive --out sin     all 2^32 inputs; started again it goes on")]
pub(super) struct AuditArguments {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    precision: Precision,
    #[command(flatten)]
    exhaustive: super::exhaustive::Options,
}

/// Options of `rootq bench`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq bench 'ellipse_axes/cross*'                 times of some variants\n  \
    rootq bench ltc_line --reference heitz2017 --seconds 10")]
pub(super) struct BenchArguments {
    #[command(flatten)]
    common: Common,
    /// Only this scenario; may be given again [default: each family's first]
    #[arg(long, value_name = "NAME")]
    scenario: Vec<String>,
    #[command(flatten)]
    timing: TimingArguments,
}

/// What is to be done, whichever verb says so.
#[derive(Debug)]
pub(super) struct Arguments {
    pub(super) select: Vec<String>,
    configurations: u64,
    pub(super) exhaustive: super::exhaustive::Options,
    seed: u64,
    scenario: Vec<String>,
    pub(super) device: DeviceArguments,
    shaders: ShaderArguments,
    pub(super) out: Option<PathBuf>,
    pub(super) force: bool,
    pub(super) max_failures: usize,
    pub(super) chunk: u64,
    threads: Option<usize>,
    timing: TimingArguments,
}

impl Arguments {
    fn new(
        common: Common,
        precision: Precision,
        exhaustive: super::exhaustive::Options,
        timing: TimingArguments,
    ) -> Self {
        let Common { select, seed, device, shaders, out, force } = common;
        let Precision { configurations, scenario, max_failures, chunk, threads } = precision;
        Arguments {
            select,
            configurations,
            exhaustive,
            seed,
            scenario,
            device,
            shaders,
            out,
            force,
            max_failures,
            chunk,
            threads,
            timing,
        }
    }
}

impl From<RunArguments> for Arguments {
    fn from(RunArguments { common, precision, timing }: RunArguments) -> Self {
        Arguments::new(common, precision, Default::default(), timing)
    }
}

impl From<AuditArguments> for Arguments {
    fn from(AuditArguments { common, precision, exhaustive }: AuditArguments) -> Self {
        Arguments::new(common, precision, exhaustive, TimingArguments::default())
    }
}

impl From<BenchArguments> for Arguments {
    fn from(BenchArguments { common, scenario, timing }: BenchArguments) -> Self {
        let precision = Precision {
            configurations: crate::bench::CONFIGURATIONS as u64,
            scenario,
            max_failures: MAX_FAILURES,
            chunk: MAX_CHUNK as u64,
            threads: None,
        };
        Arguments::new(common, precision, Default::default(), timing)
    }
}

/// Variants that are ready to run, and those that cannot here.
pub(super) struct Prepared {
    pub(super) record: record::Family,
    pub(super) selected: Selected,
    /// Programs, each with its variant's place in the record.
    pub(super) programs: Vec<<VulkanDevice as Device>::Program>,
    /// The same for audits, where some watch their indices.
    pub(super) audited: Vec<<VulkanDevice as Device>::Program>,
    pub(super) places: Vec<usize>,
    /// Names and modules of shaders that are not built in.
    modules: Vec<(String, Vec<u32>)>,
}

impl Prepared {
    /// Lets the run keep what nobody else has.
    pub(super) fn keep_modules(&self, folder: &mut Folder) {
        for (variant, words) in &self.modules {
            folder.keep_module(&self.record.name, variant, words);
        }
    }
}

pub(super) fn run(arguments: &Arguments, halves: Halves, stop: &AtomicBool) -> Result<()> {
    let start = Instant::now();
    let started = jiff::Timestamp::now();
    arguments.timing.check()?;
    if let Some(threads) = arguments.threads {
        if !(1..=1024).contains(&threads) {
            bail!("--threads must be from 1 to 1024");
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().context("--threads")?;
    }
    if arguments.exhaustive.wanted() {
        return super::exhaustive::audit(arguments, start, started, stop);
    }
    let selected = select(arguments)?;
    selection::check_scenarios(&selected, &arguments.scenario)?;
    arguments.timing.check_reference(&selected)?;
    let machine = arguments.device.open_with(arguments.timing.options())?;
    let facts = machine.device.facts().clone();
    let target = arguments.out.clone().unwrap_or_else(|| {
        let date = started.strftime("%Y-%m-%d").to_string();
        record::default_path(&facts.name, &date, env!("ROOTQ_REVISION"))
    });
    let mut folder = Folder::create(&target, arguments.force)?;

    let mut families = selected
        .into_iter()
        .map(|selected| prepare(selected, &machine.device))
        .collect::<Result<Vec<_>>>()?;
    eprintln!("device: {} ({} {})", facts.name, facts.driver, facts.driver_info);
    families.iter().for_each(|family| family.keep_modules(&mut folder));
    let timer = match halves {
        Halves::Audit => None,
        Halves::Both => Some(Timer::new(&arguments.timing, &machine.device, Depth::Glance, stop)?),
        Halves::Bench => Some(Timer::new(&arguments.timing, &machine.device, Depth::Study, stop)?),
    };
    let mut evidence = Vec::new();
    for family in &mut families {
        let scenarios = selection::scenarios(family.selected.problem, &arguments.scenario);
        for (position, scenario) in scenarios.into_iter().enumerate() {
            // Times hardly depend on the configurations: one scenario tells them, unless more are asked for.
            let named = halves == Halves::Bench && !arguments.scenario.is_empty();
            let timer = timer.as_ref().filter(|_| position == 0 || named);
            if halves == Halves::Bench && timer.is_none() {
                break;
            }
            let work = Work { audit: halves != Halves::Bench, timer };
            measure(family, scenario, &machine.device, arguments, work, stop, &mut evidence)?;
        }
    }
    machine.check_validation()?;

    let measured = Measured {
        configurations: arguments.configurations,
        device: facts,
        ceilings: timer.map(|timer| timer.ceilings),
        families: families.into_iter().map(|family| family.record).collect(),
        evidence,
    };
    finish(arguments, (start, started), folder, measured)
}

/// The selected variants; with shaders of the user's own and no other wish, these alone.
pub(super) fn select(arguments: &Arguments) -> Result<Vec<Selected>> {
    arguments.shaders.select(&arguments.select)
}

/// What a run found.
pub(super) struct Measured {
    /// Configurations a scenario.
    pub(super) configurations: u64,
    pub(super) device: device::Facts,
    pub(super) ceilings: Option<Ceilings>,
    pub(super) families: Vec<record::Family>,
    pub(super) evidence: Vec<Evidence>,
}

/// Writes the run's folder and shows its tables.
pub(super) fn finish(
    arguments: &Arguments,
    (start, started): (Instant, jiff::Timestamp),
    folder: Folder,
    measured: Measured,
) -> Result<()> {
    let Measured { configurations, device, ceilings, families, evidence } = measured;
    let run = record::Run {
        schema: record::SCHEMA,
        program: program(),
        command: std::env::args().collect(),
        started: started.to_string(),
        seconds: start.elapsed().as_secs_f64(),
        host: host(),
        device,
        settings: record::Settings {
            seed: arguments.seed,
            configurations,
            chunk: arguments.chunk.min(MAX_CHUNK as u64) as usize,
            max_failures: arguments.max_failures,
        },
        ceilings,
        families,
    };
    let folder = folder.finish(&run, &evidence)?;
    super::print(&report::run(&run, super::colour()))?;
    eprintln!("run folder: {} ({:.0} s)", folder.display(), run.seconds);
    Ok(())
}

pub(super) fn host() -> record::Host {
    record::Host {
        os: std::env::consts::OS.to_owned(),
        arch: std::env::consts::ARCH.to_owned(),
        threads: rayon::current_num_threads(),
    }
}

pub(super) fn program() -> record::Program {
    record::Program {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        revision: env!("ROOTQ_REVISION").to_owned(),
        dirty: env!("ROOTQ_DIRTY") == "true",
        compiler: catalog::compiler_version(),
    }
}

/// Compiles the selected variants; what the device lacks is recorded as a skip.
pub(super) fn prepare(selected: Selected, device: &VulkanDevice) -> Result<Prepared> {
    let signature = selected.problem.signature();
    let mut record = record::family(selected.problem);
    let (mut programs, mut audited) = (Vec::new(), Vec::new());
    let (mut places, mut modules) = (Vec::new(), Vec::new());
    for variant in &selected.variants {
        let Compiled { kernel, watched, facts } = variant.compile(&signature, false)?;
        let skipped = match device.program(&kernel) {
            Ok(program) => {
                audited.push(watched.map(|kernel| device.program(&kernel)).transpose()?);
                programs.push(program);
                places.push(record.variants.len());
                None
            }
            // Who brings a shader wants to know.
            Err(error @ device::Error::NotSupported { .. }) if !variant.is_own() => Some(error.to_string()),
            Err(error) => return Err(error.into()),
        };
        if variant.is_own() {
            modules.push((variant.name.clone(), kernel.spirv));
        }
        record.variants.push(record::Variant {
            name: variant.name.clone(),
            file: variant.file.clone(),
            summary: variant.summary.clone(),
            source: variant.source.clone(),
            tried: variant.tried.clone(),
            precise: variant.precise,
            tables: variant.tables.iter().map(|(name, form)| (name.as_str().to_owned(), *form)).collect(),
            spirv: facts,
            own: variant.is_own().then(|| variant.language()),
            skipped,
            results: Vec::new(),
        });
    }
    let audited =
        programs.iter().cloned().zip(audited).map(|(plain, watched)| watched.unwrap_or(plain)).collect();
    Ok(Prepared { record, selected, programs, audited, places, modules })
}

/// What is to be done on a scenario.
#[derive(Clone, Copy)]
struct Work<'a> {
    audit: bool,
    timer: Option<&'a Timer<'a>>,
}

/// One scenario of one family: audit, times, or both, into the family's record.
fn measure(
    family: &mut Prepared,
    scenario: &'static Scenario,
    device: &VulkanDevice,
    arguments: &Arguments,
    work: Work<'_>,
    stop: &AtomicBool,
    evidence: &mut Vec<Evidence>,
) -> Result<()> {
    let problem = family.selected.problem;
    let label = format!("{}/{}", problem.name(), scenario.name);
    let plan = Plan {
        problem,
        scenario,
        seed: arguments.seed,
        configurations: arguments.configurations,
        chunk: arguments.chunk.min(MAX_CHUNK as u64) as usize,
        max_failures: arguments.max_failures,
    };
    let mut results: Vec<record::Result> = family
        .programs
        .iter()
        .map(|_| record::Result {
            scenario: scenario.name.to_owned(),
            audit: None,
            timing: None,
            arithmetic: Vec::new(),
            hunt: None,
        })
        .collect();
    let (mut oracle, mut digest) = (None, None);

    if work.audit {
        let total = arguments.configurations * family.programs.len() as u64;
        let bar = bar(total, &format!("audit {label}"), "{human_pos} of {human_len}  {elapsed}, {eta} to go");
        let audited = audit::audit(device, &family.audited, &plan, &|count| bar.inc(count), stop)?;
        bar.finish_and_clear();
        oracle = Some(audited.oracle.into());
        digest = Some(format!("{:016x}", audited.inputs));
        for ((result, summary), place) in results.iter_mut().zip(&audited.summaries).zip(&family.places) {
            result.audit = Some(record::audit(problem, summary));
            evidence.push(Evidence {
                family: problem.name(),
                variant: family.record.variants[*place].name.clone(),
                scenario: scenario.name,
                failures: summary.failures.sorted().into_iter().cloned().collect(),
                bits: summary.bits.clone(),
            });
        }
    }
    let mut rankings = Vec::new();
    if let Some(timer) = work.timer {
        let variants: Vec<&Variant> =
            family.places.iter().map(|place| &family.selected.variants[*place]).collect();
        let facts = family.places.iter().map(|place| &family.record.variants[*place].spirv);
        let timed = Timed {
            problem,
            scenario,
            seed: arguments.seed,
            operations: facts.map(|facts| facts.operations).collect(),
            variants,
            programs: &family.programs,
        };
        for (ranking, timings) in timer.time(&timed, device, stop)? {
            for (result, timing) in results.iter_mut().zip(timings) {
                match timing.setting.regime {
                    Regime::Streaming => result.timing = Some(timing),
                    Regime::Arithmetic => result.arithmetic.push(timing),
                }
            }
            rankings.push(ranking);
        }
    }

    for (result, place) in results.into_iter().zip(&family.places) {
        family.record.variants[*place].results.push(result);
    }
    family.record.scenarios.push(record::Scenario {
        name: scenario.name.to_owned(),
        summary: scenario.summary.to_owned(),
        inputs: digest,
        oracle,
        rankings,
    });
    eprintln!("done: {label}");
    Ok(())
}
