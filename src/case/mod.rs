//! One configuration: again, smaller, elsewhere.
//!
//! What a run recorded is evaluated once more on an open device ([`replay`]), told in full ([`story`]), shrunk to what a
//! person can read ([`minimize`](mod@minimize)), or written as a script that another machine can run ([`amber`], [`glsl`]).

pub mod amber;
mod check;
mod cost;
pub mod evaluate;
pub mod glsl;
pub mod minimize;
pub mod origin;
pub mod replay;
pub mod shrunk;
mod simpler;
pub mod story;

pub use cost::cost;
pub use evaluate::{Answer, evaluate, truth};
pub use minimize::minimize;
pub use origin::Origin;
pub use replay::{Fate, Replay};
pub use shrunk::Shrunk;
pub use story::Story;
