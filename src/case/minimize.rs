//! Shrinks a failing configuration to one that a person can read.
//!
//! Each step tries a whole population of simpler configurations at once and takes the cheapest that
//! still fails in the same way; the last step is the one in which none does. [`cost`] falls with every step, and nothing
//! is random, so that it ends, and ends the same way every time.

use serde::Serialize;

use super::cost::cost;
use super::simpler;
use crate::audit::Verdict;
use crate::catalog::Signature;

/// What became of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It fails with the same verdict.
    Fails,
    /// It has another verdict, [`Verdict::Ok`] or worse.
    Other(Verdict),
    /// The oracle does not take it, or no variant that was right before is right on it: it is no fair configuration.
    Unfair,
}

/// The simplest configuration found, and the way there.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimized {
    pub values: Vec<f32>,
    /// Costs, first before any step and then after each.
    pub costs: Vec<u64>,
    /// Configurations that were tried.
    pub evaluations: u64,
    /// One a component.
    pub kept: Vec<Kept>,
}

/// Why a component is not simpler: what became of each simpler value of it, all else as in the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Kept {
    /// Simpler values tried.
    pub tried: u64,
    /// Of these, with verdict ok, or ill-conditioned or unspecified, which do not blame the variant.
    pub pass: u64,
    /// Failed with another verdict.
    pub other: u64,
    /// Were no fair configurations.
    pub unfair: u64,
}

/// More steps than any input needs: a step lowers the cost, which is a few hundred at most, by one at least.
const MAX_STEPS: usize = 10_000;

/// Minimizes `values`, a configuration of `signature`'s parameters. `judge` says what becomes of candidates, in order.
pub fn minimize<E>(
    signature: &Signature,
    values: &[f32],
    mut judge: impl FnMut(&[Vec<f32>]) -> Result<Vec<Outcome>, E>,
) -> Result<Minimized, E> {
    let parameters = simpler::parameters(signature);
    let mut values = values.to_vec();
    let mut costs = vec![cost(&values)];
    let mut evaluations = 0;
    let mut kept = vec![Kept::default(); values.len()];
    for _ in 0..MAX_STEPS {
        let candidates = simpler::candidates(&parameters, &values);
        if candidates.is_empty() {
            break;
        }
        let rows: Vec<Vec<f32>> = candidates.iter().map(|candidate| candidate.values.clone()).collect();
        let outcomes = judge(&rows)?;
        evaluations += rows.len() as u64;
        if let Some(best) = outcomes.iter().position(|outcome| *outcome == Outcome::Fails) {
            values.clone_from(&candidates[best].values);
            costs.push(candidates[best].cost);
            continue;
        }
        for (candidate, outcome) in candidates.iter().zip(&outcomes) {
            if let Some(at) = candidate.alone {
                kept[at].count(*outcome);
            }
        }
        break;
    }
    Ok(Minimized { values, costs, evaluations, kept })
}

impl Kept {
    fn count(&mut self, outcome: Outcome) {
        self.tried += 1;
        match outcome {
            Outcome::Other(verdict) if verdict.is_failure() => self.other += 1,
            Outcome::Other(_) => self.pass += 1,
            Outcome::Unfair | Outcome::Fails => self.unfair += u64::from(outcome == Outcome::Unfair),
        }
    }

