//! Buffers and the memory behind them.

use std::sync::{Arc, Mutex};

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};

use super::call::{Named, lock};
use super::logical::Logical;
use crate::device::Error;

/// What a buffer is for; it decides usage and memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Inputs that the host writes and kernels read in place.
    SharedInputs,
    /// Outputs that kernels write and the host reads in place.
    SharedOutputs,
    /// Columns in the device's own memory, copied to or from it.
    DeviceColumns,
    /// What the host writes and the device copies from.
    Upload,
    /// What the device copies to and the host reads.
    Download,
}

impl Role {
    fn usage(self) -> vk::BufferUsageFlags {
        match self {
            Self::SharedInputs => vk::BufferUsageFlags::STORAGE_BUFFER,
            Self::SharedOutputs => vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
            Self::DeviceColumns => {
                vk::BufferUsageFlags::STORAGE_BUFFER
                    | vk::BufferUsageFlags::TRANSFER_SRC
                    | vk::BufferUsageFlags::TRANSFER_DST
            }
            Self::Upload => vk::BufferUsageFlags::TRANSFER_SRC,
            Self::Download => vk::BufferUsageFlags::TRANSFER_DST,
        }
    }

    /// The allocator's `CpuToGpu` and `GpuToCpu` are always host coherent, so nothing here flushes or
    /// invalidates; `GpuToCpu` prefers cached memory, without which reading outputs back is slower by an
    /// order of magnitude.
    fn location(self) -> MemoryLocation {
        match self {
            Self::SharedInputs | Self::Upload => MemoryLocation::CpuToGpu,
            Self::SharedOutputs | Self::Download => MemoryLocation::GpuToCpu,
            Self::DeviceColumns => MemoryLocation::GpuOnly,
        }
    }
}

/// The device's allocator.
pub(super) struct Memory {
    /// First, so that memory is freed before the device goes.
    pub(super) allocator: Mutex<Allocator>,
    pub(super) logical: Arc<Logical>,
}

impl Memory {
    pub(super) fn new(
        logical: &Arc<Logical>,
        instance: &ash::Instance,
        physical: vk::PhysicalDevice,
    ) -> Result<Arc<Self>, Error> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.clone(),
            device: logical.device.clone(),
            physical_device: physical,
            debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
            buffer_device_address: false,
            allocation_sizes: gpu_allocator::AllocationSizes::default(),
        })
        .map_err(|error| Error::Memory(error.to_string()))?;
        Ok(Arc::new(Self { allocator: Mutex::new(allocator), logical: Arc::clone(logical) }))
    }
}

/// A buffer bound to memory of its own.
pub(super) struct Buffer {
    handle: vk::Buffer,
    /// `None` only between creation and binding.
    allocation: Option<Allocation>,
    memory: Arc<Memory>,
}

impl Buffer {
    pub(super) fn new(memory: &Arc<Memory>, role: Role, bytes: u64) -> Result<Self, Error> {
        let device = &memory.logical.device;
        let create = vk::BufferCreateInfo::default().size(bytes).usage(role.usage());
        // SAFETY: a live device and a filled-in description.
        let handle = unsafe { device.create_buffer(&create, None) }.named("vkCreateBuffer")?;
        let mut buffer = Self { handle, allocation: None, memory: Arc::clone(memory) };
        // SAFETY: `handle` is this device's.
        let mut requirements = unsafe { device.get_buffer_memory_requirements(handle) };
        // Columns are read as f32; a cache line keeps neighbours in one block from sharing one.
        requirements.alignment = requirements.alignment.max(64);
        let allocation = lock(&memory.allocator)
            .allocate(&AllocationCreateDesc {
                name: "columns",
                requirements,
                location: role.location(),
                linear: true,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            })
            .map_err(|error| Error::Memory(format!("{bytes} bytes for {role:?}: {error}")))?;
        let allocation = buffer.allocation.insert(allocation);
        if role.location() != MemoryLocation::GpuOnly && allocation.mapped_ptr().is_none() {
            return Err(Error::Memory(format!("{role:?} is not visible to the host")));
        }
        // SAFETY: the memory is this allocation's, made for this buffer's requirements and freed only after
        // it.
        unsafe { device.bind_buffer_memory(handle, allocation.memory(), allocation.offset()) }
            .named("vkBindBufferMemory")?;
        Ok(buffer)
    }

    pub(super) fn handle(&self) -> vk::Buffer {
        self.handle
    }

    /// The buffer's memory as f32; empty where the host does not see it.
    ///
    /// # Safety
    ///
    /// The device does not write the buffer while the slice lives.
    pub(super) unsafe fn read(&self) -> &[f32] {
        let bytes = self.allocation.as_ref().and_then(Allocation::mapped_slice).unwrap_or(&[]);
        // SAFETY: any bits are an f32. The memory is 64-byte aligned, so nothing is cut off in front.
        unsafe { bytes.align_to::<f32>().1 }
    }

    /// As [`read`](Self::read), to write. Contents are whatever they were before.
    ///
    /// # Safety
    ///
    /// The device does not use the buffer while the slice lives.
    pub(super) unsafe fn write(&mut self) -> &mut [f32] {
        let bytes = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut).unwrap_or(&mut []);
        // SAFETY: as in `read`; exclusive through `&mut self`.
        unsafe { bytes.align_to_mut::<f32>().1 }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: made by this device and owned here alone; a submission keeps its buffers until its fence.
        unsafe { self.memory.logical.device.destroy_buffer(self.handle, None) };
        if let Some(allocation) = self.allocation.take() {
            // Failure would mean that the allocator lost its books; there is nobody here to tell.
            let _ = lock(&self.memory.allocator).free(allocation);
        }
    }
}
