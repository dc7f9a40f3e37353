//! Compares one result with the truth, by what the result is.

use glam::DVec3;

use super::Verdict;
use crate::family::{Output, Quantity, Relation};
use crate::numeric::spacing::{UNIT_ROUNDOFF, f16_spacing, f32_spacing};

/// An error up to this many times what one rounding of each input does is blamed on the problem: an algorithm that is
/// backward stable commits a handful of such roundings on its way.
pub const EXPLAINED_BY_ROUNDING: f64 = 4.0;

/// A device may flush subnormals to zero: an error of up to the smallest normal number is free.
const FLUSH: f64 = f32::MIN_POSITIVE as f64;

/// The error of one output of one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    pub verdict: Verdict,
    /// In the quantity's own measure: relative for a length, radians for a direction. Infinite if not finite.
    pub error: f64,
    /// Distance from the unrounded truth in units of the f32 spacing there; for a direction in units of 2^-24 rad.
    pub ulp: f64,
    /// The error over what rounding every input once (relative 2^-24) would do at most.
    pub conditioned: f64,
    /// Steps of a display or frame buffer: of 8 bits, of 10 bits, of binary16.
    pub steps: [f64; 3],
}

impl Measure {
    /// No error.
    pub(super) const NONE: Measure =
        Measure { verdict: Verdict::Ok, error: 0.0, ulp: 0.0, conditioned: 0.0, steps: [0.0; 3] };

    /// `size`, but 0 where the specification promises nothing.
    pub(super) fn promised(&self, size: f64) -> f64 {
        if self.verdict == Verdict::Unspecified { 0.0 } else { size }
    }

    pub(super) fn failed(verdict: Verdict) -> Self {
        let worst = f64::INFINITY;
        Measure { verdict, error: worst, ulp: worst, conditioned: worst, steps: [worst; 3] }
    }

    /// From an error in the quantity's own measure, the same in absolute terms, and the spacings there.
    fn graded(error: f64, absolute: f64, spacings: [f64; 2], output: &Output, sensitivity: f64) -> Self {
        let explained = UNIT_ROUNDOFF * sensitivity;
        let verdict = if error <= output.tolerance {
            Verdict::Ok
        } else if absolute <= EXPLAINED_BY_ROUNDING * explained {
            Verdict::IllConditioned
        } else {
            Verdict::Inaccurate
        };
        let conditioned = if absolute == 0.0 { 0.0 } else { absolute / explained };
        let [f32_step, f16_step] = spacings;
        let steps = [255.0 * error, 1023.0 * error, absolute / f16_step];
        Measure { verdict, error, ulp: absolute / f32_step, conditioned, steps }
    }
}

/// Judges one output: its components `values` against the exact `truth`.
///
/// `sensitivity` is the oracle's: the change of the truth for a relative change of every input by one; for a builtin
/// the permitted error.
///
/// # Panics
/// Given a property, which is judged by its residual and not by its distance from one truth.
pub fn measure(output: &Output, values: &[f32], truth: &[f64], sensitivity: f64) -> Measure {
    match output.quantity {
        Quantity::Magnitude | Quantity::Scalar => relative(output, values[0], truth[0], sensitivity),
        Quantity::Irradiance => irradiance(output, values[0], truth[0], sensitivity),
        Quantity::VectorIrradiance => {
            let value = vector(values);
            vector_irradiance(output, value, DVec3::from_slice(truth), sensitivity)
        }
        Quantity::Coordinate => coordinate(output, values[0], truth[0], sensitivity),
        Quantity::SolidAngle => solid_angle(output, values[0], truth[0], sensitivity),
        Quantity::Vector { sign_free } => {
            sized_vector(output, sign_free, vector(values), DVec3::from_slice(truth), sensitivity)
        }
        Quantity::UnitVector { sign_free } => {
            unit_vector(output, sign_free, vector(values), DVec3::from_slice(truth), sensitivity)
        }
        Quantity::Builtin => builtin(values, truth, sensitivity),
        Quantity::Property => panic!("{} has no one truth to be compared with", output.field.name),
    }
}

