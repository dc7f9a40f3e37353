//! The command line: one verb a file. Only this module prints.
//!
//! Data goes to standard output, words to standard error. Exit status: 0 clean, 1 a gate or a claim is violated, 2 the
//! call or the machine is at fault, with one line that says what and how to mend it; 130 interrupted.

mod compare;
mod count;
mod devices;
mod draft;
mod eval;
mod exhaustive;
mod fit;
mod hunt;
mod list;
mod machine;
mod minimize;
mod new;
mod pick;
mod progress;
mod replay;
mod run;
mod selection;
mod shader;
mod timing;

use std::io::IsTerminal;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::{Parser, Subcommand};

/// Audits the precision and measures the throughput of GPU shader variants.
///
/// Every variant of a numerical kernel runs over millions of random configurations on a Vulkan device; every result is
/// compared with a certified f64 oracle. What fails is recorded so that it can be repeated; what works is timed.
#[derive(Debug, Parser)]
#[command(
    version,
    max_term_width = 100,
    after_help = "Start with 'rootq devices' and 'rootq list'; then 'rootq run' does everything.\n\
                  Exit status: 0 clean, 1 a gate or claim is violated, 2 the call or the machine is at fault\n\
                  (one line says what), 130 interrupted."
)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// The Vulkan devices of this machine
    ///
    /// Lists every device the Vulkan loader finds, in the order of '--device' indices. VK_DRIVER_FILES chooses the
    /// drivers, as for any Vulkan program; ROOTQ_VULKAN_LOADER names another loader library than the system's. With
    /// --probe it says what each does: whether fma() is fused, subnormals are kept, how results are rounded, what NaN and
    /// infinity do to comparisons, min and max, and how finely a sampler interpolates.
    Devices(devices::Arguments),
    /// Families, their columns and scenarios, and variants
    ///
    /// Lists every family, or one with its function's signature, columns, scenarios, landmark coordinates and variants.
    List(list::Arguments),
    /// Audit and time variants, show tables, leave a run folder
    ///
    /// Runs variants over random configurations of each scenario, compares every result with the oracle, and takes the
    /// time on each family's first one. Tables go to standard output. The run folder holds run.json (counts, histograms,
    /// quantiles, worst configurations, times, and what repeats the run) and failures.parquet (a sample of failing
    /// configurations with their exact bits). The same seed gives the same counts on any number of threads and with any
    /// chunk size.
    Run(run::RunArguments),
    /// Only the precision half of 'run'
    ///
    /// Runs variants over random configurations of each scenario and compares every result with the oracle. See 'rootq
    /// run --help' for what it leaves. With --exhaustive, families of one input are audited on all 2^32 bit patterns of
    /// it, in minutes; interrupted, the same command with the same --out goes on.
    Audit(run::AuditArguments),
    /// Only the throughput half of 'run'
    ///
    /// Takes the time of variants by the device's own timestamps in two regimes. Streaming: one evaluation a
    /// configuration, inputs from memory and outputs to it. Arithmetic: many evaluations in registers, each with inputs
    /// perturbed by the last results, once with the same configuration throughout a workgroup (coherent) and once with
    /// independent ones (divergent). Variants take turns, in changing order, until their ratios to a reference are known to
    /// half a per cent or time is up. Each ranking holds its reference twice: what differs between the two is noise,
    /// inside which no variant ranks before another. The table shows shares of what the device did at best in the same
    /// run. Only a family's first scenario is timed, unless --scenario names others.
    Bench(run::BenchArguments),
    /// Evaluate your own configurations, by oracle and variants, from CSV or Parquet to either
    ///
    /// The input's columns are the family's, in any order ('rootq list FAMILY' shows them). CSV: a header, and decimal or
    /// hexadecimal floats (0x1.8p-3), rounded once to f32. Parquet, by name or content: float32 or float64, rounded
    /// likewise; uncompressed, snappy, gzip or lz4. A run's failures.parquet is an input, too: the rows of this family,
    /// without what else it holds. Tables of any length need little memory. The output has one row an input row, in the
    /// same order, with the columns oracle.<column> (f64; 17 digits) and <variant>.<column> (f32; 9 digits), which read
    /// back to the same bits. A mistake anywhere in the input leaves no output at all.
    Eval(eval::Arguments),
    /// Search for the worst configuration of each scenario
    ///
    /// Searches among all configurations that a scenario can draw, however rarely, for the one that a variant does worst:
    /// a global optimiser (CMA-ES with restarts) over the random words behind a configuration, the judged error as its
    /// objective, whole populations on the device at a time. Only errors that the variant is to blame for count: a failure
    /// above any error that rounding the inputs explains. As many random configurations are judged beside it, so that the
    /// table says what the search was worth. The worst of each failing verdict is kept with its exact inputs: in
    /// failures.parquet of the run folder (index 0, for it is in no random stream), which other verbs read as they do a
    /// run's. Interrupted, the hunt ends with what it found.
    Hunt(hunt::Arguments),
    /// Evaluate recorded failures again, here or on another device; export one for a bug report
    ///
    /// RUN is a run's folder or a failures.parquet. Every failure's inputs are evaluated again, bit for bit, and the list says
    /// for each variant and scenario how many still fail with the same verdict, with another one, or no longer, and how
    /// many outputs have the recorded bits. With --failure K it tells everything of one: inputs and outputs in decimal, as
    /// hexadecimal floats and as bits, the truth and how certain it is, and what every other variant of the family makes of
    /// it. Exit status: 0 whether or not they still fail.
    Replay(replay::Arguments),
    /// Shrink a failing configuration to one that a person can read and that fails in the same way
    ///
    /// Tries whole populations of simpler configurations at a time (zeros, ones, powers of two, few bits or digits, equal or
    /// axis-aligned or unit vectors) and takes the simplest that has the same verdict, again and again until none has. A
    /// configuration counts only where the oracle is certain and, if other variants of the family were right at the start,
    /// one of them still is. The same failure on the same device always ends in the same bits. Shows both side by side, and
    /// for each input what became of simpler values.
    Minimize(minimize::Arguments),
    /// Write a shader to begin with
    ///
    /// A file with the family's function, to be filled in: what it computes, parameters and results with their columns, how
    /// each result's error is measured, the scenarios it will meet, and what to run next. It compiles, and returns zeros. A
    /// file that is there already stays as it is.
    New(new::Arguments),
    /// What changed between two recorded runs, row by row; with --gate, whether that is allowed
    ///
    /// Two runs of another driver, device, version or day: for each variant and scenario, whether accuracy and time (apart
    /// from each other) got better, worse, stayed the same, or cannot be told, and on about how many configurations the
    /// outputs' bits differ. Needs no device. Comparing a run with a repetition of itself reports no difference in at least
    /// 95 of 100 cases.
    Compare(compare::Arguments),
    /// Which variant of a family to ship, from recorded runs
    ///
    /// Shows the front of accuracy against cost over one or several devices, the best variant first, and why each other
    /// one was not chosen. Without a limit on errors or failures the fewest failures count before time; with one, the
    /// fastest variant that keeps it. Needs no device. Exit status 1: no variant keeps the constraints.
    Pick(pick::Arguments),
    /// Fit tables that shaders sample
    ///
    /// One material so far; 'rootq fit ggx --help' says what its table holds.
    Fit(fit::Arguments),
}

