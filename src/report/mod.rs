//! Tables for the terminal, made from a record alone: what is shown can be shown again from `run.json`.

mod builtin;
mod numbers;
mod probe;
mod table;

pub use probe::probes;
pub use table::{devices, run};
