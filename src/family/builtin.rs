//! What the families of the device's own instructions share: `sin`, `pow`, `normalize` and the like, each with the variant
//! `native` that calls it and published approximations beside it.
//!
//! Truth is the exact result for the exact f32 inputs, in f64. The functions of the `libm` crate (ports of FreeBSD's msun
//! and of ARM's optimized routines, by way of musl) state errors below 1 ULP of f64 each, arguments reduced with as many
//! bits of pi as they need; the truths here take three roundings more at most. [`BOUND`] is 4 ULP, a millionth of an f32
//! spacing, so plain f64 always does. Golden values in 50 digits, the system's own library and the reciprocal identities
//! check that bound.
//!
//! The tolerance is the specification's: see [`vulkan_limits`](crate::numeric::vulkan_limits). Where a subnormal input may
//! be flushed to zero and that would move the result by more than the limit, as for infinite inputs and NaN, nothing is
//! promised.

use super::problem::{Landmark, Output, Problem, Quantity, Scenario, Truth};
use crate::catalog::{Field, Signature, Type};
use crate::numeric::vulkan_limits::Interval;
use crate::sample::{Draw, landmarks};

/// Relative error bound of every truth: 4 ULP of f64.
const BOUND: f64 = 4.0 * f64::EPSILON;

/// The exact result for some inputs, and the interval that the specification permits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promise {
    value: [f64; 3],
    limit: f64,
}

impl Promise {
    /// A scalar. A value that is NaN has no promise.
    pub(super) fn scalar(value: f64, permitted: Interval) -> Self {
        // Beyond f64 a value only has to be beyond f32.
        let value = value.clamp(-f64::MAX, f64::MAX);
        // An exact result leaves no error to permit, and an error's share of none has no size.
        Promise { value: [value, 0.0, 0.0], limit: permitted.reach(value).max(f64::MIN_POSITIVE) }
    }

    /// A vector and the permitted length of its error.
    pub(super) fn vector(value: [f64; 3], limit: f64) -> Self {
        Promise { value, limit }
    }
}

/// The family of one instruction.
pub(super) struct Builtin {
    /// The instruction's name in GLSL.
    pub(super) name: &'static str,
    /// The variants' function: a name of its own, since GLSL's would hide the instruction.
    pub(super) function: &'static str,
    pub(super) summary: &'static str,
    pub(super) inputs: &'static [Field],
    /// One only.
    pub(super) outputs: &'static [Output],
    pub(super) scenarios: &'static [Scenario],
    pub(super) landmarks: &'static [Landmark],
    /// For finite inputs.
    pub(super) promise: fn(&[f64]) -> Promise,
}

/// The input of a function of one variable.
pub(super) const X: &[Field] = &[Field::new("x", Type::Float)];
/// Its result.
pub(super) const Y: &[Output] = &[Output::new("y", Type::Float, Quantity::Builtin, 1.0).headline()];
/// The result of a function of several variables.
pub(super) const R: &[Output] = &[Output::new("r", Type::Float, Quantity::Builtin, 1.0).headline()];
/// A vector's.
pub(super) const VECTOR: &[Output] = &[Output::new("n", Type::Vec3, Quantity::Builtin, 1.0).headline()];

/// Where on the axis of the first input.
pub(super) const AXIS: &[Landmark] = &[Landmark {
    name: "x",
    summary: "the first input",
    edges: &[
        -1e20,
        -1e4,
        -std::f64::consts::PI,
        -1.0,
        -1e-4,
        -SMALLEST_NORMAL,
        0.0,
        SMALLEST_NORMAL,
        1e-4,
        0.5,
        1.0,
        2.0,
        std::f64::consts::PI,
        1e4,
        1e20,
    ],
    coordinate: |input, _| f64::from(input[0]),
}];

const SMALLEST_NORMAL: f64 = f32::MIN_POSITIVE as f64;
/// More components than any of these families has.
const MAX_INPUTS: usize = 4;

impl Problem for Builtin {
    fn name(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        self.summary
    }