/// Judges an output that must have a property by how far it is from having it. NaN: its values are not finite.
pub(super) fn residual(output: &Output, residual: f64, sensitivity: f64) -> Measure {
    if !residual.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    let error = residual.abs();
    // Properties are of unit vectors so far: binary16 has steps of 2^-11 just below 1.
    Measure::graded(error, error, [UNIT_ROUNDOFF, 1.0 / 2048.0], output, sensitivity)
}

/// The verdict on a configuration without a result to measure, because the truth, the variant or both say that there is
/// none; `None` where both are hits. `margin` is the oracle's: the relative change of the inputs that turns the class.
pub(super) fn miss(finite: bool, missed: bool, truth_missed: bool, margin: f64) -> Option<Verdict> {
    if !missed && !truth_missed {
        None
    } else if !finite {
        Some(Verdict::NonFinite)
    } else if missed == truth_missed {
        Some(Verdict::Ok)
    } else if margin <= EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF {
        Some(Verdict::IllConditioned)
    } else {
        Some(Verdict::Missed)
    }
}

fn vector(values: &[f32]) -> DVec3 {
    DVec3::new(f64::from(values[0]), f64::from(values[1]), f64::from(values[2]))
}

fn irradiance(output: &Output, value: f32, truth: f64, sensitivity: f64) -> Measure {
    if !value.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    let value = f64::from(value);
    let error = (value - truth).abs();
    let mut measure =
        Measure::graded(error, error, [f32_spacing(truth), f16_spacing(truth)], output, sensitivity);
    if !(-output.tolerance..=1.0 + output.tolerance).contains(&value) {
        measure.verdict = Verdict::OutOfRange;
    }
    measure
}

fn vector_irradiance(output: &Output, value: DVec3, truth: DVec3, sensitivity: f64) -> Measure {
    if !value.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    let error = (value - truth).length();
    let size = truth.length();
    Measure::graded(error, error, [f32_spacing(size), f16_spacing(size)], output, sensitivity)
}

fn coordinate(output: &Output, value: f32, truth: f64, sensitivity: f64) -> Measure {
    if !value.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    let error = (f64::from(value) - truth).abs();
    Measure::graded(error, error, [f32_spacing(truth), f16_spacing(truth)], output, sensitivity)
}

fn solid_angle(output: &Output, value: f32, truth: f64, sensitivity: f64) -> Measure {
    const SPHERE: f64 = 4.0 * std::f64::consts::PI;
    let mut measure = relative(output, value, truth, sensitivity);
    // No rounding of the inputs makes a solid angle negative or more than the sphere.
    if measure.verdict != Verdict::NonFinite {
        if f64::from(value) < -FLUSH {
            measure.verdict = Verdict::WrongSign;
        } else if f64::from(value) > SPHERE * (1.0 + output.tolerance) {
            measure.verdict = Verdict::OutOfRange;
        }
    }
    measure
}

fn sized_vector(output: &Output, sign_free: bool, value: DVec3, truth: DVec3, sensitivity: f64) -> Measure {
    if !value.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    let size = truth.length();
    let absolute = if sensitivity.is_infinite() {
        (value.length() - size).abs()
    } else if sign_free && value.dot(truth) < 0.0 {
        (value + truth).length()
    } else {
        (value - truth).length()
    };
    let error = (absolute - FLUSH).max(0.0) / size.max(FLUSH);
    // What is left where the direction is free is a length, which no rounding of the inputs makes free as well.
    let explained = if sensitivity.is_infinite() { size } else { sensitivity };
    let mut measure =
        Measure::graded(error, absolute, [f32_spacing(size), f16_spacing(size)], output, explained);
    // First order understates large turns, as for directions.
    if measure.verdict == Verdict::Inaccurate && size > 0.0 && sensitivity.is_finite() {
        let double = 2.0 * EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF * sensitivity / size;
        if double >= 1.0 || error <= 0.5 * f64::asin(double) {
            measure.verdict = Verdict::IllConditioned;
        }
    }
    measure
}

