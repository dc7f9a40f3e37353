//! Images that kernels sample, and the memory behind them.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};

use super::call::{Named, lock};
use super::memory::Memory;
use crate::device::Error;

/// A two-dimensional image in the device's own memory.
pub(super) struct Image {
    handle: vk::Image,
    /// `None` only between creation and binding.
    allocation: Option<Allocation>,
    memory: Arc<Memory>,
}

impl Image {
    pub(super) fn new(
        memory: &Arc<Memory>,
        format: vk::Format,
        width: u32,
        height: u32,
    ) -> Result<Self, Error> {
        let device = &memory.logical.device;
        let create = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST)
            .initial_layout(vk::ImageLayout::UNDEFINED);
        // SAFETY: a live device and a filled-in description.
        let handle = unsafe { device.create_image(&create, None) }.named("vkCreateImage")?;
        let mut image = Self { handle, allocation: None, memory: Arc::clone(memory) };
        // SAFETY: `handle` is this device's.
        let requirements = unsafe { device.get_image_memory_requirements(handle) };
        let allocation = lock(&memory.allocator)
            .allocate(&AllocationCreateDesc {
                name: "table",
                requirements,
                location: MemoryLocation::GpuOnly,
                linear: false,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            })
            .map_err(|error| Error::Memory(format!("an image of {width} x {height}: {error}")))?;
        let allocation = image.allocation.insert(allocation);
        // SAFETY: the memory is this allocation's, made for this image's requirements and freed only after
        // it.
        unsafe { device.bind_image_memory(handle, allocation.memory(), allocation.offset()) }
            .named("vkBindImageMemory")?;
        Ok(image)
    }

    pub(super) fn handle(&self) -> vk::Image {
        self.handle
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: made by this device and owned here alone; whoever samples it holds it until its fence.
        unsafe { self.memory.logical.device.destroy_image(self.handle, None) };
        if let Some(allocation) = self.allocation.take() {
            // As for buffers: there is nobody here to tell.
            let _ = lock(&self.memory.allocator).free(allocation);
        }
    }
}

/// All of a single-level colour image.
pub(super) const WHOLE: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};
