//! The judge's word on one configuration: every output measured, relations checked, hits told from misses.

use super::Verdict;
use super::judge::{self, Measure};
use crate::family::{MAX_COMPONENTS, MAX_OUTPUTS, Problem, Quantity, Truth};

/// A row of the truth table beside which a variant's outputs are judged.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    pub index: u64,
    pub inputs: &'a [f32],
    /// All components in column order.
    pub truth: &'a [f64],
    /// One an output.
    pub sensitivities: &'a [f64],
    /// The relative change of the inputs that turns a hit into a miss or back.
    pub margin: f64,
    /// One bin a landmark.
    pub bins: &'a [u8],
}

/// What there was to compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// Results on both sides, or at least values that are not finite on the variant's.
    Measured,
    /// Truth and variant both say that there is no result.
    BothMiss,
    /// One of them does.
    OneMisses,
}

/// One configuration's verdict and what it rests on.
#[derive(Clone, Copy, Debug)]
pub struct Judgement {
    /// The gravest of all outputs and relations.
    pub verdict: Verdict,
    pub comparison: Comparison,
    measures: [Measure; MAX_OUTPUTS],
    outputs: usize,
}

impl Judgement {
    /// Judges `values`, all components in column order, beside `row`.
    ///
    /// A device may flush subnormal inputs to zero before the shader sees them. What is right for the flushed inputs, or
    /// as near as rounding them explains, is `ill_conditioned`, not the variant's fault.
    pub fn new(problem: &dyn Problem, row: Row<'_>, values: &[f32]) -> Judgement {
        let judgement = Judgement::beside(problem, row, values);
        // Promises of builtins say themselves what becomes of subnormals.
        let promised = problem.outputs().iter().any(|output| output.quantity == Quantity::Builtin);
        let blamed = judgement.verdict.is_failure() && judgement.verdict != Verdict::NonFinite;
        if promised || !blamed || !row.inputs.iter().any(|input| input.is_subnormal()) {
            return judgement;
        }
        let flushed: Vec<f32> =
            row.inputs.iter().map(|input| if input.is_subnormal() { 0.0 } else { *input }).collect();
        let mut truth = Truth::new(problem.outputs());
        problem.oracle(&flushed, &mut truth);
        let row = Row {
            inputs: &flushed,
            truth: truth.values(),
            sensitivities: truth.sensitivities(),
            margin: truth.margin(),
            ..row
        };
        if Judgement::beside(problem, row, values).verdict.is_failure() {
            judgement
        } else {
            judgement.excused()
        }
    }

    /// The same with every failure laid to the problem.
    fn excused(mut self) -> Judgement {
        let verdicts = self.measures.iter_mut().map(|measure| &mut measure.verdict);
        for verdict in verdicts.chain([&mut self.verdict]).filter(|verdict| verdict.is_failure()) {
            *verdict = Verdict::IllConditioned;
        }
        self
    }

    fn beside(problem: &dyn Problem, row: Row<'_>, values: &[f32]) -> Judgement {
        let outputs = problem.outputs();
        let mut exact = [0.0; MAX_COMPONENTS];
        for (exact, value) in exact.iter_mut().zip(values) {
            *exact = f64::from(*value);
        }
        let exact = &exact[..values.len()];
        let finite = values.iter().all(|value| value.is_finite());
        let (missed, truth_missed) = (problem.is_miss(exact), problem.is_miss(row.truth));
        let all = |verdict, comparison, measure| Judgement {
            verdict,
            comparison,
            measures: [measure; MAX_OUTPUTS],
            outputs: outputs.len(),
        };
        if let Some(class) = judge::miss(finite, missed, truth_missed, row.margin) {
            return match class {
                Verdict::Ok => all(class, Comparison::BothMiss, Measure::NONE),
                _ if finite => all(class, Comparison::OneMisses, Measure::failed(class)),
                _ => all(class, Comparison::Measured, Measure::failed(class)),
            };
        }
        let mut judgement = all(Verdict::Ok, Comparison::Measured, Measure::NONE);
        let mut start = 0;
        let mut starts = [0; MAX_OUTPUTS];
        for (position, output) in outputs.iter().enumerate() {
            let components = start..start + output.field.ty.components();
            starts[position] = start;
            start = components.end;
            let sensitivity = row.sensitivities[position];
            let measure = match output.quantity {
                Quantity::Property => {
                    judge::residual(output, problem.residual(position, row.inputs, exact), sensitivity)
                }
                _ => judge::measure(output, &values[components.clone()], &row.truth[components], sensitivity),
            };
            judgement.verdict = judgement.verdict.max(measure.verdict);
            judgement.measures[position] = measure;
        }
        let components = |at: usize| starts[at]..starts[at] + outputs[at].field.ty.components();
        for relation in problem.relations() {
            judgement.verdict = judgement.verdict.max(judge::relate(
                *relation,
                outputs,
                |output| &values[components(output)],
                |output| &row.truth[components(output)],
            ));
        }
        judgement
    }

    /// One an output; all of them without error where both sides miss, all of them failed where one does.
    pub fn measures(&self) -> &[Measure] {
        &self.measures[..self.outputs]
    }

    /// The outputs' errors, each in its quantity's own measure; 0 where the specification promises nothing.
    pub fn errors(&self) -> impl Iterator<Item = f64> {
        self.measures().iter().map(|measure| measure.promised(measure.error))
    }

