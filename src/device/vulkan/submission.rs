//! One evaluation of a kernel: dispatches short enough for any watchdog, and their times.

use std::sync::Arc;
use std::time::Duration;

use super::columns::{Inputs, OutputColumns};
use super::engine::Engine;
use super::flight::Flight;
use super::lane::Extent;
use super::memory::Role;
use super::pace::{PROBE_ROWS, TARGET_NS, WARM_ROWS};
use super::pool::Lease;
use super::program::{Compiled, Program};
use crate::catalog::kernel::{Range, trap_of};
use crate::device::{Clock, Elapsed, Error, Outputs};

/// What unwritten outputs hold if outputs are poisoned: a signalling NaN that no arithmetic returns.
const POISON: u32 = 0x7fba_dbad;

/// A submission in flight. Dropping it waits for it.
pub struct Pending {
    engine: Arc<Engine>,
    /// `None` for no rows.
    flight: Option<Flight<Held>>,
    program: Program,
    rows: u32,
    /// Time already taken, by dispatches that were waited for.
    spent_ns: f64,
    /// Dispatches whose timestamps are still to be read, and their rows.
    queued: usize,
    queued_rows: u32,
}

/// What the dispatches use.
struct Held {
    inputs: Inputs,
    _program: Program,
    outputs: Lease,
    /// Where the host reads the outputs, if not in place.
    download: Option<Lease>,
}

impl Pending {
    /// Starts evaluating every row of `inputs`.
    ///
    /// Returns at once, but for a program's first rows, which are run and waited for to learn its pace, and
    /// but for devices timed by the host's clock: there each dispatch must have the queue to itself.
    pub(super) fn submit(engine: &Arc<Engine>, program: &Program, inputs: &Inputs) -> Result<Self, Error> {
        let compiled = &program.compiled;
        let rows = inputs.rows();
        if !compiled.pipeline.is_of(engine.logical()) || !inputs.is_of(engine) {
            return Err(Error::Shape(format!("{} or its inputs were made for another device", compiled.id)));
        }
        if inputs.columns() != compiled.inputs {
            return Err(Error::Shape(format!(
                "{} takes {} input columns, not {}",
                compiled.id,
                compiled.inputs,
                inputs.columns()
            )));
        }
        if rows as usize > engine.max_rows(compiled.outputs) {
            return Err(Error::Shape(format!(
                "{rows} rows of {}'s {} outputs are more than the {} that fit one buffer of this device",
                compiled.id,
                compiled.outputs,
                engine.max_rows(compiled.outputs)
            )));
        }
        let mut pending = Self {
            engine: Arc::clone(engine),
            flight: None,
            program: program.clone(),
            rows,
            spent_ns: 0.0,
            queued: 0,
            queued_rows: 0,
        };
        let Some(columns) = inputs.extent() else {
            return Ok(pending);
        };

        let bytes = u64::from(rows) * compiled.outputs as u64 * 4;
        let role = if engine.staging { Role::DeviceColumns } else { Role::SharedOutputs };
        let outputs = engine.pool.lease(role, bytes)?;
        let download = engine.staging.then(|| engine.pool.lease(Role::Download, bytes)).transpose()?;
        let written = Extent { buffer: outputs.handle(), bytes };
        let to = download.as_ref().map(|lease| lease.handle());
        let held = Held { inputs: inputs.clone(), _program: program.clone(), outputs, download };
        let flight = pending.flight.insert(Flight::new(engine, held)?);
        flight.lane().bind(columns, written);
        if engine.poison {
            let commands = flight.lane().record_fill(written, POISON)?;
            flight.submit(commands, false)?;
        }
        let done = pending.learn_pace()?;
        pending.dispatch(done, to.is_none())?;
        if let (Some(flight), Some(to)) = (&mut pending.flight, to) {
            let commands = flight.lane().record_copy(written, to)?;
            flight.submit(commands, true)?;
        }
        Ok(pending)
    }

    /// Runs the first rows of a program that has no estimate yet. Returns how many.
    fn learn_pace(&mut self) -> Result<u32, Error> {
        let program = self.program.clone();
        let pace = &program.pace;
        let mut done = 0;
        if pace.estimate().is_some() {
            return Ok(done);
        }
        // So few rows as one of these are a dispatch of their own, with nothing to split.
        if self.rows > WARM_ROWS {
            let ns = self.run_now(0, WARM_ROWS)?;
            done = WARM_ROWS;
            // Slow to compile or slow to run: a second dispatch as small tells, and is safe either way.
            let count = if ns > TARGET_NS { WARM_ROWS } else { PROBE_ROWS };
            if self.rows - done > count {
                let ns = self.run_now(done, count)?;
                done += count;
                pace.learn(ns, count);
            }
        }
        Ok(done)
    }

