//! Given configurations on an open device, judged one by one.

use rayon::prelude::*;
use serde::Serialize;

use crate::audit::{Failure, Judgement, MAX_CHUNK, Row, Verdict};
use crate::device::{Device, Error, Outputs};
use crate::family::{Problem, Truth};

/// What a variant gave for one configuration, and the judge's word on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// All components in column order.
    pub outputs: Vec<f32>,
    pub verdict: Verdict,
    /// One an output, in the quantity's own measure; infinite where there is nothing to measure.
    pub errors: Vec<f64>,
    /// One an output, in f32 spacings.
    pub ulps: Vec<f64>,
}

impl Answer {
    /// Judges `outputs` beside the truth for `inputs`.
    pub fn judged(problem: &dyn Problem, inputs: &[f32], truth: &Truth, outputs: Vec<f32>) -> Answer {
        let row = Row {
            index: 0,
            inputs,
            truth: truth.values(),
            sensitivities: truth.sensitivities(),
            margin: truth.margin(),
            bins: &[],
        };
        let judgement = Judgement::new(problem, row, &outputs);
        Answer {
            verdict: judgement.verdict,
            errors: judgement.errors().collect(),
            ulps: judgement.ulps().collect(),
            outputs,
        }
    }

    /// Whether the outputs are these to the last bit.
    pub fn same_bits(&self, outputs: &[f32]) -> bool {
        let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<u32>>();
        bits(&self.outputs) == bits(outputs)
    }
}

impl From<&Failure> for Answer {
    fn from(failure: &Failure) -> Self {
        Answer {
            outputs: failure.outputs.clone(),
            verdict: failure.verdict,
            errors: failure.errors.clone(),
            ulps: failure.ulps.clone(),
        }
    }
}

/// The exact result for one configuration.
pub fn truth(problem: &dyn Problem, inputs: &[f32]) -> Truth {
    let mut truth = Truth::new(problem.outputs());
    problem.oracle(inputs, &mut truth);
    truth
}

/// Evaluates every configuration of `inputs` (row-major), any number of them, and judges it.
pub fn evaluate<D: Device>(
    device: &D,
    program: &D::Program,
    problem: &dyn Problem,
    inputs: &[f32],
) -> Result<Vec<Answer>, Error> {
    let signature = problem.signature();
    let (width, columns) = (signature.input_columns().len(), signature.output_columns().len());
    let batch = device.max_rows(width, columns).min(MAX_CHUNK);
    let mut answers = Vec::with_capacity(inputs.len() / width);
    for batch in inputs.chunks(batch * width) {
        let uploaded = device.upload(batch, width)?;
        let outputs = device.wait(device.submit(program, &uploaded)?)?;
        let outputs: Vec<&[f32]> = (0..columns).map(|column| outputs.column(column)).collect();
        let judged = batch.par_chunks(width).enumerate().map(|(row, inputs)| {
            let values = outputs.iter().map(|column| column[row]).collect();
            Answer::judged(problem, inputs, &truth(problem, inputs), values)
        });
        answers.extend(judged.collect::<Vec<Answer>>());
    }
    Ok(answers)
}

/// A number as scripts want it: in decimal where JSON has one, and exactly.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    pub column: String,
    /// `null` if it is not finite.
    pub value: f32,
    pub hex: String,
    pub bits: String,
}

impl Number {
    /// Values under their columns' names.
    pub fn all(columns: &[String], values: &[f32]) -> Vec<Number> {
        let number = |(column, value): (&String, &f32)| Number {
            column: column.clone(),
            value: *value,
            hex: crate::record::hex_f32(*value),
            bits: format!("0x{:08x}", value.to_bits()),
        };
        columns.iter().zip(values).map(number).collect()
    }
}
