//! Throughput: how long a device takes for a configuration, by its own clock.
//!
//! [`Contest`] times variants against each other on a device: [`rounds`] takes interleaved samples until ratios are known
//! or time is up, and [`standing`] says what follows from them; neither knows a device. [`ceilings`] are what the device
//! does at best.

mod bootstrap;
mod ceilings;
mod contest;
#[cfg(test)]
mod noise;
mod ranking;
mod rounds;
mod statistics;
mod timing;
mod trial;

pub use ceilings::ceilings;
pub use contest::{CONFIGURATIONS, Contest, Entrant};
pub use ranking::{Standing, standing};
pub use rounds::{Effort, Rounds, Sampler, rounds};
pub use statistics::{Quartiles, rate_interval};
pub use timing::{
    Bound, Ceiling, Ceilings, Coherence, Rank, Ranking, Ratio, Regime, Setting, Share, Stop, Timing,
};
