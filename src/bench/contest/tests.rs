//! Contests on a pretended device.

use std::cell::Cell;
use std::sync::Mutex;

use super::*;
use crate::bench::noise::Noise;
use crate::catalog::Kernel;
use crate::device::{Clock, Elapsed, Error, Facts, Outputs};

/// A device that computes nothing and takes the time it is told.
struct Pretended {
    facts: Facts,
    noise: Mutex<Noise>,
    clock: Clock,
    /// Of every time.
    scale: f64,
    repeats: bool,
}

/// Nanoseconds of a row's loads and stores, nanoseconds of an evaluation, evaluations.
type Cost = (f64, f64, u32);

struct Nothing(Elapsed);

impl Outputs for Nothing {
    fn column(&self, _: usize) -> &[f32] {
        &[]
    }

    fn elapsed(&self) -> Elapsed {
        self.0
    }
}

impl Device for Pretended {
    type Program = Cost;
    type Inputs = usize;
    type Pending = Elapsed;
    type Outputs = Nothing;

    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn max_rows(&self, _: usize, _: usize) -> usize {
        1 << 24
    }

    fn program(&self, kernel: &Kernel) -> Result<Cost, Error> {
        Err(no_loops(&kernel.id))
    }

    fn repeating(&self, program: &Cost, evaluations: u32) -> Option<Cost> {
        self.repeats.then_some((program.0, program.1, evaluations))
    }

    fn upload(&self, rows: &[f32], columns: usize) -> Result<usize, Error> {
        Ok(rows.len() / columns)
    }

    fn submit(&self, program: &Cost, rows: &usize) -> Result<Elapsed, Error> {
        let ns = (program.0 + program.1 * f64::from(program.2)) * *rows as f64;
        let ns = self.noise.lock().unwrap().around(ns, 0.01) * self.scale;
        Ok(Elapsed { time: Duration::from_secs_f64(ns * 1e-9), clock: self.clock })
    }

    fn wait(&self, elapsed: Elapsed) -> Result<Nothing, Error> {
        Ok(Nothing(elapsed))
    }
}

fn pretended(kind: &str) -> Pretended {
    let facts = serde_json::json!({
        "index": 0, "name": "pretended", "kind": kind, "uuid": "", "vendor_id": 0, "device_id": 0, "driver": "",
        "driver_info": "", "driver_version": 0, "api_version": "1.1.0", "subgroup_size": 32,
        "shader_float64": false, "shader_float16": false, "float_controls": null,
        "max_storage_buffer_range": 1 << 27, "unified_memory": true, "timestamp_period": 1.0,
        "timestamp_bits": 64, "validation": false,
    });
    Pretended {
        facts: serde_json::from_value(facts).unwrap(),
        noise: Mutex::new(Noise::new(5)),
        clock: Clock::DeviceTimestamps,
        scale: 1.0,
        repeats: true,
    }
}

