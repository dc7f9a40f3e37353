//! One configuration: again, smaller, elsewhere.
//!
//! What a run recorded is evaluated once more on an open device ([`replay`]), told in full ([`story`]), or written as a
//! script that another machine can run ([`amber`], [`glsl`]).

pub mod evaluate;
pub mod origin;
pub mod replay;
pub mod story;

pub use evaluate::{Answer, evaluate, truth};
pub use origin::Origin;
pub use replay::{Fate, Replay};
pub use story::Story;
