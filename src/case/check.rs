//! What must hold of a right answer, in terms simple enough for a script: numbers made of the outputs, and bounds.
//!
//! Follows the judge ([`crate::audit::measure`]), and says so where it cannot: what a family computes of its own, such as
//! a property's residual or what a miss is, has no form here, and then only the recorded bits are refused.

use std::f64::consts::PI;
use std::fmt::Write;

use glam::DVec3;

use crate::audit::{EXPLAINED_BY_ROUNDING, Verdict};
use crate::family::{Output, Problem, Quantity, Relation, Truth};
use crate::numeric::spacing::UNIT_ROUNDOFF;

/// As the judge's: an error up to the smallest normal number is free.
const FLUSH: f64 = f32::MIN_POSITIVE as f64;
/// In the place of what cannot be measured.
const BEYOND: f32 = f32::MAX;

/// One number of the outputs and the closed interval in which it must lie.
#[derive(Clone, Debug)]
pub(super) struct Check {
    /// What it is, for a comment.
    pub what: String,
    pub number: Number,
    pub low: f32,
    pub high: f32,
}

/// How the number is made. Positions are those of output columns.
#[derive(Clone, Debug)]
pub(super) enum Number {
    /// A component itself.
    Value(usize),
    /// How many of all components are not finite.
    NonFinite { columns: usize },
    /// Distance of a vector from the truth, or from its negative if that is nearer and signs are free.
    Distance { at: usize, truth: Vec<f64>, sign_free: bool },
    /// Length of a vector.
    Length { at: usize },
    /// Tangent of the angle to the truth, [`BEYOND`] from a right angle on.
    Tangent { at: usize, truth: Vec<f64>, sign_free: bool },
    /// |u.v| - tolerance |u| |v|.
    Orthogonality { u: usize, v: usize, tolerance: f64 },
    /// 1 where every component has the recorded bits, else 0.
    Recorded { bits: Vec<u32> },
}

/// The checks of one configuration. At least one of them fails on `recorded`, and none on the truth.
pub(super) fn checks(problem: &dyn Problem, truth: &Truth, verdict: Verdict, recorded: &[f32]) -> Vec<Check> {
    let outputs = problem.outputs();
    let mut checks = vec![Check {
        what: "components that are not finite".to_owned(),
        number: Number::NonFinite { columns: recorded.len() },
        low: 0.0,
        high: 0.0,
    }];
    // Both sides of a miss have their own definition.
    let hit = !problem.is_miss(truth.values());
    if hit {
        let mut at = 0;
        let mut starts = Vec::new();
        for (position, output) in outputs.iter().enumerate() {
            starts.push(at);
            let sensitivity = truth.sensitivities()[position];
            of_output(output, at, truth.output(position), sensitivity, &mut checks);
            at += output.field.ty.components();
        }
        for relation in problem.relations() {
            of_relation(*relation, outputs, &starts, truth, &mut checks);
        }
    }
    if verdict.is_failure() && checks.iter().all(|check| check.passes(recorded)) {
        checks.push(Check {
            what: "1 if all bits are those of the wrong answer".to_owned(),
            number: Number::Recorded { bits: recorded.iter().map(|value| value.to_bits()).collect() },
            low: 0.0,
            high: 0.0,
        });
    }
    checks
}

