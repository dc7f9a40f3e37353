//! The schema of `run.json`.
//!
//! Numbers that may be infinite are `null` where they are. Rates carry their 95 % interval. A reader must refuse a
//! `schema` above its own [`SCHEMA`]; fields may be added without raising it, never changed in meaning.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize};

use super::hunt::Hunt;
use crate::audit::Verdict;
use crate::bench::{Ceilings, Ranking, Setting, Timing, rate_interval};
use crate::{catalog, device};

/// Version of this schema.
pub const SCHEMA: u32 = 1;

/// One recorded execution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    pub schema: u32,
    pub program: Program,
    /// The command line, program name included.
    pub command: Vec<String>,
    /// RFC 3339, UTC.
    pub started: String,
    pub seconds: f64,
    pub host: Host,
    pub device: device::Facts,
    pub settings: Settings,
    /// Absent if no times were taken, or by a version that did not measure them.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub ceilings: Option<Ceilings>,
    pub families: Vec<Family>,
}

/// Which rootq this was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Program {
    pub version: String,
    /// Git revision of the build; empty if it was not built from a repository.
    pub revision: String,
    /// Sources differed from that revision.
    pub dirty: bool,
    /// Shader compiler and its version.
    pub compiler: String,
}

/// The machine around the device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Host {
    pub os: String,
    pub arch: String,
    pub threads: usize,
}

/// What, with the program's revision and the device, repeats the run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    pub seed: u64,
    /// Configurations a scenario; of a hunt, its evaluations a scenario, or 0 if time was its limit.
    pub configurations: u64,
    pub chunk: usize,
    pub max_failures: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Family {
    pub name: String,
    pub summary: String,
    pub outputs: Vec<Output>,
    pub landmarks: Vec<Landmark>,
    pub scenarios: Vec<Scenario>,
    pub variants: Vec<Variant>,
}

/// One result of the family's function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Output {
    pub name: String,
    /// How its error is measured: `magnitude`, `scalar`, `solid_angle` and `vector` (relative), `unit_vector` (radians),
    /// `irradiance` and `vector_irradiance` (absolute, the full hemisphere being 1), `coordinate` (absolute), `property`
    /// (the largest residual of what must hold), `builtin` (a share of the permitted error).
    pub quantity: String,
    pub tolerance: f64,
    pub headline: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Landmark {
    pub name: String,
    pub summary: String,
    /// Bin k holds `edges[k-1] <= coordinate < edges[k]`.
    pub edges: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scenario {
    pub name: String,
    pub summary: String,
    /// Digest of all configurations' bits, in hexadecimal: where two runs agree in it, they had the same configurations.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub inputs: Option<String>,
    /// Absent if only times were taken.
    pub oracle: Option<Oracle>,
    /// One a setting in which times were taken: what its timings have in common.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub rankings: Vec<Ranking>,
}

impl Scenario {
    /// The ranking of that setting, if times were taken in it.
    pub fn ranking(&self, setting: Setting) -> Option<&Ranking> {
        self.rankings.iter().find(|ranking| ranking.setting == setting)
    }
}

/// The oracle's own certainty.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Oracle {
    /// Configurations for which plain f64 did not do.
    pub escalations: u64,
    /// Configurations whose bound stayed above 1/16 of the f32 spacing.
    pub uncertified: u64,
    /// Largest bound in units of the f32 spacing; `null` if infinite.
    #[serde(deserialize_with = "null_is_infinite")]
    pub worst_bound: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    pub name: String,
    pub file: String,
    pub summary: String,
    pub source: String,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tried: Option<String>,
    /// Decorated NoContraction throughout by the harness.
    pub precise: bool,
    /// Built-in tables that it reads, and how; the program's revision says what is in them.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub tables: BTreeMap<String, catalog::TableForm>,
    pub spirv: catalog::Facts,
    /// Of a shader that is not built in: its language. The run keeps its module, `shaders/<family>.<variant>.spv`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub own: Option<catalog::Language>,
    /// Why this device could not run it; then there are no results.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub skipped: Option<String>,
    pub results: Vec<Result>,
}

