//! Variants timed against each other on a device.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::ceilings::no_loops;
use super::trial::{Loaned, Trial};
use super::{
    Bound, Ceilings, Coherence, Effort, Quartiles, Ranking, Regime, Setting, Share, Timing, rounds, standing,
};
use crate::audit::Stopped;
use crate::catalog::Operations;
use crate::catalog::kernel::LOCAL_SIZE;
use crate::device::{self, Device};

/// Configurations that are drawn of a scenario: columns too large for most caches.
pub const CONFIGURATIONS: usize = 1 << 18;

/// A GPU streams through them again and again, up to so many and so many bytes a side, lest it measure its cache and the
/// submission.
const STREAMED: usize = 1 << 22;
const STREAMED_BYTES: usize = 512 << 20;
/// Fewer are streamed where a submission would take longer than this, but not fewer than that.
const LONGEST: Duration = Duration::from_millis(50);
const LEAST_STREAMED: usize = 1 << 14;

/// Invocations in the arithmetic regime: some for every lane of a device, of which a software device has few.
const LANES_SOFTWARE: usize = 1 << 12;
const LANES: usize = 1 << 20;
/// Not longer than this, or the device would split a dispatch and leave lanes idle.
const LONGEST_LOOP: Duration = Duration::from_millis(30);
/// Evaluations an invocation: enough for loads and stores not to matter, few enough for a watchdog.
const EVALUATIONS: std::ops::RangeInclusive<u32> = 16..=4096;

/// Submissions a sample at most.
const MAX_REPEATS: usize = 64;
/// A sample lasts at least so long, and no longer than that for the sake of a long sample.
const SHORTEST_SAMPLE: Duration = Duration::from_millis(2);
const LONGEST_SAMPLE: Duration = Duration::from_millis(40);
/// Trials of each variant, in turns, whose least time says which is the fastest: one alone is as good as its noise.
const TRIALS: usize = 7;
/// Rounds that ought to fit into the time given.
const WANTED_ROUNDS: u32 = 40;

/// Where the null kernel takes this much of a variant's time, the time is not the arithmetic's.
const NOT_ARITHMETIC: f64 = 0.5;

/// A variant's programs.
pub struct Entrant<'a, D: Device> {
    pub name: &'a str,
    pub streaming: &'a D::Program,
    /// Of a kernel that repeats its evaluation; needed in the arithmetic regime.
    pub repeating: Option<&'a D::Program>,
    pub operations: Operations,
}

/// Who is timed, on what.
pub struct Contest<'a, D: Device> {
    pub device: &'a D,
    /// At least one.
    pub entrants: Vec<Entrant<'a, D>>,
    /// The null kernel of the same signature.
    pub null: Entrant<'a, D>,
    /// Columns of inputs and of outputs.
    pub inputs: usize,
    pub outputs: usize,
    /// Row-major, at least one row; see [`CONFIGURATIONS`].
    pub configurations: &'a [f32],
    /// Position of the variant to which ratios are taken; `None`: the [fastest](Contest::fastest) in the setting itself.
    pub reference: Option<usize>,
    pub ceilings: Option<&'a Ceilings>,
}