    /// In words: `all 12 simpler values pass`; empty if there is no simpler one.
    pub fn words(&self) -> String {
        let Kept { tried, pass, other, unfair } = *self;
        let parts: Vec<String> = [
            (pass, "passes", "pass"),
            (other, "fails otherwise", "fail otherwise"),
            (unfair, "is unfair", "are unfair"),
        ]
        .into_iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, one, several)| match (count == tried, count) {
            (true, 1) => format!("the only simpler value {one}"),
            (true, _) => format!("all {count} simpler values {several}"),
            (false, 1) => format!("1 {one}"),
            (false, _) => format!("{count} {several}"),
        })
        .collect();
        match parts.len() {
            0 | 1 => parts.concat(),
            _ => format!("of {tried} simpler values {}", parts.join(", ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{Field, Type};
    use proptest::prelude::*;
    use std::convert::Infallible;

    fn signature() -> Signature {
        Signature {
            function: "f",
            parameters: vec![Field::new("v", Type::Vec3), Field::new("s", Type::Float)],
            results: vec![Field::new("y", Type::Float)],
        }
    }

    fn minimized(values: [f32; 4], fails: impl Fn(&[f32]) -> bool) -> Minimized {
        assert!(fails(&values));
        let judge = |rows: &[Vec<f32>]| {
            let outcome =
                |row: &Vec<f32>| if fails(row) { Outcome::Fails } else { Outcome::Other(Verdict::Ok) };
            Ok::<_, Infallible>(rows.iter().map(outcome).collect())
        };
        minimize(&signature(), &values, judge).unwrap()
    }

    const START: [f32; 4] = [-3.456_789, 17.25, 0.000_123_4, 0.100_97];

    /// Whatever the rest is: nothing is simpler than nothing.
    #[test]
    fn known_minima_are_reached() {
        assert_eq!(minimized(START, |_| true).values, [0.0; 4]);
        // 1 is the only number as cheap as 2, and 4 cheaper than 3.
        assert_eq!(minimized(START, |v| v[0].abs() >= 3.0).values[..], [4.0, 0.0, 0.0, 0.0]);
        // Of all numbers there 0.1 alone is written in one digit; in binary it takes nine bits.
        assert_eq!(minimized(START, |v| (0.0995..0.101).contains(&v[3])).values, [0.0, 0.0, 0.0, 0.1]);
        // Both or neither: no change of one component fails.
        let pair = |v: &[f32]| v[0] * v[1] < 0.0 || v[..2] == [0.0, 0.0] && v[3] > 0.0;
        assert_eq!(minimized(START, pair).values, [0.0, 0.0, 0.0, 1.0]);
        // -1 and 1 are read once, and 8 is a power of two.
        let ratio = |v: &[f32]| v[0] < 0.0 && v[1] >= 5.0 * v[3] && v[3] > 0.9;
        assert_eq!(minimized([-3.5, 17.25, 0.1, 1.7], ratio).values, [-1.0, 8.0, 0.0, 1.0]);
    }

    #[test]
    fn what_cannot_be_simpler_is_told() {
        let found = minimized(START, |v| v[3] == 0.100_97 && v[0] < 0.0);
        assert_eq!(found.values, [-1.0, 0.0, 0.0, 0.100_97]);
        assert!(found.kept[3].tried > 20 && found.kept[3].pass == found.kept[3].tried, "{:?}", found.kept);
        assert_eq!(found.kept[1], Kept::default());
        let all = format!("all {} simpler values pass", found.kept[3].tried);
        assert_eq!(found.kept[3].words(), all);
        assert_eq!(found.kept[1].words(), "");
        assert_eq!(
            Kept { tried: 1, other: 1, ..Kept::default() }.words(),
            "the only simpler value fails otherwise"
        );
        let mixed = Kept { tried: 3, pass: 2, other: 0, unfair: 1 };
        assert_eq!(mixed.words(), "of 3 simpler values 2 pass, 1 is unfair");
    }

    proptest! {
        /// Whatever fails: each step costs less than the last, the result fails, and again it is the same.
        #[test]
        fn steps_never_raise_the_cost(
            bits in proptest::array::uniform4(any::<u32>()),
            seed in any::<u64>(),
            share in 1u64..8,
        ) {
            let values = bits.map(f32::from_bits);
            prop_assume!(values.iter().all(|value| value.is_finite()));
            let start = values.to_vec();
            let fails = |row: &[f32]| {
                let mix = |hash: u64, value: &f32| {
                    (hash ^ u64::from(value.to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
                };
                row == start || row.iter().fold(seed, mix) % 8 < share
            };
            let found = minimized(values, fails);
            prop_assert!(fails(&found.values));
            prop_assert!(found.costs.is_sorted_by(|a, b| a > b), "{:?}", found.costs);
            prop_assert_eq!(cost(&found.values), *found.costs.last().unwrap());
            prop_assert_eq!(minimized(values, fails), found);
        }
    }
}