/// What rounds to infinity: the largest f32 and half its spacing.
const OVERFLOW: f64 = f32::MAX as f64 * (1.0 + UNIT_ROUNDOFF / 2.0);
/// The verdict follows the specification of Vulkan: within the limit; a result whose permitted range reaches into the
/// subnormals may be flushed to zero, and one whose range reaches beyond the largest f32 may be infinite or that largest
/// one. Neither counts as an error. Without a limit any answer will do, and the error is the absolute or the relative
/// one, whichever is less.
fn builtin(values: &[f32], truth: &[f64], limit: f64) -> Measure {
    let off = |(value, truth): (&f32, &f64)| {
        let may_flush = *value == 0.0 && truth.abs() < FLUSH + limit;
        let may_overflow = value.abs() >= f32::MAX
            && truth.abs() + limit > f64::from(f32::MAX)
            && (*value > 0.0) == (*truth > 0.0);
        if limit.is_finite() && (may_flush || may_overflow) { 0.0 } else { (f64::from(*value) - truth).abs() }
    };
    let (absolute, size) = match (values, truth) {
        // Squares of subnormals would vanish.
        ([value], [truth]) => (off((value, truth)), truth.abs()),
        _ => {
            let square: f64 = values.iter().zip(truth).map(|pair| off(pair).powi(2)).sum();
            (square.sqrt(), truth.iter().map(|truth| truth * truth).sum::<f64>().sqrt())
        }
    };
    let steps = [255.0 * absolute, 1023.0 * absolute, absolute / f16_spacing(size)];
    let ulp = absolute / f32_spacing(size);
    if !limit.is_finite() {
        let error = absolute.min(absolute / size);
        return Measure { verdict: Verdict::Unspecified, error, ulp, conditioned: 0.0, steps };
    }
    if !absolute.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    let error = if absolute == 0.0 { 0.0 } else { absolute / limit };
    let verdict = if error <= 1.0 { Verdict::Ok } else { Verdict::Inaccurate };
    Measure { verdict, error, ulp, conditioned: 0.0, steps }
}

fn relative(output: &Output, value: f32, truth: f64, sensitivity: f64) -> Measure {
    if !value.is_finite() {
        let overflows = value.is_infinite() && truth.abs() >= OVERFLOW && (value > 0.0) == (truth > 0.0);
        return if overflows {
            Measure::graded(0.0, 0.0, [1.0, 1.0], output, sensitivity)
        } else {
            Measure::failed(Verdict::NonFinite)
        };
    }
    let absolute = (f64::from(value) - truth).abs();
    let error = (absolute - FLUSH).max(0.0) / truth.abs().max(FLUSH);
    let mut measure =
        Measure::graded(error, absolute, [f32_spacing(truth), f16_spacing(truth)], output, sensitivity);
    // Blaming a sign needs a truth whose sign is certain: not one that rounding the inputs may turn.
    let wrong =
        if output.quantity == Quantity::Scalar { f64::from(value) * truth < 0.0 } else { value < 0.0 };
    if wrong && measure.verdict == Verdict::Inaccurate {
        measure.verdict = Verdict::WrongSign;
    }
    measure
}

fn unit_vector(output: &Output, sign_free: bool, value: DVec3, truth: DVec3, sensitivity: f64) -> Measure {
    if !value.is_finite() {
        return Measure::failed(Verdict::NonFinite);
    }
    const TINY: f64 = 1.0 / 1_048_576.0;
    let norm = value.length();
    let angle = if sensitivity.is_infinite() {
        0.0
    } else {
        let dot = value.dot(truth);
        let dot = if sign_free { dot.abs() } else { dot };
        let tangent = value.cross(truth).length() / dot;
        // Below 2^-20 the tangent is the angle to 3e-13 of itself, at a third of atan2's cost.
        if dot > 0.0 && tangent < TINY { tangent } else { f64::atan2(value.cross(truth).length(), dot) }
    };
    // binary16 has steps of 2^-11 just below 1.
    let mut measure = Measure::graded(angle, angle, [UNIT_ROUNDOFF, 1.0 / 2048.0], output, sensitivity);
    // First order understates large turns: a perturbation that turns an axis by E to first order turns it by
    // asin(2 E)/2 at most, and anywhere once 2 E reaches 1 (the sin 2 theta theorem of Davis and Kahan, 1970).
    if measure.verdict == Verdict::Inaccurate {
        let double = 2.0 * EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF * sensitivity;
        if double >= 1.0 || angle <= 0.5 * f64::asin(double) {
            measure.verdict = Verdict::IllConditioned;
        }
    }
    if (norm - 1.0).abs() > output.tolerance {
        measure.verdict = Verdict::NotUnit;
    }
    measure
}

