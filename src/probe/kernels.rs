//! Compiling and running the probes' kernels.

use crate::catalog::{self, Field, Signature, Type, Variant};
use crate::device::{self, Device, Outputs};

/// Why a probe did not answer: the machine's fault, or this program's.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Device(#[from] device::Error),
    #[error(transparent)]
    Catalog(#[from] catalog::Error),
    #[error("there is no table {0} with texels to interpolate between")]
    Table(&'static str),
}

/// One kernel: its text in this folder, its inputs and results.
pub(super) struct Source {
    pub(super) function: &'static str,
    pub(super) text: &'static str,
    pub(super) inputs: &'static [(&'static str, Type)],
    pub(super) results: &'static [&'static str],
}

/// The columns of results for row-major inputs.
pub(super) fn run<D: Device>(device: &D, source: &Source, rows: &[f32]) -> Result<Vec<Vec<f32>>, Error> {
    let signature = Signature {
        function: source.function,
        parameters: source.inputs.iter().map(|(name, ty)| Field::new(name, *ty)).collect(),
        results: source.results.iter().map(|name| Field::new(name, Type::Float)).collect(),
    };
    let file = format!("probe/{}.comp", source.function);
    let variants = Variant::parse("probe", &file, source.text)?;
    let kernel = variants[0].compile(&signature, false)?.kernel;
    let program = device.program(&kernel)?;
    let inputs = device.upload(rows, kernel.inputs)?;
    let outputs = device.wait(device.submit(&program, &inputs)?)?;
    Ok((0..kernel.outputs).map(|column| outputs.column(column).to_vec()).collect())
}
