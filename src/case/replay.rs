//! What becomes of recorded failures when they are evaluated again.

use serde::Serialize;

use super::Answer;
use crate::audit::Verdict;
use crate::record::RecordedFailure;

/// What became of one failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// It fails again with the same verdict.
    Same,
    /// It fails again, with another verdict.
    Other,
    /// It fails no longer.
    Passes,
}

impl Fate {
    pub fn of(recorded: Verdict, now: Verdict) -> Fate {
        if now == recorded {
            Fate::Same
        } else if now.is_failure() {
            Fate::Other
        } else {
            Fate::Passes
        }
    }

    /// In words: `fails again with the same verdict`.
    pub fn words(self) -> &'static str {
        match self {
            Fate::Same => "fails again with the same verdict",
            Fate::Other => "fails again with another verdict",
            Fate::Passes => "fails no longer",
        }
    }
}

/// Recorded failures, replayed.
#[derive(Clone, Debug, Serialize)]
pub struct Replay {
    /// One a variant and scenario, in the record's order.
    pub groups: Vec<Group>,
    pub failures: Vec<Replayed>,
}

/// The failures of one variant on one scenario.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Group {
    pub family: String,
    pub variant: String,
    pub scenario: String,
    /// Number of the first failure, from 1, and of the last one.
    pub first: usize,
    pub last: usize,
    pub failures: u64,
    /// Verdicts as recorded, the most frequent first.
    pub verdicts: Vec<(Verdict, u64)>,
    pub same_verdict: u64,
    pub other_verdict: u64,
    pub passes: u64,
    /// Whose outputs are those recorded to the last bit.
    pub same_bits: u64,
    /// Why the variant could not be evaluated; then nothing is known of its failures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skipped: Option<String>,
}

/// One failure, replayed.
#[derive(Clone, Debug, Serialize)]
pub struct Replayed {
    /// Its number in the record, from 1.
    pub failure: usize,
    pub family: String,
    pub variant: String,
    pub scenario: String,
    pub index: u64,
    pub recorded: Verdict,
    /// One an output; `null` where infinite.
    pub recorded_errors: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub now: Option<Now>,
}

/// What one failure is now.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Now {
    pub verdict: Verdict,
    pub fate: Fate,
    pub errors: Vec<f64>,
    pub same_bits: bool,
}

impl Now {
    pub fn new(recorded: &RecordedFailure, answer: &Answer) -> Now {
        Now {
            verdict: answer.verdict,
            fate: Fate::of(recorded.failure.verdict, answer.verdict),
            errors: answer.errors.clone(),
            same_bits: answer.same_bits(&recorded.failure.outputs),
        }
    }
}

impl Replay {
    /// From failures with their numbers and what they are now, or why that is not known.
    pub fn new<'a>(
        replayed: impl IntoIterator<Item = (usize, &'a RecordedFailure, Result<Now, String>)>,
    ) -> Replay {
        let mut replay = Replay { groups: Vec::new(), failures: Vec::new() };
        for (number, recorded, now) in replayed {
            replay.count(number, recorded, &now);
            replay.failures.push(Replayed {
                failure: number,
                family: recorded.problem.name().to_owned(),
                variant: recorded.variant.clone(),
                scenario: recorded.scenario.clone(),
                index: recorded.failure.index,
                recorded: recorded.failure.verdict,
                recorded_errors: recorded.failure.errors.clone(),
                now: now.ok(),
            });
        }
        for group in &mut replay.groups {
            group.verdicts.sort_by_key(|(verdict, count)| (std::cmp::Reverse(*count), *verdict));
        }
        replay
    }

    fn count(&mut self, number: usize, recorded: &RecordedFailure, now: &Result<Now, String>) {
        let family = recorded.problem.name();
        let same = |group: &&mut Group| {
            group.family == family && group.variant == recorded.variant && group.scenario == recorded.scenario
        };
        let group = match self.groups.last_mut().filter(same) {
            Some(group) => group,
            None => {
                self.groups.push(Group {
                    family: family.to_owned(),
                    variant: recorded.variant.clone(),
                    scenario: recorded.scenario.clone(),
                    first: number,
                    last: number,
                    failures: 0,
                    verdicts: Vec::new(),
                    same_verdict: 0,
                    other_verdict: 0,
                    passes: 0,
                    same_bits: 0,
                    skipped: None,
                });
                let last = self.groups.len() - 1;
                &mut self.groups[last]
            }
        };
        group.last = number;
        group.failures += 1;
        match group.verdicts.iter_mut().find(|(verdict, _)| *verdict == recorded.failure.verdict) {
            Some((_, count)) => *count += 1,
            None => group.verdicts.push((recorded.failure.verdict, 1)),
        }
        match now {
            Ok(now) => {
                let fate = match now.fate {
                    Fate::Same => &mut group.same_verdict,
                    Fate::Other => &mut group.other_verdict,
                    Fate::Passes => &mut group.passes,
                };
                *fate += 1;
                group.same_bits += u64::from(now.same_bits);
            }
            Err(why) => group.skipped = Some(why.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Failure;
    use crate::family;

    fn recorded(scenario: &str, verdict: Verdict) -> RecordedFailure {
        let failure = Failure {
            index: 7,
            verdict,
            inputs: vec![1.0],
            outputs: vec![2.0],
            truth: vec![3.0],
            errors: vec![0.5],
            ulps: vec![9.0],
        };
        let (problem, variant) = (family::find("sqrt").unwrap(), "native".to_owned());
        RecordedFailure { problem, variant, scenario: scenario.to_owned(), failure }
    }

    fn answer(verdict: Verdict, output: f32) -> Answer {
        Answer { outputs: vec![output], verdict, errors: vec![0.5], ulps: vec![9.0] }
    }

    #[test]
    fn fates_are_counted_by_variant_and_scenario() {
        let cases = [
            (recorded("a", Verdict::Inaccurate), answer(Verdict::Inaccurate, 2.0)),
            (recorded("a", Verdict::Inaccurate), answer(Verdict::Ok, 2.5)),
            (recorded("a", Verdict::NonFinite), answer(Verdict::WrongSign, f32::NAN)),
            (recorded("b", Verdict::Inaccurate), answer(Verdict::IllConditioned, 2.0)),
        ];
        let replayed =
            cases.iter().enumerate().map(|(at, (case, answer))| (at + 1, case, Ok(Now::new(case, answer))));
        let replay = Replay::new(replayed);
        let [a, b] = &replay.groups[..] else { panic!("{:?}", replay.groups) };
        assert_eq!((a.first, a.last, a.failures), (1, 3, 3));
        assert_eq!((a.same_verdict, a.other_verdict, a.passes, a.same_bits), (1, 1, 1, 1));
        assert_eq!(a.verdicts, [(Verdict::Inaccurate, 2), (Verdict::NonFinite, 1)]);
        assert_eq!((b.first, b.passes, b.same_bits), (4, 1, 1));
        let lost = Replay::new([(1, &cases[0].0, Err("gone".to_owned()))]);
        assert_eq!(lost.groups[0].skipped.as_deref(), Some("gone"));
        assert_eq!(lost.failures[0].now, None);
    }
}
