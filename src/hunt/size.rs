//! How bad a configuration is, on one scale for failures and for what comes near one.

use crate::audit::{Comparison, EXPLAINED_BY_ROUNDING, Judgement, Measure, Row};
use crate::family::{Output, Problem, Quantity};
use crate::numeric::spacing::UNIT_ROUNDOFF;

/// The size of what a variant is to blame for; 1 is the border between failing and not.
///
/// A failure's size is its largest error over the tolerance, of the outputs that fail; at least 1, as one whose relations
/// alone fail has, and infinite where there is no finite error, as for NaN or a missed hit. Without a failure the size is
/// how near one is: an output fails when its error exceeds both its tolerance and what rounding the inputs would explain, so
/// the lesser of these two shares counts; of a hit taken for a miss, the share of the margin that rounding explains.
/// An ill-conditioned error, however large, is thus below any failure: it is the problem's fault and worth no search.
pub(super) fn size(problem: &dyn Problem, row: Row<'_>, judgement: &Judgement) -> f64 {
    let outputs = || problem.outputs().iter().zip(judgement.measures());
    if judgement.verdict.is_failure() {
        let failing = outputs().filter(|(_, measure)| measure.verdict.is_failure());
        return failing.map(|(output, measure)| measure.error / output.tolerance).fold(1.0, f64::max);
    }
    let near = match judgement.comparison {
        Comparison::BothMiss => 0.0,
        Comparison::OneMisses => row.margin / (EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF),
        Comparison::Measured => outputs().map(|(output, measure)| share(output, measure)).fold(0.0, f64::max),
    };
    near.min(1.0)
}

/// How near an output is to failing.
fn share(output: &Output, measure: &Measure) -> f64 {
    let error = measure.error / output.tolerance;
    match output.quantity {
        // The permitted error takes the place of conditioning.
        Quantity::Builtin if measure.verdict == crate::audit::Verdict::Unspecified => 0.0,
        Quantity::Builtin => error,
        _ => error.min(measure.conditioned / EXPLAINED_BY_ROUNDING),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Verdict;
    use crate::catalog::{Field, Type};
    use crate::family::{Landmark, Scenario, Truth};

    /// A length of tolerance 1e-3; a negative one is a miss.
    struct Length;

    impl Problem for Length {
        fn name(&self) -> &'static str {
            "length"
        }

        fn summary(&self) -> &'static str {
            "a length"
        }

        fn inputs(&self) -> &'static [Field] {
            const { &[Field::new("x", Type::Float)] }
        }

        fn outputs(&self) -> &'static [Output] {
            const { &[Output::new("l", Type::Float, Quantity::Magnitude, 1e-3)] }
        }

        fn scenarios(&self) -> &'static [Scenario] {
            &[]
        }

        fn landmarks(&self) -> &'static [Landmark] {
            &[]
        }

        fn oracle(&self, _: &[f32], _: &mut Truth) {}

        fn is_miss(&self, values: &[f64]) -> bool {
            values[0] < 0.0
        }
    }

    /// Verdict and size of `value` where 1 is right; `explained` is what rounding the inputs may do.
    fn told(value: f32, explained: f64, margin: f64) -> (Verdict, f64) {
        let sensitivity = explained / (EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF);
        let row =
            Row { index: 0, inputs: &[1.0], truth: &[1.0], sensitivities: &[sensitivity], margin, bins: &[] };
        let judgement = Judgement::new(&Length, row, &[value]);
        (judgement.verdict, size(&Length, row, &judgement))
    }

    #[test]
    fn one_is_the_border() {
        let (verdict, size) = told(1.0005, 1e-6, 1.0);
        assert!(verdict == Verdict::Ok && (size - 0.5).abs() < 1e-3, "{size}");
        let (verdict, size) = told(1.5, 1.0, 1.0);
        assert!(verdict == Verdict::IllConditioned && (size - 0.5).abs() < 1e-3, "{size}");
        let (verdict, size) = told(1.5, 0.4, 1.0);
        assert!(verdict == Verdict::Inaccurate && (size - 500.0).abs() < 0.1, "{size}");
        assert_eq!(told(1.0, 1e-6, 1.0), (Verdict::Ok, 0.0));
    }

    #[test]
    fn no_finite_error_is_infinite() {
        assert_eq!(told(f32::NAN, 1.0, 1.0), (Verdict::NonFinite, f64::INFINITY));
        assert_eq!(told(-1.0, 1.0, 1.0), (Verdict::Missed, f64::INFINITY));
        let (verdict, size) = told(-1.0, 1.0, UNIT_ROUNDOFF);
        assert_eq!((verdict, size), (Verdict::IllConditioned, 1.0 / EXPLAINED_BY_ROUNDING));
    }
}
