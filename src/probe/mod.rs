//! What a device's f32 arithmetic does where Vulkan leaves it a choice, found out by small kernels.
//!
//! A probe is no family: it has no distribution and no tolerance, and its kernels ask for what an audit must avoid. The
//! kernels are generated and compiled as variants are; each is run on chosen inputs, and the host says which of the
//! permitted behaviours the results agree with. Nothing is taken from the driver's own word.

mod arithmetic;
mod filter;
mod kernels;
mod special;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use arithmetic::{Exactness, Fused, Fusing, Rounding, SAMPLES, Subnormals};
pub use kernels::Error;
pub use special::Observation;

use crate::device::Device;

/// The behaviours of one device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    pub fused: Fused,
    pub sum: Rounding,
    pub difference: Rounding,
    pub product: Rounding,
    pub division: Exactness,
    pub square_root: Exactness,
    pub inverse_square_root: Exactness,
    pub subnormals: Subnormals,
    /// Expressions of NaN, infinity and signed zeros, and what came out.
    pub special: Vec<Observation>,
    /// Bits of a sampler's interpolation weight; absent where the device filters no floats.
    pub filter_bits: Option<u32>,
}

/// Probes a device: a few kernels, less than a second.
pub fn probe<D: Device>(device: &D) -> Result<Probe, Error> {
    let arithmetic::Roundings { sum, difference, product, division } = arithmetic::roundings(device)?;
    let (square_root, inverse_square_root) = arithmetic::roots(device)?;
    Ok(Probe {
        fused: arithmetic::fused(device)?,
        sum,
        difference,
        product,
        division,
        square_root,
        inverse_square_root,
        subnormals: arithmetic::subnormals(device)?,
        special: special::observe(device)?,
        filter_bits: filter::bits(device)?,
    })
}
