//! Commands on their way through the device, and what they need until they are through.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use ash::vk;

use super::call::{Named, lock};
use super::engine::Engine;
use super::lane::Lane;
use crate::device::Error;

/// One wait for a fence.
const WAIT_STEP_NS: u64 = 10_000_000_000;
/// Waits without any backlog before a submission counts as hung: two minutes, where a dispatch is made to
/// take a twentieth of a second.
const WAIT_STEPS: u64 = 12;
/// How many times longer than expected the backlog may take on top.
const PATIENCE: u64 = 4;

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// The device has nothing of this.
    Idle,
    /// Commands are submitted, the last of them without the fence.
    Unfenced,
    /// The fence will tell when all are finished.
    Fenced,
    /// The device is gone, and so is its use of anything.
    Lost,
    /// The device may be at it forever.
    Hung,
}

/// A lane and whatever its commands use, `held` until the device is done.
pub(super) struct Flight<H> {
    engine: Arc<Engine>,
    lane: Option<Lane>,
    held: Option<H>,
    state: State,
    expected_ns: u64,
}

impl<H> Flight<H> {
    pub(super) fn new(engine: &Arc<Engine>, held: H) -> Result<Self, Error> {
        let lane = engine.lane()?;
        Ok(Self {
            engine: Arc::clone(engine),
            lane: Some(lane),
            held: Some(held),
            state: State::Idle,
            expected_ns: 0,
        })
    }

    pub(super) fn lane(&mut self) -> &mut Lane {
        self.lane.as_mut().expect("a flight has its lane until it is dropped")
    }

    /// Tells how long the device is going to be at it, so that nobody takes a long queue for a hung one.
    pub(super) fn expect(&mut self, ns: f64) {
        let ns = ns as u64;
        self.expected_ns += ns;
        self.engine.backlog_ns.fetch_add(ns, Ordering::Relaxed);
    }

    /// Submits one command buffer; the last one of all with the fence.
    pub(super) fn submit(&mut self, commands: vk::CommandBuffer, last: bool) -> Result<(), Error> {
        let engine = Arc::clone(&self.engine);
        let queue = lock(&engine.queue);
        self.submit_to(*queue, &[commands], last)
    }

    /// Submits one command buffer and waits for it, alone on the queue. Returns the host's nanoseconds for
    /// both.
    pub(super) fn run_alone(&mut self, commands: vk::CommandBuffer) -> Result<f64, Error> {
        let engine = Arc::clone(&self.engine);
        let queue = lock(&engine.queue);
        // What was submitted before is not to be timed here. A fence, since vkQueueWaitIdle may wait forever.
        self.submit_to(*queue, &[], true)?;
        self.finish()?;
        let start = Instant::now();
        self.submit_to(*queue, &[commands], true)?;
        self.finish()?;
        Ok(start.elapsed().as_secs_f64() * 1e9)
    }

    fn submit_to(
        &mut self,
        queue: vk::Queue,
        commands: &[vk::CommandBuffer],
        last: bool,
    ) -> Result<(), Error> {
        let fence = if last { self.lane().fence.get() } else { vk::Fence::null() };
        let submit = [vk::SubmitInfo::default().command_buffers(commands)];
        // SAFETY: the caller has locked the queue; the commands are recorded in this flight's lane, which
        // stays, as does all they use, until the fence; the fence is unsignalled, for `finish` resets it.
        let result = unsafe { self.engine.logical().device.queue_submit(queue, &submit, fence) };
        match result {
            Ok(()) => self.state = if last { State::Fenced } else { State::Unfenced },
            Err(vk::Result::ERROR_DEVICE_LOST) => self.state = State::Lost,
            Err(_) => {}
        }
        result.named("vkQueueSubmit")
    }

    /// Waits for the fence, if one is out, and makes it ready for another submission.
    pub(super) fn finish(&mut self) -> Result<(), Error> {
        if self.state != State::Fenced {
            return Ok(());
        }
        let fence = [self.lane().fence.get()];
        let device = &self.engine.logical().device;
        let backlog = self.engine.backlog_ns.load(Ordering::Relaxed);
        let steps = WAIT_STEPS + PATIENCE * (backlog / WAIT_STEP_NS);
        let mut result = Err(vk::Result::TIMEOUT);
        for _ in 0..steps {
            // SAFETY: the fence is this device's and submitted.
            result = unsafe { device.wait_for_fences(&fence, true, WAIT_STEP_NS) };
            if result != Err(vk::Result::TIMEOUT) {
                break;
            }
        }
        self.state = match result {
            Ok(()) => State::Idle,
            Err(vk::Result::ERROR_DEVICE_LOST) => State::Lost,
            Err(_) => State::Hung,
        };
        result.named("vkWaitForFences")?;
        // SAFETY: the fence is signalled and in no submission.
        let reset = unsafe { device.reset_fences(&fence) };
        if reset.is_err() {
            // Nothing is in flight, but the lane cannot be used again.
            self.state = State::Lost;
        }
        reset.named("vkResetFences")
    }

    /// What was held, once [`finish`](Self::finish) has succeeded.
    pub(super) fn into_held(mut self) -> H {
        debug_assert!(self.state == State::Idle);
        self.held.take().expect("a flight has what it holds until it is dropped")
    }
}

impl<H> Drop for Flight<H> {
    fn drop(&mut self) {
        if self.state == State::Unfenced {
            // A submission failed halfway, so the fence is still to be sent after it.
            let engine = Arc::clone(&self.engine);
            let sent = self.submit_to(*lock(&engine.queue), &[], true);
            if sent.is_err() && self.state == State::Unfenced {
                self.state = State::Hung;
            }
        }
        // Its error has nowhere to go, but the state it leaves says what may be freed.
        let _ = self.finish();
        self.engine.backlog_ns.fetch_sub(self.expected_ns, Ordering::Relaxed);
        match (self.state, self.lane.take()) {
            (State::Idle, Some(lane)) => self.engine.recycle(lane),
            // Freed under a device that may yet write to it, memory would be somebody else's by then: it is
            // leaked, and with it the device.
            (State::Hung, lane) => {
                std::mem::forget(lane);
                std::mem::forget(self.held.take());
            }
            _ => {}
        }
    }
}
