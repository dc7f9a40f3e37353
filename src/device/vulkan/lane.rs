//! What one submission records into: commands, descriptors, queries and a fence.
//!
//! A lane belongs to one submission at a time, by value, which is all the synchronisation its pools need.

use std::sync::Arc;

use ash::vk;

use super::call::Named;
use super::image::WHOLE;
use super::logical::Logical;
use super::owned::Owned;
use super::program::Compiled;
use crate::catalog::kernel::{COLUMNS_SET, INPUTS_BINDING, LOCAL_SIZE, OUTPUTS_BINDING, Range, TABLES_SET};
use crate::device::Error;

/// A buffer and how much of it is in use.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub(super) buffer: vk::Buffer,
    pub(super) bytes: u64,
}

pub(super) struct Lane {
    logical: Arc<Logical>,
    commands: Owned<vk::CommandPool>,
    /// Made as needed; the first `recorded` of them hold commands since the last reset.
    buffers: Vec<vk::CommandBuffer>,
    recorded: usize,
    _descriptors: Owned<vk::DescriptorPool>,
    set: vk::DescriptorSet,
    pub(super) fence: Owned<vk::Fence>,
    queries: Option<(Owned<vk::QueryPool>, u32)>,
}

impl Lane {
    pub(super) fn new(
        logical: &Arc<Logical>,
        family: u32,
        layout: vk::DescriptorSetLayout,
    ) -> Result<Self, Error> {
        let device = &logical.device;
        let create = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(family);
        // SAFETY: a live device and filled-in descriptions, here and below.
        let commands = unsafe { device.create_command_pool(&create, None) }.named("vkCreateCommandPool")?;
        let commands = Owned::new(logical, commands);
        let sizes =
            [vk::DescriptorPoolSize::default().ty(vk::DescriptorType::STORAGE_BUFFER).descriptor_count(2)];
        let create = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: as above.
        let descriptors =
            unsafe { device.create_descriptor_pool(&create, None) }.named("vkCreateDescriptorPool")?;
        let descriptors = Owned::new(logical, descriptors);
        let layouts = [layout];
        let allocate =
            vk::DescriptorSetAllocateInfo::default().descriptor_pool(descriptors.get()).set_layouts(&layouts);
        // SAFETY: the pool is new and has room for this one set, which goes with it.
        let sets = unsafe { device.allocate_descriptor_sets(&allocate) }.named("vkAllocateDescriptorSets")?;
        // SAFETY: as above.
        let fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) };
        let fence = Owned::new(logical, fence.named("vkCreateFence")?);
        Ok(Self {
            logical: Arc::clone(logical),
            commands,
            buffers: Vec::new(),
            recorded: 0,
            _descriptors: descriptors,
            set: sets.first().copied().unwrap_or_default(),
            fence,
            queries: None,
        })
    }

    /// Forgets all commands. The device is done with them.
    pub(super) fn reset(&mut self) -> Result<(), Error> {
        self.recorded = 0;
        // SAFETY: lanes are reset only between submissions.
        unsafe {
            self.logical.device.reset_command_pool(self.commands.get(), vk::CommandPoolResetFlags::empty())
        }
        .named("vkResetCommandPool")
    }

    /// Points the kernel's two bindings at their columns.
    pub(super) fn bind(&self, inputs: Extent, outputs: Extent) {
        let info = |extent: Extent| {
            [vk::DescriptorBufferInfo::default().buffer(extent.buffer).offset(0).range(extent.bytes)]
        };
        let (inputs, outputs) = (info(inputs), info(outputs));
        let write = |binding| {
            vk::WriteDescriptorSet::default()
                .dst_set(self.set)
                .dst_binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
        };
        let writes =
            [write(INPUTS_BINDING).buffer_info(&inputs), write(OUTPUTS_BINDING).buffer_info(&outputs)];
        // SAFETY: buffers and set are alive, and no submission is using the set.
        unsafe { self.logical.device.update_descriptor_sets(&writes, &[]) }
    }

    /// Makes room for the timestamps of `dispatches`. The device is done with earlier ones.
    pub(super) fn reserve_timestamps(&mut self, dispatches: usize) -> Result<(), Error> {
        let wanted = 2 * dispatches as u32;
        if self.queries.as_ref().is_some_and(|&(_, room)| room >= wanted) {
            return Ok(());
        }
        let room = wanted.next_power_of_two().max(64);
        let create =
            vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(room);
        // SAFETY: a live device and a filled-in description.
        let pool =
            unsafe { self.logical.device.create_query_pool(&create, None) }.named("vkCreateQueryPool")?;
        self.queries = Some((Owned::new(&self.logical, pool), room));
        Ok(())
    }

    /// The timestamps before and after each of the first `dispatches`, finished by now.
    pub(super) fn timestamps(&self, dispatches: usize) -> Result<Vec<u64>, Error> {
        let mut stamps = vec![0; 2 * dispatches];
        if let Some((pool, _)) = &self.queries
            && dispatches > 0
        {
            // Not WAIT: after the fence they are there, and if they are not it must not hang.
            // SAFETY: the pool has room for these queries, each reset and written by finished commands.
            unsafe {
                self.logical.device.get_query_pool_results(
                    pool.get(),
                    0,
                    &mut stamps,
                    vk::QueryResultFlags::TYPE_64,
                )
            }
            .named("vkGetQueryPoolResults")?;
        }
        Ok(stamps)
    }

    /// Records one dispatch between full barriers; `timestamps`: the pair of queries that takes its time.
    pub(super) fn record_dispatch(
        &mut self,
        compiled: &Compiled,
        layout: vk::PipelineLayout,
        range: Range,
        timestamps: Option<u32>,
    ) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        let device = &self.logical.device;
        let queries = self.queries.as_ref().map(|(pool, _)| pool.get()).zip(timestamps);
        // SAFETY: the command buffer is recording; pipeline, layout, set and queries are this device's and
        // stay alive with the submission; group counts are within the limit that split the rows.
        unsafe {
            if let Some((pool, pair)) = queries {
                device.cmd_reset_query_pool(commands, pool, 2 * pair, 2);
            }
            device.cmd_bind_pipeline(commands, vk::PipelineBindPoint::COMPUTE, compiled.pipeline.get());
            device.cmd_bind_descriptor_sets(
                commands,
                vk::PipelineBindPoint::COMPUTE,
                layout,
                COLUMNS_SET,
                &[self.set],
                &[],
            );
            if let Some(tables) = &compiled.tables {
                device.cmd_bind_descriptor_sets(
                    commands,
                    vk::PipelineBindPoint::COMPUTE,
                    layout,
                    TABLES_SET,
                    &[tables.set],
                    &[],
                );
            }
            device.cmd_push_constants(commands, layout, vk::ShaderStageFlags::COMPUTE, 0, &range.bytes());
            self.barrier(commands);
            // At the bottom of the pipe: a stamp at the top may be taken while earlier work is still
            // draining.
            if let Some((pool, pair)) = queries {
                device.cmd_write_timestamp(commands, vk::PipelineStageFlags::BOTTOM_OF_PIPE, pool, 2 * pair);
            }
            device.cmd_dispatch(commands, range.count.div_ceil(LOCAL_SIZE), 1, 1);
            if let Some((pool, pair)) = queries {
                device.cmd_write_timestamp(
                    commands,
                    vk::PipelineStageFlags::BOTTOM_OF_PIPE,
                    pool,
                    2 * pair + 1,
                );
            }
            self.barrier(commands);
        }
        self.end(commands)
    }

    /// Records a copy of the beginning of `from` to that of `to`.
    pub(super) fn record_copy(&mut self, from: Extent, to: vk::Buffer) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        let region = [vk::BufferCopy::default().size(from.bytes)];
        // SAFETY: the command buffer is recording; both buffers are at least so long and stay with the
        // submission.
        unsafe {
            self.barrier(commands);
            self.logical.device.cmd_copy_buffer(commands, from.buffer, to, &region);
            self.barrier(commands);
        }
        self.end(commands)
    }

    /// Records a copy of tightly packed texels from the beginning of `from` to the whole of a new image, which it
    /// leaves ready for sampling.
    pub(super) fn record_image_copy(
        &mut self,
        from: vk::Buffer,
        to: vk::Image,
        width: u32,
        height: u32,
    ) -> Result<vk::CommandBuffer, Error> {
        use vk::{AccessFlags as A, ImageLayout as L};
        let commands = self.begin()?;
        let layer = vk::ImageSubresourceLayers {
            aspect_mask: WHOLE.aspect_mask,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let region = [vk::BufferImageCopy::default().image_subresource(layer).image_extent(vk::Extent3D {
            width,
            height,
            depth: 1,
        })];
        // SAFETY: the command buffer is recording; the buffer has all texels, and both stay with the submission.
        unsafe {
            self.barrier(commands);
            self.transition(
                commands,
                to,
                (L::UNDEFINED, A::empty()),
                (L::TRANSFER_DST_OPTIMAL, A::TRANSFER_WRITE),
            );
            let copied = L::TRANSFER_DST_OPTIMAL;
            self.logical.device.cmd_copy_buffer_to_image(commands, from, to, copied, &region);
            self.transition(
                commands,
                to,
                (copied, A::TRANSFER_WRITE),
                (L::SHADER_READ_ONLY_OPTIMAL, A::SHADER_READ),
            );
        }
        self.end(commands)
    }

    /// Records filling a buffer with a word.
    pub(super) fn record_fill(&mut self, extent: Extent, word: u32) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        // SAFETY: as in `record_copy`; the length is a multiple of 4, being columns of f32.
        unsafe {
            self.barrier(commands);
            self.logical.device.cmd_fill_buffer(commands, extent.buffer, 0, extent.bytes, word);
            self.barrier(commands);
        }
        self.end(commands)
    }

    fn begin(&mut self) -> Result<vk::CommandBuffer, Error> {
        let device = &self.logical.device;
        if self.recorded == self.buffers.len() {
            let allocate = vk::CommandBufferAllocateInfo::default()
                .command_pool(self.commands.get())
                .level(vk::CommandBufferLevel::PRIMARY)
                .command_buffer_count(1);
            // SAFETY: the pool is this lane's alone; its buffers go with it.
            let made = unsafe { device.allocate_command_buffers(&allocate) };
            self.buffers.extend(made.named("vkAllocateCommandBuffers")?);
        }
        let commands = self.buffers[self.recorded];
        self.recorded += 1;
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the buffer has been reset with its pool since it was last used.
        unsafe { device.begin_command_buffer(commands, &begin) }.named("vkBeginCommandBuffer")?;
        Ok(commands)
    }

    fn end(&self, commands: vk::CommandBuffer) -> Result<vk::CommandBuffer, Error> {
        // SAFETY: the buffer is recording.
        unsafe { self.logical.device.end_command_buffer(commands) }.named("vkEndCommandBuffer")?;
        Ok(commands)
    }

    /// Everything before, the host's writes too, is finished and visible to everything after, the host too.
    ///
    /// # Safety
    ///
    /// `commands` is recording.
    unsafe fn barrier(&self, commands: vk::CommandBuffer) {
        use vk::{AccessFlags as A, PipelineStageFlags as S};
        let memory = [vk::MemoryBarrier::default()
            .src_access_mask(A::MEMORY_WRITE | A::HOST_WRITE)
            .dst_access_mask(A::MEMORY_READ | A::MEMORY_WRITE | A::HOST_READ)];
        let stages = S::ALL_COMMANDS | S::HOST;
        // SAFETY: the caller's promise.
        unsafe {
            self.logical.device.cmd_pipeline_barrier(
                commands,
                stages,
                stages,
                vk::DependencyFlags::empty(),
                &memory,
                &[],
                &[],
            );
        }
    }

    /// Takes an image from one layout and access to another, everything before to everything after.
    ///
    /// # Safety
    ///
    /// `commands` is recording, and `image` is in the first layout when they run.
    unsafe fn transition(
        &self,
        commands: vk::CommandBuffer,
        image: vk::Image,
        from: (vk::ImageLayout, vk::AccessFlags),
        to: (vk::ImageLayout, vk::AccessFlags),
    ) {
        let barrier = [vk::ImageMemoryBarrier::default()
            .old_layout(from.0)
            .src_access_mask(from.1)
            .new_layout(to.0)
            .dst_access_mask(to.1)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(image)
            .subresource_range(WHOLE)];
        let stages = vk::PipelineStageFlags::ALL_COMMANDS;
        // SAFETY: the caller's promise.
        unsafe {
            self.logical.device.cmd_pipeline_barrier(
                commands,
                stages,
                stages,
                vk::DependencyFlags::empty(),
                &[],
                &[],
                &barrier,
            );
        }
    }
}
