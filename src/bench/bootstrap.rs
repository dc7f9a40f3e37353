//! Ratios of times and how sure they are: the percentile bootstrap over rounds.
//!
//! A round holds one sample of every variant, taken within moments of each other, so drift of the machine cancels from
//! the ratios within rounds. Rounds are drawn again with replacement, the same ones for every pair, and the statistic is
//! the median ratio (Efron and Tibshirani, An Introduction to the Bootstrap, 1993, chapter 13).

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::Ratio;

/// Resamples: the interval's ends are the 25th smallest and largest medians.
const RESAMPLES: usize = 1000;
/// Share of the resamples beyond each end of a 95 % interval.
const TAIL: f64 = 0.025;
/// Any will do; fixed, so that the same samples give the same interval.
const SEED: u64 = 1;

/// Resampled rounds.
pub(super) struct Bootstrap {
    /// Positions of rounds, `rounds` to a resample.
    drawn: Vec<u32>,
    rounds: usize,
}

impl Bootstrap {
    /// Draws resamples of so many rounds, at least one.
    pub(super) fn new(rounds: usize) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(SEED);
        let mut below = |n: usize| ((u64::from(generator.next_u32()) * n as u64) >> 32) as u32;
        Bootstrap { drawn: (0..rounds * RESAMPLES).map(|_| below(rounds)).collect(), rounds }
    }

    /// The ratio of `times` to `reference`, each with one sample a round.
    pub(super) fn ratio(&self, times: &[f64], reference: &[f64]) -> Ratio {
        // Logarithms, so that a ratio and its inverse have inverse intervals.
        let logs: Vec<f64> =
            times.iter().zip(reference).map(|(time, reference)| (time / reference).ln()).collect();
        debug_assert_eq!(logs.len(), self.rounds);
        let mut scratch = logs.clone();
        let middle = median(&mut scratch);
        let mut medians: Vec<f64> = self
            .drawn
            .chunks_exact(self.rounds)
            .map(|drawn| {
                scratch.clear();
                scratch.extend(drawn.iter().map(|round| logs[*round as usize]));
                median(&mut scratch)
            })
            .collect();
        let beyond = (TAIL * medians.len() as f64) as usize;
        let last = medians.len() - 1;
        let low = *medians.select_nth_unstable_by(beyond, f64::total_cmp).1;
        let high = *medians.select_nth_unstable_by(last - beyond, f64::total_cmp).1;
        Ratio { median: middle.exp(), low: low.exp(), high: high.exp() }
    }
}

/// The median of at least one value, which it reorders.
pub(super) fn median(values: &mut [f64]) -> f64 {
    let half = values.len() / 2;
    let even = values.len().is_multiple_of(2);
    let (below, middle, _) = values.select_nth_unstable_by(half, f64::total_cmp);
    if even { 0.5 * (*middle + below.iter().copied().fold(f64::NEG_INFINITY, f64::max)) } else { *middle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::noise::Noise;

    #[test]
    fn medians() {
        assert_eq!(median(&mut [3.0]), 3.0);
        assert_eq!(median(&mut [4.0, 1.0]), 2.5);
        assert_eq!(median(&mut [9.0, 1.0, 5.0]), 5.0);
        assert_eq!(median(&mut [9.0, 1.0, 5.0, 2.0]), 3.5);
    }

    #[test]
    fn a_ratio_and_its_inverse_agree() {
        let mut noise = Noise::new(3);
        let slow: Vec<f64> = (0..31).map(|_| noise.around(20.0, 0.05)).collect();
        let fast: Vec<f64> = (0..31).map(|_| noise.around(10.0, 0.05)).collect();
        let bootstrap = Bootstrap::new(31);
        let (ratio, inverse) = (bootstrap.ratio(&slow, &fast), bootstrap.ratio(&fast, &slow));
        assert!(ratio.low < 2.0 && 2.0 < ratio.high && ratio.high - ratio.low < 0.2, "{ratio:?}");
        assert!((ratio.median * inverse.median - 1.0).abs() < 1e-12);
        assert!((ratio.low * inverse.high - 1.0).abs() < 1e-12);
    }

    /// Drift that hits all of a round, by ten times the noise, does not widen the interval.
    #[test]
    fn drift_cancels() {
        let mut noise = Noise::new(4);
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for round in 0..25 {
            let drift = 1.0 + 0.2 * f64::from(round) / 25.0;
            a.push(drift * noise.around(10.0, 0.01));
            b.push(drift * noise.around(10.0, 0.01));
        }
        let ratio = Bootstrap::new(25).ratio(&a, &b);
        assert!(ratio.high / ratio.low < 1.03, "{ratio:?}");
    }

    /// The promise of 95 %: over 400 pairs of equal variants the interval misses 1 in about one of twenty. The percentile
    /// interval of a median is known to be a little narrow with few rounds; 10 % is four standard deviations above 5.
    #[test]
    fn intervals_cover_what_they_promise() {
        for rounds in [11, 25, 50] {
            let mut noise = Noise::new(rounds as u64);
            let bootstrap = Bootstrap::new(rounds);
            let missed = (0..400)
                .filter(|_| {
                    let a: Vec<f64> = (0..rounds).map(|_| noise.around(10.0, 0.03)).collect();
                    let b: Vec<f64> = (0..rounds).map(|_| noise.around(10.0, 0.03)).collect();
                    let ratio = bootstrap.ratio(&a, &b);
                    ratio.low > 1.0 || ratio.high < 1.0
                })
                .count();
            assert!((4..=40).contains(&missed), "{missed} of 400 with {rounds} rounds");
        }
    }
}
