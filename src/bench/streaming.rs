//! Streaming time: one evaluation a configuration, inputs from memory and outputs to it.
//!
//! On a GPU this measures memory more than arithmetic. Variants are interleaved (A B C A B C ...), so that drift of the
//! machine cancels from their ratios.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::{Effort, Quartiles, Setting, Timing};
use crate::audit::Stopped;
use crate::device::{Clock, Device, Outputs};

/// Configurations a submission: columns too large for most caches, and tens of milliseconds for the slowest kernels on a
/// software device, where a dispatch over 200 ms may be killed.
pub const CONFIGURATIONS: u64 = 1 << 18;

/// A sample lasts at least this long: shorter kernels are submitted several times for one sample.
const MIN_SAMPLE: Duration = Duration::from_millis(2);
/// So many submissions a sample at most.
const MAX_REPEATS: usize = 64;

/// Times `programs` on the same inputs. `advance` hears of each finished sample.
pub fn streaming<D: Device>(
    device: &D,
    programs: &[D::Program],
    inputs: &D::Inputs,
    configurations: usize,
    effort: &Effort,
    advance: &dyn Fn(),
    stop: &AtomicBool,
) -> Result<Vec<Timing>, Stopped> {
    let once = |program: &D::Program| {
        let outputs = device.wait(device.submit(program, inputs)?)?;
        Ok::<_, Stopped>(outputs.elapsed())
    };

    let mut fastest = vec![Duration::MAX; programs.len()];
    let mut clock = Clock::DeviceTimestamps;
    let warm_up = Instant::now();
    loop {
        for (program, fastest) in programs.iter().zip(&mut fastest) {
            if stop.load(Ordering::Relaxed) {
                return Err(Stopped::Interrupted);
            }
            let elapsed = once(program)?;
            clock = elapsed.clock;
            *fastest = (*fastest).min(elapsed.time);
        }
        if warm_up.elapsed() >= effort.warm_up {
            break;
        }
    }
    let repeats = |fastest: Duration| {
        let needed = MIN_SAMPLE.as_secs_f64() / fastest.as_secs_f64().max(1e-9);
        (needed.ceil() as usize).clamp(1, MAX_REPEATS)
    };
    let repeats: Vec<usize> = fastest.into_iter().map(repeats).collect();

    let mut samples: Vec<Vec<f64>> = vec![Vec::new(); programs.len()];
    let start = Instant::now();
    for round in 0..effort.max_rounds {
        if round >= effort.min_rounds && start.elapsed() >= effort.time {
            break;
        }
        for ((program, samples), repeats) in programs.iter().zip(&mut samples).zip(&repeats) {
            if stop.load(Ordering::Relaxed) {
                return Err(Stopped::Interrupted);
            }
            let mut time = Duration::ZERO;
            for _ in 0..*repeats {
                time += once(program)?.time;
            }
            samples.push(time.as_secs_f64() * 1e9 / (*repeats * configurations) as f64);
            advance();
        }
    }
    let timing = |(samples, repeats): (Vec<f64>, usize)| {
        let ns = Quartiles::of(&samples)?;
        Some(Timing {
            setting: Setting::STREAMING,
            ns,
            clock,
            rounds: samples.len(),
            configurations,
            repeats,
            evaluations: 1,
            ratio: None,
            rank: None,
            share: None,
            bound: None,
        })
    };
    Ok(samples.into_iter().zip(repeats).filter_map(timing).collect())
}
