//! What all work on one device shares: queue, layouts, buffers, lanes and limits.

use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex};

use ash::vk;

use super::adapter::Adapter;
use super::call::{Named, lock};
use super::capability::Abilities;
use super::instance::Loaded;
use super::lane::Lane;
use super::logical::Logical;
use super::memory::Memory;
use super::owned::Owned;
use super::pool::Pool;
use super::texel::TexelWidth;
use super::vulkan_device::Options;
use crate::catalog::kernel::{INPUTS_BINDING, LOCAL_SIZE, OUTPUTS_BINDING, Range};
use crate::device::{Clock, Error};

/// Lanes kept for reuse; more can be in flight.
const IDLE_LANES: usize = 16;

pub(super) struct Engine {
    lanes: Mutex<Vec<Lane>>,
    pub(super) pool: Arc<Pool>,
    cache: Owned<vk::PipelineCache>,
    pipeline_layout: Owned<vk::PipelineLayout>,
    set_layout: Owned<vk::DescriptorSetLayout>,
    /// Locked around every submission and every wait for idleness, as Vulkan demands.
    pub(super) queue: Mutex<vk::Queue>,
    /// What the work in flight is expected to take.
    pub(super) backlog_ns: AtomicU64,
    logical: Arc<Logical>,
    family: u32,
    abilities: Abilities,
    limits: Limits,
    pub(super) stopwatch: Stopwatch,
    /// Kernels work on device memory, with copies to and from it.
    pub(super) staging: bool,
    pub(super) poison: bool,
    texel_width: Option<TexelWidth>,
}

struct Limits {
    /// Configurations in one dispatch.
    dispatch: u32,
    /// Bytes in one set of columns.
    bytes: u64,
}

/// How times are taken.
#[derive(Debug, PartialEq)]
pub(super) struct Stopwatch {
    pub(super) clock: Clock,
    mask: u64,
    period_ns: f64,
}

impl Stopwatch {
    /// For a queue whose timestamps have so many meaningful bits and so many nanoseconds a tick. The host's clock where
    /// there are none, where a tick is said to be no time at all, or where `ignored`.
    fn new(bits: u32, period_ns: f32, ignored: bool) -> Self {
        let usable = bits > 0 && period_ns.is_finite() && period_ns > 0.0 && !ignored;
        Stopwatch {
            clock: if usable { Clock::DeviceTimestamps } else { Clock::HostFence },
            mask: u64::MAX >> (64 - bits.clamp(1, 64)),
            // A float in the interface, and rarely whole: 83.3 ns truncated to 83 is 0.4 % off.
            period_ns: f64::from(period_ns),
        }
    }

    /// Nanoseconds between two timestamps, the counter having wrapped at most once.
    pub(super) fn ns(&self, before: u64, after: u64) -> f64 {
        (after.wrapping_sub(before) & self.mask) as f64 * self.period_ns
    }
}

