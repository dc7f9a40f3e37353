//! Tables for the terminal, made from a record alone: what is shown can be shown again from `run.json`.

mod numbers;
mod table;
mod timing;

pub use table::{devices, run};