fn of_output(output: &Output, at: usize, truth: &[f64], sensitivity: f64, checks: &mut Vec<Check>) {
    let explained = EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF * sensitivity;
    let tolerance = output.tolerance;
    let name = output.field.name;
    let relative = |size: f64| tolerance * size.max(FLUSH) + FLUSH;
    let mut within = |low: f64, high: f64| {
        if low.is_finite() && high.is_finite() {
            let what = format!("{name}, exactly {:.16e}", truth[0]);
            checks.push(Check { what, number: Number::Value(at), low: above(low), high: below(high) });
        }
    };
    match output.quantity {
        Quantity::Magnitude | Quantity::Scalar => {
            let allowed = relative(truth[0].abs()).max(explained);
            within(truth[0] - allowed, truth[0] + allowed);
        }
        Quantity::SolidAngle => {
            let allowed = relative(truth[0].abs()).max(explained);
            within((truth[0] - allowed).max(-FLUSH), (truth[0] + allowed).min(4.0 * PI * (1.0 + tolerance)));
        }
        Quantity::Irradiance => {
            let allowed = tolerance.max(explained);
            within((truth[0] - allowed).max(-tolerance), (truth[0] + allowed).min(1.0 + tolerance));
        }
        Quantity::Coordinate => {
            let allowed = tolerance.max(explained);
            within(truth[0] - allowed, truth[0] + allowed);
        }
        Quantity::Builtin if truth.len() == 1 => {
            // What may be flushed may be anything down to zero.
            let flushed = |bound: f64| if truth[0].abs() < FLUSH + sensitivity { 0.0 } else { bound };
            let (low, high) = (truth[0] - sensitivity, truth[0] + sensitivity);
            if low.abs().max(high.abs()) <= f64::from(f32::MAX) {
                within(low.min(flushed(low)), high.max(flushed(high)));
            }
        }
        Quantity::Builtin => distance(name, at, truth, false, sensitivity, checks),
        Quantity::VectorIrradiance => distance(name, at, truth, false, tolerance.max(explained), checks),
        Quantity::Vector { sign_free } => {
            let size = DVec3::from_slice(truth).length();
            if sensitivity.is_infinite() {
                let allowed = relative(size).max(EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF * size);
                length(name, at, size - allowed, size + allowed, checks);
            } else if let Some(turned) = turned(sensitivity / size) {
                let allowed = relative(size).max(explained).max(turned * size.max(FLUSH) + FLUSH);
                distance(name, at, truth, sign_free, allowed, checks);
            }
        }
        Quantity::UnitVector { sign_free } => {
            length(name, at, 1.0 - tolerance, 1.0 + tolerance, checks);
            if let Some(turned) = turned(sensitivity).filter(|_| sensitivity.is_finite()) {
                checks.push(Check {
                    what: format!("{name}: tangent of the angle to {}", vector(truth)),
                    number: Number::Tangent { at, truth: truth.to_vec(), sign_free },
                    low: 0.0,
                    high: tolerance.max(explained).max(turned).tan() as f32,
                });
            }
        }
        Quantity::Property => {}
    }
}

/// The largest turn that rounding the inputs explains, as the judge has it; `None` if any.
fn turned(sensitivity: f64) -> Option<f64> {
    let double = 2.0 * EXPLAINED_BY_ROUNDING * UNIT_ROUNDOFF * sensitivity;
    (double < 1.0).then(|| 0.5 * f64::asin(double))
}

fn distance(name: &str, at: usize, truth: &[f64], sign_free: bool, allowed: f64, checks: &mut Vec<Check>) {
    if allowed.is_finite() && truth.iter().all(|value| value.is_finite()) {
        let sign = if sign_free { " or its negative" } else { "" };
        checks.push(Check {
            what: format!("{name}: distance from {}{sign}", vector(truth)),
            number: Number::Distance { at, truth: truth.to_vec(), sign_free },
            low: 0.0,
            high: below(allowed),
        });
    }
}

fn length(name: &str, at: usize, low: f64, high: f64, checks: &mut Vec<Check>) {
    let what = format!("{name}: length");
    checks.push(Check { what, number: Number::Length { at }, low: above(low), high: below(high) });
}

fn of_relation(
    relation: Relation,
    outputs: &[Output],
    starts: &[usize],
    truth: &Truth,
    checks: &mut Vec<Check>,
) {
    match relation {
        Relation::Orthogonal(u, v) => checks.push(Check {
            what: format!(
                "{0}, {1}: |{0}.{1}| over the tolerance",
                outputs[u].field.name, outputs[v].field.name
            ),
            number: Number::Orthogonality {
                u: starts[u],
                v: starts[v],
                tolerance: outputs[u].tolerance.max(outputs[v].tolerance),
            },
            low: -BEYOND,
            high: 0.0,
        }),
        Relation::Encloses { min, max } => {
            for (output, upper) in [(min, false), (max, true)] {
                for (component, value) in truth.output(output).iter().enumerate() {
                    let name = outputs[output].field.name;
                    let (low, high) =
                        if upper { (above(value - FLUSH), BEYOND) } else { (-BEYOND, below(value + FLUSH)) };
                    checks.push(Check {
                        what: format!("{name}[{component}] encloses {value:.16e}"),
                        number: Number::Value(starts[output] + component),
                        low,
                        high,
                    });
                }
            }
        }
    }
}

impl Check {
    /// Whether these outputs keep it.
    pub(super) fn passes(&self, values: &[f32]) -> bool {
        (self.low..=self.high).contains(&self.number.of(values))
    }
}

