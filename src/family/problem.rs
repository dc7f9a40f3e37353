//! What a family is: typed columns, scenarios, landmark coordinates, and the oracle that defines truth.

use crate::catalog::{Field, Signature, Type};
use crate::numeric::spacing::{UNIT_ROUNDOFF, f32_spacing};
use crate::sample::Draw;

/// One mathematical problem with one definition of truth.
pub trait Problem: Sync {
    /// The family's name, also its folder's and its GLSL function's: `ellipse_axes`.
    fn name(&self) -> &'static str;

    /// What is computed, one line.
    fn summary(&self) -> &'static str;

    /// Parameters of the function, in column order.
    fn inputs(&self) -> &'static [Field];

    /// Results of the function, in column order.
    fn outputs(&self) -> &'static [Output];

    /// What must hold between results.
    fn relations(&self) -> &'static [Relation] {
        &[]
    }

    /// Distributions of configurations; the first is the one that renderers meet.
    fn scenarios(&self) -> &'static [Scenario];

    /// Coordinates along which a variant's failures are told apart.
    fn landmarks(&self) -> &'static [Landmark];

    /// The exact result for these f32 bits, with certainty and conditioning, at most 2 us.
    ///
    /// `input` has one value a column, all finite unless [`takes_all_bits`](Problem::takes_all_bits).
    fn oracle(&self, input: &[f32], truth: &mut Truth);

    /// How far results are from the property that output `output` must have, a [`Quantity::Property`]; 0 where it holds
    /// exactly. `values` are all results in column order, and not necessarily finite: then the answer may be NaN.
    fn residual(&self, _output: usize, _input: &[f32], _values: &[f64]) -> f64 {
        f64::NAN
    }

    /// Whether results, of a variant or exact ones, say that there is none, such as a ray's miss: by the values that the
    /// family states for it. Hits and misses are two classes. Where truth and variant both miss there is nothing to
    /// measure; where one does, either the oracle's [`Truth::margin`] explains it or the variant has `missed`.
    fn is_miss(&self, _values: &[f64]) -> bool {
        false
    }

    /// Whether the family has one input column and its oracle answers for every bit pattern of it, so that an audit can
    /// be exhaustive.
    fn takes_all_bits(&self) -> bool {
        false
    }

    /// The GLSL function's signature.
    fn signature(&self) -> Signature {
        Signature {
            function: self.name(),
            parameters: self.inputs().to_vec(),
            results: self.outputs().iter().map(|output| output.field).collect(),
        }
    }

    /// The scenario of that name.
    fn scenario(&self, name: &str) -> Option<&'static Scenario> {
        self.scenarios().iter().find(|scenario| scenario.name == name)
    }
}

/// One result: its column, what it is, and how far off it may be.
#[derive(Clone, Copy, Debug)]
pub struct Output {
    pub field: Field,
    pub quantity: Quantity,
    /// Errors beyond this are `inaccurate`, in the quantity's own measure.
    pub tolerance: f64,
    /// Whether tables show this output's errors beside the verdicts.
    pub headline: bool,
}

impl Output {
    pub const fn new(name: &'static str, ty: Type, quantity: Quantity, tolerance: f64) -> Self {
        Output { field: Field::new(name, ty), quantity, tolerance, headline: false }
    }

    /// The output that tables show.
    pub const fn headline(mut self) -> Self {
        self.headline = true;
        self
    }
}

/// What a result is, and so how its error is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length, a tangent or another magnitude that is never negative: relative error.
    Magnitude,
    /// A signed value such as an eigenvalue: relative error, and the sign must be right where it matters.
    Scalar,
    /// Irradiance as a share of the full hemisphere's, in 0..1: absolute error.
    Irradiance,
    /// A vector of irradiances, such as one edge's contribution: absolute error, as the distance of the two.
    VectorIrradiance,
    /// A coordinate within -1..1, such as a place along a semi-axis: absolute error.
    Coordinate,
    /// A solid angle in steradians: relative error, within 0..4 pi.
    SolidAngle,
    /// A vector that has a length, such as a centre or a semi-axis: distance of the two over the truth's length. With
    /// `sign_free`, both signs are right. Where the sensitivity is infinite only the direction is undefined, and the
    /// lengths are compared.
    Vector { sign_free: bool },
    /// A direction: angle between the two in radians, and a length of 1. With `sign_free`, both signs are right.
    UnitVector { sign_free: bool },
    /// Whatever has a property together with the inputs and other results, such as a basis of a plane: absolute, the
    /// largest residual of what must hold, by [`Problem::residual`]. The oracle's values are one right answer of many, and
    /// its sensitivity is the residual that a change of the inputs alone makes of them.
    Property,
    /// What one of the device's own instructions returns: the error, of a vector its length, over what the Vulkan
    /// specification permits for these very inputs. The tolerance is 1.
    Builtin,
}

