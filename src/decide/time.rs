//! Whether one variant takes as long in run B as in run A.
//!
//! Samples of one run share its machine's mood (clock, neighbours, memory layout), so the spread within a run says too
//! little about another run. Two times differ where their ratio is beyond what one may expect of two runs of the same
//! thing (`drift`), and beyond the sampling error of both medians on top of that.

use serde::Serialize;

use super::Change;
use crate::bench::{Quartiles, Setting, Timing};

/// The change of one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TimeChange {
    #[serde(flatten)]
    pub setting: Setting,
    pub change: Change,
    /// Nanoseconds a configuration in A and in B.
    pub ns: [f64; 2],
    /// B's time over A's, with the change of the whole machine taken out where that was asked for.
    pub ratio: f64,
    /// Sampling error of the two medians, at the comparison's level.
    pub low: f64,
    pub high: f64,
}

/// How two runs of the same thing may differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Allowance {
    /// Of the times of two runs, as a share: 0.1 is ten per cent.
    pub(super) drift: f64,
    /// Two-sided normal quantile of the level.
    pub(super) z: f64,
    /// B's machine as a whole took so many times A's time; 1 to leave that in.
    pub(super) common: f64,
}

pub(super) fn time([a, b]: [&Timing; 2], noise: f64, allowance: Allowance) -> TimeChange {
    let ratio = b.ns.median / a.ns.median / allowance.common;
    let error = allowance.z * (relative_error(a).powi(2) + relative_error(b).powi(2)).sqrt();
    let (low, high) = (ratio * f64::exp(-error), ratio * f64::exp(error));
    let limit = 1.0 + allowance.drift.max(noise);
    // Different clocks, or other work a sample, measure different things.
    let alike = a.clock == b.clock && a.evaluations == b.evaluations;
    let change = if !alike || !ratio.is_finite() || ratio <= 0.0 {
        Change::CannotTell
    } else if low > limit {
        Change::Worse
    } else if high < 1.0 / limit {
        Change::Better
    } else if high <= limit && low >= 1.0 / limit {
        Change::Same
    } else {
        Change::CannotTell
    };
    TimeChange { setting: a.setting, change, ns: [a.ns.median, b.ns.median], ratio, low, high }
}

/// Standard error of a median of samples with these quartiles, relative to it: that of a normal sample, 1.2533 sigma /
/// sqrt(n), with sigma from the interquartile range (McGill, Tukey and Larsen, The American Statistician 32, 1978).
fn relative_error(timing: &Timing) -> f64 {
    let Quartiles { lower, median, upper } = timing.ns;
    let sigma = (upper - lower) / 1.349;
    1.2533 * sigma / (timing.rounds.max(1) as f64).sqrt() / median
}

/// The median of all ratios: what the machine as a whole did. Of fewer than [`FEW`] there is none.
pub(super) fn common(mut ratios: Vec<f64>) -> Option<f64> {
    ratios.retain(|ratio| ratio.is_finite() && *ratio > 0.0);
    if ratios.len() < FEW {
        return None;
    }
    Quartiles::of(&ratios).map(|quartiles| quartiles.median)
}

/// With fewer times than this a change of most of them may be theirs and not the machine's.
const FEW: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::Clock;

    fn timing(median: f64, spread: f64, rounds: usize) -> Timing {
        Timing {
            setting: Setting::STREAMING,
            ns: Quartiles {
                lower: median * (1.0 - spread / 2.0),
                median,
                upper: median * (1.0 + spread / 2.0),
            },
            clock: Clock::DeviceTimestamps,
            rounds,
            configurations: 1,
            repeats: 1,
            evaluations: 1,
            ratio: None,
            rank: None,
            share: None,
            bound: None,
        }
    }

    fn change(a: f64, b: f64, spread: f64) -> Change {
        let allowance = Allowance { drift: 0.1, z: 3.0, common: 1.0 };
        time([&timing(a, spread, 25), &timing(b, spread, 25)], 0.01, allowance).change
    }

    #[test]
    fn a_ratio_counts_beyond_drift_and_error() {
        assert_eq!(change(10.0, 10.5, 0.01), Change::Same);
        assert_eq!(change(10.0, 12.0, 0.01), Change::Worse);
        assert_eq!(change(12.0, 10.0, 0.01), Change::Better);
        // At the border of the drift, or with a wide spread, nothing can be told.
        assert_eq!(change(10.0, 11.0, 0.01), Change::CannotTell);
        assert_eq!(change(10.0, 12.0, 0.5), Change::CannotTell);
        assert_eq!(change(0.0, 12.0, 0.1), Change::CannotTell);
    }

    #[test]
    fn the_machines_own_change_is_the_median_of_many() {
        assert_eq!(common(vec![1.2; 7]), None);
        assert_eq!(common(vec![1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 9.0, f64::NAN, 1.2]), Some(1.2));
    }
}