impl Number {
    /// Its value for given outputs, as the GLSL computes it but for rounding.
    fn of(&self, values: &[f32]) -> f32 {
        let finite = |value: f32| if value.is_finite() { value } else { BEYOND };
        let vector = |at: usize| {
            let vector = DVec3::new(values[at].into(), values[at + 1].into(), values[at + 2].into());
            vector.is_finite().then_some(vector)
        };
        let number = match self {
            Number::Value(at) => return finite(values[*at]),
            Number::NonFinite { .. } => {
                return values.iter().filter(|value| !value.is_finite()).count() as f32;
            }
            Number::Recorded { bits } => {
                let same = values.iter().zip(bits).all(|(value, bits)| value.to_bits() == *bits);
                return if same { 1.0 } else { 0.0 };
            }
            Number::Distance { at, truth, sign_free } => vector(*at).map(|value| {
                let truth = DVec3::from_slice(truth);
                let distance = (value - truth).length();
                if *sign_free { distance.min((value + truth).length()) } else { distance }
            }),
            Number::Length { at } => vector(*at).map(DVec3::length),
            Number::Tangent { at, truth, sign_free } => vector(*at).and_then(|value| {
                let truth = DVec3::from_slice(truth);
                let dot = if *sign_free { value.dot(truth).abs() } else { value.dot(truth) };
                (dot > 0.0).then(|| value.cross(truth).length() / dot)
            }),
            Number::Orthogonality { u, v, tolerance } => {
                vector(*u).zip(vector(*v)).map(|(u, v)| u.dot(v).abs() - tolerance * u.length() * v.length())
            }
        };
        number.map_or(BEYOND, |number| finite(number as f32))
    }

    /// An expression of it in GLSL, where `bits[]` are the outputs and [`SHARED`] is declared.
    pub(super) fn glsl(&self) -> String {
        let constant = |truth: &[f64]| {
            let parts: Vec<String> = truth.iter().map(|value| format!("{:.9e}", *value as f32)).collect();
            format!("vec3({})", parts.join(", "))
        };
        match self {
            Number::Value(at) => format!("value({at}u)"),
            Number::NonFinite { columns } => {
                let parts: Vec<String> = (0..*columns).map(|at| format!("float(!finite({at}u))")).collect();
                parts.join(" + ")
            }
            Number::Distance { at, truth, sign_free } => {
                format!("off({at}u, {}, {sign_free})", constant(truth))
            }
            Number::Length { at } => format!("size({at}u)"),
            Number::Tangent { at, truth, sign_free } => {
                format!("tangent({at}u, {}, {sign_free})", constant(truth))
            }
            Number::Orthogonality { u, v, tolerance } => format!("skew({u}u, {v}u, {tolerance:e})"),
            Number::Recorded { bits } => {
                let parts: Vec<String> = bits
                    .iter()
                    .enumerate()
                    .map(|(at, bits)| format!("bits[{at}] == 0x{bits:08x}u"))
                    .collect();
                format!("{} ? 1.0 : 0.0", parts.join(" && "))
            }
        }
    }
}

/// Functions that the expressions call. What is not finite is told by its bits: a compiler may assume NaN away.
pub(super) const SHARED: &str = "\
const float BEYOND = uintBitsToFloat(0x7f7fffffu);
bool finite(uint k) { return (bits[k] & 0x7f800000u) != 0x7f800000u; }
bool finite3(uint k) { return finite(k) && finite(k + 1u) && finite(k + 2u); }
float value(uint k) { return finite(k) ? uintBitsToFloat(bits[k]) : BEYOND; }
vec3 values(uint k) { return vec3(value(k), value(k + 1u), value(k + 2u)); }
float size(uint k) { return finite3(k) ? min(length(values(k)), BEYOND) : BEYOND; }
float off(uint k, vec3 truth, bool sign_free)
{
    if (!finite3(k)) return BEYOND;
    float d = min(distance(values(k), truth), BEYOND);
    return sign_free ? min(d, distance(values(k), -truth)) : d;
}
float tangent(uint k, vec3 truth, bool sign_free)
{
    if (!finite3(k)) return BEYOND;
    float d = dot(values(k), truth);
    if (sign_free) d = abs(d);
    return d > 0.0 ? min(length(cross(values(k), truth)) / d, BEYOND) : BEYOND;
}
float skew(uint k, uint l, float tolerance)
{
    if (!finite3(k) || !finite3(l)) return BEYOND;
    return abs(dot(values(k), values(l))) - tolerance * length(values(k)) * length(values(l));
}
";

fn vector(truth: &[f64]) -> String {
    let mut text = String::from("(");
    for (at, value) in truth.iter().enumerate() {
        _ = write!(text, "{}{value:.9e}", if at == 0 { "" } else { ", " });
    }
    text + ")"
}

/// The largest f32 that is not above `value`, within the finite ones.
fn below(value: f64) -> f32 {
    let rounded = value as f32;
    let rounded = if f64::from(rounded) > value { rounded.next_down() } else { rounded };
    rounded.clamp(f32::MIN, f32::MAX)
}

/// The smallest f32 that is not below `value`.
fn above(value: f64) -> f32 {
    -below(-value)
}
