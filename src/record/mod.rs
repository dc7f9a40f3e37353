//! What a run leaves behind: a versioned `run.json`, `failures.parquet`, and the folder that holds them; and the tables
//! in which users hand over configurations and take their evaluations.

mod bits;
pub mod configurations;
pub mod evaluations;
mod failures;
mod folder;
mod hunt;
mod number;
mod recall;
mod schema;
mod summarize;

use std::path::PathBuf;

use crate::audit::{Failure, Fingerprint};

pub use bits::Bits;
pub use failures::write as write_failures;
pub use folder::{Folder, Recorded, default_path, module_path, read};
pub use hunt::{Find, Hunt, hunt};
pub use number::{decimal_f32, hex_f32, parse_f32};
pub use recall::{RecordedFailure, failures};
pub use schema::{
    Audit, Bin, Buckets, Distribution, Extremes, Family, Host, Landmark, Oracle, Output, OutputAudit,
    Program, Rate, Result, Run, SCHEMA, Scenario, Settings, Specimen, Variant, Visible, Worst,
};
pub use summarize::{audit, family};

/// What one variant left on one scenario beside its summary.
#[derive(Clone, Debug)]
pub struct Evidence {
    pub family: &'static str,
    pub variant: String,
    pub scenario: &'static str,
    pub failures: Vec<Failure>,
    pub bits: Fingerprint,
}

/// Why a record could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("cannot {action} {}", path.display())]
    Io { action: &'static str, path: PathBuf, source: std::io::Error },
    #[error("{} is not empty; choose another --out (--force replaces an earlier run)", path.display())]
    Occupied { path: PathBuf },
    #[error("{} is beside an unfinished run: move it away, or choose another --out", path.display())]
    Foreign { path: PathBuf },
    #[error("cannot move the run to {}: it is whole in {}", path.display(), draft.display())]
    Left { draft: PathBuf, path: PathBuf, source: std::io::Error },
    #[error("cannot write {}", path.display())]
    Json { path: PathBuf, source: serde_json::Error },
    #[error("cannot write {}", path.display())]
    Parquet { path: PathBuf, source: parquet::errors::ParquetError },
    #[error("{} holds no run (no run.json)", path.display())]
    NoRun { path: PathBuf },
    #[error("{} holds no failures (no failures.parquet, which run, audit, hunt and minimize write)", path.display())]
    NoFailures { path: PathBuf },
    #[error("{} is not a run that this rootq reads: {message}", path.display())]
    Unreadable { path: PathBuf, message: String },
    /// The user's table is at fault; `place` is `FILE`, `FILE:LINE` or `FILE, row N`.
    #[error("{place}: {message}")]
    Table { place: String, message: String },
}