    fn inputs(&self) -> &'static [Field] {
        self.inputs
    }

    fn outputs(&self) -> &'static [Output] {
        self.outputs
    }

    fn scenarios(&self) -> &'static [Scenario] {
        self.scenarios
    }

    fn landmarks(&self) -> &'static [Landmark] {
        self.landmarks
    }

    fn signature(&self) -> Signature {
        Signature {
            function: self.function,
            parameters: self.inputs.to_vec(),
            results: self.outputs.iter().map(|output| output.field).collect(),
        }
    }

    fn takes_all_bits(&self) -> bool {
        matches!(self.inputs, [Field { ty: Type::Float, .. }])
    }

    fn oracle(&self, input: &[f32], truth: &mut Truth) {
        let components = self.outputs[0].field.ty.components();
        if !input.iter().all(|value| value.is_finite()) {
            truth.builtin(0, &[f64::NAN; 3][..components], 0.0, f64::INFINITY);
            return;
        }
        let mut exact = [0.0; MAX_INPUTS];
        for (exact, value) in exact.iter_mut().zip(input) {
            *exact = f64::from(*value);
        }
        let exact = &exact[..input.len()];
        let Promise { value, mut limit } = (self.promise)(exact);
        if limit.is_finite() && input.iter().any(|value| value.is_subnormal()) {
            limit = self.limit_with_flushing(exact, &value, limit);
        }
        let largest = value[..components].iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
        let bound = if limit.is_finite() || largest.is_finite() { BOUND * largest } else { 0.0 };
        truth.builtin(0, &value[..components], bound, limit);
    }
}

impl Builtin {
    /// The limit where any of the subnormal inputs may be flushed: infinite if that moves the result by more than `limit`,
    /// else what the flushed inputs permit besides.
    fn limit_with_flushing(&self, exact: &[f64], value: &[f64; 3], limit: f64) -> f64 {
        let subnormal = |value: f64| value != 0.0 && value.abs() < SMALLEST_NORMAL;
        let flushed = |flush: u32| {
            let mut inputs = [0.0; MAX_INPUTS];
            for (at, (slot, value)) in inputs.iter_mut().zip(exact).enumerate() {
                *slot = if flush >> at & 1 == 1 && subnormal(*value) { 0.0 * value } else { *value };
            }
            let flushed = (self.promise)(&inputs[..exact.len()]);
            let distance = flushed.value.iter().zip(value).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            if distance <= limit { distance + flushed.limit } else { f64::INFINITY }
        };
        (1..1 << exact.len()).map(flushed).fold(limit, f64::max)
    }
}

/// Any finite f32, all bit patterns alike: half the exponents below 0, all magnitudes as often.
pub(super) fn any(draw: &mut Draw) -> f32 {
    let bits = draw.word();
    let value = f32::from_bits(bits);
    // The exponent of infinity and NaN becomes that of the binade of 1.
    if value.is_finite() { value } else { f32::from_bits(bits ^ 0x4000_0000) }
}

/// One of `ends` or of the general landmarks, of either sign, or one of the hundred neighbours either side.
pub(super) fn near(draw: &mut Draw, ends: &[f32]) -> f32 {
    let pick = draw.below(2);
    let general = landmarks::near_landmark(draw);
    let offset = i64::from(draw.below(2 * landmarks::NEIGHBOURS + 1)) - i64::from(landmarks::NEIGHBOURS);
    let end = draw.pick(ends);
    let sign = draw.sign() as f32;
    if pick == 0 { general } else { sign * landmarks::neighbour(end, offset) }
}

/// Of either sign, its magnitude log-uniform within `exponent` powers of two either side of 1.
pub(super) fn spread_exponents(draw: &mut Draw, exponent: f64) -> f32 {
    (draw.sign() * libm::exp2(draw.uniform(-exponent, exponent))) as f32
}