/// Variants of 2, 6 and 30 ns behind 10 ns of loads and stores, streaming and looping alike.
fn contest<R>(
    device: &Pretended,
    reference: Option<usize>,
    then: impl FnOnce(&Contest<'_, Pretended>) -> R,
) -> R {
    let costs: Vec<Cost> = [6.0, 2.0, 30.0, 0.2].map(|ns| (10.0, ns, 1)).to_vec();
    let entrant = |at: usize| Entrant {
        name: ["middling", "fast", "slow", "(null)"][at],
        streaming: &costs[at],
        repeating: Some(&costs[at]),
        operations: Operations { flops: 60, ..Operations::default() },
    };
    let ceiling = |per_second| crate::bench::Ceiling { per_second, kernel: String::new() };
    let ceilings = Ceilings {
        copy: ceiling(4e9),
        multiply_add: ceiling(1e10),
        inverse_sqrt: ceiling(1e9),
        divide: ceiling(1e9),
        sine: ceiling(1e9),
        exp2: ceiling(1e9),
    };
    then(&Contest {
        device,
        entrants: (0..3).map(entrant).collect(),
        null: entrant(3),
        inputs: 2,
        outputs: 3,
        configurations: &vec![1.0; 2000],
        reference,
        ceilings: Some(&ceilings),
    })
}

fn effort() -> Effort {
    Effort { warm_up: Duration::ZERO, time: Duration::ZERO, ..Effort::default() }
}

#[test]
fn in_registers_the_arithmetic_counts() {
    for kind in ["cpu", "discrete_gpu"] {
        let device = pretended(kind);
        let heard = Cell::new(0);
        let advance = || heard.set(heard.get() + 1);
        let (ranking, timings) = contest(&device, None, |contest| {
            contest.run(Setting::DIVERGENT, &effort(), &advance, &AtomicBool::new(false)).unwrap()
        });
        assert_eq!(ranking.reference, "fast");
        let places: Vec<_> = timings.iter().map(|timing| timing.rank.unwrap().first).collect();
        assert_eq!(places, [2, 1, 3]);
        assert!((timings[2].ratio.unwrap().median / 15.0 - 1.0).abs() < 0.3, "{:?}", timings[2].ratio);
        assert!((timings[2].ns.median / 30.0 - 1.0).abs() < 0.1, "{:?}", timings[2].ns);
        // 60 operations at 10 a nanosecond are 6 ns.
        assert!((timings[2].share.unwrap().arithmetic / 0.2 - 1.0).abs() < 0.1, "{:?}", timings[2].share);
        assert_eq!(timings[2].bound, Some(Bound::Compute));
        assert!(timings[0].evaluations >= 16 && ranking.rounds >= 11);
        // Warm-up and rounds of three variants, control and null kernel.
        assert_eq!(heard.get(), 5 * (1 + ranking.rounds + ranking.discarded));
    }
}

/// 10 ns of loads and stores are more than half of all but the slow one.
#[test]
fn what_memory_takes_is_not_ranked() {
    let device = pretended("discrete_gpu");
    let (ranking, timings) = contest(&device, Some(0), |contest| {
        contest.run(Setting::STREAMING, &effort(), &|| (), &AtomicBool::new(false)).unwrap()
    });
    assert_eq!(ranking.reference, "middling");
    let bounds: Vec<_> = timings.iter().map(|timing| timing.bound.unwrap()).collect();
    assert_eq!(bounds, [Bound::Memory, Bound::Memory, Bound::Compute]);
    let places: Vec<_> =
        timings.iter().map(|timing| timing.rank.unwrap()).map(|r| (r.first, r.last)).collect();
    assert_eq!(places, [(1, 2), (1, 2), (3, 3)]);
    // 20 bytes at 4 a nanosecond are 5 ns of 16.
    assert!((timings[0].share.unwrap().bandwidth * 16.0 / 5.0 - 1.0).abs() < 0.1);
    assert!(timings[0].configurations > 2000, "a GPU streams through more than is drawn");
}

#[test]
fn devices_that_lie_or_lack_are_told() {
    let run = |device: &Pretended, setting| {
        let stop = AtomicBool::new(false);
        contest(device, None, |contest| contest.run(setting, &effort(), &|| (), &stop))
    };
    let still = Pretended { scale: 0.0, ..pretended("cpu") };
    let error = run(&still, Setting::STREAMING).unwrap_err().to_string();
    assert!(error.contains("timestamps that advance (--host-clock does without)"), "{error}");
    let single = Pretended { repeats: false, ..pretended("cpu") };
    assert!(matches!(run(&single, Setting::COHERENT), Err(Stopped::Device(Error::NotSupported { .. }))));
    assert!(run(&single, Setting::STREAMING).is_ok());
    let fenced = Pretended { clock: Clock::HostFence, ..pretended("cpu") };
    let (_, timings) = run(&fenced, Setting::STREAMING).unwrap();
    assert_eq!(timings[0].clock, Clock::HostFence);
    // So coarse a clock that only the slow one's samples are more than nothing: still no ratio is zero or infinite.
    let coarse = Pretended { scale: 1e-7, ..pretended("cpu") };
    let (_, timings) = run(&coarse, Setting::STREAMING).unwrap();
    let finite = |ratio: crate::bench::Ratio| ratio.low > 0.0 && ratio.high.is_finite();
    assert!(timings.iter().all(|timing| finite(timing.ratio.unwrap())), "{timings:?}");
    let stopped = contest(&pretended("cpu"), None, |contest| {
        contest.run(Setting::STREAMING, &effort(), &|| (), &AtomicBool::new(true))
    });
    assert!(matches!(stopped, Err(Stopped::Interrupted)));
}
