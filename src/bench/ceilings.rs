//! What the device does at best: bytes copied, multiply-adds and special functions a second.
//!
//! Each is the fastest sample of the best of several kernels, so that shares of it flatter nobody. The kernels are
//! functions like a variant's, inside the same generated loops: a ceiling that the harness cannot reach would be no use.

use std::fmt::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::{Ceiling, Ceilings};
use crate::audit::Stopped;
use crate::catalog::{self, Error, Field, Kernel, Operations, Signature, Type, Variant};
use crate::device::{self, Device, Outputs};

/// Bytes of columns on either side of a copy: more than caches hold, software devices' caches being the processor's.
const COPIED_SOFTWARE: usize = 32 << 20;
const COPIED: usize = 256 << 20;
/// Invocations of an arithmetic kernel: some for every lane of a device. A software device has few lanes.
const LANES_SOFTWARE: usize = 1 << 12;
const LANES: usize = 1 << 20;
/// A sample lasts about so long: short, so that some fall between the interruptions of a busy machine.
const SAMPLE: Duration = Duration::from_millis(3);
/// Samples of every kernel, and more of the best one.
const TRIALS: usize = 5;
const FINALS: usize = 20;
/// Results in a row of one chain, within one evaluation.
const STEPS: usize = 16;

const VECTORS: [Field; 8] = [
    Field::new("x0", Type::Vec4),
    Field::new("x1", Type::Vec4),
    Field::new("x2", Type::Vec4),
    Field::new("x3", Type::Vec4),
    Field::new("x4", Type::Vec4),
    Field::new("x5", Type::Vec4),
    Field::new("x6", Type::Vec4),
    Field::new("x7", Type::Vec4),
];

/// A kernel that might reach a ceiling.
struct Candidate {
    kernel: Kernel,
    /// Whether it loops in registers; then its last two columns are the chains' scalars.
    repeats: bool,
    /// Bytes or operations of one evaluation.
    work: f64,
}

/// As many columns in as out, nothing in between.
fn columns(vectors: usize) -> Result<Candidate, Error> {
    let signature = Signature {
        function: "columns",
        parameters: VECTORS[..vectors].to_vec(),
        results: VECTORS[..vectors].to_vec(),
    };
    let mut variant = Variant::null(&signature);
    variant.name = format!("copy{}", 4 * vectors);
    Ok(copying(variant.compile(&signature, false)?.kernel))
}

fn copying(kernel: Kernel) -> Candidate {
    let work = ((kernel.inputs + kernel.outputs) * size_of::<f32>()) as f64;
    Candidate { kernel, repeats: false, work }
}

/// `step` applied to each of `chains` vectors in turn, [`STEPS`] times. In `step`, `$x` is the vector; `m` and `c` are
/// scalars just below 1 and above 0.
fn chains(
    name: &str,
    step: &str,
    chains: usize,
    operations: impl Fn(&Operations) -> u64,
) -> Result<Candidate, Error> {
    let mut parameters = VECTORS[..chains].to_vec();
    parameters.extend([Field::new("m", Type::Float), Field::new("c", Type::Float)]);
    let signature =
        Signature { function: "chains", parameters, results: vec![Field::new("sum", Type::Vec4)] };
    let mut text = format!("{} {{\n", signature.declaration());
    for _ in 0..STEPS {
        for chain in 0..chains {
            _ = writeln!(text, "    x{chain} = {};", step.replace("$x", &format!("x{chain}")));
        }
    }
    let names: Vec<&str> = VECTORS[..chains].iter().map(|field| field.name).collect();
    _ = writeln!(text, "    return {};\n}}", names.join(" + "));
    let variant = Variant::generated("ceiling", &format!("{name}_{}", 4 * chains), "", text);
    // Counted like a variant's.
    let work = operations(&variant.compile(&signature, false)?.facts.operations) as f64;
    Ok(Candidate { kernel: variant.compile_repeating(&signature)?.kernel, repeats: true, work })
}

/// Measures all ceilings.
pub fn ceilings<D: Device>(device: &D, stop: &AtomicBool) -> Result<Ceilings, Stopped> {
    let copies = catalog::copy_kernel().map(copying);
    let copies = [1, 2, 4].map(columns).into_iter().chain([copies]);
    let multiply_add = [2, 3, 4, 8].into_iter().flat_map(|n| {
        let flops = |operations: &Operations| operations.flops;
        [chains("mul_add", "$x * m + c", n, flops), chains("fma", "fma($x, vec4(m), vec4(c))", n, flops)]
    });
    let special = |name: &'static str, step: &'static str, operations: fn(&Operations) -> u64| {
        [1, 2, 4].into_iter().map(move |n| chains(name, step, n, operations))
    };
    let best =
        |candidates: &mut dyn Iterator<Item = Result<Candidate, Error>>| best(device, candidates, stop);
    Ok(Ceilings {
        copy: best(&mut { copies })?,
        multiply_add: best(&mut { multiply_add })?,
        inverse_sqrt: best(&mut special("inversesqrt", "inversesqrt($x)", |operations| operations.roots))?,
        divide: best(&mut special("divide", "m / $x", |operations| operations.divisions))?,
        sine: best(&mut special("sin", "sin($x)", |operations| operations.trigonometric))?,
        exp2: best(&mut special("exp2", "exp2(-$x)", |operations| operations.exponential))?,
    })
}