/// What is wrong where a relation between the outputs' values does not hold; [`Verdict::Ok`] where it does.
///
/// `values` and `truth` give the components of an output by its position.
pub(super) fn relate<'a>(
    relation: Relation,
    outputs: &[Output],
    values: impl Fn(usize) -> &'a [f32],
    truth: impl Fn(usize) -> &'a [f64],
) -> Verdict {
    match relation {
        Relation::Orthogonal(a, b) => {
            let (u, v) = (vector(values(a)), vector(values(b)));
            // The coarser of the two tolerances; a zero or non-finite vector has its own verdict.
            let tolerance = outputs[a].tolerance.max(outputs[b].tolerance);
            if u.dot(v).abs() > tolerance * u.length() * v.length() {
                Verdict::NotOrthogonal
            } else {
                Verdict::Ok
            }
        }
        // To the last bit, for what a box leaves out is not there. NaN encloses nothing, but has its own verdict.
        Relation::Encloses { min, max } => {
            let beneath = |low: f64, high: f64| low <= high + FLUSH;
            let lower = values(min).iter().zip(truth(min)).all(|(v, t)| beneath(f64::from(*v), *t));
            let upper = values(max).iter().zip(truth(max)).all(|(v, t)| beneath(*t, f64::from(*v)));
            if lower && upper { Verdict::Ok } else { Verdict::NotEnclosing }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::Type;

    const LENGTH: Output = Output::new("l", Type::Float, Quantity::Magnitude, 1e-3);
    const AXIS: Output = Output::new("a", Type::Vec3, Quantity::UnitVector { sign_free: true }, 1e-3);
    const WAY: Output = Output::new("w", Type::Vec3, Quantity::UnitVector { sign_free: false }, 1e-3);

    fn length_verdict(value: f32, truth: f64, sensitivity: f64) -> Verdict {
        measure(&LENGTH, &[value], &[truth], sensitivity).verdict
    }

    #[test]
    fn lengths() {
        assert_eq!(length_verdict(1.0, 1.0, 1.0), Verdict::Ok);
        assert_eq!(length_verdict(1.0009, 1.0, 1.0), Verdict::Ok);
        assert_eq!(length_verdict(1.0011, 1.0, 1.0), Verdict::Inaccurate);
        assert_eq!(length_verdict(1.0011, 1.0, 0.0012 / (4.0 * UNIT_ROUNDOFF)), Verdict::IllConditioned);
        assert_eq!(length_verdict(-1.0, 1.0, 1.0), Verdict::WrongSign);
        assert_eq!(length_verdict(-0.0, 0.0, 0.0), Verdict::Ok);
        assert_eq!(length_verdict(f32::NAN, 1.0, f64::INFINITY), Verdict::NonFinite);
        assert_eq!(length_verdict(f32::INFINITY, 1.0, 1.0), Verdict::NonFinite);
    }

    #[test]
    fn flushing_and_overflow_are_allowed() {
        assert_eq!(length_verdict(0.0, 1e-39, 1e-39), Verdict::Ok);
        assert_eq!(length_verdict(0.0, 1e-37, 1e-37), Verdict::Inaccurate);
        assert_eq!(length_verdict(f32::INFINITY, 4e38, 4e38), Verdict::Ok);
        assert_eq!(length_verdict(f32::INFINITY, 3.4e38, 3.4e38), Verdict::NonFinite);
    }

    #[test]
    fn ulps_are_fractions_of_the_spacing_at_the_unrounded_truth() {
        let truth = 1.0 + 0.25 * f64::from(f32::EPSILON);
        assert_eq!(measure(&LENGTH, &[1.0], &[truth], 1.0).ulp, 0.25);
        // Just below 1 the spacing is half of that above.
        let truth = 1.0 - 0.25 * f64::from(f32::EPSILON);
        assert_eq!(measure(&LENGTH, &[1.0], &[truth], 1.0).ulp, 0.5);
    }

    #[test]
    fn directions() {
        let verdict = |output: &Output, value: [f32; 3], sensitivity| {
            measure(output, &value, &[0.0, 0.0, 1.0], sensitivity).verdict
        };
        assert_eq!(verdict(&AXIS, [0.0, 0.0, -1.0], 1.0), Verdict::Ok);
        assert_eq!(verdict(&WAY, [0.0, 0.0, -1.0], 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(&AXIS, [0.002, 0.0, 1.0], 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(&AXIS, [0.002, 0.0, 1.0], 0.01 / UNIT_ROUNDOFF), Verdict::IllConditioned);
        // Half a radian to first order may be any turn; a quarter, at most asin(1/2)/2 = 0.26.
        assert_eq!(verdict(&AXIS, [1.0, 0.0, 0.0], 0.5 / (4.0 * UNIT_ROUNDOFF)), Verdict::IllConditioned);
        let turned = |angle: f32| [angle.sin(), 0.0, angle.cos()];
        let quarter = 0.25 / (4.0 * UNIT_ROUNDOFF);
        assert_eq!(verdict(&AXIS, turned(0.261), quarter), Verdict::IllConditioned);
        assert_eq!(verdict(&AXIS, turned(0.263), quarter), Verdict::Inaccurate);
        assert_eq!(verdict(&AXIS, [1.0, 0.0, 0.0], f64::INFINITY), Verdict::Ok);
        assert_eq!(verdict(&AXIS, [0.0, 0.0, 1.1], 1.0), Verdict::NotUnit);
        assert_eq!(verdict(&AXIS, [0.0, 0.0, 0.0], f64::INFINITY), Verdict::NotUnit);
        assert_eq!(verdict(&AXIS, [0.0, f32::NAN, 1.0], f64::INFINITY), Verdict::NonFinite);
        let angle = measure(&AXIS, &[1.0, 0.0, 1.0], &[0.0, 0.0, 1.0], 1.0).error;
        assert!((angle - std::f64::consts::FRAC_PI_4).abs() < 1e-12);
    }

    #[test]
    fn irradiances() {
        let light = Output::new("e", Type::Float, Quantity::Irradiance, 1e-4);
        let verdict =
            |value: f32, truth, sensitivity| measure(&light, &[value], &[truth], sensitivity).verdict;
        assert_eq!(verdict(0.500_09, 0.5, 1.0), Verdict::Ok);
        assert_eq!(verdict(0.500_11, 0.5, 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(-0.01, 0.0, 1.0), Verdict::OutOfRange);
        assert_eq!(verdict(1.01, 1.0, 1.0), Verdict::OutOfRange);
        assert_eq!(verdict(f32::NAN, 1.0, 1.0), Verdict::NonFinite);
        assert_eq!(verdict(0.5, 0.3, 1.0 / UNIT_ROUNDOFF), Verdict::IllConditioned);
    }

    #[test]
    fn coordinates() {
        let place = Output::new("x", Type::Float, Quantity::Coordinate, 1e-3);
        let verdict =
            |value: f32, truth, sensitivity| measure(&place, &[value], &[truth], sensitivity).verdict;
        assert_eq!(verdict(-0.000_9, 0.0, 1.0), Verdict::Ok);
        assert_eq!(verdict(-1.001_1, -1.0, 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(0.002, 0.0, 1e6), Verdict::IllConditioned);
        assert_eq!(verdict(f32::INFINITY, 1.0, f64::INFINITY), Verdict::NonFinite);
    }

    #[test]
    fn solid_angles() {
        let angle = Output::new("w", Type::Float, Quantity::SolidAngle, 1e-3);
        let verdict =
            |value: f32, truth, sensitivity| measure(&angle, &[value], &[truth], sensitivity).verdict;
        let sphere = 4.0 * std::f64::consts::PI;
        assert_eq!(verdict(0.100_09, 0.1, 1.0), Verdict::Ok);
        assert_eq!(verdict(0.100_11, 0.1, 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(0.2, 0.1, 1.0 / UNIT_ROUNDOFF), Verdict::IllConditioned);
        assert_eq!(verdict(-1e-9, 1e-9, 1.0), Verdict::WrongSign);
        assert_eq!(verdict(-1e-39, 0.0, 0.0), Verdict::Ok);
        assert_eq!(verdict(1e-12, 0.0, 0.0), Verdict::Inaccurate);
        assert_eq!(verdict(12.567, sphere, 0.0), Verdict::Ok);
        assert_eq!(verdict(12.58, sphere, 0.0), Verdict::OutOfRange);
        assert_eq!(verdict(f32::INFINITY, sphere, 0.0), Verdict::NonFinite);
    }

    #[test]
    fn vectors_that_have_a_length() {
        let axis = Output::new("a", Type::Vec3, Quantity::Vector { sign_free: true }, 1e-3);
        let center = Output::new("c", Type::Vec3, Quantity::Vector { sign_free: false }, 1e-3);
        let verdict = |output: &Output, value: [f32; 3], sensitivity| {
            measure(output, &value, &[0.0, 0.0, 2.0], sensitivity).verdict
        };
        assert_eq!(verdict(&axis, [0.0, 0.0, -2.0], 1.0), Verdict::Ok);
        assert_eq!(verdict(&center, [0.0, 0.0, -2.0], 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(&center, [0.001, 0.0, 2.001], 1.0), Verdict::Ok);
        assert_eq!(verdict(&center, [0.0, 0.0, 2.003], 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(&center, [0.0, 0.0, 2.003], 0.001 / UNIT_ROUNDOFF), Verdict::IllConditioned);
        // A turn of any size, where twice four roundings do as much as the vector is long; a little less, where not.
        assert_eq!(verdict(&axis, [2.0, 0.0, 0.0], 0.3 / UNIT_ROUNDOFF), Verdict::IllConditioned);
        assert_eq!(verdict(&axis, [2.0, 0.0, 0.0], 0.2 / UNIT_ROUNDOFF), Verdict::Inaccurate);
        // The direction is free, the length is not.
        assert_eq!(verdict(&axis, [2.0, 0.0, 0.0], f64::INFINITY), Verdict::Ok);
        assert_eq!(verdict(&axis, [1.9, 0.0, 0.0], f64::INFINITY), Verdict::Inaccurate);
        let nothing = |value: [f32; 3]| measure(&center, &value, &[0.0; 3], 0.0).verdict;
        assert_eq!(nothing([0.0, -1e-39, 0.0]), Verdict::Ok);
        assert_eq!(nothing([0.0, 1e-30, 0.0]), Verdict::Inaccurate);
        assert_eq!(nothing([0.0, f32::NAN, 0.0]), Verdict::NonFinite);
    }

    #[test]
    fn signs_of_scalars() {
        let value = Output::new("x", Type::Float, Quantity::Scalar, 1e-3);
        let verdict = |v: f32, truth, sensitivity| measure(&value, &[v], &[truth], sensitivity).verdict;
        assert_eq!(verdict(-1.0, -1.0, 1.0), Verdict::Ok);
        assert_eq!(verdict(1.0, -1.0, 1.0), Verdict::WrongSign);
        assert_eq!(verdict(1e-9, -1e-9, 1.0), Verdict::IllConditioned);
        assert_eq!(verdict(f32::NEG_INFINITY, -4e38, 1.0), Verdict::Ok);
    }

    #[test]
    fn builtins_are_judged_by_their_limit() {
        let output = Output::new("y", Type::Float, Quantity::Builtin, 1.0);
        let verdict = |value: f32, truth, limit| measure(&output, &[value], &[truth], limit).verdict;
        assert_eq!(verdict(1.25, 1.0, 0.25), Verdict::Ok);
        assert_eq!(verdict(1.25f32.next_up(), 1.0, 0.25), Verdict::Inaccurate);
        assert_eq!(measure(&output, &[1.25], &[1.0], 0.5).error, 0.5);
        assert_eq!(verdict(f32::NAN, 1.0, 0.25), Verdict::NonFinite);
        assert_eq!(verdict(f32::NAN, 1.0, f64::INFINITY), Verdict::Unspecified);
        assert_eq!(verdict(1.0, f64::NAN, f64::INFINITY), Verdict::Unspecified);
        // Flushed, and one that must not be.
        assert_eq!(verdict(0.0, 1.1e-38, 1e-45), Verdict::Ok);
        assert_eq!(verdict(0.0, 1.2e-38, 1e-45), Verdict::Inaccurate);
        // Overflown, to infinity or to the largest; not where the range ends before, nor to the other sign.
        for value in [f32::INFINITY, f32::MAX] {
            assert_eq!(verdict(value, 1e39, 1e32), Verdict::Ok);
            assert_ne!(verdict(-value, 1e39, 1e32), Verdict::Ok);
        }
        assert_eq!(verdict(f32::INFINITY, 3.4e38, 1e37), Verdict::Ok);
        assert_eq!(verdict(f32::INFINITY, 3e38, 1e37), Verdict::NonFinite);
    }

    #[test]
    fn vectors_of_builtins_are_judged_by_distance() {
        let output = Output::new("v", Type::Vec3, Quantity::Builtin, 1.0);
        let measure = measure(&output, &[0.3, 0.0, 1.4], &[0.0, 0.0, 1.0], 1.0);
        assert!((measure.error - 0.5).abs() < 1e-7 && measure.verdict == Verdict::Ok, "{measure:?}");
    }

    #[test]
    fn orthogonality() {
        let outputs = [AXIS, AXIS];
        let check = |u: [f32; 3], v: [f32; 3]| {
            let values = [u, v];
            relate(Relation::Orthogonal(0, 1), &outputs, |output| &values[output], |_| &[])
        };
        assert_eq!(check([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), Verdict::Ok);
        assert_eq!(check([1.0, 0.0, 0.0], [0.1, 1.0, 0.0]), Verdict::NotOrthogonal);
        assert_eq!(check([1.0, 0.0, 0.0], [f32::NAN, 1.0, 0.0]), Verdict::Ok);
    }

    #[test]
    fn enclosure_is_exact_but_for_subnormals() {
        let truth = [[-1.0, 0.0, 1.0], [1.0, 1e-39, 1.0 + 1e-12]];
        let check = |min: [f32; 3], max: [f32; 3]| {
            let values = [min, max];
            relate(Relation::Encloses { min: 0, max: 1 }, &[], |at| &values[at], |at| &truth[at])
        };
        let above = 1.0 + f32::EPSILON;
        assert_eq!(check([-1.0, 0.0, 1.0], [1.0, 1.0, above]), Verdict::Ok);
        assert_eq!(check([-1.0, 0.0, 1.0], [1.0, 1.0, 1.0]), Verdict::NotEnclosing);
        assert_eq!(check([-1.0, 0.0, above], [1.0, 1.0, above]), Verdict::NotEnclosing);
        // 1e-39 may count as zero.
        assert_eq!(check([-1.0, 0.0, 1.0], [1.0, 0.0, above]), Verdict::Ok);
        assert_eq!(check([-1.0, f32::NAN, 1.0], [1.0, 1.0, above]), Verdict::NotEnclosing);
    }

    #[test]
    fn classes() {
        let border = EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF;
        assert_eq!(miss(true, false, false, 0.0), None);
        assert_eq!(miss(true, true, true, 1.0), Some(Verdict::Ok));
        assert_eq!(miss(true, true, false, border), Some(Verdict::IllConditioned));
        assert_eq!(miss(true, false, true, 1.01 * border), Some(Verdict::Missed));
        assert_eq!(miss(false, true, true, f64::INFINITY), Some(Verdict::NonFinite));
        // Without a class, values that are not finite are measured as such.
        assert_eq!(miss(false, false, false, f64::INFINITY), None);
    }

    #[test]
    fn residuals() {
        let frame = Output::new("b", Type::Vec3, Quantity::Property, 1e-3);
        let verdict = |size: f64, sensitivity| residual(&frame, size, sensitivity).verdict;
        assert_eq!(verdict(0.9e-3, 1.0), Verdict::Ok);
        assert_eq!(verdict(-1.1e-3, 1.0), Verdict::Inaccurate);
        assert_eq!(verdict(1.1e-3, 1e6), Verdict::IllConditioned);
        assert_eq!(verdict(f64::NAN, f64::INFINITY), Verdict::NonFinite);
        assert_eq!(residual(&frame, -UNIT_ROUNDOFF, 1.0).ulp, 1.0);
    }
}