/// Runs the program on the process's arguments.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return usage(&error),
    };
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    let mut first = None;
    let handler = ctrlc::set_handler(move || {
        raised.store(true, Ordering::Relaxed);
        // The second time nobody waits for the chunk in flight. But `timeout` signals its child and then the child's
        // process group, as service managers do: that is one wish.
        if first.get_or_insert_with(Instant::now).elapsed() > ONE_WISH {
            std::process::exit(INTERRUPTED.into());
        }
    });
    if let Err(error) = handler {
        eprintln!("rootq: Ctrl-C will not clean up: {error}");
    }
    let result = match cli.verb {
        Verb::Devices(arguments) => devices::devices(&arguments).map(Outcome::from),
        Verb::List(arguments) => list::list(&arguments).map(Outcome::from),
        Verb::Run(arguments) => run::run(&arguments.into(), run::Halves::Both, &stop).map(Outcome::from),
        Verb::Audit(arguments) => run::run(&arguments.into(), run::Halves::Audit, &stop).map(Outcome::from),
        Verb::Bench(arguments) => run::run(&arguments.into(), run::Halves::Bench, &stop).map(Outcome::from),
        Verb::Eval(arguments) => eval::eval(&arguments, &stop).map(Outcome::from),
        Verb::Replay(arguments) => replay::replay(&arguments, &stop).map(Outcome::from),
        Verb::Minimize(arguments) => minimize::minimize(&arguments, &stop).map(Outcome::from),
        Verb::New(arguments) => new::new(&arguments).map(Outcome::from),
        Verb::Hunt(arguments) => hunt::hunt(&arguments, &stop),
        Verb::Compare(arguments) => compare::compare(&arguments),
        Verb::Pick(arguments) => pick::pick(&arguments),
        Verb::Fit(arguments) => fit::fit(&arguments, &stop).map(Outcome::from),
    };
    match result {
        Ok(Outcome::Clean) => ExitCode::SUCCESS,
        Ok(Outcome::Violated) => VIOLATED.into(),
        Ok(Outcome::Interrupted) => INTERRUPTED.into(),
        Err(error) if stop.load(Ordering::Relaxed) => {
            match error.downcast_ref::<exhaustive::Kept>() {
                Some(kept) => eprintln!("rootq: interrupted; {kept}"),
                None => eprintln!("rootq: interrupted; nothing was recorded"),
            }
            INTERRUPTED.into()
        }
        // A closed pipe is how the reader says that it has seen enough.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("rootq: {}", one_line(&format!("{error:#}")));
            AT_FAULT.into()
        }
    }
}

/// How a verb that did its work ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Clean,
    /// A gate's rule is broken, or a claim does not hold.
    Violated,
    /// Ended early on request, with what it had by then.
    Interrupted,
}

impl From<()> for Outcome {
    fn from((): ()) -> Self {
        Outcome::Clean
    }
}

const VIOLATED: u8 = 1;
const AT_FAULT: u8 = 2;
const INTERRUPTED: u8 = 130;

/// Signals within this time of the first are one.
const ONE_WISH: Duration = Duration::from_secs(1);

/// Help and version as they are; a wrong call as one line.
fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // Nothing can be done about a closed standard output.
        _ = error.print();
        return ExitCode::SUCCESS;
    }
    if error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        _ = error.print();
        return AT_FAULT.into();
    }
    let text = error.render().to_string();
    let told: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .filter(|line| !line.is_empty())
        .collect();
    let told = told.join(" ");
    eprintln!("rootq: {} (see 'rootq --help')", told.strip_prefix("error: ").unwrap_or(&told));
    AT_FAULT.into()
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<std::io::Error>())
        .any(|cause| cause.kind() == std::io::ErrorKind::BrokenPipe)
}

/// Whether standard output takes colours: a terminal, and NO_COLOR not set.
fn colour() -> bool {
    std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Prints data to standard output.
fn print(text: &str) -> anyhow::Result<()> {
    use std::io::Write;
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_sound() {
        Cli::command().debug_assert();
    }
}
