//! `rootq audit --exhaustive`: every bit pattern of a family's one input, in parts that a journal keeps.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Result, anyhow, bail};
use clap::Args;
use indicatif::{HumanDuration, ProgressBar};
use serde_json::{Map, Value, json};

use super::progress::bar;
use super::run::{self, Arguments, Measured, Prepared};
use super::selection::Selected;
use crate::audit::{MAX_CHUNK, Sweep};
use crate::device::{Device, Facts};
use crate::family::FAMILIES;
use crate::job::{self, JOURNAL, Journal, Progress};
use crate::record::{self, Evidence, Folder};

/// Options of an exhaustive audit.
#[derive(Args, Debug, Default)]
pub(super) struct Options {
    /// All 2^32 bit patterns instead of random configurations; for families of one input
    #[arg(long, conflicts_with_all = ["configurations", "scenario", "seed"])]
    exhaustive: bool,
    /// With --exhaustive: only these bit patterns, first and last included, such as 0x3f800000..0x40000000 (1 to 2)
    #[arg(long, value_name = "FIRST..LAST", value_parser = range, requires = "exhaustive")]
    bits: Option<Range<u64>>,
}

impl Options {
    pub(super) fn wanted(&self) -> bool {
        self.exhaustive
    }
}

/// What an interrupted audit leaves.
#[derive(Debug, thiserror::Error)]
#[error("{finished} of {parts} parts are kept: the same command with --out {} goes on", folder.display())]
pub(super) struct Kept {
    finished: usize,
    parts: u64,
    folder: PathBuf,
}

fn range(text: &str) -> Result<Range<u64>, String> {
    let word = |text: &str| match text.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    };
    let ends = text.split_once("..").and_then(|(first, last)| Some((word(first)?, word(last)?)));
    match ends {
        Some((first, last)) if first <= last => Ok(u64::from(first)..u64::from(last) + 1),
        _ => Err("bit patterns are two numbers of 32 bits, the lower one first: 0x0..0x7f7fffff".to_owned()),
    }
}

/// The selected variants; of families that cannot be audited so an error, unless nothing was selected.
fn select(arguments: &Arguments) -> Result<Vec<Selected>> {
    let mut selected = super::run::select(arguments)?;
    if arguments.select.is_empty() {
        selected.retain(|selected| selected.problem.takes_all_bits());
    }
    if let Some(wrong) = selected.iter().find(|selected| !selected.problem.takes_all_bits()) {
        let able: Vec<&str> =
            FAMILIES.iter().filter(|family| family.takes_all_bits()).map(|family| family.name()).collect();
        bail!("{} has more than one input; exhaustive can be: {}", wrong.problem.name(), able.join(", "));
    }
    Ok(selected)
}

pub(super) fn audit(
    arguments: &Arguments,
    start: Instant,
    started: jiff::Timestamp,
    stop: &AtomicBool,
) -> Result<()> {
    let selected = select(arguments)?;
    let range = arguments.exhaustive.bits.clone().unwrap_or(0..1 << 32);
    let machine = arguments.device.open()?;
    let facts = machine.device.facts().clone();
    let target = arguments.out.clone().unwrap_or_else(|| {
        let date = started.strftime("%Y-%m-%d").to_string();
        record::default_path(&facts.name, &date, env!("ROOTQ_REVISION"))
    });
    let mut folder = Folder::resume(&target, arguments.force, JOURNAL)?;
    let mut families = selected
        .into_iter()
        .map(|selected| run::prepare(selected, &machine.device))
        .collect::<Result<Vec<_>>>()?;
    eprintln!("device: {} ({} {})", facts.name, facts.driver, facts.driver_info);
    families.iter().for_each(|family| family.keep_modules(&mut folder));
    let job = job(&facts, &families, &range, arguments);
    let mut journal = Journal::open(&target, &job, arguments.force)?;
    let parts = families.len() as u64 * job::parts(&range);
    if journal.finished() > 0 {
        eprintln!("going on after {} of {parts} parts", journal.finished());
    }
    let patterns = range.end - range.start;
    let left = families.iter().map(|family| {
        let left = patterns - job::kept(&journal, family.selected.problem.name());
        left * family.programs.len() as u64
    });
    let ahead = Ahead::new(left.sum(), journal.finished() as u64, parts);
    let mut evidence = Vec::new();
    for family in &mut families {
        let sweep = Sweep {
            problem: family.selected.problem,
            range: range.clone(),
            chunk: arguments.chunk.min(MAX_CHUNK as u64) as usize,
            max_failures: arguments.max_failures,
        };
        if let Err(error) =
            exhaust(family, &sweep, &machine.device, &mut journal, &ahead, stop, &mut evidence)
        {
            if stop.load(Ordering::Relaxed) {
                return Err(Kept { finished: journal.finished(), parts, folder: target }.into());
            }
            return Err(error);
        }
    }
    machine.check_validation()?;
    let measured = Measured {
        configurations: range.end - range.start,
        device: facts,
        ceilings: None,
        families: families.into_iter().map(|family| family.record).collect(),
        evidence,
    };
    run::finish(arguments, (start, started), folder, measured)
}

/// What is ahead of this process, over all families.
#[derive(Debug)]
struct Ahead {
    start: Instant,
    /// Evaluations that no journal held at the start.
    total: u64,
    done: AtomicU64,
    finished: AtomicU64,
    kept: u64,
    parts: u64,
}

