//! `rootq eval`: the user's own configurations, CSV to CSV.

use std::fs::File;
use std::io::{self, BufWriter, Read};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, bail};
use clap::Args;
use tempfile::NamedTempFile;

use super::draft::{deliver, draft, is_dash};
use super::machine::{DeviceArguments, Machine};
use super::selection;
use super::shader::ShaderArguments;
use crate::audit::Chunk;
use crate::catalog::{Catalog, Variant};
use crate::device::vulkan::VulkanDevice;
use crate::device::{Device, Outputs};
use crate::family::Problem;
use crate::record::configurations::Reader;

/// Options of `rootq eval`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq eval ellipse_axes --inputs in.csv --output out.csv\n  \
    rootq eval ellipse_axes --inputs - --oracle-only < in.csv\n  \
    rootq eval ellipse_axes --inputs in.csv --variant naive --variant cross --device llvmpipe\n  \
    rootq eval ltc_disk --inputs in.csv --shader old.comp --shader new.comp")]
pub(super) struct Arguments {
    /// Family whose columns the table has
    family: String,
    /// CSV to read; '-' is standard input
    #[arg(long, value_name = "IN.csv")]
    inputs: PathBuf,
    /// Variant to evaluate; may be given again [default: all of the family]
    #[arg(long, value_name = "V", conflicts_with = "oracle_only")]
    variant: Vec<String>,
    /// Only the oracle; needs no device
    #[arg(long)]
    oracle_only: bool,
    /// CSV to write; '-' is standard output
    #[arg(long, value_name = "OUT.csv", default_value = "-")]
    output: PathBuf,
    #[command(flatten)]
    device: DeviceArguments,
    #[command(flatten)]
    shaders: ShaderArguments,
}

/// Configurations read, evaluated and written at a time.
const BATCH: usize = 1 << 16;

pub(super) fn eval(arguments: &Arguments, stop: &AtomicBool) -> Result<()> {
    let problem = selection::family(&arguments.family)?;
    let mut catalog = Catalog::embedded()?;
    let own = arguments.shaders.bring(&mut catalog, Some(problem.name()))?;
    let variants: Vec<Variant> = if arguments.oracle_only {
        Vec::new()
    } else if arguments.variant.is_empty() && own.is_empty() {
        catalog.family(problem.name()).cloned().collect()
    } else {
        let named = arguments.variant.iter().chain(&own);
        named.map(|name| selection::variant(&catalog, problem, name)).collect::<Result<_>>()?
    };
    for (position, variant) in variants.iter().enumerate() {
        if variants[..position].iter().any(|earlier| earlier.name == variant.name) {
            bail!("variant '{}' is given twice", variant.name);
        }
    }
    let signature = problem.signature();
    let (source, name): (Box<dyn Read>, String) = if is_dash(&arguments.inputs) {
        (Box::new(io::stdin().lock()), "standard input".to_owned())
    } else {
        let name = arguments.inputs.display().to_string();
        (Box::new(File::open(&arguments.inputs).with_context(|| format!("cannot read {name}"))?), name)
    };
    let reader = Reader::new(source, &name, signature.input_columns())?;
    // Written aside: a mistake in the last line must leave nothing behind.
    let draft = draft(&arguments.output)?;
    let evaluator =
        if variants.is_empty() { None } else { Some(Evaluator::new(arguments, problem, &variants)?) };
    write_all(&draft, reader, problem, evaluator.as_ref(), stop)?;
    if let Some(evaluator) = &evaluator {
        evaluator.machine.check_validation()?;
    }
    deliver(draft, &arguments.output)
}

/// Programs on an open device.
struct Evaluator {
    machine: Machine,
    programs: Vec<(String, <VulkanDevice as Device>::Program)>,
}

impl Evaluator {
    fn new(arguments: &Arguments, problem: &dyn Problem, variants: &[Variant]) -> Result<Self> {
        let machine = arguments.device.open()?;
        let signature = problem.signature();
        let mut programs = Vec::new();
        for variant in variants {
            let kernel = variant.compile(&signature, false)?.into_safe();
            programs.push((variant.name.clone(), machine.device.program(&kernel)?));
        }
        Ok(Evaluator { machine, programs })
    }
}

fn write_all<R: Read>(
    draft: &NamedTempFile,
    mut reader: Reader<R>,
    problem: &dyn Problem,
    evaluator: Option<&Evaluator>,
    stop: &AtomicBool,
) -> Result<()> {
    let columns = problem.signature().output_columns();
    let width = problem.signature().input_columns().len();
    let mut csv = csv::Writer::from_writer(BufWriter::new(draft.as_file()));
    let programs = evaluator.map_or(&[][..], |evaluator| &evaluator.programs);
    let sources = std::iter::once("oracle").chain(programs.iter().map(|(name, _)| name.as_str()));
    csv.write_record(
        sources.flat_map(|source| columns.iter().map(move |column| format!("{source}.{column}"))),
    )?;

    let mut first = 0;
    loop {
        if stop.load(Ordering::Relaxed) {
            bail!("interrupted");
        }
        let inputs = reader.batch(BATCH)?;
        if inputs.is_empty() {
            break;
        }
        let chunk = Chunk::of_inputs(problem, first, inputs);
        first += chunk.rows() as u64;
        let mut outputs = Vec::new();
        if let Some(Evaluator { machine, programs }) = evaluator {
            let inputs = machine.device.upload(chunk.inputs(), width)?;
            for (_, program) in programs {
                outputs.push(machine.device.wait(machine.device.submit(program, &inputs)?)?);
            }
        }
        for row in 0..chunk.rows() {
            for value in chunk.truth(row) {
                csv.write_field(format!("{value:.16e}"))?;
            }
            for outputs in &outputs {
                for column in 0..columns.len() {
                    csv.write_field(format!("{:.8e}", outputs.column(column)[row]))?;
                }
            }
            csv.write_record(None::<&[u8]>)?;
        }
    }
    csv.flush()?;
    Ok(())
}
