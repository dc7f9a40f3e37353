//! Vulkan handles that destroy themselves.

use std::sync::Arc;

use ash::vk;

use super::logical::Logical;

/// A handle that a logical device can destroy.
pub(super) trait Handle: Copy {
    /// Destroys the object.
    ///
    /// # Safety
    ///
    /// It came from `device`, the device is not using it, and it is not used again.
    unsafe fn destroy(self, device: &ash::Device);
}

macro_rules! handles {
    ($($handle:ty => $destroy:ident,)*) => {$(
        impl Handle for $handle {
            unsafe fn destroy(self, device: &ash::Device) {
                // SAFETY: the caller's promise is the function's whole contract.
                unsafe { device.$destroy(self, None) }
            }
        }
    )*};
}

handles! {
    vk::CommandPool => destroy_command_pool,
    vk::DescriptorPool => destroy_descriptor_pool,
    vk::DescriptorSetLayout => destroy_descriptor_set_layout,
    vk::Fence => destroy_fence,
    vk::ImageView => destroy_image_view,
    vk::Pipeline => destroy_pipeline,
    vk::PipelineCache => destroy_pipeline_cache,
    vk::PipelineLayout => destroy_pipeline_layout,
    vk::QueryPool => destroy_query_pool,
    vk::Sampler => destroy_sampler,
    vk::ShaderModule => destroy_shader_module,
}

/// A handle together with the device that destroys it on drop.
///
/// Whoever holds one drops it only when the device is done with it: submissions keep theirs until their
/// fence.
pub(super) struct Owned<H: Handle> {
    handle: H,
    logical: Arc<Logical>,
}

impl<H: Handle> Owned<H> {
    /// Takes over a handle that `logical` has just made.
    pub(super) fn new(logical: &Arc<Logical>, handle: H) -> Self {
        Self { handle, logical: Arc::clone(logical) }
    }

    pub(super) fn is_of(&self, logical: &Arc<Logical>) -> bool {
        Arc::ptr_eq(&self.logical, logical)
    }

    pub(super) fn get(&self) -> H {
        self.handle
    }
}

impl<H: Handle> Drop for Owned<H> {
    fn drop(&mut self) {
        // SAFETY: made by this device and owned here alone; not in use, as the type's contract says.
        unsafe { self.handle.destroy(&self.logical.device) }
    }
}