/// The highest rate of the best candidate.
fn best<D: Device>(
    device: &D,
    candidates: &mut dyn Iterator<Item = Result<Candidate, Error>>,
    stop: &AtomicBool,
) -> Result<Ceiling, Stopped> {
    let mut best: Option<(f64, String, Entry<D>)> = None;
    for candidate in candidates {
        let candidate = candidate.map_err(|error| device::Error::InvalidKernel {
            kernel: "ceiling".to_owned(),
            reason: error.to_string(),
        })?;
        let entry = Entry::new(device, &candidate)?;
        let rate = entry.rate(device, TRIALS, stop)?;
        if best.as_ref().is_none_or(|(most, ..)| rate > *most) {
            best = Some((rate, candidate.kernel.id, entry));
        }
    }
    let Some((rate, kernel, entry)) = best else {
        return Ok(Ceiling { per_second: 0.0, kernel: String::new() });
    };
    let again = entry.rate(device, FINALS, stop)?;
    let kernel = kernel.rsplit('/').next().unwrap_or_default().to_owned();
    Ok(Ceiling { per_second: rate.max(again), kernel })
}

/// A candidate ready to be timed.
struct Entry<D: Device> {
    program: D::Program,
    inputs: D::Inputs,
    /// Of one submission.
    work: f64,
    submissions: usize,
}

impl<D: Device> Entry<D> {
    fn new(device: &D, candidate: &Candidate) -> Result<Self, Stopped> {
        let kernel = &candidate.kernel;
        let columns = kernel.inputs;
        let software = device.facts().kind == "cpu";
        let copied = if software { COPIED_SOFTWARE } else { COPIED };
        let wanted = match (candidate.repeats, software) {
            (false, _) => copied / (columns * size_of::<f32>()),
            (true, true) => LANES_SOFTWARE,
            (true, false) => LANES,
        };
        let rows = wanted.min(device.max_rows(columns, kernel.outputs));
        // Near 1, and no two alike; `m` just below 1 and `c` what keeps x at 1.
        let mut inputs: Vec<f32> = (0..rows * columns).map(|at| 0.9 + 1e-4 * (at % 1009) as f32).collect();
        if candidate.repeats {
            for row in inputs.chunks_exact_mut(columns) {
                row[columns - 2..].copy_from_slice(&[0.9995, 0.0005]);
            }
        }
        let inputs = device.upload(&inputs, columns)?;
        let mut program = device.program(kernel)?;
        let mut evaluations = 1;
        if candidate.repeats {
            // A few first, which is safe on a slow device; then as many as make a sample.
            for goal in [None, Some(SAMPLE / 4), Some(SAMPLE)] {
                evaluations = match goal {
                    None => 8,
                    Some(goal) => {
                        let once = time(device, &program, &inputs)?.as_secs_f64() / f64::from(evaluations);
                        (goal.as_secs_f64() / once.max(1e-12)).clamp(8.0, 65_536.0) as u32
                    }
                };
                let repeating = device.repeating(&program, evaluations);
                program = repeating.ok_or_else(|| no_loops(&kernel.id))?;
                time(device, &program, &inputs)?;
            }
        }
        let once = time(device, &program, &inputs)?;
        let submissions = (SAMPLE.as_secs_f64() / once.as_secs_f64().max(1e-9)).ceil().clamp(1.0, 64.0);
        let work = candidate.work * rows as f64 * f64::from(evaluations);
        Ok(Entry { program, inputs, work, submissions: submissions as usize })
    }

    /// Work a second in the fastest of some samples.
    fn rate(&self, device: &D, samples: usize, stop: &AtomicBool) -> Result<f64, Stopped> {
        let mut least = f64::INFINITY;
        for _ in 0..samples {
            if stop.load(Ordering::Relaxed) {
                return Err(Stopped::Interrupted);
            }
            let mut spent = Duration::ZERO;
            for _ in 0..self.submissions {
                spent += time(device, &self.program, &self.inputs)?;
            }
            least = least.min(spent.as_secs_f64() / self.submissions as f64);
        }
        Ok(self.work / least.max(1e-12))
    }
}

fn time<D: Device>(device: &D, program: &D::Program, inputs: &D::Inputs) -> Result<Duration, Stopped> {
    Ok(device.wait(device.submit(program, inputs)?)?.elapsed().time)
}

/// The device cannot run timing loops.
pub(super) fn no_loops(kernel: &str) -> device::Error {
    device::Error::NotSupported { kernel: kernel.to_owned(), what: "a loop count to be timed".to_owned() }
}
