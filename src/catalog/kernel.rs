//! A compiled variant, and the binary interface that the generated `main()` and every device share.
//!
//! Storage buffers, all in descriptor set 0, hold f32 columns one after another (structure of arrays):
//! component `c` of configuration `i` is at element `c * stride + i`.
//!
//! Tables, where a variant asks for any, are in descriptor set 1: they stay as they are while columns come and go.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// Binding of the input columns.
pub const INPUTS_BINDING: u32 = 0;
/// Binding of the output columns.
pub const OUTPUTS_BINDING: u32 = 1;
/// Descriptor set of the columns.
pub const COLUMNS_SET: u32 = 0;
/// Descriptor set of the tables.
pub const TABLES_SET: u32 = 1;
/// Binding of the first table, in order of names; no other set uses the same numbers.
pub const FIRST_TABLE_BINDING: u32 = 2;
/// The kernel's invocations a workgroup, along x only.
pub const LOCAL_SIZE: u32 = 64;

/// The push constants, as four consecutive u32; a kernel that evaluates once need not declare the last.
///
/// Invocation `g` evaluates configuration `first + g` if `g < count`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    /// First configuration of this dispatch.
    pub first: u32,
    /// Configurations in this dispatch.
    pub count: u32,
    /// Configurations between one column and the next, for inputs and outputs alike.
    pub stride: u32,
    /// Evaluations a configuration, for kernels that loop to be timed.
    pub evaluations: u32,
}

impl Range {
    /// The push-constant block's bytes.
    pub fn bytes(&self) -> [u8; 16] {
        let mut bytes = [0; 16];
        let words = [self.first, self.count, self.stride, self.evaluations];
        for (slot, word) in bytes.chunks_exact_mut(4).zip(words) {
            slot.copy_from_slice(&word.to_ne_bytes());
        }
        bytes
    }
}

/// One variant as SPIR-V, ready for any device.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// `family/variant`, for messages and debug names.
    pub id: String,
    /// The module's words; its entry point is `main`.
    pub spirv: Vec<u32>,
    /// Number of input columns.
    pub inputs: usize,
    /// Number of output columns.
    pub outputs: usize,
    /// Tables that it reads, by ascending binding.
    pub tables: Vec<TableBinding>,
    /// Places in its source where it may index outside of its own arrays: what it then returns says which
    /// ([`trap_of`]).
    pub traps: Vec<String>,
}

/// The most places that [`Kernel::traps`] tells apart.
pub const MAX_TRAPS: usize = 0xffff;

/// Results of an invocation that left its arrays at the place `number`, from 1: a quiet NaN, but not the one that
/// arithmetic makes.
pub const fn trap_bits(number: u32) -> u32 {
    0x7fd0_0000 | number
}

/// The place among [`Kernel::traps`] that a result's bits tell of, if they do.
pub const fn trap_of(bits: u32) -> Option<usize> {
    let number = bits & 0x000f_ffff;
    if bits & 0xfff0_0000 == trap_bits(0) && number > 0 { Some(number as usize - 1) } else { None }
}

/// How a kernel reads a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TableForm {
    /// A storage buffer: exact texels, filtered by the shader if at all.
    Buffer,
    /// A sampled image: bilinear filter, clamped to the edge.
    Image,
}

/// One table as a kernel's resource.
#[derive(Clone, Debug)]
pub struct TableBinding {
    pub name: &'static str,
    pub binding: u32,
    pub form: TableForm,
    pub width: u32,
    pub height: u32,
    /// Floats a texel, 1 or 4.
    pub channels: u32,
    /// Row-major: channel `c` of texel (x, y) is at `(y * width + x) * channels + c`.
    pub texels: Arc<[f32]>,
}