impl Ahead {
    fn new(total: u64, kept: u64, parts: u64) -> Self {
        let (done, finished) = (AtomicU64::new(0), AtomicU64::new(kept));
        Ahead { start: Instant::now(), total, done, finished, kept, parts }
    }

    /// A part more is finished: a line for where there is no bar, after this process's first part and then every tenth.
    fn finished_part(&self, elapsed: Duration) -> Option<String> {
        let finished = self.finished.fetch_add(1, Ordering::Relaxed) + 1;
        let wanted = (finished - self.kept) % 10 == 1 && finished < self.parts;
        let done = self.done.load(Ordering::Relaxed);
        if !wanted || done == 0 {
            return None;
        }
        let left = elapsed.mul_f64(self.total.saturating_sub(done) as f64 / done as f64);
        Some(format!("{finished} of {} parts, about {} to go", self.parts, HumanDuration(left)))
    }
}

/// A bar on a terminal, lines elsewhere.
struct Shown<'a> {
    ahead: &'a Ahead,
    bar: &'a ProgressBar,
}

impl Progress for Shown<'_> {
    fn advance(&self, evaluations: u64) {
        self.ahead.done.fetch_add(evaluations, Ordering::Relaxed);
        self.bar.inc(evaluations);
    }

    fn finished_part(&self) {
        let line = self.ahead.finished_part(self.ahead.start.elapsed());
        if let Some(line) = line.filter(|_| self.bar.is_hidden()) {
            eprintln!("{line}");
        }
    }
}

/// All that the results depend on.
fn job(
    facts: &Facts,
    families: &[Prepared],
    range: &Range<u64>,
    arguments: &Arguments,
) -> Map<String, Value> {
    let variants: Map<String, Value> = families
        .iter()
        .flat_map(|family| {
            let variants = family.record.variants.iter();
            variants.map(|variant| {
                (format!("{}/{}", family.record.name, variant.name), variant.spirv.sha256.clone().into())
            })
        })
        .collect();
    let program = run::program();
    Map::from_iter([
        ("job".to_owned(), json!("exhaustive")),
        ("program".to_owned(), json!([program.version, program.revision, program.dirty])),
        ("device".to_owned(), json!([facts.name, facts.uuid, facts.driver_info, facts.driver_version])),
        ("variants".to_owned(), variants.into()),
        ("bits".to_owned(), json!([range.start, range.end - 1])),
        ("max_failures".to_owned(), json!(arguments.max_failures)),
    ])
}

fn exhaust<D: Device<Program = crate::device::vulkan::Program>>(
    family: &mut Prepared,
    sweep: &Sweep<'_>,
    device: &D,
    journal: &mut Journal,
    ahead: &Ahead,
    stop: &AtomicBool,
    evidence: &mut Vec<Evidence>,
) -> Result<()> {
    const NAME: &str = "exhaustive";
    let problem = family.selected.problem;
    let total = (sweep.range.end - sweep.range.start) * family.programs.len() as u64;
    let label = format!("audit {}, all bits", problem.name());
    let bar = bar(total, &label, "{human_pos} of {human_len}  {elapsed}, {eta} to go");
    bar.set_position(job::kept(journal, problem.name()) * family.programs.len() as u64);
    // The time to go is told from what this process does.
    bar.reset_eta();
    let shown = Shown { ahead, bar: &bar };
    let audited = job::exhaust(device, &family.audited, sweep, journal, &shown, stop)
        .map_err(|error| anyhow!(error))?;
    bar.finish_and_clear();
    for (summary, place) in audited.summaries.iter().zip(&family.places) {
        let variant = &mut family.record.variants[*place];
        variant.results.push(record::Result {
            scenario: NAME.to_owned(),
            audit: Some(record::audit(problem, summary)),
            timing: None,
            arithmetic: Vec::new(),
            hunt: None,
        });
        evidence.push(Evidence {
            family: problem.name(),
            variant: variant.name.clone(),
            scenario: NAME,
            failures: summary.failures.sorted().into_iter().cloned().collect(),
            bits: summary.bits.clone(),
        });
    }
    family.record.scenarios.push(record::Scenario {
        name: NAME.to_owned(),
        summary: format!(
            "the bit patterns {:#010x} to {:#010x}, each the index of its configuration",
            sweep.range.start,
            sweep.range.end - 1
        ),
        inputs: Some(format!("{:016x}", audited.inputs)),
        oracle: Some(audited.oracle.into()),
        rankings: Vec::new(),
    });
    eprintln!("done: {}/{NAME}", problem.name());
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;
    use std::time::Duration;

    use super::{Ahead, range};

    #[test]
    fn the_time_to_go_does_not_count_what_was_kept() {
        let ahead = Ahead::new(400, 60, 100);
        let mut lines = Vec::new();
        for part in 1..=40 {
            ahead.done.fetch_add(10, Ordering::Relaxed);
            lines.extend(ahead.finished_part(Duration::from_secs(60 * part)));
        }
        let expected = [(61, 39), (71, 29), (81, 19), (91, 9)];
        let expected =
            expected.map(|(part, left)| format!("{part} of 100 parts, about {left} minutes to go"));
        assert_eq!(lines, expected);
    }

    #[test]
    fn ranges_include_both_ends() {
        assert_eq!(range("0x3f800000..0x40000000"), Ok(0x3f80_0000..0x4000_0001));
        assert_eq!(range("0..4294967295"), Ok(0..1 << 32));
        for wrong in ["", "1", "2..1", "0..0x100000000", "a..b", "-1..1"] {
            assert!(range(wrong).is_err(), "{wrong}");
        }
    }
}
