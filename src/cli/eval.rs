//! `rootq eval`: the user's own configurations, CSV or Parquet in and out.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, bail};
use clap::Args;

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
use crate::record::evaluations::{Batch, Writer};

/// Options of `rootq eval`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq eval ellipse_axes --inputs in.csv --output out.csv\n  \
    rootq eval ellipse_axes --inputs - --oracle-only < in.csv\n  \
    rootq eval ellipse_axes --inputs in.parquet --output out.parquet\n  \
    rootq eval ellipse_axes --inputs run/failures.parquet --device 1    a run's failures, elsewhere\n  \
    rootq eval ellipse_axes --inputs in.csv --variant naive --variant cross --device llvmpipe\n  \
    rootq eval ltc_disk --inputs in.csv --shader old.comp --shader new.comp")]
pub(super) struct Arguments {
    /// Family whose columns the table has
    family: String,
    /// CSV or Parquet to read; '-' is standard input, always CSV
    #[arg(long, value_name = "IN")]
    inputs: PathBuf,
    /// Variant to evaluate; may be given again [default: all of the family]
    #[arg(long, value_name = "V", conflicts_with = "oracle_only")]
    variant: Vec<String>,
    /// Only the oracle; needs no device
    #[arg(long)]
    oracle_only: bool,
    /// CSV to write, or Parquet if it is named so; '-' is standard output, always CSV
    #[arg(long, value_name = "OUT", default_value = "-")]
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
    let columns = signature.input_columns();
    let reader = if is_dash(&arguments.inputs) {
        Reader::standard_input(columns)?
    } else {
        Reader::open(&arguments.inputs, problem.name(), columns)?
    };
    // Written aside: a mistake in the last line must leave nothing behind.
    let draft = draft(&arguments.output)?;
    let names: Vec<String> = variants.iter().map(|variant| variant.name.clone()).collect();
    let writer = Writer::new(draft.reopen()?, &arguments.output, &names, &signature.output_columns())?;
    let evaluator =
        if variants.is_empty() { None } else { Some(Evaluator::new(arguments, problem, &variants)?) };
    write_all(writer, reader, problem, evaluator.as_ref(), stop)?;
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

fn write_all(
    mut writer: Writer,
    mut reader: Reader,
    problem: &dyn Problem,
    evaluator: Option<&Evaluator>,
    stop: &AtomicBool,
) -> Result<()> {
    let columns = problem.signature().output_columns().len();
    let width = problem.signature().input_columns().len();
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
        let mut evaluated = Vec::new();
        if let Some(Evaluator { machine, programs }) = evaluator {
            let inputs = machine.device.upload(chunk.inputs(), width)?;
            for (_, program) in programs {
                evaluated.push(machine.device.wait(machine.device.submit(program, &inputs)?)?);
            }
        }
        let truth = |column| (0..chunk.rows()).map(|row| chunk.truth(row)[column]).collect();
        let outputs = |outputs| (0..columns).map(move |column| Outputs::column(outputs, column));
        writer.write(&Batch {
            truth: (0..columns).map(truth).collect(),
            outputs: evaluated.iter().flat_map(outputs).collect(),
        })?;
    }
    writer.finish()?;
    Ok(())
}