impl Quantity {
    /// Its name in records: `solid_angle`.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Magnitude => "magnitude",
            Quantity::Scalar => "scalar",
            Quantity::Irradiance => "irradiance",
            Quantity::VectorIrradiance => "vector_irradiance",
            Quantity::Coordinate => "coordinate",
            Quantity::SolidAngle => "solid_angle",
            Quantity::Vector { .. } => "vector",
            Quantity::UnitVector { .. } => "unit_vector",
            Quantity::Property => "property",
            Quantity::Builtin => "builtin",
        }
    }

    /// What its error and its tolerance are.
    pub fn measure(self) -> &'static str {
        match self {
            Quantity::Magnitude => "never negative; relative error",
            Quantity::Scalar => "signed; relative error",
            Quantity::Irradiance => "share of the full hemisphere's irradiance, 0..1; absolute error",
            Quantity::VectorIrradiance => {
                "vector of irradiances, shares of the hemisphere's; distance of the two"
            }
            Quantity::Coordinate => "coordinate in -1..1; absolute error",
            Quantity::SolidAngle => "steradians, 0..4 pi; relative error",
            Quantity::Vector { sign_free: false } => "vector; distance of the two over the truth's length",
            Quantity::Vector { sign_free: true } => {
                "vector, either sign; distance of the two over the truth's length"
            }
            Quantity::UnitVector { sign_free: false } => {
                "direction of length 1; angle between the two in radians"
            }
            Quantity::UnitVector { sign_free: true } => {
                "axis of length 1, either sign; angle between the two in radians"
            }
            Quantity::Property => {
                "has a property with the inputs and other results; largest residual of what must hold"
            }
            Quantity::Builtin => "error over what the Vulkan specification permits",
        }
    }
}

/// What must hold of several results together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// Two unit vectors, by position among the outputs, are orthogonal.
    Orthogonal(usize, usize),
    /// Two corners of a box, by position among the outputs, enclose the exact box that lies between their truths.
    Encloses { min: usize, max: usize },
}

/// A named distribution of configurations.
#[derive(Clone, Copy)]
pub struct Scenario {
    pub name: &'static str,
    /// What it draws, one line.
    pub summary: &'static str,
    /// Fills one input row, finite values only.
    pub draw: fn(&mut Draw, &mut [f32]),
}

/// A coordinate of configurations along which errors are split.
#[derive(Clone, Copy)]
pub struct Landmark {
    pub name: &'static str,
    /// What it is and where trouble lies, one line.
    pub summary: &'static str,
    /// Ascending; bin `k` holds `edges[k-1] <= coordinate < edges[k]`, so there is one bin more than edges. NaN goes last.
    pub edges: &'static [f64],
    pub coordinate: fn(&[f32], &Truth) -> f64,
}

impl Landmark {
    /// The bin of a configuration.
    pub fn bin(&self, input: &[f32], truth: &Truth) -> usize {
        let coordinate = (self.coordinate)(input, truth);
        self.edges.partition_point(|edge| coordinate.is_nan() || *edge <= coordinate)
    }
}

/// The most f32 components that all outputs of a family have together.
pub const MAX_COMPONENTS: usize = 16;
/// The most outputs of a family.
pub const MAX_OUTPUTS: usize = 8;

/// What an oracle says of one configuration.
#[derive(Clone, Debug)]
pub struct Truth {
    components: [usize; MAX_OUTPUTS],
    outputs: usize,
    values: [f64; MAX_COMPONENTS],
    sensitivities: [f64; MAX_OUTPUTS],
    worst_bound: f64,
    margin: f64,
    escalated: bool,
}

impl Truth {
    /// An empty truth for these outputs, to be filled by an oracle again and again.
    pub fn new(outputs: &[Output]) -> Self {
        let mut components = [0; MAX_OUTPUTS];
        for (slot, output) in components.iter_mut().zip(outputs) {
            *slot = output.field.ty.components();
        }
        Truth {
            components,
            outputs: outputs.len(),
            values: [0.0; MAX_COMPONENTS],
            sensitivities: [0.0; MAX_OUTPUTS],
            worst_bound: 0.0,
            margin: f64::INFINITY,
            escalated: false,
        }
    }

    /// Forgets the last configuration.
    pub fn clear(&mut self) {
        self.worst_bound = 0.0;
        self.margin = f64::INFINITY;
        self.escalated = false;
    }

    /// Sets a scalar output. `bound` is the absolute error bound of `value`; `sensitivity` the change of the exact value
    /// for a relative change of every input by one (to first order, in the worst direction).
    pub fn scalar(&mut self, output: usize, value: f64, bound: f64, sensitivity: f64) {
        self.values[self.offset(output)] = value;
        self.sensitivities[output] = sensitivity;
        self.certify(value, bound / f32_spacing(value));
    }

    /// Sets a vector that has a length. `bound` is the absolute error bound of `value` as the distance of the two, counted
    /// in f32 spacings of its norm; `sensitivity` the length of the exact value's change for a relative change of every
    /// input by one, infinite where the inputs do not define the vector (any finite one is right then).
    pub fn vector(&mut self, output: usize, value: glam::DVec3, bound: f64, sensitivity: f64) {
        let offset = self.offset(output);
        self.values[offset..offset + 3].copy_from_slice(&value.to_array());
        self.sensitivities[output] = sensitivity;
        if sensitivity.is_finite() {
            self.certify(value.length(), bound / f32_spacing(value.length()));
        }
    }

