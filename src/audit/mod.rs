//! The chunk engine and the judge: pipelines sampling, device and oracle, and summarises what they disagree on.

mod chunk;
mod engine;
mod exact_bits;
mod extremes;
mod failures;
mod fingerprint;
mod histogram;
mod judge;
mod judgement;
mod summary;
mod verdict;

pub use chunk::{Chunk, MAX_CHUNK, OracleSummary};
pub use engine::{Audited, Plan, Stopped, Sweep, audit, judge, sweep};
pub use extremes::{Extremes, Specimen};
pub use failures::{Failure, Failures};
pub use fingerprint::Fingerprint;
pub use histogram::Histogram;
pub use judge::{EXPLAINED_BY_ROUNDING, Measure, measure};
pub use judgement::{Comparison, Judgement, Row};
pub use summary::{Bin, OutputSummary, Summary, Worst};
pub use verdict::Verdict;
