//! Whether one variant is as accurate in run B as in run A.

use serde::Serialize;
use statrs::distribution::{Binomial, ContinuousCDF, DiscreteCDF, Normal};

use super::Change;
use crate::audit::{Fingerprint, Verdict};
use crate::record::{Audit, Buckets, Distribution, Rate};

/// The change and what it rests on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AccuracyChange {
    pub change: Change,
    /// In words, for whoever asks why.
    pub reason: String,
    /// Wrong by the variant's own fault, in A and in B.
    pub failed: [Rate; 2],
    pub non_finite: [Rate; 2],
}

/// Whether the bits of the outputs agree.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BitsChange {
    /// About how many configurations have other bits; 0 only if none has.
    pub differing: f64,
    pub configurations: u64,
}

impl BitsChange {
    pub(super) fn between(a: &Fingerprint, b: &Fingerprint, configurations: u64) -> BitsChange {
        let differing = a.difference(b).min(configurations as f64);
        BitsChange { differing, configurations }
    }

    pub fn identical(&self) -> bool {
        self.differing == 0.0
    }
}

/// A quantile of errors must move by this factor to count: the histogram's buckets are a quarter wide, so a move of one
/// bucket may be a hair's.
const QUANTILE_FACTOR: f64 = 1.5;
/// Configurations that must lie beyond a quantile for it to be looked at: its own sampling error is then below a fifth.
const BEYOND_QUANTILE: f64 = 30.0;

/// Compares two audits. `bits` if both runs had the same configurations and kept fingerprints; `paired` if they had the
/// same configurations; `level` is the probability of a false alarm that this comparison may have.
pub(super) fn accuracy(
    [a, b]: [&Audit; 2],
    bits: Option<BitsChange>,
    paired: bool,
    level: f64,
) -> AccuracyChange {
    let non_finite = [a, b].map(|audit| audit.verdict(Verdict::NonFinite));
    let failed = [a.failed, b.failed];
    let result = |change, reason: String| AccuracyChange { change, reason, failed, non_finite };
    if bits.is_some_and(|bits| bits.identical()) {
        return result(Change::Same, "identical to the last bit".to_owned());
    }
    let totals = [a.configurations, b.configurations];
    let mut moves = Vec::new();
    for (what, [from, to]) in [("not finite", non_finite), ("failed", failed)] {
        // On the same configurations a first NaN, or the last one gone, is a fact and needs no statistics.
        let fact = what == "not finite" && paired && (from.count == 0) != (to.count == 0);
        if fact || differ([from.count, to.count], totals, level) {
            let change = if to.rate > from.rate { Change::Worse } else { Change::Better };
            moves.push((change, format!("{what}: {} -> {}", told(&from), told(&to))));
        }
    }
    moves.extend(quantile_moves(a, b, level));
    let first = |change: Change| moves.iter().find(|(moved, _)| *moved == change);
    match (first(Change::Worse), first(Change::Better)) {
        (Some((_, worse)), Some((_, better))) => {
            return result(Change::CannotTell, format!("{worse}, but {better}"));
        }
        (Some((change, reason)), None) | (None, Some((change, reason))) => {
            return result(*change, reason.clone());
        }
        (None, None) => {}
    }
    if agree(failed, totals) {
        result(Change::Same, "failures and quantiles of errors agree".to_owned())
    } else {
        let reason = format!("failed: {} -> {}, too few to tell", failed[0].count, failed[1].count);
        result(Change::CannotTell, reason)
    }
}

/// How many tests of this level [`accuracy`] makes of audits with so many outputs.
pub(super) fn tests(outputs: usize) -> usize {
    2 + 3 * outputs
}

fn told(rate: &Rate) -> String {
    match rate.count {
        0 => "0".to_owned(),
        count if rate.rate < 1e-4 => format!("{count} configurations"),
        _ => format!("{:.2} %", 100.0 * rate.rate),
    }
}