impl Engine {
    pub(super) fn open(
        loaded: &Arc<Loaded>,
        adapter: &Adapter,
        options: Options,
    ) -> Result<Arc<Self>, Error> {
        let logical = Logical::open(loaded, adapter)?;
        let device = &logical.device;
        let binding = |binding| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        };
        let bindings = [binding(INPUTS_BINDING), binding(OUTPUTS_BINDING)];
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: a live device and filled-in descriptions, here and below.
        let set_layout = unsafe { device.create_descriptor_set_layout(&create, None) };
        let set_layout = Owned::new(&logical, set_layout.named("vkCreateDescriptorSetLayout")?);
        let pipeline_layout = pipeline_layout(&logical, &[set_layout.get()])?;
        // SAFETY: as above.
        let cache = unsafe { device.create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) };
        let cache = Owned::new(&logical, cache.named("vkCreatePipelineCache")?);
        // SAFETY: the device was opened with one queue of this family.
        let queue = unsafe { device.get_device_queue(adapter.family, 0) };
        let memory = Memory::new(&logical, &loaded.instance, adapter.physical)?;
        Ok(Arc::new(Self {
            lanes: Mutex::default(),
            pool: Pool::new(memory),
            cache,
            pipeline_layout,
            set_layout,
            queue: Mutex::new(queue),
            backlog_ns: AtomicU64::new(0),
            logical,
            family: adapter.family,
            abilities: adapter.abilities,
            limits: Limits {
                dispatch: adapter.limits.max_compute_work_group_count[0].saturating_mul(LOCAL_SIZE),
                bytes: u64::from(adapter.limits.max_storage_buffer_range).min(adapter.max_allocation),
            },
            stopwatch: Stopwatch::new(
                adapter.facts.timestamp_bits,
                adapter.limits.timestamp_period,
                options.ignore_timestamps,
            ),
            staging: options.force_staging || !adapter.facts.unified_memory,
            poison: options.poison_outputs,
            texel_width: adapter
                .texel_width
                .map(|widest| if options.half_images { TexelWidth::Half } else { widest }),
        }))
    }

    pub(super) fn logical(&self) -> &Arc<Logical> {
        &self.logical
    }

    pub(super) fn abilities(&self) -> &Abilities {
        &self.abilities
    }

    pub(super) fn pipeline_layout(&self) -> vk::PipelineLayout {
        self.pipeline_layout.get()
    }

    /// The layout of the columns' descriptor set.
    pub(super) fn set_layout(&self) -> vk::DescriptorSetLayout {
        self.set_layout.get()
    }

    /// How wide texels of sampled tables are; `None`: none can be filtered.
    pub(super) fn texel_width(&self) -> Option<TexelWidth> {
        self.texel_width
    }

    pub(super) fn pipeline_cache(&self) -> vk::PipelineCache {
        self.cache.get()
    }

    /// The most configurations one dispatch may have; whole workgroups.
    pub(super) fn dispatch_limit(&self) -> u32 {
        self.limits.dispatch / LOCAL_SIZE * LOCAL_SIZE
    }

    /// The most rows whose columns fit a buffer's range and a u32 element index, at least 1.
    pub(super) fn max_rows(&self, columns: usize) -> usize {
        let columns = columns.max(1) as u64;
        let elements = (self.limits.bytes / 4).min(u64::from(u32::MAX));
        // The last workgroup's invocations must not wrap around either.
        let rows = (elements / columns).min(u64::from(u32::MAX - LOCAL_SIZE));
        usize::try_from(rows).unwrap_or(usize::MAX).max(1)
    }

    /// A lane with nothing recorded.
    pub(super) fn lane(&self) -> Result<Lane, Error> {
        let idle = lock(&self.lanes).pop();
        match idle {
            Some(lane) => Ok(lane),
            None => Lane::new(&self.logical, self.family, self.set_layout.get()),
        }
    }

    /// Takes back a lane that the device is done with.
    pub(super) fn recycle(&self, mut lane: Lane) {
        if lane.reset().is_ok() {
            let mut lanes = lock(&self.lanes);
            if lanes.len() < IDLE_LANES {
                lanes.push(lane);
            }
        }
    }
}

/// The layout of pipelines that take a [`Range`] and use these descriptor sets.
pub(super) fn pipeline_layout(
    logical: &Arc<Logical>,
    sets: &[vk::DescriptorSetLayout],
) -> Result<Owned<vk::PipelineLayout>, Error> {
    let constants = [vk::PushConstantRange::default()
        .stage_flags(vk::ShaderStageFlags::COMPUTE)
        .size(size_of::<Range>() as u32)];
    let create = vk::PipelineLayoutCreateInfo::default().set_layouts(sets).push_constant_ranges(&constants);
    // SAFETY: a live device, layouts of it, and a filled-in description.
    let layout = unsafe { logical.device.create_pipeline_layout(&create, None) };
    Ok(Owned::new(logical, layout.named("vkCreatePipelineLayout")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrapped_counter_and_a_broken_period_are_exact() {
        let stopwatch = Stopwatch::new(36, 83.333_336, false);
        assert_eq!(stopwatch.clock, Clock::DeviceTimestamps);
        assert_eq!(stopwatch.ns(10, 1_010), 1000.0 * f64::from(83.333_336_f32));
        assert_eq!(stopwatch.ns((1 << 36) - 1, 9), 10.0 * f64::from(83.333_336_f32));
        // Bits above the valid ones are noise.
        assert_eq!(stopwatch.ns(0xdead << 40, 0xbeef << 40 | 5), 5.0 * f64::from(83.333_336_f32));
        // All 64 bits, which no shift may overflow, and a single one.
        assert_eq!(Stopwatch::new(64, 1.0, false).ns(u64::MAX - 1, 3), 5.0);
        assert_eq!(Stopwatch::new(1, 2.0, false).ns(u64::MAX, 2), 2.0);
        // A second apart at a tick that is no binary fraction: within the rounding of f64.
        let second = Stopwatch::new(64, 0.1, false).ns(0, 10_000_000_000);
        assert!((second - 1e10 * f64::from(0.1_f32)).abs() < 1e-6, "{second}");
    }

    #[test]
    fn without_usable_timestamps_the_host_takes_the_time() {
        for (bits, period, ignored) in
            [(0, 1.0, false), (64, 0.0, false), (64, f32::NAN, false), (64, -1.0, false), (64, 1.0, true)]
        {
            assert_eq!(Stopwatch::new(bits, period, ignored).clock, Clock::HostFence, "{bits} {period}");
        }
    }
}
