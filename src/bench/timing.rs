//! What a measurement says of one variant, and of the ranking in which it was taken.

use serde::{Deserialize, Serialize};

use super::Quartiles;
use crate::device::Clock;

/// How a kernel is exercised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Regime {
    /// One evaluation a configuration, inputs from memory and outputs to it: on a GPU this measures memory.
    #[default]
    Streaming,
    /// Many evaluations a configuration in registers, each input perturbed by the last output.
    Arithmetic,
}

/// What the invocations of a workgroup evaluate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Coherence {
    /// All the same configuration: they branch alike.
    Coherent,
    /// Independent draws of the scenario.
    #[default]
    Divergent,
}

/// Regime and coherence together: what one ranking is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Setting {
    #[serde(default)]
    pub regime: Regime,
    #[serde(default)]
    pub inputs: Coherence,
}

impl Setting {
    pub const STREAMING: Setting = Setting { regime: Regime::Streaming, inputs: Coherence::Divergent };
    pub const COHERENT: Setting = Setting { regime: Regime::Arithmetic, inputs: Coherence::Coherent };
    pub const DIVERGENT: Setting = Setting { regime: Regime::Arithmetic, inputs: Coherence::Divergent };

    /// What tables call it.
    pub fn name(self) -> &'static str {
        match (self.regime, self.inputs) {
            (Regime::Streaming, _) => "streaming",
            (Regime::Arithmetic, Coherence::Coherent) => "arithmetic, coherent",
            (Regime::Arithmetic, Coherence::Divergent) => "arithmetic, divergent",
        }
    }
}

/// Time of one variant in one setting.
///
/// Records from before there were two regimes have only `ns`, `clock`, `rounds`, `configurations` and `repeats`, and are
/// streaming.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    #[serde(flatten)]
    pub setting: Setting,
    /// Nanoseconds an evaluation, as measured: nothing is subtracted.
    pub ns: Quartiles,
    pub clock: Clock,
    /// Samples kept, interleaved with the other variants'.
    pub rounds: usize,
    /// Configurations a submission, and submissions a sample.
    pub configurations: usize,
    pub repeats: usize,
    /// Evaluations a configuration; 1 when streaming.
    #[serde(default = "once")]
    pub evaluations: u32,
    /// Time over the reference variant's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ratio: Option<Ratio>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rank: Option<Rank>,
    /// Shares of the run's ceilings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share: Option<Share>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<Bound>,
}

fn once() -> u32 {
    1
}

impl Timing {
    /// Evaluations a second, from the median.
    pub fn per_second(&self) -> f64 {
        1e9 / self.ns.median
    }
}

/// A ratio of times within rounds: the median over rounds, and its 95 % bootstrap interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    pub median: f64,
    pub low: f64,
    pub high: f64,
}

/// The places that the noise leaves open to a variant, 1 being the fastest: one more than the variants that are
/// certainly faster, to all but those that are certainly slower. Variants inside each other's noise share a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rank {
    pub first: usize,
    pub last: usize,
}

/// Parts of what the device could do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// Bytes of columns moved a second, over the best copy kernel's: at most 1, but for errors of measurement and caches.
    pub bandwidth: f64,
    /// The time that the counted operations take at their ceilings, one kind after the other, over the time measured:
    /// above 1 where a device's units work at once. With loops in the text, which count once, it is too low; with
    /// branches, of which both sides count, too high.
    pub arithmetic: f64,
}

/// What takes the time. The rule: where the null kernel (same loads, loop and stores, no evaluation) takes half of the
/// time or more, it is not the arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// Loads and stores, streaming.
    Memory,
    /// The timing loop itself, in the arithmetic regime.
    Loop,
    Compute,
}

/// What is true of all variants timed together on one scenario in one setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ranking {
    #[serde(flatten)]
    pub setting: Setting,
    /// The variant over whose time ratios are taken.
    pub reference: String,
    /// The null kernel's nanoseconds, taken in the same rounds.
    pub null_ns: Quartiles,
    /// The reference entered a second time, over the first: what is not 1 about it is noise.
    pub control: Ratio,
    /// Two variants whose median ratio is this close to 1 are not told apart, whatever their interval: the control's
    /// farther end, as a share (0.01: one per cent).
    pub noise: f64,
    /// Each variant's odd rounds against its even ones, by the rule that tells variants apart.
    pub self_comparisons: usize,
    /// How many of them it told apart: each a false positive.
    pub false_positives: usize,
    pub stopped: Stop,
    /// Rounds kept, and rounds discarded for being throttled.
    pub rounds: usize,
    pub discarded: usize,
    pub seconds: f64,
}

/// Why sampling ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// Every ratio's interval is narrow enough.
    Narrow,
    /// Time is up.
    Time,
    /// The most rounds were taken.
    Rounds,
}

/// What the device does at best, measured in the same run: operations or bytes a second, each of the best of several
/// kernels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ceilings {
    /// Bytes read plus bytes written.
    pub copy: Ceiling,
    /// f32 operations, a multiply-add counting two.
    pub multiply_add: Ceiling,
    /// Results of inversesqrt, of division, of sin and of exp2.
    pub inverse_sqrt: Ceiling,
    pub divide: Ceiling,
    pub sine: Ceiling,
    pub exp2: Ceiling,
}

/// One of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ceiling {
    pub per_second: f64,
    /// The kernel that reached it.
    pub kernel: String,
}