    /// Sets a unit vector; bound and sensitivity are angles in radians. An infinite sensitivity says that the direction
    /// is not defined by the inputs: any unit vector that keeps the family's relations is right.
    pub fn unit_vector(&mut self, output: usize, value: glam::DVec3, bound: f64, sensitivity: f64) {
        let offset = self.offset(output);
        self.values[offset..offset + 3].copy_from_slice(&value.to_array());
        self.sensitivities[output] = sensitivity;
        if sensitivity.is_finite() {
            self.certify(value.length(), bound / UNIT_ROUNDOFF);
        }
    }

    /// A value or a bound that is not a number certifies nothing.
    fn certify(&mut self, value: f64, bound: f64) {
        let bound = if value.is_nan() || bound.is_nan() { f64::INFINITY } else { bound };
        self.worst_bound = self.worst_bound.max(bound);
    }

    /// Sets how far the configuration is from the other class, a hit from a miss: the least relative change of every
    /// input (to first order, in the worst direction) that turns one into the other. Infinite unless set.
    pub fn set_margin(&mut self, margin: f64) {
        self.margin = margin;
    }

    /// The least relative change of every input that turns a hit into a miss or a miss into a hit.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Sets what a builtin returns, one value a component. `bound` is the absolute error bound of each; `limit` what the
    /// Vulkan specification permits as the length of the error, infinite where it promises nothing: the value may then
    /// be NaN. The limit takes the place of a sensitivity.
    pub fn builtin(&mut self, output: usize, value: &[f64], bound: f64, limit: f64) {
        let offset = self.offset(output);
        self.values[offset..offset + value.len()].copy_from_slice(value);
        self.sensitivities[output] = limit;
        if limit != f64::INFINITY {
            let missing = value.iter().any(|component| component.is_nan());
            let largest = value.iter().fold(0.0, |largest: f64, component| largest.max(component.abs()));
            self.certify(if missing { f64::NAN } else { largest }, bound / f32_spacing(largest));
        }
    }

    /// Notes that plain f64 did not do.
    pub fn escalate(&mut self) {
        self.escalated = true;
    }

    /// Whether plain f64 did not do.
    pub fn escalated(&self) -> bool {
        self.escalated
    }

    /// The largest error bound of any output in units of its f32 spacing (of 2^-24 rad for directions).
    pub fn worst_bound(&self) -> f64 {
        self.worst_bound
    }

    /// All components in column order.
    pub fn values(&self) -> &[f64] {
        &self.values[..self.offset(self.outputs)]
    }

    /// The components of one output.
    pub fn output(&self, output: usize) -> &[f64] {
        &self.values[self.offset(output)..][..self.components[output]]
    }

    /// Sensitivities, one an output; of a [`Quantity::Builtin`] the permitted error.
    pub fn sensitivities(&self) -> &[f64] {
        &self.sensitivities[..self.outputs]
    }

    fn offset(&self, output: usize) -> usize {
        self.components[..output].iter().sum()
    }
}

/// An oracle is certified where its bound is at most this much of the f32 spacing.
pub const CERTIFIED: f64 = 1.0 / 16.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// `f64::max` would drop NaN silently.
    #[test]
    fn what_is_not_a_number_is_not_certified() {
        const OUTPUTS: [Output; 1] = [Output::new("x", Type::Float, Quantity::Scalar, 1e-3)];
        let bound = |value, bound| {
            let mut truth = Truth::new(&OUTPUTS);
            truth.scalar(0, value, bound, 1.0);
            truth.worst_bound()
        };
        assert!(bound(1.0, 1e-12) <= CERTIFIED);
        assert!(bound(f64::NAN, 0.0) > CERTIFIED);
        assert!(bound(1.0, f64::NAN) > CERTIFIED);
    }

    /// A builtin's value need not be a number where nothing is promised, and only there.
    #[test]
    fn a_promise_is_certified() {
        const OUTPUTS: [Output; 1] = [Output::new("n", Type::Vec3, Quantity::Builtin, 1.0)];
        let bound = |value: [f64; 3], bound, limit| {
            let mut truth = Truth::new(&OUTPUTS);
            truth.builtin(0, &value, bound, limit);
            truth.worst_bound()
        };
        assert!(bound([0.0, 1.0, 0.0], 1e-12, 1e-6) <= CERTIFIED);
        assert!(bound([f64::NAN; 3], 0.0, f64::INFINITY) <= CERTIFIED);
        assert!(bound([0.0, f64::NAN, 1.0], 1e-12, 1e-6) > CERTIFIED);
        assert!(bound([0.0, 1.0, 0.0], f64::NAN, 1e-6) > CERTIFIED);
        assert!(bound([0.0, 1.0, 0.0], 1.0, 1e-6) > CERTIFIED);
        assert!(bound([f64::NAN; 3], 0.0, f64::NAN) > CERTIFIED);
    }
}