    /// The outputs' distances from the unrounded truth in f32 spacings; 0 where the specification promises nothing.
    pub fn ulps(&self) -> impl Iterator<Item = f64> {
        self.measures().iter().map(|measure| measure.promised(measure.ulp))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{Field, Type};
    use crate::family::{Landmark, Output, Relation, Scenario};

    /// A ray's parameter and direction; a negative parameter is a miss.
    struct Ray;

    impl Problem for Ray {
        fn name(&self) -> &'static str {
            "ray"
        }

        fn summary(&self) -> &'static str {
            "a ray"
        }

        fn inputs(&self) -> &'static [Field] {
            const { &[Field::new("x", Type::Float)] }
        }

        fn outputs(&self) -> &'static [Output] {
            const {
                &[
                    Output::new("t", Type::Float, Quantity::Scalar, 1e-3),
                    Output::new("u", Type::Vec3, Quantity::UnitVector { sign_free: true }, 1e-3),
                    Output::new("v", Type::Vec3, Quantity::UnitVector { sign_free: true }, 1e-3),
                ]
            }
        }

        fn relations(&self) -> &'static [Relation] {
            &[Relation::Orthogonal(1, 2)]
        }

        fn scenarios(&self) -> &'static [Scenario] {
            &[]
        }

        fn landmarks(&self) -> &'static [Landmark] {
            &[]
        }

        /// 2, or 1 where x is 0.
        fn oracle(&self, input: &[f32], truth: &mut Truth) {
            truth.scalar(0, if input[0] == 0.0 { 1.0 } else { 2.0 }, 0.0, 1.0);
            truth.unit_vector(1, glam::DVec3::X, 0.0, 1.0);
            truth.unit_vector(2, glam::DVec3::Y, 0.0, 1.0);
        }

        fn is_miss(&self, values: &[f64]) -> bool {
            values[0] < 0.0
        }
    }

    const HIT: [f64; 7] = [2.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    const MISS: [f64; 7] = [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];

    fn row(truth: &[f64; 7]) -> Row<'_> {
        Row { index: 0, inputs: &[0.0], truth, sensitivities: &[1.0; 3], margin: 1.0, bins: &[] }
    }

    fn judge(truth: &[f64; 7], values: [f32; 7]) -> Judgement {
        Judgement::new(&Ray, row(truth), &values)
    }

    fn values(truth: &[f64; 7]) -> [f32; 7] {
        truth.map(|value| value as f32)
    }

    #[test]
    fn the_gravest_counts() {
        let mut off = values(&HIT);
        off[0] = 2.1;
        let judgement = judge(&HIT, off);
        assert_eq!((judgement.verdict, judgement.comparison), (Verdict::Inaccurate, Comparison::Measured));
        let errors: Vec<f64> = judgement.errors().collect();
        assert!((errors[0] - 0.05).abs() < 1e-6 && errors[1..] == [0.0, 0.0], "{errors:?}");
        off[6] = f32::NAN;
        let judgement = judge(&HIT, off);
        assert_eq!(judgement.verdict, Verdict::NonFinite);
        assert_eq!(judgement.errors().nth(2), Some(f64::INFINITY));
        assert_eq!(judgement.measures()[0].verdict, Verdict::Inaccurate);
    }

    #[test]
    fn relations_are_checked_beside_the_outputs() {
        // Each within its tolerance of 1e-3, and 1.6e-3 from orthogonal.
        let judgement = judge(&HIT, [2.0, 1.0, 0.0008, 0.0, 0.0008, 1.0, 0.0]);
        assert!(judgement.measures().iter().all(|measure| measure.verdict == Verdict::Ok));
        assert_eq!(judgement.verdict, Verdict::NotOrthogonal);
    }

    #[test]
    fn what_flushing_explains_is_excused() {
        let mut of_flushed = values(&HIT);
        of_flushed[0] = 1.0;
        let judged = |x: f32, values: [f32; 7]| {
            let row = Row { inputs: &[x], ..row(&HIT) };
            Judgement::new(&Ray, row, &values)
        };
        assert_eq!(judged(1e-40, values(&HIT)).verdict, Verdict::Ok);
        let excused = judged(1e-40, of_flushed);
        assert_eq!(excused.verdict, Verdict::IllConditioned);
        assert_eq!(excused.measures()[0].verdict, Verdict::IllConditioned);
        // A normal input is not flushed, and neither answer is right.
        assert_eq!(judged(1e-30, of_flushed).verdict, Verdict::Inaccurate);
        let mut neither = of_flushed;
        neither[0] = 1.5;
        assert_eq!(judged(1e-40, neither).verdict, Verdict::Inaccurate);
        of_flushed[6] = f32::NAN;
        assert_eq!(judged(1e-40, of_flushed).verdict, Verdict::NonFinite);
    }

    #[test]
    fn misses_are_classes() {
        let (hit, miss) = (values(&HIT), values(&MISS));
        let both = judge(&MISS, miss);
        assert_eq!((both.verdict, both.comparison), (Verdict::Ok, Comparison::BothMiss));
        assert!(both.errors().all(|error| error == 0.0));
        for one in [judge(&MISS, hit), judge(&HIT, miss)] {
            assert_eq!((one.verdict, one.comparison), (Verdict::Missed, Comparison::OneMisses));
            assert!(one.errors().all(|error| error == f64::INFINITY));
        }
        let broken = judge(&MISS, [f32::NAN; 7]);
        assert_eq!((broken.verdict, broken.comparison), (Verdict::NonFinite, Comparison::Measured));
    }
}
