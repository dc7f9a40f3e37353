//! Throughput: how long a device takes for a configuration, by its own clock.

mod statistics;
mod streaming;
mod timing;

pub use statistics::{Quartiles, rate_interval};
pub use streaming::{CONFIGURATIONS, Effort, streaming};
pub use timing::{
    Bound, Ceiling, Ceilings, Coherence, Rank, Ranking, Ratio, Regime, Setting, Share, Stop, Timing,
};
