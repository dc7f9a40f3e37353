//! The Vulkan device as the rest of the program sees it.

use std::sync::Arc;

use super::columns::{Inputs, OutputColumns};
use super::engine::Engine;
use super::instance::Instance;
use super::pool::Usage;
use super::program::Program;
use super::submission::Pending;
use super::texel::TexelWidth;
use crate::catalog::Kernel;
use crate::device::{Device, Error, Facts};

/// Deviations from what suits the device, to exercise the other path on any driver.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Copy columns to and from the device's own memory, also where it shares the host's.
    pub force_staging: bool,
    /// Take times from the host's clock, also where the device has timestamps.
    pub ignore_timestamps: bool,
    /// Fill outputs with a NaN before each evaluation, so that a row that no kernel wrote shows.
    pub poison_outputs: bool,
    /// Upload sampled tables as 16-bit floats, also where the device filters 32-bit ones.
    pub half_images: bool,
}

/// An open Vulkan device.
pub struct VulkanDevice {
    facts: Facts,
    engine: Arc<Engine>,
}

impl VulkanDevice {
    /// Opens the device at `index` of [`Instance::devices`].
    pub fn open(instance: &Instance, index: usize) -> Result<Self, Error> {
        Self::open_with(instance, index, Options::default())
    }

    /// As [`open`](Self::open), with `options`.
    pub fn open_with(instance: &Instance, index: usize, options: Options) -> Result<Self, Error> {
        let mut adapters = instance.adapters()?;
        if adapters.is_empty() {
            return Err(Error::NoDevice);
        }
        if index >= adapters.len() {
            let known = adapters
                .iter()
                .map(|adapter| format!("{} '{}'", adapter.facts.index, adapter.facts.name))
                .collect();
            return Err(Error::UnknownDevice { selector: index.to_string(), known });
        }
        let adapter = adapters.swap_remove(index);
        let engine = Engine::open(instance.loaded(), &adapter, options)?;
        let mut facts = adapter.facts;
        facts.unified_memory = !engine.staging;
        facts.table_image_bits = engine.texel_width().map_or(0, TexelWidth::bits);
        Ok(Self { facts, engine })
    }

    /// How the device's buffers have been used so far.
    pub fn buffer_usage(&self) -> Usage {
        self.engine.pool.usage()
    }
}

impl Device for VulkanDevice {
    type Program = Program;
    type Inputs = Inputs;
    type Pending = Pending;
    type Outputs = OutputColumns;

    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn max_rows(&self, inputs: usize, outputs: usize) -> usize {
        self.engine.max_rows(inputs.max(outputs))
    }

    fn program(&self, kernel: &Kernel) -> Result<Program, Error> {
        Program::new(&self.engine, kernel)
    }

    fn repeating(&self, program: &Program, evaluations: u32) -> Option<Program> {
        Some(program.repeating(evaluations))
    }

    /// An error if `rows` is not made of whole rows or exceeds [`max_rows`](Device::max_rows). No rows are
    /// fine.
    fn upload(&self, rows: &[f32], columns: usize) -> Result<Inputs, Error> {
        Inputs::upload(&self.engine, rows, columns)
    }

    /// No rows give empty columns in no time.
    fn submit(&self, program: &Program, inputs: &Inputs) -> Result<Pending, Error> {
        Pending::submit(&self.engine, program, inputs)
    }

    fn wait(&self, pending: Pending) -> Result<OutputColumns, Error> {
        pending.wait()
    }
}
