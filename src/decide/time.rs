//! Whether one variant takes as long in run B as in run A.
//!
//! Samples of one run share its machine's mood (clock, neighbours, memory layout), so the spread within a run says too
//! little about another run. Two times differ where their ratio is beyond what one may expect of two runs of the same
//! thing (`drift`), and beyond the sampling error of both medians on top of that.
//!
//! A software device shares its machine, and what the machine does to all times of a regime ([`Common`]) is taken out. By
//! regime, because memory and arithmetic have moods of their own: of 57 repetitions on an idle machine whole runs took
//! 1.6 times as long to stream, with arithmetic the same to 3 %.

use serde::Serialize;

use super::Change;
use crate::bench::{Quartiles, Regime, Setting, Timing};

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
    /// Of the times of two runs, as a share: 0.1 is ten per cent. At least the rankings' own noise, and what the null
    /// kernel, whose text no variant changes, did in the same rounds.
    pub(super) drift: f64,
    /// Two-sided normal quantile of the level.
    pub(super) z: f64,
    /// B's machine as a whole took so many times A's time; 1 to leave that in.
    pub(super) common: f64,
}

pub(super) fn time([a, b]: [&Timing; 2], allowance: Allowance) -> TimeChange {
    let ratio = b.ns.median / a.ns.median / allowance.common;
    let error = allowance.z * (relative_error(a).powi(2) + relative_error(b).powi(2)).sqrt();
    let (low, high) = (ratio * f64::exp(-error), ratio * f64::exp(error));
    let limit = 1.0 + allowance.drift;
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

/// By how much a ratio differs from 1, whichever way round: 0.25 for 1.25 and for 0.8. 0 of what is no ratio.
pub(super) fn apart(ratio: f64) -> f64 {
    if ratio.is_finite() && ratio > 0.0 { ratio.max(ratio.recip()) - 1.0 } else { 0.0 }
}

/// How many times A's time B's machine as a whole took, by regime; absent where there are too few times to tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Common {
    pub streaming: Option<f64>,
    pub arithmetic: Option<f64>,
}

impl Common {
    pub(super) fn of(times: &[[Timing; 2]]) -> Common {
        let regime = |regime| {
            let times = times.iter().filter(|[a, _]| a.setting.regime == regime);
            common(times.map(|[a, b]| b.ns.median / a.ns.median).collect())
        };
        Common { streaming: regime(Regime::Streaming), arithmetic: regime(Regime::Arithmetic) }
    }

    pub(super) fn of_regime(&self, regime: Regime) -> Option<f64> {
        match regime {
            Regime::Streaming => self.streaming,
            Regime::Arithmetic => self.arithmetic,
        }
    }
}

/// The median of all ratios: what the machine as a whole did. Of fewer than [`FEW`] there is none.
fn common(mut ratios: Vec<f64>) -> Option<f64> {
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
        time([&timing(a, spread, 25), &timing(b, spread, 25)], allowance).change
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
        assert_eq!([apart(1.25), apart(0.8), apart(f64::NAN), apart(0.0)], [0.25, 0.25, 0.0, 0.0]);
    }

    #[test]
    fn memory_and_arithmetic_are_told_apart() {
        let pair = |setting, ratio| [1.0, ratio].map(|ns| Timing { setting, ..timing(ns, 0.01, 25) });
        let times: Vec<_> =
            (0..8).flat_map(|_| [pair(Setting::STREAMING, 1.6), pair(Setting::COHERENT, 0.99)]).collect();
        assert_eq!(Common::of(&times), Common { streaming: Some(1.6), arithmetic: Some(0.99) });
    }
}
