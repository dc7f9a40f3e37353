//! The hunt: a search for the worst configuration that a scenario can draw, beside as much random sampling.
//!
//! What is searched are the words that a scenario draws, as a point of the unit cube, so that every candidate is a
//! configuration that the scenario draws, if ever so rarely. The device evaluates whole batches; the judge's verdict says how
//! bad each is (`size`). With every batch goes one of the same number of ordinary random configurations, so
//! that search and sampling have cost the same whenever the hunt ends.

mod search;
mod size;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use rayon::prelude::*;

use crate::audit::{Chunk, Failure, Judgement, Verdict};
use crate::device::{Device, Error, Outputs};
use crate::family::{MAX_COMPONENTS, Problem, Scenario};
use crate::sample::Draw;
use crate::sample::draw::{Stream, WORDS};
use search::Search;

/// Configurations of one evaluation of the device, at most: half of them the search's.
pub const BATCH: usize = 2 * search::BATCH;

/// What to hunt.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
    pub problem: &'a dyn Problem,
    pub scenario: &'a Scenario,
    /// Of the search, and of the random configurations: those that an audit of the same seed begins with.
    pub seed: u64,
    pub budget: Budget,
}

/// When a hunt ends.
#[derive(Clone, Copy, Debug)]
pub enum Budget {
    /// After so many evaluations by the search, and as many random ones. The same seed then finds the same.
    Evaluations(u64),
    Until(Instant),
}

/// The worst of its kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Find {
    /// How bad it is: from 1 on a failure, its error over the tolerance; infinite without a finite error; below 1 how near a
    /// failure it is.
    pub size: f64,
    /// Which evaluation it was, from 1.
    pub evaluation: u64,
    /// Its index is that of a random configuration; 0 for one of the search, which is in no stream.
    pub failure: Failure,
}

/// The worst of every failing verdict that occurred, and what came nearest to failing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finds {
    pub failures: BTreeMap<Verdict, Find>,
    pub nearest: Option<Find>,
}

/// What a hunt found, by search and by random sampling.
#[derive(Clone, Debug, PartialEq)]
pub struct Hunted {
    /// By the search; as many random ones.
    pub evaluations: u64,
    /// Words that a configuration draws: the dimensions of the search.
    pub dimensions: usize,
    pub search: Finds,
    pub random: Finds,
}

/// Hunts with one program on `device`. `advance` hears of every batch; a raised `stop` ends the hunt with what was found.
pub fn hunt<D: Device>(
    device: &D,
    program: &D::Program,
    plan: &Plan<'_>,
    advance: &dyn Fn(&Hunted),
    stop: &AtomicBool,
) -> Result<Hunted, Error> {
    let Plan { problem, scenario, seed, budget } = *plan;
    let width = problem.signature().input_columns().len();
    let dimensions = dimensions(problem, scenario, seed);
    let mut search = Search::new(dimensions, seed);
    let mut hunted =
        Hunted { evaluations: 0, dimensions, search: Finds::default(), random: Finds::default() };
    while !stop.load(Ordering::Relaxed) {
        let left = match budget {
            Budget::Evaluations(all) => all - hunted.evaluations,
            // However little time there is, one batch tells something.
            Budget::Until(end) if hunted.evaluations == 0 || Instant::now() < end => u64::MAX,
            Budget::Until(_) => 0,
        };
        let points = search.ask();
        let rows = left.min(points.len() as u64) as usize;
        if rows == 0 {
            break;
        }
        let mut inputs = vec![0.0; rows * width];
        for (point, row) in points.iter().zip(inputs.chunks_exact_mut(width)) {
            (scenario.draw)(&mut Draw::of_words(&words(point)), row);
        }
        inputs.extend(Chunk::draw_inputs(problem, scenario, seed, hunted.evaluations, rows));

        let columns = device.upload(&inputs, width)?;
        let pending = device.submit(program, &columns)?;
        // The oracle works while the device does.
        let chunk = Chunk::of_inputs(problem, 0, inputs);
        let outputs = device.wait(pending)?;
        let sizes = judge(problem, &chunk, &outputs);
        let first = hunted.evaluations;
        for (row, (verdict, size)) in sizes.iter().enumerate() {
            let (finds, at) =
                if row < rows { (&mut hunted.search, row) } else { (&mut hunted.random, row - rows) };
            let evaluation = first + at as u64 + 1;
            finds.offer(*verdict, *size, evaluation, || Failure {
                // A configuration's place in the stream is the evaluation's.
                index: if row < rows { 0 } else { first + at as u64 },
                ..failure(problem, &chunk, row, &outputs)
            });
        }
        hunted.evaluations += rows as u64;
        if rows == search::BATCH {
            let sizes: Vec<f64> = sizes[..rows].iter().map(|(_, size)| *size).collect();
            search.tell(&sizes);
        }
        advance(&hunted);
    }
    Ok(hunted)
}

