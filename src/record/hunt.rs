//! A hunt in a run's record.

use serde::{Deserialize, Serialize};

use crate::audit::Verdict;
use crate::hunt::{self, Finds, Hunted};

/// A search for the worst configuration that a scenario can draw, and as much random sampling.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hunt {
    /// By the search; as many random ones beside it.
    pub evaluations: u64,
    /// Words that a configuration draws.
    pub dimensions: usize,
    /// The worst of each failing verdict, gravest first, then what came nearest to failing.
    pub search: Vec<Find>,
    pub random: Vec<Find>,
}

/// The worst of its kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Find {
    pub verdict: Verdict,
    /// From 1 on a failure, its largest error over the tolerance, `null` where that is infinite; below 1 how near a failure
    /// it is: the lesser of error over tolerance and error over what rounding the inputs explains.
    pub size: Option<f64>,
    /// Number of the evaluation, from 1.
    pub evaluation: u64,
    /// In the scenario's stream under the run's seed; absent from the search's finds, which are in none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub index: Option<u64>,
    /// In the order of input columns.
    pub inputs: Vec<f32>,
    /// In the order of output columns, as `truth`; `null` where not a finite number.
    pub output: Vec<Option<f32>>,
    pub truth: Vec<Option<f64>>,
}

/// One hunt's record.
pub fn hunt(hunted: &Hunted) -> Hunt {
    Hunt {
        evaluations: hunted.evaluations,
        dimensions: hunted.dimensions,
        search: finds(&hunted.search, false),
        random: finds(&hunted.random, true),
    }
}

fn finds(finds: &Finds, in_stream: bool) -> Vec<Find> {
    let find = |find: &hunt::Find| Find {
        verdict: find.failure.verdict,
        size: find.size.is_finite().then_some(find.size),
        evaluation: find.evaluation,
        index: in_stream.then_some(find.failure.index),
        inputs: find.failure.inputs.clone(),
        output: find.failure.outputs.iter().map(|value| value.is_finite().then_some(*value)).collect(),
        truth: find.failure.truth.iter().map(|value| value.is_finite().then_some(*value)).collect(),
    };
    finds.failures.values().rev().chain(&finds.nearest).map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Failure;

    /// JSON knows no infinity and no NaN.
    #[test]
    fn a_record_reads_back() {
        let find = |verdict, size| hunt::Find {
            size,
            evaluation: 7,
            failure: Failure {
                index: 6,
                verdict,
                inputs: vec![0.1, -0.0],
                outputs: vec![f32::NAN],
                truth: vec![f64::INFINITY],
                errors: vec![],
                ulps: vec![],
            },
        };
        let failures = [(Verdict::NonFinite, f64::INFINITY), (Verdict::Inaccurate, 3.0)];
        let finds = Finds {
            failures: failures.into_iter().map(|(verdict, size)| (verdict, find(verdict, size))).collect(),
            nearest: Some(find(Verdict::Ok, 0.5)),
        };
        let record = hunt(&Hunted { evaluations: 9, dimensions: 2, search: finds.clone(), random: finds });
        let sizes: Vec<_> = record.search.iter().map(|find| (find.verdict, find.size, find.index)).collect();
        assert_eq!(
            sizes,
            [
                (Verdict::NonFinite, None, None),
                (Verdict::Inaccurate, Some(3.0), None),
                (Verdict::Ok, Some(0.5), None)
            ]
        );
        assert!(record.random.iter().all(|find| find.index == Some(6)));
        let text = serde_json::to_string(&record).unwrap();
        assert_eq!(serde_json::from_str::<Hunt>(&text).unwrap(), record);
    }
}
