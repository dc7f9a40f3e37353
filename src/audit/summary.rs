//! What an audit keeps of millions of comparisons. Everything in it merges by integer addition or by a maximum with a
//! fixed rule for ties, so that neither threads nor chunks nor their order show.

use serde::{Deserialize, Serialize};

use super::exact_bits;
use super::extremes::Extremes;
use super::failures::{Failure, Failures};
use super::judge::Measure;
use super::{Fingerprint, Histogram, Verdict, judge};
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

/// A row of the truth table beside which a variant's outputs are judged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'a> {
    pub index: u64,
    pub inputs: &'a [f32],
    pub truth: &'a [f64],
    pub sensitivities: &'a [f64],
    /// The relative change of the inputs that turns a hit into a miss or back.
    pub margin: f64,
    /// One bin a landmark.
    pub bins: &'a [u8],
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
        let outputs = problem.outputs();
        let values = &values[..row.truth.len()];
        let (mut errors, mut ulps) = ([0.0; MAX_OUTPUTS], [0.0; MAX_OUTPUTS]);
        let mut record = |position: usize, measure: &Measure| {
            (errors[position], ulps[position]) = (measure.error, measure.ulp);
        };
        let mut verdict = Verdict::Ok;
        let mut exact = [0.0; MAX_COMPONENTS];
        for (exact, value) in exact.iter_mut().zip(values) {
            *exact = f64::from(*value);
        }
        let exact = &exact[..values.len()];
        let finite = values.iter().all(|value| value.is_finite());
        let (missed, truth_missed) = (problem.is_miss(exact), problem.is_miss(row.truth));
        if let Some(class) = judge::miss(finite, missed, truth_missed, row.margin) {
            verdict = class;
            for (position, summary) in self.outputs.iter_mut().enumerate().filter(|_| class != Verdict::Ok) {
                let failed = Measure::failed(class);
                record(position, &failed);
                if finite {
                    summary.add_unmeasured();
                } else {
                    summary.add(&failed, outputs[position].tolerance, row.index);
                }
            }
        } else {
            let mut start = 0;
            let mut starts = [0; MAX_OUTPUTS];
            for (position, output) in outputs.iter().enumerate() {
                let components = start..start + output.field.ty.components();
                starts[position] = start;
                start = components.end;
                let sensitivity = row.sensitivities[position];
                let measure = match output.quantity {
                    Quantity::Property => {
                        let residual = problem.residual(position, row.inputs, exact);
                        judge::residual(output, residual, sensitivity)
                    }
                    _ => judge::measure(
                        output,
                        &values[components.clone()],
                        &row.truth[components.clone()],
                        sensitivity,
                    ),
                };
                verdict = verdict.max(measure.verdict);
                if output.quantity == Quantity::Builtin {
                    let (value, truth) = (&values[components.clone()], &row.truth[components]);
                    self.outputs[position].extremes.add(&measure, row, value, truth, sensitivity);
                    if measure.verdict == Verdict::Unspecified {
                        continue;
                    }
                }
                record(position, &measure);
                self.outputs[position].add(&measure, output.tolerance, row.index);
            }
            let components = |at: usize| starts[at]..starts[at] + outputs[at].field.ty.components();
            for relation in problem.relations() {
                verdict = verdict.max(judge::relate(
                    *relation,
                    outputs,
                    |output| &values[components(output)],
                    |output| &row.truth[components(output)],
                ));
            }
        }

        self.configurations += 1;
        self.bits.add(row.index, values);
        self.verdicts[verdict as usize] += 1;
        for (bins, bin) in self.landmarks.iter_mut().zip(row.bins) {
            let bin = &mut bins[usize::from(*bin)];
            bin.verdicts[verdict as usize] += 1;
            for ((beyond, error), output) in bin.beyond.iter_mut().zip(&errors).zip(outputs) {
                *beyond += u64::from(*error > output.tolerance);
            }
        }
        if verdict.is_failure() {
            self.failures.offer(row.index, || Failure {
                index: row.index,
                verdict,
                inputs: row.inputs.to_vec(),
                outputs: values.to_vec(),
                truth: row.truth.to_vec(),
                errors: errors[..outputs.len()].to_vec(),
                ulps: ulps[..outputs.len()].to_vec(),
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