impl Finds {
    fn offer(&mut self, verdict: Verdict, size: f64, evaluation: u64, failure: impl FnOnce() -> Failure) {
        let best = if verdict.is_failure() { self.failures.get(&verdict) } else { self.nearest.as_ref() };
        if best.is_some_and(|best| size <= best.size) {
            return;
        }
        let find = Find { size, evaluation, failure: failure() };
        if verdict.is_failure() {
            self.failures.insert(verdict, find);
        } else {
            self.nearest = Some(find);
        }
    }

    /// The worst of finite error or, without a failure, what came nearest to one.
    pub fn worst_finite(&self) -> Option<&Find> {
        let finite = self.failures.values().filter(|find| find.size.is_finite());
        finite.chain(&self.nearest).max_by(|one, other| one.size.total_cmp(&other.size))
    }
}

/// The words that a scenario draws: the most that any of a few thousand configurations does. What rarer ones draw more
/// stays as it is.
fn dimensions(problem: &dyn Problem, scenario: &Scenario, seed: u64) -> usize {
    const SAMPLE: usize = 4096;
    let mut row = vec![0.0; problem.signature().input_columns().len()];
    let mut most = 1;
    Stream::new(seed, scenario.name).visit(0, SAMPLE, |_, draw| {
        (scenario.draw)(draw, &mut row);
        most = most.max(draw.used());
    });
    most
}

/// The words at a point of the unit cube.
///
/// Of each word the lowest bit repeats the highest: some draws look at that bit alone, and this way a coordinate has two
/// halves for them instead of 2^32 slices. For all other draws it is a change by 2^-32.
fn words(point: &[f64]) -> [u32; WORDS] {
    let mut words = [1 << 31; WORDS];
    for (word, coordinate) in words.iter_mut().zip(point) {
        // The conversion saturates: 1 is the largest word.
        let nearest = (coordinate * 4_294_967_296.0) as u32;
        *word = (nearest & !1) | (nearest >> 31);
    }
    words
}

/// Verdicts and sizes of all rows.
fn judge<O: Outputs + Sync>(problem: &dyn Problem, chunk: &Chunk, outputs: &O) -> Vec<(Verdict, f64)> {
    let columns = columns(problem, outputs);
    let rows = (0..chunk.rows()).into_par_iter().with_min_len(64);
    rows.map(|row| {
        let judgement = Judgement::new(problem, chunk.row(row), &values(&columns, row)[..columns.len()]);
        (judgement.verdict, size::size(problem, chunk.row(row), &judgement))
    })
    .collect()
}

fn columns<'a, O: Outputs>(problem: &dyn Problem, outputs: &'a O) -> Vec<&'a [f32]> {
    (0..problem.signature().output_columns().len()).map(|column| outputs.column(column)).collect()
}

fn values(columns: &[&[f32]], row: usize) -> [f32; MAX_COMPONENTS] {
    let mut values = [0.0; MAX_COMPONENTS];
    for (value, column) in values.iter_mut().zip(columns) {
        *value = column[row];
    }
    values
}

/// One row as it was seen.
fn failure<O: Outputs>(problem: &dyn Problem, chunk: &Chunk, row: usize, outputs: &O) -> Failure {
    let columns = columns(problem, outputs);
    let values = &values(&columns, row)[..columns.len()];
    let judgement = Judgement::new(problem, chunk.row(row), values);
    Failure {
        index: 0,
        verdict: judgement.verdict,
        inputs: chunk.row(row).inputs.to_vec(),
        outputs: values.to_vec(),
        truth: chunk.truth(row).to_vec(),
        errors: judgement.errors().collect(),
        ulps: judgement.ulps().collect(),
    }
}
