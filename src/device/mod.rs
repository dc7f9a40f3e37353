//! Where a variant runs. The trait is all that the chunk engine and the benchmark know of a device.
//!
//! A device evaluates kernels over columns of f32. It knows no family: a kernel is SPIR-V and two column counts.

pub mod vulkan;

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::catalog::Kernel;

/// Something that evaluates kernels.
///
/// Work is asynchronous: [`submit`](Device::submit) returns at once and [`wait`](Device::wait) blocks. Several
/// submissions may be in flight; each owns its buffers until it has been waited for (or dropped, which waits).
pub trait Device: Sync {
    /// A kernel made ready for this device.
    type Program: Send + Sync;
    /// Input columns in the device's memory; cheap to clone.
    type Inputs: Clone + Send + Sync;
    /// A submission in flight.
    type Pending: Send;
    /// The output columns of a finished submission.
    type Outputs: Outputs + Send + Sync;

    /// Who the device is, for the record.
    fn facts(&self) -> &Facts;

    /// The most configurations one set of columns can hold for a kernel of this many input and output columns.
    fn max_rows(&self, inputs: usize, outputs: usize) -> usize;

    /// Makes a kernel ready. [`Error::NotSupported`] where it needs what the device lacks.
    fn program(&self, kernel: &Kernel) -> Result<Self::Program, Error>;

    /// The program with its loop of a kernel made for timing run `evaluations` times a configuration; `None` if the device
    /// cannot pass the number on.
    fn repeating(&self, program: &Self::Program, evaluations: u32) -> Option<Self::Program> {
        let _ = (program, evaluations);
        None
    }

    /// Copies `rows` (row-major, `columns` wide) into device columns.
    fn upload(&self, rows: &[f32], columns: usize) -> Result<Self::Inputs, Error>;

    /// Starts evaluating every configuration of `inputs`.
    fn submit(&self, program: &Self::Program, inputs: &Self::Inputs) -> Result<Self::Pending, Error>;

    /// Blocks until the submission is finished.
    fn wait(&self, pending: Self::Pending) -> Result<Self::Outputs, Error>;
}

/// Finished output columns.
pub trait Outputs {
    /// Column `column` of the kernel's outputs, one value a configuration.
    fn column(&self, column: usize) -> &[f32];

    /// Time the device spent in the kernel's dispatches, without transfers, and how it was measured.
    fn elapsed(&self) -> Elapsed;
}

/// A measured time and the clock it came from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elapsed {
    pub time: Duration,
    pub clock: Clock,
}

/// The clock behind a device time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The device's own timestamps, written around each dispatch.
    DeviceTimestamps,
    /// The host's clock around submission and fence: the device has no timestamps.
    HostFence,
}

/// Who a device is and which of its properties bear on results: enough to recognise it and repeat a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// Position in the loader's list, as `--device 0` selects it.
    pub index: usize,
    pub name: String,
    /// `cpu`, `integrated_gpu`, `discrete_gpu`, `virtual_gpu` or `other`.
    pub kind: String,
    /// 32 lower-case hexadecimal digits.
    pub uuid: String,
    pub vendor_id: u32,
    pub device_id: u32,
    /// Driver name and version text as the driver itself gives them.
    pub driver: String,
    pub driver_info: String,
    pub driver_version: u32,
    /// Highest Vulkan version the device supports: `1.3.230`.
    pub api_version: String,
    pub subgroup_size: u32,
    pub shader_float64: bool,
    pub shader_float16: bool,
    /// What the driver says of f32 arithmetic, where it says anything (Vulkan 1.2 float controls).
    pub float_controls: Option<FloatControls>,
    pub max_storage_buffer_range: u64,
    /// Whether kernels read and write host memory directly, without staging copies.
    pub unified_memory: bool,
    /// Nanoseconds a timestamp tick.
    pub timestamp_period: f32,
    /// Meaningful bits of a timestamp; 0: no timestamps, times come from fences.
    pub timestamp_bits: u32,
    /// Bits of a channel in tables that kernels read as sampled images: 32, 16 where the device does not filter 32-bit
    /// floats linearly, 0 where it filters none.
    #[serde(default)]
    pub table_image_bits: u32,
    /// Validation layer active.
    pub validation: bool,
}

/// `VkPhysicalDeviceFloatControlsProperties`, the f32 part: what a shader may *ask for*, not what it gets unasked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FloatControls {
    pub preserves_signed_zero_inf_nan: bool,
    pub preserves_denormals: bool,
    pub flushes_denormals: bool,
    pub rounds_to_nearest_even: bool,
    pub rounds_toward_zero: bool,
}

/// Why a device could not be had or could not do its work. Never a statement about a variant.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    #[error("no Vulkan loader found ({reason}); install it (Debian: apt-get install libvulkan1)")]
    NoLoader { reason: String },
    #[error(
        "the Vulkan loader found no device; install a driver (Debian: apt-get install mesa-vulkan-drivers) or set VK_DRIVER_FILES"
    )]
    NoDevice,
    #[error("no device matches '{selector}'; there are: {}", known.join(", "))]
    UnknownDevice { selector: String, known: Vec<String> },
    #[error("'{selector}' matches several devices: {}; use an index or a UUID", matches.join(", "))]
    AmbiguousDevice { selector: String, matches: Vec<String> },
    #[error(
        "the validation layer VK_LAYER_KHRONOS_validation is not installed (Debian: apt-get install vulkan-validationlayers)"
    )]
    NoValidationLayer,
    #[error("{kernel} needs {what}, which this device does not have")]
    NotSupported { kernel: String, what: String },
    /// The module itself is at fault, on any device.
    #[error("{kernel} is not a usable kernel: {reason}")]
    InvalidKernel { kernel: String, reason: String },
    #[error(
        "{kernel} indexes outside of one of its own arrays, at {place}, for row {row} of {rows}: what it computes there is \
         nobody's"
    )]
    OutOfBounds { kernel: String, place: String, row: usize, rows: usize },
    /// Columns and kernel do not fit each other, or do not fit the device: the caller's mistake.
    #[error("columns do not fit: {0}")]
    Shape(String),
    /// A driver call failed; `call` is the Vulkan function's name.
    #[error("{call} failed: {result}")]
    Call { call: &'static str, result: String },
    #[error("device memory: {0}")]
    Memory(String),
}