impl Variant {
    /// Its file as seen from the source tree, or as it was given.
    pub fn path(&self) -> String {
        if self.own.is_some() { self.file.clone() } else { format!("glsl/{}", self.file) }
    }
}

/// One variant on one scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Result {
    pub scenario: String,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub audit: Option<Audit>,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub timing: Option<Timing>,
    /// Times in the arithmetic regime; `timing` is the streaming one.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub arithmetic: Vec<Timing>,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub hunt: Option<Hunt>,
}

impl Result {
    /// All times, whatever the regime.
    pub fn timings(&self) -> impl Iterator<Item = &Timing> {
        self.timing.iter().chain(&self.arithmetic)
    }

    /// The time in that setting, if it was taken.
    pub fn timing_in(&self, setting: Setting) -> Option<&Timing> {
        self.timings().find(|timing| timing.setting == setting)
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audit {
    pub configurations: u64,
    /// Verdicts that occurred.
    pub verdicts: BTreeMap<Verdict, Rate>,
    /// All verdicts that blame the variant, together.
    pub failed: Rate,
    /// In the order of the family's outputs.
    pub outputs: Vec<OutputAudit>,
    /// In the order of the family's landmarks; bins nobody fell into are left out.
    pub landmarks: Vec<Vec<Bin>>,
}

impl Audit {
    /// Configurations with that verdict.
    pub fn verdict(&self, verdict: Verdict) -> Rate {
        self.verdicts.get(&verdict).copied().unwrap_or_else(|| {
            let (low, high) = rate_interval(0, self.configurations);
            Rate { count: 0, rate: 0.0, low, high }
        })
    }

    /// The worst error of one of these outputs; none if it is not finite somewhere.
    pub fn worst(&self, output: &OutputAudit) -> Option<Worst> {
        let not_finite = output.error.buckets.reaches_last() && self.verdict(Verdict::NonFinite).count > 0;
        output.worst.filter(|_| !not_finite)
    }
}

/// A count and the 95 % interval of the rate behind it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    pub count: u64,
    pub rate: f64,
    pub low: f64,
    pub high: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutputAudit {
    pub name: String,
    /// Error beyond the tolerance, not finite, or not to be had because only one of truth and variant is a miss; whoever
    /// is to blame.
    pub beyond: Rate,
    pub visible: Visible,
    /// In the quantity's own measure; of the configurations where neither truth nor variant is a miss, as all that follow.
    pub error: Distribution,
    /// Units of the f32 spacing at the unrounded truth.
    pub ulp: Distribution,
    /// Multiples of what rounding each input once may do.
    pub conditioned: Distribution,
    /// The worst finite error.
    pub worst: Option<Worst>,
    /// Of a builtin: the worst configurations themselves.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub extremes: Option<Extremes>,
}

/// The worst finite errors of a builtin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// In units in the last place, where the specification promises anything.
    pub ulp: Option<Specimen>,
    /// As a share of the permitted error.
    pub share: Option<Specimen>,
    /// Absolute or relative, whichever is less, where the specification promises nothing.
    pub unspecified: Option<Specimen>,
}

/// One configuration and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Specimen {
    /// The error, as the field says that holds it.
    pub size: f64,
    pub index: u64,
    /// In the order of input columns; `null` where infinite or not a number.
    #[serde(deserialize_with = "null_is_nan")]
    pub inputs: Vec<f32>,
    pub output: Vec<Option<f32>>,
    /// `null` where infinite or not a number.
    #[serde(deserialize_with = "null_is_nan")]
    pub truth: Vec<f64>,
    /// The permitted error; `null` where nothing is promised.
    pub limit: Option<f64>,
}

/// Configurations whose error is at least one step of a display or frame buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Visible {
    pub bits8: u64,
    pub bits10: u64,
    pub half: u64,
}

