//! What an audit keeps of millions of comparisons. Everything in it merges by integer addition or by a maximum with a
//! fixed rule for ties, so that neither threads nor chunks nor their order show.

use serde::{Deserialize, Serialize};

use super::exact_bits;
use super::extremes::Extremes;
use super::failures::{Failure, Failures};
use super::judge::Measure;
use super::judgement::{Comparison, Judgement, Row};
use super::{Fingerprint, Histogram, Verdict};
use crate::family::{MAX_COMPONENTS, MAX_OUTPUTS, Problem, Quantity};

/// One variant on one scenario.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Summary {
    pub configurations: u64,
    /// By position in [`Verdict::ALL`].
    pub verdicts: [u64; Verdict::ALL.len()],
    pub outputs: Vec<OutputSummary>,
    /// One a landmark coordinate, one a bin.
    pub landmarks: Vec<Vec<Bin>>,
    pub failures: Failures,
    /// Of all outputs.
    pub bits: Fingerprint,
}

/// One output of one variant on one scenario.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct OutputSummary {
    /// Configurations whose error is beyond the output's tolerance, not finite, or not to be had because only one of truth
    /// and variant is a miss; whoever is to blame.
    pub beyond: u64,
    /// Configurations whose error is at least one step of 8 bits, of 10 bits, of binary16.
    pub visible: [u64; 3],
    /// This and the others: of the configurations where neither truth nor variant is a miss.
    pub error: Histogram,
    pub ulp: Histogram,
    pub conditioned: Histogram,
    pub worst: Worst,
    /// Only of builtins.
    pub extremes: Extremes,
}

/// The worst finite error and its configuration; the smallest index among equals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    #[serde(with = "exact_bits")]
    pub found: Option<(f64, u64)>,
    #[serde(with = "exact_bits")]
    pub ulp: f64,
}

/// What happened in one bin of a landmark coordinate.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bin {
    pub verdicts: [u64; Verdict::ALL.len()],
    /// One an output, as [`OutputSummary::beyond`].
    pub beyond: [u64; MAX_OUTPUTS],
}

impl Worst {
    fn offer(&mut self, error: f64, ulp: f64, index: u64) {
        let better = match self.found {
            None => true,
            Some((worst, at)) => error > worst || (error == worst && index < at),
        };
        if better {
            self.found = Some((error, index));
        }
        self.ulp = self.ulp.max(ulp);
    }
}

impl Summary {
    pub fn new(problem: &dyn Problem, max_failures: usize) -> Self {
        let bin = Bin { verdicts: [0; Verdict::ALL.len()], beyond: [0; MAX_OUTPUTS] };
        Summary {
            configurations: 0,
            verdicts: [0; Verdict::ALL.len()],
            outputs: vec![OutputSummary::default(); problem.outputs().len()],
            landmarks: problem.landmarks().iter().map(|l| vec![bin.clone(); l.edges.len() + 1]).collect(),
            failures: Failures::new(max_failures),
            bits: Fingerprint::default(),
        }
    }

    /// Judges one configuration's outputs, given as all components in column order.
    pub(super) fn judge(&mut self, problem: &dyn Problem, row: Row<'_>, values: &[f32; MAX_COMPONENTS]) {
        let values = &values[..row.truth.len()];
        let judgement = Judgement::new(problem, row, values);
        self.add(problem, row, values, &judgement);
    }

    fn add(&mut self, problem: &dyn Problem, row: Row<'_>, values: &[f32], judgement: &Judgement) {
        let (outputs, verdict) = (problem.outputs(), judgement.verdict);
        match judgement.comparison {
            Comparison::BothMiss => {}
            Comparison::OneMisses => self.outputs.iter_mut().for_each(OutputSummary::add_unmeasured),
            Comparison::Measured => {
                let mut start = 0;
                for (position, (output, measure)) in outputs.iter().zip(judgement.measures()).enumerate() {
                    let components = start..start + output.field.ty.components();
                    start = components.end;
                    let summary = &mut self.outputs[position];
                    if output.quantity == Quantity::Builtin {
                        let (value, truth) = (&values[components.clone()], &row.truth[components]);
                        summary.extremes.add(measure, row, value, truth, row.sensitivities[position]);
                    }
                    if measure.verdict != Verdict::Unspecified {
                        summary.add(measure, output.tolerance, row.index);
                    }
                }
            }
        }
        self.configurations += 1;
        self.bits.add(row.index, values);
        self.verdicts[verdict as usize] += 1;
        for (bins, bin) in self.landmarks.iter_mut().zip(row.bins) {
            let bin = &mut bins[usize::from(*bin)];
            bin.verdicts[verdict as usize] += 1;
            for ((beyond, error), output) in bin.beyond.iter_mut().zip(judgement.errors()).zip(outputs) {
                *beyond += u64::from(error > output.tolerance);
            }
        }
        if verdict.is_failure() {
            self.failures.offer(row.index, || Failure {
                index: row.index,
                verdict,
                inputs: row.inputs.to_vec(),
                outputs: values.to_vec(),
                truth: row.truth.to_vec(),
                errors: judgement.errors().collect(),
                ulps: judgement.ulps().collect(),
            });
        }
    }

    /// Adds another part of the same variant and scenario.
    pub fn merge(&mut self, other: Summary) {
        self.configurations += other.configurations;
        add(&mut self.verdicts, &other.verdicts);
        for (mine, theirs) in self.outputs.iter_mut().zip(&other.outputs) {
            mine.merge(theirs);
        }
        for (mine, theirs) in self.landmarks.iter_mut().flatten().zip(other.landmarks.iter().flatten()) {
            add(&mut mine.verdicts, &theirs.verdicts);
            add(&mut mine.beyond, &theirs.beyond);
        }
        self.failures.merge(other.failures);
        self.bits.merge(&other.bits);
    }

    /// Configurations with this verdict.
    pub fn count(&self, verdict: Verdict) -> u64 {
        self.verdicts[verdict as usize]
    }

    /// Configurations that failed by the variant's fault.
    pub fn failed(&self) -> u64 {
        Verdict::ALL.iter().filter(|verdict| verdict.is_failure()).map(|verdict| self.count(*verdict)).sum()
    }
}

impl OutputSummary {
    fn add(&mut self, measure: &Measure, tolerance: f64, index: u64) {
        self.beyond += u64::from(measure.error > tolerance);
        for (count, steps) in self.visible.iter_mut().zip(measure.steps) {
            *count += u64::from(steps >= 1.0);
        }
        self.error.add(measure.error);
        self.ulp.add(measure.ulp);
        self.conditioned.add(measure.conditioned);
        if measure.error.is_finite() {
            self.worst.offer(measure.error, measure.ulp, index);
        }
    }

    /// Counts a miss for a hit or a hit for a miss: beyond any tolerance, and surely seen.
    fn add_unmeasured(&mut self) {
        self.beyond += 1;
        for count in &mut self.visible {
            *count += 1;
        }
    }

    fn merge(&mut self, other: &OutputSummary) {
        self.beyond += other.beyond;
        add(&mut self.visible, &other.visible);
        self.error.merge(&other.error);
        self.ulp.merge(&other.ulp);
        self.conditioned.merge(&other.conditioned);
        self.extremes.merge(&other.extremes);
        if let Some((error, index)) = other.worst.found {
            self.worst.offer(error, other.worst.ulp, index);
        }
    }
}

fn add(counts: &mut [u64], more: &[u64]) {
    for (count, more) in counts.iter_mut().zip(more) {
        *count += more;
    }
}