/// Each quantile of each output's error that moved by [`QUANTILE_FACTOR`] or more, where the shares of errors beyond the
/// smaller of the two also differ at this level: between two modes of a distribution a quantile moves far for nothing.
fn quantile_moves(a: &Audit, b: &Audit, level: f64) -> Vec<(Change, String)> {
    let beyond = |share: f64| share * a.configurations.min(b.configurations) as f64 >= BEYOND_QUANTILE;
    let mut moves = Vec::new();
    for output in &a.outputs {
        let Some(other) = b.outputs.iter().find(|other| other.name == output.name) else { continue };
        type Get = fn(&Distribution) -> Option<f64>;
        let quantiles: [(&str, f64, Get); 3] =
            [("p50", 0.5, |d| d.p50), ("p99", 0.01, |d| d.p99), ("p999", 0.001, |d| d.p999)];
        for (name, share, get) in quantiles {
            if !beyond(share) {
                continue;
            }
            // Absent is infinite.
            let [from, to] = [output, other].map(|output| get(&output.error).unwrap_or(f64::INFINITY));
            let change = if to > QUANTILE_FACTOR * from {
                Change::Worse
            } else if from > QUANTILE_FACTOR * to {
                Change::Better
            } else {
                continue;
            };
            let counts = [output, other].map(|output| beyond_value(&output.error, from.min(to)));
            if !differ(counts, [a.configurations, b.configurations], level) {
                continue;
            }
            moves.push((change, format!("{name} of {}: {from:.2e} -> {to:.2e}", output.name)));
        }
    }
    moves
}

/// Errors beyond `value`, the upper edge of one of the histogram's buckets.
fn beyond_value(distribution: &Distribution, value: f64) -> u64 {
    let Buckets { first, counts } = &distribution.buckets;
    let beyond = counts.iter().enumerate().filter(|(at, _)| Buckets::start(first + at) >= value);
    beyond.map(|(_, count)| count).sum()
}

/// Whether two rates differ at this level, by the exact conditional test: given their sum, the first count is binomial.
fn differ(counts: [u64; 2], totals: [u64; 2], level: f64) -> bool {
    let sum = counts[0] + counts[1];
    if sum == 0 || totals.contains(&0) {
        return false;
    }
    // Of counts beyond this the normal approximation errs by less than the level's own roughness.
    const EXACT: u64 = 10_000;
    let share = totals[0] as f64 / (totals[0] + totals[1]) as f64;
    // Where most configurations fail, those that do not are the rarer and better told event.
    let rest = [totals[0] - counts[0], totals[1] - counts[1]];
    if rest[0] + rest[1] < sum {
        return differ(rest, totals, level);
    }
    if sum <= EXACT {
        let Ok(binomial) = Binomial::new(share, sum) else { return false };
        let lower = binomial.cdf(counts[0]);
        let upper = if counts[0] == 0 { 1.0 } else { binomial.sf(counts[0] - 1) };
        return 2.0 * lower.min(upper) < level;
    }
    let [p, q] = [0, 1].map(|side| counts[side] as f64 / totals[side] as f64);
    let pooled = sum as f64 / (totals[0] + totals[1]) as f64;
    let variance = pooled * (1.0 - pooled) * (1.0 / totals[0] as f64 + 1.0 / totals[1] as f64);
    (p - q).abs() > quantile_of_normal(level) * variance.sqrt()
}

/// The two-sided normal quantile of a level: 1.96 of 0.05.
pub(super) fn quantile_of_normal(level: f64) -> f64 {
    Normal::standard().inverse_cdf(1.0 - level / 2.0)
}

