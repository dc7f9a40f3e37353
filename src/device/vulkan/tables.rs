//! A kernel's tables on the device: uploaded once, bound with every dispatch.

use std::sync::Arc;

use ash::vk;

use super::call::Named;
use super::engine::{self, Engine};
use super::flight::Flight;
use super::image::{Image, WHOLE};
use super::lane::Extent;
use super::memory::Role;
use super::owned::Owned;
use super::pool::Lease;
use super::texel::TexelWidth;
use crate::catalog::{Kernel, TableBinding, TableForm};
use crate::device::Error;

/// The side that every Vulkan device allows an image.
const LARGEST_SIDE: u32 = 4096;

/// The descriptor set of the tables, and the layout of pipelines that use it beside the columns' set.
pub(super) struct Tables {
    pub(super) pipeline_layout: Owned<vk::PipelineLayout>,
    pub(super) set: vk::DescriptorSet,
    _descriptors: Owned<vk::DescriptorPool>,
    _set_layout: Owned<vk::DescriptorSetLayout>,
    _sampler: Owned<vk::Sampler>,
    _uploaded: Vec<Uploaded>,
}

enum Uploaded {
    Buffer(Arc<Lease>, u64),
    /// The view first: dropped before its image.
    Image(Owned<vk::ImageView>, #[expect(dead_code, reason = "held for the view")] Arc<Image>),
}

impl Tables {
    /// Uploads the kernel's tables and waits until they are there; `None` if it has none.
    pub(super) fn new(engine: &Arc<Engine>, kernel: &Kernel) -> Result<Option<Self>, Error> {
        if kernel.tables.is_empty() {
            return Ok(None);
        }
        for table in &kernel.tables {
            check(kernel, table)?;
        }
        let logical = engine.logical();
        let device = &logical.device;
        let bindings: Vec<_> = kernel
            .tables
            .iter()
            .map(|table| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(table.binding)
                    .descriptor_type(descriptor_type(table.form))
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: a live device and filled-in descriptions, here and below.
        let set_layout = unsafe { device.create_descriptor_set_layout(&create, None) };
        let set_layout = Owned::new(logical, set_layout.named("vkCreateDescriptorSetLayout")?);
        let pipeline_layout = engine::pipeline_layout(logical, &[engine.set_layout(), set_layout.get()])?;
        let sizes = [TableForm::Buffer, TableForm::Image].map(|form| {
            let count = kernel.tables.iter().filter(|table| table.form == form).count() as u32;
            // A size of no descriptors is not allowed.
            vk::DescriptorPoolSize::default().ty(descriptor_type(form)).descriptor_count(count.max(1))
        });
        let create = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: as above.
        let descriptors = unsafe { device.create_descriptor_pool(&create, None) };
        let descriptors = Owned::new(logical, descriptors.named("vkCreateDescriptorPool")?);
        let layouts = [set_layout.get()];
        let allocate =
            vk::DescriptorSetAllocateInfo::default().descriptor_pool(descriptors.get()).set_layouts(&layouts);
        // SAFETY: the pool is new and has room for this one set, which goes with it.
        let sets = unsafe { device.allocate_descriptor_sets(&allocate) }.named("vkAllocateDescriptorSets")?;
        let set = sets.first().copied().unwrap_or_default();

        let create = vk::SamplerCreateInfo::default()
            .mag_filter(vk::Filter::LINEAR)
            .min_filter(vk::Filter::LINEAR)
            .mipmap_mode(vk::SamplerMipmapMode::NEAREST)
            .address_mode_u(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .address_mode_v(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .address_mode_w(vk::SamplerAddressMode::CLAMP_TO_EDGE);
        // SAFETY: as above.
        let sampler = unsafe { device.create_sampler(&create, None) };
        let sampler = Owned::new(logical, sampler.named("vkCreateSampler")?);

        let mut uploaded = Vec::new();
        for table in &kernel.tables {
            let resource = match table.form {
                TableForm::Buffer => upload_buffer(engine, table)?,
                TableForm::Image => upload_image(engine, kernel, table)?,
            };
            write(engine, set, table.binding, &resource, sampler.get());
            uploaded.push(resource);
        }
        Ok(Some(Self {
            pipeline_layout,
            set,
            _descriptors: descriptors,
            _set_layout: set_layout,
            _sampler: sampler,
            _uploaded: uploaded,
        }))
    }
}

fn descriptor_type(form: TableForm) -> vk::DescriptorType {
    match form {
        TableForm::Buffer => vk::DescriptorType::STORAGE_BUFFER,
        TableForm::Image => vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
    }
}

fn check(kernel: &Kernel, table: &TableBinding) -> Result<(), Error> {
    let TableBinding { name, width, height, channels, .. } = table;
    let texels = *width as usize * *height as usize * *channels as usize;
    if !matches!(channels, 1 | 4) || texels == 0 || texels != table.texels.len() {
        return Err(Error::InvalidKernel {
            kernel: kernel.id.clone(),
            reason: format!(
                "its table {name} is said to have {width} x {height} texels of {channels} channels and has {} floats",
                table.texels.len()
            ),
        });
    }
    if table.form == TableForm::Image && (*width).max(*height) > LARGEST_SIDE {
        return Err(Error::NotSupported {
            kernel: kernel.id.clone(),
            what: format!("an image of {width} x {height} texels"),
        });
    }
    Ok(())
}

/// Words in a buffer that the host writes.
fn write_words(engine: &Engine, role: Role, words: &[u32]) -> Result<(Lease, u64), Error> {
    let bytes = size_of_val(words) as u64;
    let mut host = engine.pool.lease(role, bytes)?;
    // SAFETY: the lease is new, so the device does not use it.
    for (slot, word) in unsafe { host.write() }.iter_mut().zip(words) {
        *slot = f32::from_bits(*word);
    }
    Ok((host, bytes))
}

fn upload_buffer(engine: &Arc<Engine>, table: &TableBinding) -> Result<Uploaded, Error> {
    let words = TexelWidth::Single.words(&table.texels);
    if !engine.staging {
        let (buffer, bytes) = write_words(engine, Role::SharedInputs, &words)?;
        return Ok(Uploaded::Buffer(Arc::new(buffer), bytes));
    }
    let (host, bytes) = write_words(engine, Role::Upload, &words)?;
    let buffer = Arc::new(engine.pool.lease(Role::DeviceColumns, bytes)?);
    let (from, to) = (Extent { buffer: host.handle(), bytes }, buffer.handle());
    let mut flight = Flight::new(engine, (host, Arc::clone(&buffer)))?;
    let commands = flight.lane().record_copy(from, to)?;
    flight.submit(commands, true)?;
    flight.finish()?;
    Ok(Uploaded::Buffer(buffer, bytes))
}

fn upload_image(engine: &Arc<Engine>, kernel: &Kernel, table: &TableBinding) -> Result<Uploaded, Error> {
    let Some(width) = engine.texel_width() else {
        return Err(Error::NotSupported {
            kernel: kernel.id.clone(),
            what: "linear filtering of floating-point images".to_owned(),
        });
    };
    let logical = engine.logical();
    let format = width.format(table.channels);
    let image = Arc::new(Image::new(engine.pool.memory(), format, table.width, table.height)?);
    logical.name(image.handle(), table.name);
    let create = vk::ImageViewCreateInfo::default()
        .image(image.handle())
        .view_type(vk::ImageViewType::TYPE_2D)
        .format(format)
        .subresource_range(WHOLE);
    // SAFETY: a live device and image, and a filled-in description.
    let view = unsafe { logical.device.create_image_view(&create, None) }.named("vkCreateImageView")?;
    let view = Owned::new(logical, view);

    let (host, _) = write_words(engine, Role::Upload, &width.words(&table.texels))?;
    let from = host.handle();
    let mut flight = Flight::new(engine, (host, Arc::clone(&image)))?;
    let commands = flight.lane().record_image_copy(from, image.handle(), table.width, table.height)?;
    flight.submit(commands, true)?;
    flight.finish()?;
    Ok(Uploaded::Image(view, image))
}

/// Points a binding of the set at its table.
fn write(engine: &Engine, set: vk::DescriptorSet, binding: u32, resource: &Uploaded, sampler: vk::Sampler) {
    let (mut buffer, mut image) =
        ([vk::DescriptorBufferInfo::default()], [vk::DescriptorImageInfo::default()]);
    let write = vk::WriteDescriptorSet::default().dst_set(set).dst_binding(binding);
    let write = match resource {
        Uploaded::Buffer(lease, bytes) => {
            buffer = [buffer[0].buffer(lease.handle()).offset(0).range(*bytes)];
            write.descriptor_type(vk::DescriptorType::STORAGE_BUFFER).buffer_info(&buffer)
        }
        Uploaded::Image(view, _) => {
            image = [image[0]
                .sampler(sampler)
                .image_view(view.get())
                .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)];
            write.descriptor_type(vk::DescriptorType::COMBINED_IMAGE_SAMPLER).image_info(&image)
        }
    };
    // SAFETY: set and resource are alive, and no submission has used the set yet.
    unsafe { engine.logical().device.update_descriptor_sets(&[write], &[]) }
}
