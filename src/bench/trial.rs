//! Programs on columns, submitted again and again: where a contest's samples come from.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::Sampler;
use crate::audit::Stopped;
use crate::device::{Clock, Device, Outputs};

/// A program of the entrant's or made for the contest.
pub(super) enum Loaned<'a, D: Device> {
    Borrowed(&'a D::Program),
    Owned(D::Program),
}

impl<D: Device> Loaned<'_, D> {
    fn get(&self) -> &D::Program {
        match self {
            Loaned::Borrowed(program) => program,
            Loaned::Owned(program) => program,
        }
    }
}

/// Programs and columns that belong together: the source of samples.
pub(super) struct Trial<'a, D: Device> {
    device: &'a D,
    pub(super) programs: Vec<Loaned<'a, D>>,
    pub(super) inputs: D::Inputs,
    pub(super) rows: usize,
    pub(super) evaluations: u32,
    /// Which program each entry is.
    pub(super) entries: Vec<usize>,
    /// Submissions a sample of each entry.
    pub(super) repeats: Vec<usize>,
    pub(super) clock: Clock,
    start: Instant,
    pub(super) advance: &'a dyn Fn(),
    stop: &'a AtomicBool,
}

impl<'a, D: Device> Trial<'a, D> {
    pub(super) fn new(
        device: &'a D,
        programs: Vec<Loaned<'a, D>>,
        inputs: D::Inputs,
        rows: usize,
        evaluations: u32,
        stop: &'a AtomicBool,
    ) -> Self {
        let entries: Vec<usize> = (0..programs.len()).collect();
        Trial {
            device,
            repeats: vec![1; entries.len()],
            entries,
            programs,
            inputs,
            rows,
            evaluations,
            clock: Clock::DeviceTimestamps,
            start: Instant::now(),
            advance: &|| (),
            stop,
        }
    }

    fn submission(&mut self, program: usize) -> Result<Duration, Stopped> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Stopped::Interrupted);
        }
        let pending = self.device.submit(self.programs[program].get(), &self.inputs)?;
        let elapsed = self.device.wait(pending)?.elapsed();
        self.clock = elapsed.clock;
        Ok(elapsed.time)
    }

    /// The least time of so many submissions of each program, taken in turns, after one that may pay for first use.
    pub(super) fn least(&mut self, trials: usize) -> Result<Vec<Duration>, Stopped> {
        for program in 0..self.programs.len() {
            self.submission(program)?;
        }
        let mut times = vec![Duration::MAX; self.programs.len()];
        for _ in 0..trials {
            for (program, time) in times.iter_mut().enumerate() {
                *time = self.submission(program)?.min(*time);
            }
        }
        Ok(times)
    }
}

impl<D: Device> Sampler for Trial<'_, D> {
    type Error = Stopped;

    fn entries(&self) -> usize {
        self.entries.len()
    }

    fn sample(&mut self, entry: usize) -> Result<f64, Stopped> {
        let mut time = Duration::ZERO;
        for _ in 0..self.repeats[entry] {
            time += self.submission(self.entries[entry])?;
        }
        (self.advance)();
        let evaluations = self.repeats[entry] as f64 * self.rows as f64 * f64::from(self.evaluations);
        // A clock too coarse to see a sample must not make a ratio of it zero or infinite.
        Ok((time.as_secs_f64() * 1e9 / evaluations).max(1e-9))
    }

    fn now(&self) -> Duration {
        self.start.elapsed()
    }
}
