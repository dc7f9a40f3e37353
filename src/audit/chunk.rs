//! One chunk of a scenario: inputs and truth, a pure function of (family, scenario, seed, index range).

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::exact_bits;
use super::fingerprint::row_hash;
use super::judgement::Row;
use crate::family::{CERTIFIED, Problem, Scenario, Truth};
use crate::sample::Stream;

/// The most configurations of a chunk.
pub const MAX_CHUNK: usize = 1 << 20;

/// Rows drawn and judged by one task.
pub(super) const BLOCK: usize = 4096;

/// Inputs and truth of consecutive configurations.
#[derive(Debug)]
pub struct Chunk {
    first: u64,
    rows: usize,
    widths: Widths,
    /// Row-major.
    inputs: Vec<f32>,
    truth: Vec<f64>,
    sensitivities: Vec<f64>,
    margins: Vec<f64>,
    bins: Vec<u8>,
    /// What the oracle said of its own certainty.
    pub oracle: OracleSummary,
}

/// The oracle's certainty over many configurations; merges like everything else.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OracleSummary {
    pub configurations: u64,
    /// Plain f64 did not do.
    pub escalations: u64,
    /// Not certified even so: the bound is above 1/16 of the f32 spacing.
    pub uncertified: u64,
    /// Largest error bound in units of the f32 spacing.
    #[serde(with = "exact_bits")]
    pub worst_bound: f64,
}

#[derive(Clone, Copy, Debug)]
struct Widths {
    inputs: usize,
    truth: usize,
    sensitivities: usize,
    bins: usize,
}

impl Chunk {
    /// Draws the configurations `first .. first + rows` of a scenario and computes their truth.
    pub fn draw(problem: &dyn Problem, scenario: &Scenario, seed: u64, first: u64, rows: usize) -> Self {
        Chunk::of_inputs(problem, first, Chunk::draw_inputs(problem, scenario, seed, first, rows))
    }

    /// Only the inputs of [`draw`](Self::draw), row-major.
    pub fn draw_inputs(
        problem: &dyn Problem,
        scenario: &Scenario,
        seed: u64,
        first: u64,
        rows: usize,
    ) -> Vec<f32> {
        let stream = Stream::new(seed, &format!("{}/{}", problem.name(), scenario.name));
        let width: usize = problem.inputs().iter().map(|field| field.ty.components()).sum();
        let mut inputs = vec![0.0; rows * width];
        inputs.par_chunks_mut(BLOCK * width).enumerate().for_each(|(block, inputs)| {
            let count = inputs.len() / width;
            stream.visit(first + (block * BLOCK) as u64, count, |row, draw| {
                (scenario.draw)(draw, &mut inputs[row * width..][..width]);
            });
        });
        inputs
    }

    /// The truth of consecutive bit patterns of a family's one input column.
    pub fn of_bits(problem: &dyn Problem, first: u64, rows: usize) -> Self {
        let inputs = (first..first + rows as u64).map(|bits| f32::from_bits(bits as u32)).collect();
        Chunk::of_inputs(problem, first, inputs)
    }

