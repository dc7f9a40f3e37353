//! A kernel as a pipeline.

use std::sync::Arc;

use ash::vk;

use super::call::Named;
use super::engine::Engine;
use super::owned::Owned;
use super::pace::{PROBE_ROWS, Pace};
use super::tables::Tables;
use crate::catalog::Kernel;
use crate::device::Error;

/// A kernel made ready for one device. Cheap to clone.
///
/// The device trusts it to keep to its columns, as [`Kernel`] describes them: buffer accesses are not bounds
/// checked, for that would be timed too.
#[derive(Clone)]
pub struct Program {
    pub(super) compiled: Arc<Compiled>,
    pub(super) evaluations: u32,
    pub(super) pace: Arc<Pace>,
}

pub(super) struct Compiled {
    pub(super) pipeline: Owned<vk::Pipeline>,
    pub(super) id: String,
    pub(super) inputs: usize,
    pub(super) outputs: usize,
    pub(super) tables: Option<Tables>,
    pub(super) traps: Vec<String>,
}

impl Compiled {
    /// The layout that the pipeline was made with.
    pub(super) fn layout(&self, engine: &Engine) -> vk::PipelineLayout {
        layout(self.tables.as_ref(), engine)
    }
}

fn layout(tables: Option<&Tables>, engine: &Engine) -> vk::PipelineLayout {
    tables.map_or_else(|| engine.pipeline_layout(), |tables| tables.pipeline_layout.get())
}

impl Program {
    pub(super) fn new(engine: &Arc<Engine>, kernel: &Kernel) -> Result<Self, Error> {
        let invalid =
            |reason: &str| Error::InvalidKernel { kernel: kernel.id.clone(), reason: reason.to_owned() };
        if kernel.inputs == 0 || kernel.outputs == 0 {
            return Err(invalid("it needs an input and an output column"));
        }
        if let Some(what) = engine.abilities().missing(&kernel.spirv).map_err(invalid)? {
            return Err(Error::NotSupported { kernel: kernel.id.clone(), what });
        }
        let tables = Tables::new(engine, kernel)?;
        let logical = engine.logical();
        let device = &logical.device;
        let create = vk::ShaderModuleCreateInfo::default().code(&kernel.spirv);
        // SAFETY: the device has what the module declares.
        let module = unsafe { device.create_shader_module(&create, None) }.named("vkCreateShaderModule")?;
        let module = Owned::new(logical, module);
        logical.name(module.get(), &kernel.id);
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module.get())
            .name(c"main");
        let layout = layout(tables.as_ref(), engine);
        let create = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
        // SAFETY: module and layout are this device's and alive; the cache is synchronised by the driver.
        let made = unsafe { device.create_compute_pipelines(engine.pipeline_cache(), &[create], None) };
        let pipeline = match made {
            Ok(pipelines) => pipelines.first().copied().unwrap_or_default(),
            // One pipeline was asked for, so on failure there is none to destroy.
            Err((_, result)) => Err(result).named("vkCreateComputePipelines")?,
        };
        let pipeline = Owned::new(logical, pipeline);
        logical.name(pipeline.get(), &kernel.id);
        Ok(Self {
            compiled: Arc::new(Compiled {
                pipeline,
                id: kernel.id.clone(),
                inputs: kernel.inputs,
                outputs: kernel.outputs,
                tables,
                traps: kernel.traps.clone(),
            }),
            evaluations: 1,
            pace: Arc::new(Pace::new()),
        })
    }

    /// Whether so many rows are enough work for their time to say more of the kernel than of a dispatch's fixed cost.
    pub(super) fn teaches(&self, rows: u32) -> bool {
        rows.saturating_mul(self.evaluations) >= PROBE_ROWS
    }

    /// The same pipeline with another loop count, and so with a pace of its own.
    pub(super) fn repeating(&self, evaluations: u32) -> Self {
        Self { compiled: Arc::clone(&self.compiled), evaluations, pace: Arc::new(Pace::new()) }
    }
}
