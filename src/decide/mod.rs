//! What recorded runs decide: what changed between two of them, what breaks a rule, which variant to ship.
//!
//! Nothing here runs a device: a run folder is all it takes.

mod accuracy;
mod compare;
mod gate;
mod pick;
mod quantile;
#[cfg(test)]
mod sample;
mod time;

use serde::{Deserialize, Serialize};

pub use accuracy::{AccuracyChange, BitsChange};
pub use compare::{Comparison, Row, Side, Tolerances, compare};
pub use gate::{Breach, Rules};
pub use pick::{At, Candidate, Choice, Constraints, Seen, USELESS, pick};
pub use quantile::Quantile;
pub use time::TimeChange;

/// What became of something from run A to run B.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    Worse,
    Better,
    /// Neither shown to differ nor shown to agree.
    CannotTell,
    Same,
}

impl Change {
    /// In a table: `cannot tell`.
    pub fn words(self) -> &'static str {
        match self {
            Change::Worse => "worse",
            Change::Better => "better",
            Change::CannotTell => "cannot tell",
            Change::Same => "same",
        }
    }
}