/// Whether two rates are close enough to be called the same: equal, or apart by at most a tenth of the smaller even at
/// the far ends of their intervals.
fn agree([a, b]: [Rate; 2], totals: [u64; 2]) -> bool {
    if a.count == b.count && totals[0] == totals[1] {
        return true;
    }
    let apart = (a.high - b.low).max(b.high - a.low);
    apart <= 0.1 * a.rate.min(b.rate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::rate_interval;
    use crate::record::{OutputAudit, Visible};

    fn rate(count: u64, total: u64) -> Rate {
        let (low, high) = rate_interval(count, total);
        Rate { count, rate: count as f64 / total as f64, low, high }
    }

    fn audit(failed: u64, non_finite: u64, p99: f64) -> Audit {
        const N: u64 = 1_000_000;
        // All errors in three buckets: 2 per cent just below p99 or 1, one in 500 just below 1.
        let mut counts = vec![0; 258];
        let bucket = |value: f64| (1..258).rfind(|bucket| Buckets::start(*bucket) < value).unwrap_or(0);
        counts[0] = N - N / 50 - N / 500;
        counts[bucket(p99)] += N / 50;
        counts[bucket(1.0)] += N / 500;
        let none = Distribution {
            p50: Some(0.0),
            p90: Some(0.0),
            p99: Some(p99),
            p999: Some(1.0),
            buckets: Buckets { first: 0, counts },
        };
        let mut verdicts = std::collections::BTreeMap::new();
        if non_finite > 0 {
            verdicts.insert(Verdict::NonFinite, rate(non_finite, N));
        }
        Audit {
            configurations: N,
            verdicts,
            failed: rate(failed, N),
            outputs: vec![OutputAudit {
                name: "x".to_owned(),
                beyond: rate(0, N),
                visible: Visible { bits8: 0, bits10: 0, half: 0 },
                error: none.clone(),
                ulp: none.clone(),
                conditioned: none,
                worst: None,
                extremes: None,
            }],
            landmarks: vec![],
        }
    }

    fn change(a: &Audit, b: &Audit) -> Change {
        accuracy([a, b], None, true, 1e-4).change
    }

    #[test]
    fn equal_bits_are_the_same_whatever_else() {
        let bits = BitsChange { differing: 0.0, configurations: 5 };
        let told = accuracy([&audit(0, 0, 1.0), &audit(9, 9, 2.0)], Some(bits), true, 1e-4);
        assert_eq!(told.change, Change::Same);
    }

    #[test]
    fn failures_decide_first() {
        assert_eq!(change(&audit(100, 0, 1.0), &audit(100, 0, 1.0)), Change::Same);
        assert_eq!(change(&audit(100, 0, 1.0), &audit(300, 0, 1.0)), Change::Worse);
        assert_eq!(change(&audit(300, 0, 1.0), &audit(100, 0, 1.0)), Change::Better);
        assert_eq!(change(&audit(3, 0, 1.0), &audit(6, 0, 1.0)), Change::CannotTell);
        // Half of all: a hundred more is noise, and the intervals are close.
        assert_eq!(change(&audit(500_000, 0, 1.0), &audit(500_100, 0, 1.0)), Change::Same);
        assert_eq!(change(&audit(500_000, 0, 1.0), &audit(510_000, 0, 1.0)), Change::Worse);
        // Nearly all: those that pass are the rare event.
        assert_eq!(change(&audit(999_999, 0, 1.0), &audit(999_900, 0, 1.0)), Change::Better);
    }

    #[test]
    fn a_first_nan_is_worse_on_the_same_configurations_only() {
        assert_eq!(change(&audit(5, 0, 1.0), &audit(5, 1, 1.0)), Change::Worse);
        assert_eq!(change(&audit(5, 1, 1.0), &audit(5, 0, 1.0)), Change::Better);
        let told = accuracy([&audit(5, 0, 1.0), &audit(5, 1, 1.0)], None, false, 1e-4);
        assert_eq!(told.change, Change::Same);
    }

    /// Fewer NaN and more failures: neither better nor worse.
    #[test]
    fn opposite_moves_tell_nothing() {
        assert_eq!(change(&audit(900, 800, 1.0), &audit(2_000, 300, 1.0)), Change::CannotTell);
        assert_eq!(change(&audit(900, 1, 1.0), &audit(2_000, 0, 1.0)), Change::CannotTell);
    }

    #[test]
    fn then_quantiles() {
        assert_eq!(change(&audit(0, 0, 1e-7), &audit(0, 0, 1.25e-7)), Change::Same);
        assert_eq!(change(&audit(0, 0, 1e-7), &audit(0, 0, 2e-7)), Change::Worse);
        let mut mixed = audit(0, 0, 2e-7);
        let error = &mut mixed.outputs[0].error;
        error.p999 = Some(0.1);
        error.buckets.counts.truncate(200);
        assert_eq!(change(&audit(0, 0, 1e-7), &mixed), Change::CannotTell);
    }

    /// Two modes, half of the errors in each: the median is in one or the other by chance.
    #[test]
    fn a_median_between_two_modes_tells_nothing() {
        let with = |p50: f64, low: u64| {
            let mut audit = audit(0, 0, 1.0);
            let error = &mut audit.outputs[0].error;
            error.p50 = Some(p50);
            error.buckets = Buckets { first: 100, counts: vec![low, 0, 0, 0, 0, 0, 0, 1_000_000 - low] };
            audit
        };
        let (low, high) = (Buckets::start(101), Buckets::start(108));
        assert_eq!(change(&with(low, 500_100), &with(high, 499_900)), Change::Same);
        assert_eq!(change(&with(low, 510_000), &with(high, 490_000)), Change::Worse);
    }

    /// Binomial tails summed by hand.
    #[test]
    fn the_test_is_exact_for_small_counts() {
        // 0 against 5 of equal totals: 2 * 2^-5 = 0.0625.
        assert!(differ([0, 5], [100, 100], 0.063));
        assert!(!differ([0, 5], [100, 100], 0.062));
        // 1 against 9: 2 * 11/1024 = 0.02148.
        assert!(differ([9, 1], [1000, 1000], 0.0215));
        assert!(!differ([9, 1], [1000, 1000], 0.0214));
        assert!(!differ([0, 0], [10, 10], 0.5));
        assert!((quantile_of_normal(0.05) - 1.959_963_984_540_054).abs() < 1e-9);
    }
}
