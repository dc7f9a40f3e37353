//! Interleaved rounds: when to begin counting, when to stop, and what to discard.
//!
//! Nothing here knows a device: samples come from a [`Sampler`], whose clock may be a synthetic one.

use std::time::Duration;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::Stop;
use super::bootstrap::{Bootstrap, median};

/// Where samples come from.
pub trait Sampler {
    type Error;
    /// Variants entered, the same one twice if need be.
    fn entries(&self) -> usize;
    /// Takes one sample of an entry: nanoseconds an evaluation.
    fn sample(&mut self, entry: usize) -> Result<f64, Self::Error>;
    /// Time since some beginning, by the clock that the effort is meant in.
    fn now(&self) -> Duration;
}

/// How much to measure.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Uncounted rounds until so much time has passed, at least one: a clock may need 400 ms to ramp up.
    pub warm_up: Duration,
    /// Rounds counted and kept, at least.
    pub min_rounds: usize,
    /// Counted rounds, at most.
    pub max_rounds: usize,
    /// Counted rounds go on for so long, if intervals do not become narrow before.
    pub time: Duration,
    /// An interval is narrow if it reaches no farther than this share from its ratio.
    pub narrow: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Effort {
            warm_up: Duration::from_millis(400),
            // With fewer the bootstrap of a median promises more than it keeps.
            min_rounds: 11,
            max_rounds: 201,
            time: Duration::from_secs(3),
            narrow: 0.005,
        }
    }
}

/// Samples taken.
#[derive(Clone, Debug)]
pub struct Rounds {
    /// For each entry one sample a round kept.
    pub samples: Vec<Vec<f64>>,
    pub stopped: Stop,
    /// Rounds discarded for being throttled.
    pub discarded: usize,
    /// Of the counted rounds.
    pub time: Duration,
}

/// Takes rounds over all entries, in each of them every entry once and in random order, so that no entry always runs in
/// the wake of the same other. They may stop when the ratios to the entry `reference` are known well enough.
pub fn rounds<S: Sampler>(sampler: &mut S, reference: usize, effort: &Effort) -> Result<Rounds, S::Error> {
    let entries = sampler.entries();
    let mut order: Vec<usize> = (0..entries).collect();
    let mut generator = ChaCha8Rng::seed_from_u64(1);

    let start = sampler.now();
    loop {
        for entry in 0..entries {
            sampler.sample(entry)?;
        }
        if sampler.now().saturating_sub(start) >= effort.warm_up {
            break;
        }
    }

    let mut samples = vec![Vec::new(); entries];
    let start = sampler.now();
    let mut look = effort.min_rounds;
    let stopped = loop {
        shuffle(&mut order, &mut generator);
        for entry in &order {
            samples[*entry].push(sampler.sample(*entry)?);
        }
        let taken = samples.first().map_or(0, Vec::len);
        if taken >= effort.max_rounds.max(1) {
            break Stop::Rounds;
        }
        if taken < effort.min_rounds || taken - count(&throttled(&samples)) < effort.min_rounds {
            continue;
        }
        // Each look is a chance to stop at a lucky moment, so there are few of them.
        if taken >= look {
            look = taken + taken.div_ceil(2);
            if narrow(&samples, reference, effort.narrow) {
                break Stop::Narrow;
            }
        }
        if sampler.now().saturating_sub(start) >= effort.time {
            break Stop::Time;
        }
    };
    let time = sampler.now().saturating_sub(start);
    let discard = throttled(&samples);
    for samples in &mut samples {
        let mut discard = discard.iter();
        samples.retain(|_| !discard.next().copied().unwrap_or(false));
    }
    Ok(Rounds { samples, stopped, discarded: count(&discard), time })
}

fn count(marked: &[bool]) -> usize {
    marked.iter().filter(|marked| **marked).count()
}

/// Fisher and Yates' shuffle.
fn shuffle(order: &mut [usize], generator: &mut ChaCha8Rng) {
    for last in (1..order.len()).rev() {
        let other = (u64::from(generator.next_u32()) * (last as u64 + 1)) >> 32;
        order.swap(last, other as usize);
    }
}

