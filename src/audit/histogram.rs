//! Counts of errors in logarithmic buckets: exact integers, so that merging is addition.

use serde::{Deserialize, Serialize};

/// Buckets an octave: the two leading mantissa bits.
const PER_OCTAVE: usize = 4;
/// Octaves 2^-64 .. 2^64.
const LOWEST: i64 = -64;
const OCTAVES: usize = 128;

/// A histogram of non-negative errors.
///
/// Bucket 0 holds zero and what lies below 2^-64, the last one what is 2^64 or more, infinity included.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Histogram {
    counts: Vec<u64>,
}

const LAST: usize = PER_OCTAVE * OCTAVES + 1;

impl Default for Histogram {
    fn default() -> Self {
        Histogram { counts: vec![0; LAST + 1] }
    }
}

impl Histogram {
    /// Counts one error, which must not be negative; NaN counts as infinite.
    pub fn add(&mut self, error: f64) {
        self.counts[bucket(error)] += 1;
    }

    /// Adds another histogram's counts.
    pub fn merge(&mut self, other: &Histogram) {
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count += more;
        }
    }

    /// Errors counted.
    pub fn total(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// An upper bound of the `q`-quantile (0 < q <= 1), at most a quarter above it: the upper edge of its bucket.
    /// Zero if the histogram is empty; infinite if it lies in the last bucket.
    pub fn quantile(&self, q: f64) -> f64 {
        let total = self.total();
        if total == 0 {
            return 0.0;
        }
        let rank = ((q * total as f64).ceil() as u64).clamp(1, total);
        let mut below = 0;
        for (bucket, count) in self.counts.iter().enumerate() {
            below += count;
            if below >= rank {
                return upper_edge(bucket);
            }
        }
        f64::INFINITY
    }

    /// All buckets' counts, ascending.
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }
}

fn bucket(error: f64) -> usize {
    let octave = ((error.to_bits() >> 52) & 0x7ff) as i64 - 1023 - LOWEST;
    if error.is_nan() || octave >= OCTAVES as i64 {
        return LAST;
    }
    if octave < 0 {
        return 0;
    }
    1 + octave as usize * PER_OCTAVE + ((error.to_bits() >> 50) & 3) as usize
}

fn upper_edge(bucket: usize) -> f64 {
    if bucket == LAST {
        return f64::INFINITY;
    }
    let octave = LOWEST + (bucket / PER_OCTAVE) as i64;
    libm::ldexp(1.0 + (bucket % PER_OCTAVE) as f64 / PER_OCTAVE as f64, octave as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn zero_and_infinity_have_their_places() {
        let mut histogram = Histogram::default();
        for error in [0.0, 1e-30, f64::INFINITY, f64::NAN] {
            histogram.add(error);
        }
        assert_eq!((histogram.counts()[0], histogram.counts()[LAST]), (2, 2));
        assert_eq!(histogram.quantile(0.5), 2f64.powi(-64));
        assert_eq!(histogram.quantile(0.75), f64::INFINITY);
    }

    proptest! {
        #[test]
        fn quantiles_bound_from_above_by_at_most_a_quarter(
            mut errors in prop::collection::vec(1e-15f64..1e15, 1..200), q in 0.01f64..1.0) {
            let mut histogram = Histogram::default();
            errors.iter().for_each(|error| histogram.add(*error));
            errors.sort_by(f64::total_cmp);
            let rank = (q * errors.len() as f64).ceil() as usize;
            let exact = errors[rank - 1];
            let bound = histogram.quantile(q);
            prop_assert!(exact < bound && bound <= 1.25 * exact, "{} {}", exact, bound);
        }
    }
}
