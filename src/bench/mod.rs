//! Throughput: how long a device takes for a configuration, by its own clock.

mod statistics;
mod streaming;

pub use statistics::{Quartiles, rate_interval};
pub use streaming::{CONFIGURATIONS, Effort, Timing, streaming};