/// Quantiles as upper bounds, each at most a quarter too high; `null` if infinite or not a number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distribution {
    pub p50: Option<f64>,
    pub p90: Option<f64>,
    pub p99: Option<f64>,
    pub p999: Option<f64>,
    pub buckets: Buckets,
}

/// Counts of consecutive buckets. Bucket 0 is below 2^-64; bucket b from 1 to 512 is from q(b - 1) up to q(b), where
/// q(b) = 2^(floor(b/4) - 64) (1 + (b mod 4)/4); bucket 513 is 2^64 or more, infinite, or not a number.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Buckets {
    pub first: usize,
    pub counts: Vec<u64>,
}

impl Buckets {
    /// The bucket of what is 2^64 or more, infinite, or not a number.
    pub const LAST: usize = 513;

    /// Where a bucket begins.
    pub fn start(bucket: usize) -> f64 {
        match bucket {
            0 => 0.0,
            _ => {
                let (octave, quarter) = ((bucket - 1) / 4, (bucket - 1) % 4);
                libm::ldexp(1.0 + quarter as f64 / 4.0, octave as i32 - 64)
            }
        }
    }

    fn reaches_last(&self) -> bool {
        self.first + self.counts.len() > Buckets::LAST
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    pub error: f64,
    /// Configuration, to be drawn again from seed and scenario.
    pub index: u64,
    /// Largest finite error in ULP, not always at the same index.
    pub ulp: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bin {
    pub bin: usize,
    pub verdicts: BTreeMap<Verdict, u64>,
    /// One an output.
    pub beyond: Vec<u64>,
}

/// JSON has no infinities: they are written as `null`.
fn null_is_infinite<'de, D: Deserializer<'de>>(deserializer: D) -> std::result::Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
}

fn null_is_nan<'de, T, D>(deserializer: D) -> std::result::Result<Vec<T>, D::Error>
where
    T: Deserialize<'de> + From<f32>,
    D: Deserializer<'de>,
{
    let values: Vec<Option<T>> = Vec::deserialize(deserializer)?;
    Ok(values.into_iter().map(|value| value.unwrap_or_else(|| T::from(f32::NAN))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Coherence;

    /// What JSON cannot hold is written as `null`, and a record with it is read all the same.
    #[test]
    fn numbers_that_json_lacks_are_read_back() {
        let oracle = Oracle { escalations: 1, uncertified: 1, worst_bound: f64::INFINITY };
        let text = serde_json::to_string(&oracle).unwrap();
        assert!(text.contains("null"), "{text}");
        assert_eq!(serde_json::from_str::<Oracle>(&text).unwrap(), oracle);
        let specimen = Specimen {
            size: 1.0,
            index: 2,
            inputs: vec![1.5, f32::INFINITY],
            output: vec![None],
            truth: vec![f64::NAN],
            limit: None,
        };
        let text = serde_json::to_string(&specimen).unwrap();
        let read: Specimen = serde_json::from_str(&text).unwrap();
        assert!(read.inputs[0] == 1.5 && read.inputs[1].is_nan() && read.truth[0].is_nan());
    }

    /// A timing as version 1 of the schema first had it.
    #[test]
    fn times_of_earlier_records_are_streaming() {
        let earlier = r#"{"scenario": "scene", "timing": {"ns": {"lower": 1.0, "median": 2.0, "upper": 3.0},
            "clock": "device_timestamps", "rounds": 7, "configurations": 262144, "repeats": 1}}"#;
        let result: Result = serde_json::from_str(earlier).unwrap();
        let timing = result.timing_in(Setting::STREAMING).unwrap();
        assert_eq!((timing.ns.median, timing.evaluations, timing.rank), (2.0, 1, None));
        assert_eq!(result.timing_in(Setting::DIVERGENT), None);
    }

    #[test]
    fn a_timing_keeps_its_setting() {
        let written = serde_json::to_value(Setting::COHERENT).unwrap();
        assert_eq!(written, serde_json::json!({"regime": "arithmetic", "inputs": "coherent"}));
        assert_eq!(serde_json::from_value::<Setting>(written).unwrap().inputs, Coherence::Coherent);
    }
}
