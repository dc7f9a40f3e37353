//! The throughput half of a run: its options, and what it does on one scenario.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};

use super::progress::bar;
use super::selection::{self, Selected};
use crate::audit::Chunk;
use crate::bench::{self, Ceilings, Contest, Effort, Entrant, Ranking, Regime, Setting, Timing};
use crate::catalog::{Operations, Variant};
use crate::device::Device;
use crate::device::vulkan::{Options, VulkanDevice};
use crate::family::{Problem, Scenario};

/// Options of timing.
#[derive(Args, Debug, Default)]
pub(super) struct TimingArguments {
    /// Seconds for each of streaming, coherent and divergent times, unless intervals are narrow before; 11 rounds over
    /// all variants are taken in any case [default: 3 for bench, 0.3 for run]
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,
    /// Only this regime; may be given again [default: both]
    #[arg(long, value_name = "REGIME", value_enum)]
    regime: Vec<RegimeName>,
    /// Variant to which ratios of times are taken [default: the fastest in a few trials before anything
    /// is counted, the same for all of a scenario's times]
    #[arg(long, value_name = "VARIANT")]
    reference: Option<String>,
    /// Take times from the host's clock, around submission and fence, also where the device has timestamps
    #[arg(long)]
    host_clock: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum RegimeName {
    /// One evaluation a configuration, from memory to memory
    Streaming,
    /// Many dependent evaluations in registers, with coherent and with divergent inputs
    Arithmetic,
}

impl TimingArguments {
    pub(super) fn check(&self) -> Result<()> {
        if self.seconds.is_some_and(|seconds| !(seconds > 0.0 && seconds <= 86_400.0)) {
            bail!("--seconds must be above 0 and at most 86400");
        }
        Ok(())
    }

    /// Fails on a reference that is not among the selected variants.
    pub(super) fn check_reference(&self, selected: &[Selected]) -> Result<()> {
        let Some(name) = &self.reference else {
            return Ok(());
        };
        let known = || selected.iter().flat_map(|selected| &selected.variants);
        if !known().any(|variant| is_named(variant, name)) {
            let names = known().map(|variant| variant.name.clone());
            bail!(
                "--reference '{name}' is not among the selected variants{}",
                selection::suggestion(name, names)
            );
        }
        Ok(())
    }

    /// How the device is to take times.
    pub(super) fn options(&self) -> Options {
        Options { ignore_timestamps: self.host_clock, ..Options::default() }
    }

    fn settings(&self) -> impl Iterator<Item = Setting> {
        let wanted = |regime: Regime| {
            let name = match regime {
                Regime::Streaming => RegimeName::Streaming,
                Regime::Arithmetic => RegimeName::Arithmetic,
            };
            self.regime.is_empty() || self.regime.contains(&name)
        };
        [Setting::STREAMING, Setting::COHERENT, Setting::DIVERGENT]
            .into_iter()
            .filter(move |setting| wanted(setting.regime))
    }
}

fn is_named(variant: &Variant, name: &str) -> bool {
    variant.name == name || variant.id() == name
}

/// How much to measure where nobody says.
#[derive(Clone, Copy, Debug)]
pub(super) enum Depth {
    /// Enough for a column beside an audit, which has just warmed the device up.
    Glance,
    /// Enough for a place that may be believed.
    Study,
}

impl Depth {
    fn effort(self) -> Effort {
        let (warm_up, time) = match self {
            Depth::Glance => (Duration::from_millis(100), Duration::from_millis(300)),
            Depth::Study => (Duration::from_millis(400), Duration::from_secs(3)),
        };
        Effort { warm_up, time, ..Effort::default() }
    }
}

/// What all timing of a run has in common.
pub(super) struct Timer<'a> {
    arguments: &'a TimingArguments,
    effort: Effort,
    pub(super) ceilings: Ceilings,
}

/// What is timed: variants, each with its operations and its evaluating program, on one scenario.
pub(super) struct Timed<'a> {
    pub(super) problem: &'static dyn Problem,
    pub(super) scenario: &'static Scenario,
    pub(super) seed: u64,
    pub(super) variants: Vec<&'a Variant>,
    pub(super) operations: Vec<Operations>,
    pub(super) programs: &'a [<VulkanDevice as Device>::Program],
}

impl<'a> Timer<'a> {
    /// Measures the device's ceilings.
    pub(super) fn new(
        arguments: &'a TimingArguments,
        device: &VulkanDevice,
        depth: Depth,
        stop: &AtomicBool,
    ) -> Result<Self> {
        let bar = bar(0, "ceilings", "{elapsed}");
        let ceilings = bench::ceilings(device, stop)?;
        bar.finish_and_clear();
        let mut effort = depth.effort();
        if let Some(seconds) = arguments.seconds {
            effort.time = Duration::from_secs_f64(seconds);
        }
        Ok(Timer { arguments, effort, ceilings })
    }

    /// One ranking a setting, and one timing a variant for each.
    pub(super) fn time(
        &self,
        timed: &Timed<'_>,
        device: &VulkanDevice,
        stop: &AtomicBool,
    ) -> Result<Vec<(Ranking, Vec<Timing>)>> {
        if timed.variants.is_empty() {
            return Ok(Vec::new());
        }
        let signature = timed.problem.signature();
        let repeats = self.arguments.settings().any(|setting| setting.regime == Regime::Arithmetic);
        let repeating = |variant: &Variant| -> Result<_> {
            Ok(device.program(&variant.compile_repeating(&signature)?.kernel)?)
        };
        let loops = if repeats {
            timed.variants.iter().map(|variant| repeating(variant)).collect::<Result<Vec<_>>>()?
        } else {
            Vec::new()
        };
        let null = Variant::null(&signature);
        let null_streaming = device.program(&null.compile(&signature, false)?.kernel)?;
        let null_loop = if repeats { Some(repeating(&null)?) } else { None };
        let entrant = |at: usize| Entrant {
            name: timed.variants[at].name.as_str(),
            streaming: &timed.programs[at],
            repeating: loops.get(at),
            operations: timed.operations[at],
        };
        let configurations =
            Chunk::draw_inputs(timed.problem, timed.scenario, timed.seed, 0, bench::CONFIGURATIONS);
        let reference = self.arguments.reference.as_ref();
        let mut contest = Contest {
            device,
            entrants: (0..timed.variants.len()).map(entrant).collect(),
            null: Entrant {
                name: &null.name,
                streaming: &null_streaming,
                repeating: null_loop.as_ref(),
                operations: Operations::default(),
            },
            inputs: signature.input_columns().len(),
            outputs: signature.output_columns().len(),
            configurations: &configurations,
            reference: reference
                .and_then(|name| timed.variants.iter().position(|variant| is_named(variant, name))),
            ceilings: Some(&self.ceilings),
        };
        let bar = bar(
            0,
            &format!("bench {}/{}", timed.problem.name(), timed.scenario.name),
            "{human_pos} samples {elapsed}",
        );
        let mut effort = self.effort;
        // One reference for all settings, or their ratios could not be read together: from the setting that ranks.
        if let (None, Some(setting)) = (contest.reference, self.arguments.settings().last()) {
            contest.reference = Some(contest.fastest(setting, &effort, stop)?);
        }
        let mut results = Vec::new();
        for setting in self.arguments.settings() {
            results.push(contest.run(setting, &effort, &|| bar.inc(1), stop)?);
            // The device has just been at work.
            effort.warm_up /= 4;
        }
        bar.finish_and_clear();
        Ok(results)
    }
}
