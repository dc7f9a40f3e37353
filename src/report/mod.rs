//! Tables for the terminal, made from a record alone: what is shown can be shown again from `run.json`.

mod builtin;
mod numbers;
mod table;

pub use table::{devices, run};