impl<D: Device> Contest<'_, D> {
    /// Position of the entrant with the least time of several trials in turns, before anything is counted: a reference
    /// for rankings in this setting and others. Entrants about as fast may change places from call to call.
    pub fn fastest(&self, setting: Setting, effort: &Effort, stop: &AtomicBool) -> Result<usize, Stopped> {
        let times = self.trial(setting, self.sample(effort), stop)?.least(TRIALS)?;
        Ok(least(&times[..self.entrants.len()]))
    }

    /// How long a sample is to last, so that the wanted rounds fit; the control and the null kernel come on top.
    fn sample(&self, effort: &Effort) -> Duration {
        let sample = effort.time / (WANTED_ROUNDS * (self.entrants.len() as u32 + 2));
        sample.clamp(SHORTEST_SAMPLE, LONGEST_SAMPLE)
    }

    fn trial<'b>(
        &'b self,
        setting: Setting,
        sample: Duration,
        stop: &'b AtomicBool,
    ) -> Result<Trial<'b, D>, Stopped> {
        match setting.regime {
            Regime::Streaming => self.streaming(stop),
            Regime::Arithmetic => self.arithmetic(setting.inputs, sample, stop),
        }
    }

    /// Takes the time of all entrants in one setting. `advance` hears of each sample.
    pub fn run(
        &self,
        setting: Setting,
        effort: &Effort,
        advance: &dyn Fn(),
        stop: &AtomicBool,
    ) -> Result<(Ranking, Vec<Timing>), Stopped> {
        let entrants = self.entrants.len();
        let sample = self.sample(effort);
        let mut trial = self.trial(setting, sample, stop)?;
        let times = trial.least(if self.reference.is_none() { TRIALS } else { 1 })?;
        if times.iter().all(Duration::is_zero) {
            return Err(device::Error::NotSupported {
                kernel: "timing".to_owned(),
                what: "timestamps that advance (--host-clock does without)".to_owned(),
            }
            .into());
        }
        let reference = self.reference.unwrap_or_else(|| least(&times[..entrants]));
        trial.entries.insert(entrants, reference);
        let repeats = trial.entries.iter().map(|program| {
            let needed = sample.as_secs_f64() / times[*program].as_secs_f64().max(1e-9);
            (needed.ceil() as usize).clamp(1, MAX_REPEATS)
        });
        trial.repeats = repeats.collect();
        trial.advance = advance;
        let taken = rounds(&mut trial, reference, effort)?;

        let (control, null) = (&taken.samples[entrants], &taken.samples[entrants + 1]);
        let quartiles =
            |samples: &Vec<f64>| Quartiles::of(samples).expect("at least one round is taken and kept");
        let null_ns = quartiles(null);
        let quartiles: Vec<Quartiles> = taken.samples.iter().map(quartiles).collect();
        let bounds: Vec<Bound> = quartiles[..entrants]
            .iter()
            .map(|ns| match setting.regime {
                _ if null_ns.median < NOT_ARITHMETIC * ns.median => Bound::Compute,
                Regime::Streaming => Bound::Memory,
                Regime::Arithmetic => Bound::Loop,
            })
            .collect();
        let alike = |a: usize, b: usize| bounds[a] != Bound::Compute && bounds[b] != Bound::Compute;
        let standing = standing(&taken.samples[..entrants], reference, control, &alike);
        let timings = (0..entrants)
            .map(|entrant| Timing {
                setting,
                ns: quartiles[entrant],
                clock: trial.clock,
                rounds: taken.samples[entrant].len(),
                configurations: trial.rows,
                repeats: trial.repeats[entrant],
                evaluations: trial.evaluations,
                ratio: Some(standing.ratios[entrant]),
                rank: Some(standing.ranks[entrant]),
                share: self.share(&self.entrants[entrant], quartiles[entrant].median, trial.evaluations),
                bound: Some(bounds[entrant]),
            })
            .collect();
        let ranking = Ranking {
            setting,
            reference: self.entrants[reference].name.to_owned(),
            null_ns,
            control: standing.control,
            noise: standing.noise,
            self_comparisons: standing.self_comparisons,
            false_positives: standing.false_positives,
            stopped: taken.stopped,
            rounds: taken.samples[0].len(),
            discarded: taken.discarded,
            seconds: taken.time.as_secs_f64(),
        };
        Ok((ranking, timings))
    }

    /// What part of the ceilings a time of `ns` an evaluation is.
    fn share(&self, entrant: &Entrant<'_, D>, ns: f64, evaluations: u32) -> Option<Share> {
        let ceilings = self.ceilings?;
        let bytes = ((self.inputs + self.outputs) * size_of::<f32>()) as f64 / f64::from(evaluations);
        let seconds = ns * 1e-9;
        Some(Share {
            bandwidth: bytes / ceilings.copy.per_second / seconds,
            arithmetic: ceilings.seconds(&entrant.operations) / seconds,
        })
    }

    fn programs(&self) -> impl Iterator<Item = &Entrant<'_, D>> {
        self.entrants.iter().chain([&self.null])
    }

    fn rows(&self) -> usize {
        self.configurations.len() / self.inputs
    }

    /// Columns of the drawn configurations, repeated or shortened to `rows`; coherent ones are the same throughout a
    /// workgroup.
    fn upload(&self, rows: usize, coherence: Coherence) -> Result<D::Inputs, Stopped> {
        let drawn = |row: usize| match coherence {
            Coherence::Coherent => row / LOCAL_SIZE as usize % self.rows(),
            Coherence::Divergent => row % self.rows(),
        };
        let mut columns = Vec::with_capacity(rows * self.inputs);
        for row in 0..rows {
            columns.extend_from_slice(&self.configurations[drawn(row) * self.inputs..][..self.inputs]);
        }
        Ok(self.device.upload(&columns, self.inputs)?)
    }

    fn is_software(&self) -> bool {
        self.device.facts().kind == "cpu"
    }

    /// Programs and columns for the streaming regime.
    fn streaming<'b>(&'b self, stop: &'b AtomicBool) -> Result<Trial<'b, D>, Stopped> {
        let programs: Vec<Loaned<'_, D>> =
            self.programs().map(|entrant| Loaned::Borrowed(entrant.streaming)).collect();
        let most = self.device.max_rows(self.inputs, self.outputs);
        let few = LEAST_STREAMED.min(self.rows()).min(most);
        let mut trial =
            Trial::new(self.device, programs, self.upload(few, Coherence::Divergent)?, few, 1, stop);
        let slowest = trial.least(1)?.into_iter().max().unwrap_or_default();
        let fitting = LONGEST.as_secs_f64() / (slowest.as_secs_f64() / few as f64).max(1e-12);
        let wanted = if self.is_software() {
            CONFIGURATIONS
        } else {
            STREAMED.min(STREAMED_BYTES / (size_of::<f32>() * self.inputs.max(self.outputs)))
        };
        // Whole powers of two, so that runs on the same machine have the same shape.
        let rows = (1 << fitting.clamp(1.0, 1e9).log2() as u32).clamp(few, wanted.max(few)).min(most);
        trial.inputs = self.upload(rows, Coherence::Divergent)?;
        trial.rows = rows;
        Ok(trial)
    }

    /// Programs and columns for the arithmetic regime, where the slowest takes up to four samples' time.
    fn arithmetic<'b>(
        &'b self,
        coherence: Coherence,
        sample: Duration,
        stop: &'b AtomicBool,
    ) -> Result<Trial<'b, D>, Stopped> {
        let lanes = if self.is_software() { LANES_SOFTWARE } else { LANES };
        let rows = lanes.min(self.device.max_rows(self.inputs, self.outputs));
        let inputs = self.upload(rows, coherence)?;
        let programs = |evaluations: u32| {
            let repeating = |entrant: &Entrant<'_, D>| {
                let program = entrant.repeating.ok_or_else(|| no_loops(entrant.name))?;
                let repeating = self.device.repeating(program, evaluations);
                repeating.map(Loaned::Owned).ok_or_else(|| no_loops(entrant.name))
            };
            self.programs().map(repeating).collect::<Result<Vec<_>, _>>()
        };
        let few = *EVALUATIONS.start();
        let mut trial = Trial::new(self.device, programs(few)?, inputs, rows, few, stop);
        let slowest = trial.least(1)?.into_iter().max().unwrap_or_default();
        let fitting = (4 * sample).min(LONGEST_LOOP).as_secs_f64()
            / (slowest.as_secs_f64() / f64::from(few)).max(1e-12);
        trial.evaluations = (1 << fitting.clamp(1.0, 1e9).log2() as u32).clamp(few, *EVALUATIONS.end());
        trial.programs = programs(trial.evaluations)?;
        Ok(trial)
    }
}

fn least(times: &[Duration]) -> usize {
    (0..times.len()).min_by_key(|entrant| times[*entrant]).unwrap_or(0)
}

impl Ceilings {
    /// The time that so many operations take at their ceilings, one kind after the other. It is no lower bound where a
    /// device's units work at once.
    pub fn seconds(&self, operations: &Operations) -> f64 {
        let Operations { flops, divisions, roots, trigonometric, exponential, .. } = *operations;
        [
            (flops, &self.multiply_add),
            (divisions, &self.divide),
            (roots, &self.inverse_sqrt),
            (trigonometric, &self.sine),
            (exponential, &self.exp2),
        ]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, ceiling)| *count as f64 / ceiling.per_second)
        .sum()
    }
}

#[cfg(test)]
mod tests;