/// Whether every entry's ratio to the reference is known to `width`.
fn narrow(samples: &[Vec<f64>], reference: usize, width: f64) -> bool {
    let bootstrap = Bootstrap::new(samples[reference].len());
    samples.iter().enumerate().filter(|(entry, _)| *entry != reference).all(|(_, times)| {
        let ratio = bootstrap.ratio(times, &samples[reference]);
        ratio.high / ratio.median <= 1.0 + width && ratio.low / ratio.median >= 1.0 - width
    })
}

/// A round so much slower than the others, over all entries, was throttled or disturbed.
const THROTTLED: f64 = 1.25;
/// At most one round in so many is discarded, the slowest first: where all are slow, slow is how the machine is.
const DISCARD_ONE_IN: usize = 4;

/// Which rounds to discard. Single outliers stay: medians do not mind them.
fn throttled(samples: &[Vec<f64>]) -> Vec<bool> {
    let rounds = samples.first().map_or(0, Vec::len);
    let mut discard = vec![false; rounds];
    if rounds == 0 {
        return discard;
    }
    let medians: Vec<f64> = samples.iter().map(|samples| median(&mut samples.clone())).collect();
    let slowness: Vec<f64> = (0..rounds)
        .map(|round| {
            let mut factors: Vec<f64> =
                samples.iter().zip(&medians).map(|(samples, median)| samples[round] / median).collect();
            median(&mut factors)
        })
        .collect();
    let mut slow: Vec<usize> = (0..rounds).filter(|round| slowness[*round] > THROTTLED).collect();
    slow.sort_by(|a, b| slowness[*b].total_cmp(&slowness[*a]));
    for round in slow.into_iter().take(rounds / DISCARD_ONE_IN) {
        discard[round] = true;
    }
    discard
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::noise::Noise;
    use crate::bench::standing;

    /// Entries of given times under given noise; every sample takes a millisecond of a clock that only samples move.
    struct Synthetic {
        centres: Vec<f64>,
        sigma: f64,
        noise: Noise,
        taken: usize,
        /// Samples from this one to that one take `slow` times as long.
        throttle: std::ops::Range<usize>,
        slow: f64,
        seen: Vec<usize>,
    }

    impl Synthetic {
        fn new(centres: &[f64], sigma: f64) -> Self {
            Synthetic {
                centres: centres.to_vec(),
                sigma,
                noise: Noise::new(7),
                taken: 0,
                throttle: 0..0,
                slow: 3.0,
                seen: Vec::new(),
            }
        }
    }

    impl Sampler for Synthetic {
        type Error = std::convert::Infallible;

        fn entries(&self) -> usize {
            self.centres.len()
        }

        fn sample(&mut self, entry: usize) -> Result<f64, Self::Error> {
            let slow = if self.throttle.contains(&self.taken) { self.slow } else { 1.0 };
            self.taken += 1;
            self.seen.push(entry);
            Ok(slow * self.noise.around(self.centres[entry], self.sigma))
        }

        fn now(&self) -> Duration {
            Duration::from_millis(self.taken as u64)
        }
    }

    fn effort() -> Effort {
        Effort { warm_up: Duration::from_millis(10), time: Duration::from_secs(2), ..Effort::default() }
    }

    #[test]
    fn steady_samples_stop_early_and_noisy_ones_at_the_time() {
        let mut steady = Synthetic::new(&[10.0, 12.0, 30.0], 1e-4);
        let taken = rounds(&mut steady, 0, &effort()).unwrap();
        assert_eq!((taken.stopped, taken.samples[0].len()), (Stop::Narrow, 11));

        let mut noisy = Synthetic::new(&[30.0, 12.0, 10.0], 0.3);
        let taken = rounds(&mut noisy, 0, &Effort { max_rounds: 10_000, ..effort() }).unwrap();
        assert_eq!(taken.stopped, Stop::Time);
        // A round takes three milliseconds.
        assert!(
            (600..=668).contains(&(taken.samples[0].len() + taken.discarded)),
            "{}",
            taken.samples[0].len()
        );
        assert!(taken.time >= Duration::from_secs(2) && taken.time < Duration::from_millis(2010));

        let mut noisy = Synthetic::new(&[30.0, 12.0], 0.3);
        let taken = rounds(&mut noisy, 0, &Effort { max_rounds: 40, ..effort() }).unwrap();
        assert_eq!((taken.stopped, taken.samples[0].len() + taken.discarded), (Stop::Rounds, 40));
    }

    /// Stopping when intervals are narrow, and looking several times, makes no more of identical variants than one of
    /// twenty pairs.
    #[test]
    fn stopping_early_ranks_nobody() {
        let (mut told_apart, mut pairs, mut early) = (0, 0, 0);
        for seed in 0..60 {
            let mut sampler = Synthetic::new(&[10.0; 4], 0.01);
            sampler.noise = Noise::new(seed);
            let taken = rounds(&mut sampler, 0, &Effort { narrow: 0.008, ..effort() }).unwrap();
            early += usize::from(taken.stopped == Stop::Narrow);
            let ranks = standing(&taken.samples[..3], 0, &taken.samples[3], &|_, _| false).ranks;
            for (a, b) in [(0, 1), (0, 2), (1, 2)] {
                pairs += 1;
                told_apart += usize::from(ranks[a].last < ranks[b].first || ranks[b].last < ranks[a].first);
            }
        }
        assert!(early >= 30, "only {early} stopped early");
        assert!(told_apart * 20 < pairs, "{told_apart} of {pairs}");
    }

    /// Too little time still gives the least rounds, and one entry alone is nothing to wait for.
    #[test]
    fn the_least_is_always_taken() {
        let mut noisy = Synthetic::new(&[10.0, 12.0], 0.3);
        let taken = rounds(&mut noisy, 0, &Effort { time: Duration::ZERO, ..effort() }).unwrap();
        assert_eq!(taken.stopped, Stop::Time);
        assert!(taken.samples[0].len() == 11 && taken.discarded <= 3, "{}", taken.discarded);
        let alone = rounds(&mut Synthetic::new(&[10.0], 0.3), 0, &effort()).unwrap();
        assert_eq!(alone.stopped, Stop::Narrow);
    }

    #[test]
    fn rounds_are_interleaved_in_changing_order() {
        let mut sampler = Synthetic::new(&[10.0, 10.0, 10.0, 10.0], 0.1);
        rounds(&mut sampler, 0, &Effort { time: Duration::ZERO, ..effort() }).unwrap();
        let counted = &sampler.seen[sampler.seen.len() - 44..];
        let mut followers = std::collections::BTreeSet::new();
        for round in counted.chunks(4) {
            let mut sorted = round.to_vec();
            sorted.sort_unstable();
            assert_eq!(sorted, [0, 1, 2, 3]);
            followers.extend(round.windows(2).map(|pair| (pair[0], pair[1])));
        }
        assert_eq!(followers.len(), 12, "each runs after each other one");
    }

    #[test]
    fn throttled_rounds_are_discarded() {
        let mut sampler = Synthetic::new(&[10.0, 20.0, 30.0], 0.01);
        sampler.throttle = 45..60;
        let taken = rounds(&mut sampler, 0, &Effort { narrow: 0.0, ..effort() }).unwrap();
        // Fifteen samples are five rounds, and a sixth where they begin or end inside one.
        assert!((4..=6).contains(&taken.discarded), "{}", taken.discarded);
        assert!(taken.samples[0].iter().filter(|sample| **sample > 25.0).count() <= 1);
    }

    /// A machine that throttles for good, or all the time, still gives results.
    #[test]
    fn discards_are_capped() {
        for throttle in [0..usize::MAX, 30..usize::MAX, 100..usize::MAX] {
            let mut sampler = Synthetic::new(&[10.0, 20.0, 30.0], 0.01);
            sampler.throttle = throttle.clone();
            let taken = rounds(&mut sampler, 0, &Effort { narrow: 0.0, max_rounds: 60, ..effort() }).unwrap();
            assert!(
                taken.discarded <= 15 && taken.samples[0].len() >= 45,
                "{throttle:?}: {}",
                taken.discarded
            );
        }
        assert_eq!(throttled(&[vec![1.0, 9.0, 9.0]]), [false, false, false]);
        assert_eq!(throttled(&[]), Vec::<bool>::new());
    }
}