/// Uniform in `low..high` or, as often, of either sign with a log-uniform magnitude up to the larger end.
pub(super) fn spread(draw: &mut Draw, low: f64, high: f64) -> f32 {
    let uniform = draw.uniform(low, high);
    let largest = high.abs().max(low.abs());
    let magnitude = draw.sign() * draw.log_uniform(largest * 1e-12, largest);
    let log = if low < 0.0 { magnitude } else { magnitude.abs().max(low) };
    (if draw.below(2) == 0 { uniform } else { log.clamp(low, high) }) as f32
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::family::{CERTIFIED, FAMILIES};
    use crate::sample::Stream;

    pub(in crate::family) fn truth_of(problem: &dyn Problem, input: &[f32]) -> Truth {
        let mut truth = Truth::new(problem.outputs());
        problem.oracle(input, &mut truth);
        truth
    }

    fn each(problem: &dyn Problem, count: usize, mut visit: impl FnMut(&[f32], &Truth)) {
        let width: usize = problem.inputs().iter().map(|field| field.ty.components()).sum();
        for scenario in problem.scenarios() {
            Stream::new(11, scenario.name).visit(0, count, |_, draw| {
                let mut row = [0.0; MAX_INPUTS];
                (scenario.draw)(draw, &mut row[..width]);
                assert!(row.iter().all(|value| value.is_finite()), "{}: {row:?}", scenario.name);
                visit(&row[..width], &truth_of(problem, &row[..width]));
            });
        }
    }

    /// The truth, of a vector its first component, is that of another library, within the bounds of both.
    pub(in crate::family) fn agrees_with(problem: &dyn Problem, function: fn(&[f64]) -> f64) {
        each(problem, 20_000, |row, truth| {
            let exact: Vec<f64> = row.iter().map(|value| f64::from(*value)).collect();
            let (ours, theirs) = (truth.output(0)[0], function(&exact).clamp(-f64::MAX, f64::MAX));
            let same = (ours - theirs).abs() <= 2.0 * BOUND * theirs.abs();
            assert!(same || (ours.is_nan() && theirs.is_nan()), "{row:?}: {ours:e} {theirs:e}");
        });
    }

    fn builtins() -> impl Iterator<Item = &'static dyn Problem> {
        FAMILIES.iter().copied().filter(|family| family.outputs()[0].quantity == Quantity::Builtin)
    }

    #[test]
    fn every_truth_is_certified_and_every_family_makes_promises() {
        for problem in builtins() {
            let (mut promised, mut all) = (0u32, 0u32);
            each(problem, 10_000, |row, truth| {
                assert!(truth.worst_bound() <= CERTIFIED && !truth.escalated(), "{row:?}: {truth:?}");
                let limit = truth.sensitivities()[0];
                assert!(limit > 0.0, "{row:?}: {truth:?}");
                assert!(limit.is_infinite() || truth.values().iter().all(|v| v.is_finite()), "{row:?}");
                promised += u32::from(limit.is_finite());
                all += 1;
            });
            assert!(promised > all / 4, "{}: {promised} of {all}", problem.name());
        }
    }

    #[test]
    fn all_bits_have_an_answer() {
        for problem in builtins().filter(|problem| problem.takes_all_bits()) {
            for bits in (0..u32::MAX).step_by(65_521).chain([0x7f80_0000, 0xff80_0000, 0x7fc0_0000]) {
                let truth = truth_of(problem, &[f32::from_bits(bits)]);
                assert!(truth.worst_bound() <= CERTIFIED, "{}: {bits:#x} {truth:?}", problem.name());
                if !f32::from_bits(bits).is_finite() {
                    assert!(truth.sensitivities()[0].is_infinite(), "{}: {bits:#x}", problem.name());
                }
            }
        }
    }

    #[test]
    fn draws_stay_where_they_should() {
        Stream::new(1, "builtin").visit(0, 20_000, |_, draw| {
            assert!(any(draw).is_finite());
            assert!(near(draw, &[f32::MAX, 3.0]).is_finite());
            assert!((-2.0..=1.0).contains(&spread(draw, -2.0, 1.0)));
            assert!((0.0..=5.0).contains(&spread(draw, 0.0, 5.0)));
        });
    }
}
