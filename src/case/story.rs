//! One recorded failure in full: inputs, truth, and what every variant makes of it now.

use serde::Serialize;

use super::evaluate::{Answer, Number, truth};
use super::replay::Fate;
use crate::audit::{EXPLAINED_BY_ROUNDING, Verdict};
use crate::family::{CERTIFIED, Truth};
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::record::RecordedFailure;

/// Everything that is known of one failure.
#[derive(Clone, Debug, Serialize)]
pub struct Story {
    /// Its number in the record, from 1.
    pub failure: usize,
    pub family: String,
    pub variant: String,
    pub scenario: String,
    pub index: u64,
    /// Device and driver of the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded_on: Option<String>,
    /// Device and driver now.
    pub device: String,
    pub inputs: Vec<Number>,
    pub truth: Exact,
    pub recorded: Told,
    /// The failing variant first, then others.
    pub variants: Vec<Teller>,
    /// What became of the failure; absent where its variant could not be evaluated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fate: Option<Fate>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same_bits: Option<bool>,
}

/// The exact result and its certainty.
#[derive(Clone, Debug, Serialize)]
pub struct Exact {
    /// One an output column.
    pub columns: Vec<String>,
    pub values: Vec<f64>,
    /// The largest error bound of any output in f32 spacings, of directions in 2^-24 rad.
    pub bound: f64,
    /// Whether that is small enough to judge by.
    pub certified: bool,
    /// Whether plain f64 did not do.
    pub escalated: bool,
    pub outputs: Vec<Conditioned>,
    /// The relative change of the inputs that makes a miss of a hit or a hit of a miss; `null`: none does.
    pub margin: f64,
    /// Whether the record has the same truth to the last bit.
    pub as_recorded: bool,
}

/// How much one output depends on the inputs.
#[derive(Clone, Debug, Serialize)]
pub struct Conditioned {
    pub output: String,
    /// Errors beyond this are failures, in the output's own measure.
    pub tolerance: f64,
    /// Change of the exact value, absolute, for a relative change of every input by one; of a builtin the permitted error;
    /// `null` where the inputs do not define it.
    pub sensitivity: f64,
    /// An absolute error up to this is explained by rounding the inputs; of a builtin the permitted error.
    pub explained: f64,
}

/// A variant's outputs and what the judge says of them.
#[derive(Clone, Debug, Serialize)]
pub struct Told {
    pub outputs: Vec<Number>,
    pub verdict: Verdict,
    pub errors: Vec<f64>,
    pub ulps: Vec<f64>,
}

/// A variant and its outputs, or why there are none.
#[derive(Clone, Debug, Serialize)]
pub struct Teller {
    pub variant: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub told: Option<Told>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skipped: Option<String>,
}

impl Told {
    pub fn new(columns: &[String], answer: &Answer) -> Told {
        Told {
            outputs: Number::all(columns, &answer.outputs),
            verdict: answer.verdict,
            errors: answer.errors.clone(),
            ulps: answer.ulps.clone(),
        }
    }
}

impl Story {
    /// `answers` holds the failing variant's first.
    pub fn new(
        number: usize,
        recorded: &RecordedFailure,
        recorded_on: Option<String>,
        device: String,
        answers: &[(String, Result<Answer, String>)],
    ) -> Story {
        let (problem, failure) = (recorded.problem, &recorded.failure);
        let signature = problem.signature();
        let columns = signature.output_columns();
        let now = answers.first().and_then(|(_, answer)| answer.as_ref().ok());
        let teller = |(variant, answer): &(String, Result<Answer, String>)| Teller {
            variant: variant.clone(),
            told: answer.as_ref().ok().map(|answer| Told::new(&columns, answer)),
            skipped: answer.as_ref().err().cloned(),
        };
        Story {
            failure: number,
            family: problem.name().to_owned(),
            variant: recorded.variant.clone(),
            scenario: recorded.scenario.clone(),
            index: failure.index,
            recorded_on,
            device,
            inputs: Number::all(&signature.input_columns(), &failure.inputs),
            truth: Exact::new(recorded, &truth(problem, &failure.inputs)),
            recorded: Told::new(&columns, &Answer::from(failure)),
            variants: answers.iter().map(teller).collect(),
            fate: now.map(|now| Fate::of(failure.verdict, now.verdict)),
            same_bits: now.map(|now| now.same_bits(&failure.outputs)),
        }
    }
}

impl Exact {
    fn new(recorded: &RecordedFailure, truth: &Truth) -> Exact {
        use crate::family::Quantity;
        let problem = recorded.problem;
        let conditioned = |(output, sensitivity): (&crate::family::Output, &f64)| Conditioned {
            output: output.field.name.to_owned(),
            tolerance: output.tolerance,
            sensitivity: *sensitivity,
            explained: match output.quantity {
                Quantity::Builtin => *sensitivity,
                _ => EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF * sensitivity,
            },
        };
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
        Exact {
            columns: problem.signature().output_columns(),
            values: truth.values().to_vec(),
            bound: truth.worst_bound(),
            certified: truth.worst_bound() <= CERTIFIED,
            escalated: truth.escalated(),
            outputs: problem.outputs().iter().zip(truth.sensitivities()).map(conditioned).collect(),
            margin: truth.margin(),
            as_recorded: bits(truth.values()) == bits(&recorded.failure.truth),
        }
    }
}
