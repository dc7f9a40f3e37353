//! A minimized configuration beside the one that it was.

use serde::Serialize;

use super::evaluate::{Answer, Number, truth};
use super::minimize::{Kept, Minimized};
use super::story::Told;
use crate::family::Problem;

/// Before and after.
#[derive(Clone, Debug, Serialize)]
pub struct Shrunk {
    pub family: String,
    pub variant: String,
    /// Device and driver.
    pub device: String,
    pub steps: usize,
    pub evaluations: u64,
    pub before: Side,
    pub after: Side,
    /// One an input column: what became of simpler values.
    pub kept: Vec<Kept>,
    /// The family's outputs by name, as errors are.
    pub outputs: Vec<String>,
}

/// One configuration and what came of it.
#[derive(Clone, Debug, Serialize)]
pub struct Side {
    /// Of reading it.
    pub cost: u64,
    pub inputs: Vec<Number>,
    pub truth: Vec<f64>,
    pub told: Told,
}

impl Shrunk {
    /// From inputs and answers before and after.
    pub fn new(
        problem: &dyn Problem,
        variant: &str,
        device: String,
        (inputs, before): (&[f32], &Answer),
        (found, after): (&Minimized, &Answer),
    ) -> Shrunk {
        let signature = problem.signature();
        let columns = signature.output_columns();
        let side = |inputs: &[f32], answer: &Answer| Side {
            cost: super::cost(inputs),
            inputs: Number::all(&signature.input_columns(), inputs),
            truth: truth(problem, inputs).values().to_vec(),
            told: Told::new(&columns, answer),
        };
        Shrunk {
            family: problem.name().to_owned(),
            variant: variant.to_owned(),
            device,
            steps: found.costs.len() - 1,
            evaluations: found.evaluations,
            before: side(inputs, before),
            after: side(&found.values, after),
            kept: found.kept.clone(),
            outputs: problem.outputs().iter().map(|output| output.field.name.to_owned()).collect(),
        }
    }
}
