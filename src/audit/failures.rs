//! A bounded, reproducible sample of failures: those whose index hashes smallest.

use std::collections::BinaryHeap;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::fingerprint::mix;
use super::{Verdict, exact_bits};

/// One failing configuration as it was seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    pub index: u64,
    pub verdict: Verdict,
    #[serde(with = "exact_bits")]
    pub inputs: Vec<f32>,
    #[serde(with = "exact_bits")]
    pub outputs: Vec<f32>,
    #[serde(with = "exact_bits")]
    pub truth: Vec<f64>,
    /// One an output, in the quantity's own measure.
    #[serde(with = "exact_bits")]
    pub errors: Vec<f64>,
    /// One an output.
    #[serde(with = "exact_bits")]
    pub ulps: Vec<f64>,
}

/// At most `limit` failures. Which ones depends on the set of failing indices alone, not on order, chunks or threads.
#[derive(Clone, Debug)]
pub struct Failures {
    limit: usize,
    kept: BinaryHeap<Ranked>,
}

impl Failures {
    pub fn new(limit: usize) -> Self {
        Failures { limit, kept: BinaryHeap::new() }
    }

    /// Offers the failure of configuration `index`, which is only looked at if it is kept.
    pub fn offer(&mut self, index: u64, failure: impl FnOnce() -> Failure) {
        let rank = (mix(index), index);
        if self.kept.len() < self.limit {
            self.kept.push(Ranked { rank, failure: failure() });
        } else if self.kept.peek().is_some_and(|worst| rank < worst.rank) {
            self.kept.pop();
            self.kept.push(Ranked { rank, failure: failure() });
        }
    }

    /// Takes over another sample's failures.
    pub fn merge(&mut self, other: Failures) {
        for ranked in other.kept {
            self.offer(ranked.rank.1, || ranked.failure);
        }
    }

    /// The kept failures by index.
    pub fn sorted(&self) -> Vec<&Failure> {
        let mut failures: Vec<&Failure> = self.kept.iter().map(|ranked| &ranked.failure).collect();
        failures.sort_by_key(|failure| failure.index);
        failures
    }
}

/// The limit and the failures by index.
impl Serialize for Failures {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.limit, self.sorted()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Failures {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (limit, kept) = <(usize, Vec<Failure>)>::deserialize(deserializer)?;
        let mut failures = Failures::new(limit);
        for failure in kept {
            failures.offer(failure.index, || failure);
        }
        Ok(failures)
    }
}

#[derive(Clone, Debug)]
struct Ranked {
    rank: (u64, u64),
    failure: Failure,
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Self) -> bool {
        self.rank == other.rank
    }
}
impl Eq for Ranked {}
impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Ranked {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.rank.cmp(&other.rank)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(indices: impl Iterator<Item = u64>) -> Failures {
        let mut failures = Failures::new(10);
        for index in indices {
            failures.offer(index, || Failure {
                index,
                verdict: Verdict::Inaccurate,
                inputs: vec![],
                outputs: vec![],
                truth: vec![],
                errors: vec![],
                ulps: vec![],
            });
        }
        failures
    }

    fn indices(failures: &Failures) -> Vec<u64> {
        failures.sorted().iter().map(|failure| failure.index).collect()
    }

    #[test]
    fn order_and_parts_do_not_matter() {
        let whole = sample(0..1000);
        let mut parts = sample((500..1000).rev());
        parts.merge(sample(0..500));
        assert_eq!(indices(&whole).len(), 10);
        assert_eq!(indices(&whole), indices(&parts));
    }
}