    /// The truth of given inputs, row-major and what the oracle takes.
    pub fn of_inputs(problem: &dyn Problem, first: u64, inputs: Vec<f32>) -> Self {
        let signature = problem.signature();
        let widths = Widths {
            inputs: signature.input_columns().len(),
            truth: signature.output_columns().len(),
            sensitivities: problem.outputs().len(),
            bins: problem.landmarks().len(),
        };
        let rows = inputs.len() / widths.inputs;
        let mut truth = vec![0.0; rows * widths.truth];
        let mut sensitivities = vec![0.0; rows * widths.sensitivities];
        let mut margins = vec![0.0; rows];
        // Without landmarks there is one that nobody reads: nothing has no blocks, and what is zipped with it none either.
        let bin_width = widths.bins.max(1);
        let mut bins = vec![0; rows * bin_width];
        let oracle = inputs
            .par_chunks(BLOCK * widths.inputs)
            .zip(truth.par_chunks_mut(BLOCK * widths.truth))
            .zip(sensitivities.par_chunks_mut(BLOCK * widths.sensitivities))
            .zip(margins.par_chunks_mut(BLOCK))
            .zip(bins.par_chunks_mut(BLOCK * bin_width))
            .map(|((((inputs, truth), sensitivities), margins), bins)| {
                let mut oracle = OracleSummary::default();
                let mut scratch = Truth::new(problem.outputs());
                for (row, input) in inputs.chunks_exact(widths.inputs).enumerate() {
                    scratch.clear();
                    problem.oracle(input, &mut scratch);
                    oracle.add(&scratch);
                    truth[row * widths.truth..][..widths.truth].copy_from_slice(scratch.values());
                    sensitivities[row * widths.sensitivities..][..widths.sensitivities]
                        .copy_from_slice(scratch.sensitivities());
                    margins[row] = scratch.margin();
                    for (bin, landmark) in bins[row * widths.bins..].iter_mut().zip(problem.landmarks()) {
                        *bin = landmark.bin(input, &scratch) as u8;
                    }
                }
                oracle
            })
            .reduce(OracleSummary::default, OracleSummary::merged);
        Chunk { first, rows, widths, inputs, truth, sensitivities, margins, bins, oracle }
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Row-major inputs.
    pub fn inputs(&self) -> &[f32] {
        &self.inputs
    }

    /// A sum over hashes of (index, inputs), which merges by wrapping addition: equal sums, the same configurations.
    pub fn digest(&self) -> u64 {
        let row = |(row, input)| row_hash(self.first + row as u64, input);
        let rows = self.inputs.par_chunks_exact(self.widths.inputs).with_min_len(BLOCK).enumerate();
        rows.map(row).reduce(|| 0, u64::wrapping_add)
    }

    /// The exact components of one configuration, in column order.
    pub fn truth(&self, row: usize) -> &[f64] {
        &self.truth[row * self.widths.truth..][..self.widths.truth]
    }

    /// One configuration with its truth, to be judged.
    pub fn row(&self, row: usize) -> Row<'_> {
        let Widths { inputs, sensitivities, bins, .. } = self.widths;
        Row {
            index: self.first + row as u64,
            inputs: &self.inputs[row * inputs..][..inputs],
            truth: self.truth(row),
            sensitivities: &self.sensitivities[row * sensitivities..][..sensitivities],
            margin: self.margins[row],
            bins: &self.bins[row * bins..][..bins],
        }
    }
}

impl OracleSummary {
    fn add(&mut self, truth: &Truth) {
        self.configurations += 1;
        self.escalations += u64::from(truth.escalated());
        self.uncertified += u64::from(!(truth.worst_bound() <= CERTIFIED));
        self.worst_bound = self.worst_bound.max(truth.worst_bound());
    }

    /// The two parts together.
    #[must_use]
    pub fn merged(self, other: OracleSummary) -> OracleSummary {
        OracleSummary {
            configurations: self.configurations + other.configurations,
            escalations: self.escalations + other.escalations,
            uncertified: self.uncertified + other.uncertified,
            worst_bound: self.worst_bound.max(other.worst_bound),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{Field, Type};
    use crate::family::{Landmark, Output, Quantity};

    /// y = x, without landmarks.
    struct Plain;

    impl Problem for Plain {
        fn name(&self) -> &'static str {
            "plain"
        }

        fn summary(&self) -> &'static str {
            "its input"
        }

        fn inputs(&self) -> &'static [Field] {
            const { &[Field::new("x", Type::Float)] }
        }

        fn outputs(&self) -> &'static [Output] {
            const { &[Output::new("y", Type::Float, Quantity::Scalar, 1e-3)] }
        }

        fn scenarios(&self) -> &'static [Scenario] {
            &[]
        }

        fn landmarks(&self) -> &'static [Landmark] {
            &[]
        }

        fn oracle(&self, input: &[f32], truth: &mut Truth) {
            truth.scalar(0, f64::from(input[0]), 0.0, 1.0);
        }
    }

    #[test]
    fn a_family_without_landmarks_has_truths() {
        let rows = BLOCK + 3;
        let chunk = Chunk::of_bits(&Plain, 0x3f80_0000, rows);
        assert_eq!(chunk.oracle.configurations, rows as u64);
        for row in 0..rows {
            assert_eq!(chunk.truth(row), [f64::from(f32::from_bits(0x3f80_0000 + row as u32))]);
            assert!(chunk.row(row).bins.is_empty());
        }
    }
}
