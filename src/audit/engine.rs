//! The chunk engine: while the device works on one chunk, the host draws the next and judges the last.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use rayon::prelude::*;

use super::chunk::{BLOCK, Chunk, MAX_CHUNK, OracleSummary};
use super::summary::Summary;
use crate::device::{Device, Error, Outputs};
use crate::family::{MAX_COMPONENTS, Problem, Scenario};

/// What to audit: every program over `configurations` of one scenario.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
    pub problem: &'a dyn Problem,
    pub scenario: &'a Scenario,
    pub seed: u64,
    pub configurations: u64,
    /// Configurations a chunk; the device's limit and [`MAX_CHUNK`] bound it too.
    pub chunk: usize,
    pub max_failures: usize,
}

/// The audit of one scenario.
#[derive(Debug)]
pub struct Audited {
    pub oracle: OracleSummary,
    /// Sum of all chunks' [`Chunk::digest`].
    pub inputs: u64,
    /// One a program, in order.
    pub summaries: Vec<Summary>,
}

/// Why an audit did not finish.
#[derive(Debug, thiserror::Error)]
pub enum Stopped {
    #[error(transparent)]
    Device(#[from] Error),
    #[error("interrupted")]
    Interrupted,
}

/// Submissions in flight: one being judged, one on the device, so that neither waits for the other.
const IN_FLIGHT: usize = 2;

/// What an exhaustive audit covers: a range of the bit patterns of a family's one input column.
#[derive(Clone)]
pub struct Sweep<'a> {
    pub problem: &'a dyn Problem,
    /// Bit patterns, within 0..2^32; they are the configurations' indices.
    pub range: Range<u64>,
    /// As of [`Plan`].
    pub chunk: usize,
    pub max_failures: usize,
}

/// Audits `programs` on `device`. `advance` hears how many evaluations have been judged since the last call; a raised
/// `stop` ends the audit at the next chunk.
pub fn audit<D: Device>(
    device: &D,
    programs: &[D::Program],
    plan: &Plan<'_>,
    advance: &dyn Fn(u64),
    stop: &AtomicBool,
) -> Result<Audited, Stopped> {
    let all = Sweep {
        problem: plan.problem,
        range: 0..plan.configurations,
        chunk: plan.chunk,
        max_failures: plan.max_failures,
    };
    let draw = |first, rows| Chunk::draw(plan.problem, plan.scenario, plan.seed, first, rows);
    chunks(device, programs, &all, &draw, advance, stop)
}

/// As [`audit`], over every bit pattern of a range.
pub fn sweep<D: Device>(
    device: &D,
    programs: &[D::Program],
    sweep: &Sweep<'_>,
    advance: &dyn Fn(u64),
    stop: &AtomicBool,
) -> Result<Audited, Stopped> {
    let draw = |first, rows| Chunk::of_bits(sweep.problem, first, rows);
    chunks(device, programs, sweep, &draw, advance, stop)
}

/// The pipeline, over the configurations `plan.range` as `draw` makes chunks of them from a first one and a number of rows.
fn chunks<D: Device>(
    device: &D,
    programs: &[D::Program],
    plan: &Sweep<'_>,
    draw: &(dyn Fn(u64, usize) -> Chunk + Sync),
    advance: &dyn Fn(u64),
    stop: &AtomicBool,
) -> Result<Audited, Stopped> {
    let signature = plan.problem.signature();
    let (inputs, outputs) = (signature.input_columns().len(), signature.output_columns().len());
    let chunk = plan.chunk.clamp(1, MAX_CHUNK.min(device.max_rows(inputs, outputs)));
    let empty = || Summary::new(plan.problem, plan.max_failures);
    let mut audited = Audited {
        oracle: OracleSummary::default(),
        inputs: 0,
        summaries: programs.iter().map(|_| empty()).collect(),
    };

    std::thread::scope(|scope| {
        // Holds one finished chunk while the next is drawn.
        let (sender, receiver) = mpsc::sync_channel::<Chunk>(0);
        scope.spawn(move || {
            let mut first = plan.range.start;
            while first < plan.range.end && !stop.load(Ordering::Relaxed) {
                let rows = (plan.range.end - first).min(chunk as u64) as usize;
                let drawn = draw(first, rows);
                if sender.send(drawn).is_err() {
                    // The device failed: nobody listens any more.
                    return;
                }
                first += rows as u64;
            }
        });

        let mut in_flight: VecDeque<(usize, D::Pending, Arc<Chunk>)> = VecDeque::new();
        let mut judge_oldest = |in_flight: &mut VecDeque<(usize, D::Pending, Arc<Chunk>)>| {
            if let Some((program, pending, chunk)) = in_flight.pop_front() {
                let outputs = device.wait(pending)?;
                audited.summaries[program].merge(judge(plan.problem, plan.max_failures, &chunk, &outputs));
                advance(chunk.rows() as u64);
            }
            Ok::<(), Error>(())
        };
        for chunk in receiver {
            audited.oracle = audited.oracle.merged(chunk.oracle);
            audited.inputs = audited.inputs.wrapping_add(chunk.digest());
            let chunk = Arc::new(chunk);
            let columns = device.upload(chunk.inputs(), inputs)?;
            for (position, program) in programs.iter().enumerate() {
                in_flight.push_back((position, device.submit(program, &columns)?, Arc::clone(&chunk)));
                if in_flight.len() >= IN_FLIGHT {
                    judge_oldest(&mut in_flight)?;
                }
            }
            if stop.load(Ordering::Relaxed) {
                return Err(Stopped::Interrupted);
            }
        }
        while !in_flight.is_empty() {
            judge_oldest(&mut in_flight)?;
        }
        if stop.load(Ordering::Relaxed) { Err(Stopped::Interrupted) } else { Ok(()) }
    })?;
    Ok(audited)
}

/// Compares a chunk's outputs with its truth.
pub fn judge<O: Outputs + Sync>(
    problem: &dyn Problem,
    max_failures: usize,
    chunk: &Chunk,
    outputs: &O,
) -> Summary {
    let components: usize = problem.outputs().iter().map(|output| output.field.ty.components()).sum();
    let columns: Vec<&[f32]> = (0..components).map(|column| outputs.column(column)).collect();
    (0..chunk.rows().div_ceil(BLOCK))
        .into_par_iter()
        .fold(
            || Summary::new(problem, max_failures),
            |mut summary, block| {
                let mut values = [0.0; MAX_COMPONENTS];
                for row in block * BLOCK..((block + 1) * BLOCK).min(chunk.rows()) {
                    for (value, column) in values.iter_mut().zip(&columns) {
                        *value = column[row];
                    }
                    summary.judge(problem, chunk.row(row), &values);
                }
                summary
            },
        )
        .reduce(
            || Summary::new(problem, max_failures),
            |mut one, other| {
                one.merge(other);
                one
            },
        )
}
