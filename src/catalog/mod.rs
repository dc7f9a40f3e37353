//! Finds variants, reads their front matter, generates `main()`, compiles to SPIR-V and reflects facts from it.

pub mod kernel;
pub mod signature;

pub use kernel::Kernel;
pub use signature::{Field, Signature, Type};
