//! Work of minutes that may be interrupted: an exhaustive audit in parts, each written to a journal when it is finished.

mod journal;

use std::ops::Range;
use std::sync::atomic::AtomicBool;

pub use journal::{JOURNAL, Journal, Part};

use crate::audit::{self, Audited, OracleSummary, Stopped, Summary, Sweep};
use crate::device::Device;

/// Configurations a part: seconds of work, so that little is lost.
const PART: u64 = 1 << 25;

/// Why a job did not finish.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Stopped(#[from] Stopped),
    #[error(transparent)]
    Journal(#[from] journal::Error),
}

/// Who hears how far a job is.
pub trait Progress: Sync {
    /// So many evaluations more, those in the journal apart.
    fn advance(&self, evaluations: u64);

    /// The journal holds a part more.
    fn finished_part(&self);
}

/// Audits `programs` over every bit pattern of `sweep`, going on where the journal ends.
///
/// The outcome is the same however often the work was interrupted: parts merge by integer addition and maxima.
pub fn exhaust<D: Device>(
    device: &D,
    programs: &[D::Program],
    sweep: &Sweep<'_>,
    journal: &mut Journal,
    progress: &dyn Progress,
    stop: &AtomicBool,
) -> Result<Audited, Error> {
    let family = sweep.problem.name();
    let mut whole = Audited {
        oracle: OracleSummary::default(),
        inputs: 0,
        summaries: programs.iter().map(|_| Summary::new(sweep.problem, sweep.max_failures)).collect(),
    };
    let mut merge = |part: &Part| {
        whole.oracle = whole.oracle.merged(part.oracle);
        whole.inputs = whole.inputs.wrapping_add(part.inputs);
        for (whole, part) in whole.summaries.iter_mut().zip(&part.summaries) {
            whole.merge(part.clone());
        }
    };
    let mut next = sweep.range.start;
    for part in journal.parts(family) {
        merge(part);
        next = part.range.end;
    }
    while next < sweep.range.end {
        let range = next..part_end(next).min(sweep.range.end);
        let part = Sweep { range: range.clone(), ..sweep.clone() };
        let Audited { oracle, inputs, summaries } =
            audit::sweep(device, programs, &part, &|count| progress.advance(count), stop)?;
        let part = Part { family: family.to_owned(), range, oracle, inputs, summaries };
        merge(&part);
        next = part.range.end;
        journal.add(part)?;
        progress.finished_part();
    }
    Ok(whole)
}

/// The end of the part that begins at `first`.
fn part_end(first: u64) -> u64 {
    (first / PART + 1) * PART
}

/// How many bit patterns of a family the journal holds.
pub fn kept(journal: &Journal, family: &str) -> u64 {
    journal.parts(family).map(|part| part.range.end - part.range.start).sum()
}

/// How many parts a range has.
pub fn parts(range: &Range<u64>) -> u64 {
    range.end.div_ceil(PART) - range.start / PART
}