    /// Dispatches all rows from `first` on; the last dispatch bears the fence if nothing comes after
    /// (`last`).
    fn dispatch(&mut self, first: u32, last: bool) -> Result<(), Error> {
        let program = self.program.clone();
        let pace = &program.pace;
        let parts = pace.split(first, self.rows, self.engine.dispatch_limit());
        if self.engine.stopwatch.clock == Clock::HostFence {
            for (first, count) in parts {
                let ns = self.run_now(first, count)?;
                if program.teaches(count) {
                    pace.learn(ns, count);
                }
            }
            return Ok(());
        }
        let Some(flight) = &mut self.flight else {
            return Ok(());
        };
        flight.lane().reserve_timestamps(parts.len())?;
        flight.expect(pace.estimate().unwrap_or(0.0) * f64::from(self.rows - first));
        self.queued = parts.len();
        self.queued_rows = self.rows - first;
        let mut pairs = 0u32..;
        for (index, &(first, count)) in parts.iter().enumerate() {
            let range = Range { first, count, stride: self.rows, evaluations: self.program.evaluations };
            let commands = flight.lane().record_dispatch(
                &program.compiled,
                program.compiled.layout(&self.engine),
                range,
                pairs.next(),
            )?;
            flight.submit(commands, last && index + 1 == parts.len())?;
        }
        Ok(())
    }

    /// Dispatches some rows and waits for them. Returns their nanoseconds.
    fn run_now(&mut self, first: u32, count: u32) -> Result<f64, Error> {
        let Some(flight) = &mut self.flight else {
            return Ok(0.0);
        };
        let range = Range { first, count, stride: self.rows, evaluations: self.program.evaluations };
        let layout = self.program.compiled.layout(&self.engine);
        let ns = match self.engine.stopwatch.clock {
            Clock::HostFence => {
                let commands = flight.lane().record_dispatch(&self.program.compiled, layout, range, None)?;
                flight.run_alone(commands)?
            }
            Clock::DeviceTimestamps => {
                flight.lane().reserve_timestamps(1)?;
                let commands =
                    flight.lane().record_dispatch(&self.program.compiled, layout, range, Some(0))?;
                flight.submit(commands, true)?;
                flight.finish()?;
                elapsed_ns(&self.engine, &flight.lane().timestamps(1)?)
            }
        };
        self.spent_ns += ns;
        Ok(ns)
    }

    /// Waits for the device.
    pub(super) fn wait(mut self) -> Result<OutputColumns, Error> {
        let mut lease = None;
        if let Some(mut flight) = self.flight.take() {
            flight.finish()?;
            let ns = elapsed_ns(&self.engine, &flight.lane().timestamps(self.queued)?);
            self.spent_ns += ns;
            // Fewer rows say more of a dispatch's fixed cost than of the kernel.
            if self.program.teaches(self.queued_rows) {
                self.program.pace.learn(ns, self.queued_rows);
            }
            let held = flight.into_held();
            held.inputs.settle();
            lease = Some(held.download.unwrap_or(held.outputs));
        }
        let elapsed = Elapsed {
            time: Duration::from_secs_f64(self.spent_ns * 1e-9),
            clock: self.engine.stopwatch.clock,
        };
        let columns = OutputColumns::new(self.rows as usize, lease, elapsed);
        trapped(&self.program.compiled, &columns, self.rows as usize)?;
        Ok(columns)
    }
}

/// Fails if any result says that its kernel left its arrays; all of an invocation's do.
fn trapped(kernel: &Compiled, columns: &OutputColumns, rows: usize) -> Result<(), Error> {
    if kernel.traps.is_empty() || kernel.outputs == 0 {
        return Ok(());
    }
    let found = columns.column(0).iter().enumerate().find_map(|(row, value)| {
        let place = kernel.traps.get(trap_of(value.to_bits())?)?;
        Some(Error::OutOfBounds { kernel: kernel.id.clone(), place: place.clone(), row, rows })
    });
    found.map_or(Ok(()), Err)
}

/// The sum over pairs of timestamps.
fn elapsed_ns(engine: &Engine, stamps: &[u64]) -> f64 {
    stamps.chunks_exact(2).map(|pair| engine.stopwatch.ns(pair[0], pair[1])).sum()
}
