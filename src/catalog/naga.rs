//! WGSL to SPIR-V through naga.

use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Where a mistake is, and which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mistake {
    /// From 1; none where naga cannot tell.
    pub(super) line: Option<usize>,
    pub(super) message: String,
}

/// Compiles the compute entry point `entry` of a module to SPIR-V 1.3.
pub(super) fn compile(text: &str, entry: &str) -> Result<Vec<u32>, Mistake> {
    let mut front = naga::front::wgsl::Frontend::new();
    let module = front.parse(text).map_err(|error| Mistake {
        line: error.location(text).map(|location| location.line_number as usize),
        message: error.message().to_owned(),
    })?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::IMMEDIATES).validate(&module).map_err(
        |error| {
            let location = error.location(text);
            // The causes say more than the error itself: they name the expression's fault.
            let inner = error.into_inner();
            let mut message = inner.to_string();
            let mut cause: Option<&dyn std::error::Error> = std::error::Error::source(&inner);
            while let Some(error) = cause {
                message = format!("{message}: {error}");
                cause = error.source();
            }
            Mistake { line: location.map(|location| location.line_number as usize), message }
        },
    )?;
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::empty(),
        // The generated part stays within the columns, and the rest is watched like every other language's.
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Unchecked,
            buffer: BoundsCheckPolicy::Unchecked,
            ..BoundsCheckPolicies::default()
        },
        ..spv::Options::default()
    };
    let pipeline =
        spv::PipelineOptions { shader_stage: naga::ShaderStage::Compute, entry_point: entry.to_owned() };
    spv::write_vec(&module, &info, &options, Some(&pipeline))
        .map_err(|error| Mistake { line: None, message: error.to_string() })
}
