//! What a run leaves behind: a versioned `run.json`, `failures.parquet`, and the folder that holds them; and the CSV
//! in which users hand over configurations.

mod bits;
pub mod configurations;
mod failures;
mod folder;
mod number;
mod schema;
mod summarize;

use std::path::PathBuf;

use crate::audit::{Failure, Fingerprint};

pub use bits::Bits;
pub use folder::{Folder, Recorded, default_path, module_path, read};
pub use number::parse_f32;
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
    #[error("{} is not a run that this rootq reads: {message}", path.display())]
    Unreadable { path: PathBuf, message: String },
    /// The user's table is at fault; `place` is `FILE` or `FILE:LINE`.
    #[error("{place}: {message}")]
    Table { place: String, message: String },
}
