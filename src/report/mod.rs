//! Tables for the terminal, made from a record alone: what is shown can be shown again from `run.json`.

mod builtin;
mod compare;
mod hunt;
mod numbers;
mod pick;
mod probe;
mod replay;
mod shrunk;
mod table;
mod timing;

pub use compare::{Form, compare, github};
pub use hunt::hunt;
pub use pick::pick;
pub use probe::probes;
pub use replay::{replay, story};
pub use shrunk::shrunk;
pub use table::{devices, run};
