//! A physical device as read before it is opened.

use std::ffi::CStr;

use ash::{khr, vk};

use super::call::Named;
use super::capability::{Abilities, FloatModes};
use super::instance::Loaded;
use super::texel::TexelWidth;
use crate::device::{Error, Facts, FloatControls};

/// A physical device that can run kernels.
pub(super) struct Adapter {
    pub(super) physical: vk::PhysicalDevice,
    pub(super) facts: Facts,
    pub(super) limits: vk::PhysicalDeviceLimits,
    /// The largest single allocation, in bytes.
    pub(super) max_allocation: u64,
    /// The queue family to use.
    pub(super) family: u32,
    pub(super) abilities: Abilities,
    /// Texels of sampled tables.
    pub(super) texel_width: Option<TexelWidth>,
    /// Extensions to enable with the device.
    pub(super) extensions: Vec<&'static CStr>,
}

impl Adapter {
    /// Reads everything; `None` if the device is below Vulkan 1.1 or has no compute queue.
    pub(super) fn read(
        loaded: &Loaded,
        physical: vk::PhysicalDevice,
        index: usize,
    ) -> Result<Option<Self>, Error> {
        let instance = &loaded.instance;
        // SAFETY: `physical` is this instance's, here and below.
        let plain = unsafe { instance.get_physical_device_properties(physical) };
        let api = plain.api_version.min(loaded.api);
        if api < vk::API_VERSION_1_1 {
            return Ok(None);
        }
        // SAFETY: as above.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
        let Some((family, timestamp_bits)) = compute_family(&families) else {
            return Ok(None);
        };
        // SAFETY: as above.
        let offered = unsafe { instance.enumerate_device_extension_properties(physical) }
            .named("vkEnumerateDeviceExtensionProperties")?;
        let offers =
            |name: &CStr| offered.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name));

        let mut extensions = Vec::new();
        // What later versions made core is enabled as an extension on earlier ones.
        let mut has = |core: u32, name: &'static CStr| {
            if api >= core {
                return true;
            }
            let offered = offers(name);
            if offered {
                extensions.push(name);
            }
            offered
        };
        let has_driver = has(vk::API_VERSION_1_2, khr::driver_properties::NAME);
        let has_float_controls = has(vk::API_VERSION_1_2, khr::shader_float_controls::NAME);
        let has_small_types = has(vk::API_VERSION_1_2, khr::shader_float16_int8::NAME);
        let non_semantic = has(vk::API_VERSION_1_3, khr::shader_non_semantic_info::NAME);
        // Such a device must be opened with it.
        if offers(khr::portability_subset::NAME) {
            extensions.push(khr::portability_subset::NAME);
        }

        let mut id = vk::PhysicalDeviceIDProperties::default();
        let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
        let mut maintenance = vk::PhysicalDeviceMaintenance3Properties::default();
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut float_controls = vk::PhysicalDeviceFloatControlsProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default()
            .push_next(&mut id)
            .push_next(&mut subgroup)
            .push_next(&mut maintenance);
        if has_driver {
            properties = properties.push_next(&mut driver);
        }
        if has_float_controls {
            properties = properties.push_next(&mut float_controls);
        }
        // SAFETY: the device is of Vulkan 1.1 or later and knows every structure in the chain.
        unsafe { instance.get_physical_device_properties2(physical, &mut properties) };

        let mut storage16 = vk::PhysicalDevice16BitStorageFeatures::default();
        let mut small_types = vk::PhysicalDeviceShaderFloat16Int8Features::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut storage16);
        if has_small_types {
            features = features.push_next(&mut small_types);
        }
        // SAFETY: as above.
        unsafe { instance.get_physical_device_features2(physical, &mut features) };
        let features = features.features;
        // SAFETY: as above.
        let memory = unsafe { instance.get_physical_device_memory_properties(physical) };

        let in_compute = subgroup.supported_stages.contains(vk::ShaderStageFlags::COMPUTE);
        let abilities = Abilities {
            spirv: match api {
                api if api >= vk::API_VERSION_1_3 => 0x0001_0600,
                api if api >= vk::API_VERSION_1_2 => 0x0001_0500,
                _ => 0x0001_0300,
            },
            float64: features.shader_float64 != 0,
            float16: small_types.shader_float16 != 0,
            int64: features.shader_int64 != 0,
            int16: features.shader_int16 != 0,
            int8: small_types.shader_int8 != 0,
            storage16: storage16.storage_buffer16_bit_access != 0,
            subgroup: if in_compute {
                subgroup.supported_operations
            } else {
                vk::SubgroupFeatureFlags::empty()
            },
            float_modes: float_modes(&float_controls),
            non_semantic,
        };
        let texel_width = TexelWidth::widest(instance, physical);
        let facts = Facts {
            index,
            name: text(plain.device_name_as_c_str().ok()),
            kind: kind(plain.device_type).to_owned(),
            uuid: id.device_uuid.iter().map(|byte| format!("{byte:02x}")).collect(),
            vendor_id: plain.vendor_id,
            device_id: plain.device_id,
            driver: text(driver.driver_name_as_c_str().ok()),
            driver_info: text(driver.driver_info_as_c_str().ok()),
            driver_version: plain.driver_version,
            api_version: version(plain.api_version),
            subgroup_size: subgroup.subgroup_size,
            shader_float64: abilities.float64,
            shader_float16: abilities.float16,
            float_controls: has_float_controls.then(|| float_facts(&abilities.float_modes)),
            max_storage_buffer_range: u64::from(plain.limits.max_storage_buffer_range),
            unified_memory: unified(plain.device_type, &memory),
            timestamp_period: plain.limits.timestamp_period,
            timestamp_bits,
            table_image_bits: texel_width.map_or(0, TexelWidth::bits),
            validation: loaded.validating(),
        };
        Ok(Some(Self {
            physical,
            facts,
            limits: plain.limits,
            max_allocation: maintenance.max_memory_allocation_size,
            family,
            abilities,
            texel_width,
            extensions,
        }))
    }
}

/// The family to use and its timestamp bits: of those that compute the one with the most timestamp bits, and
/// of these one without graphics, where nothing else is likely to be in the way.
fn compute_family(families: &[vk::QueueFamilyProperties]) -> Option<(u32, u32)> {
    let mut best: Option<((u32, bool), u32)> = None;
    for (index, family) in (0..).zip(families) {
        if !family.queue_flags.contains(vk::QueueFlags::COMPUTE) || family.queue_count == 0 {
            continue;
        }
        let worth = (family.timestamp_valid_bits, !family.queue_flags.contains(vk::QueueFlags::GRAPHICS));
        if best.is_none_or(|(most, _)| worth > most) {
            best = Some((worth, index));
        }
    }
    best.map(|((bits, _), index)| (index, bits))
}

/// Whether kernels should work on host memory in place.
///
/// Only where there is one memory for both sides (a CPU, an integrated GPU, or every heap the device's own):
/// a discrete GPU can map some of its memory too, but then each output the host reads would cross the bus by
/// itself. And not where cached memory exists only apart from the device's: reading outputs from uncached
/// memory costs more than a copy.
fn unified(kind: vk::PhysicalDeviceType, memory: &vk::PhysicalDeviceMemoryProperties) -> bool {
    use vk::MemoryPropertyFlags as P;
    let one_memory = match kind {
        vk::PhysicalDeviceType::CPU | vk::PhysicalDeviceType::INTEGRATED_GPU => true,
        vk::PhysicalDeviceType::DISCRETE_GPU => false,
        _ => memory
            .memory_heaps_as_slice()
            .iter()
            .all(|heap| heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL)),
    };
    let offers = |flags: P| {
        memory.memory_types_as_slice().iter().any(|memory_type| memory_type.property_flags.contains(flags))
    };
    let shared = P::HOST_VISIBLE | P::HOST_COHERENT;
    let cached = shared | P::HOST_CACHED;
    one_memory && offers(P::DEVICE_LOCAL | shared) && (offers(P::DEVICE_LOCAL | cached) || !offers(cached))
}

fn kind(device_type: vk::PhysicalDeviceType) -> &'static str {
    match device_type {
        vk::PhysicalDeviceType::CPU => "cpu",
        vk::PhysicalDeviceType::INTEGRATED_GPU => "integrated_gpu",
        vk::PhysicalDeviceType::DISCRETE_GPU => "discrete_gpu",
        vk::PhysicalDeviceType::VIRTUAL_GPU => "virtual_gpu",
        _ => "other",
    }
}

fn version(version: u32) -> String {
    format!(
        "{}.{}.{}",
        vk::api_version_major(version),
        vk::api_version_minor(version),
        vk::api_version_patch(version)
    )
}

fn text(text: Option<&CStr>) -> String {
    text.unwrap_or_default().to_string_lossy().into_owned()
}

fn float_modes(controls: &vk::PhysicalDeviceFloatControlsProperties<'_>) -> FloatModes {
    let widths =
        |half: vk::Bool32, single: vk::Bool32, double: vk::Bool32| [half, single, double].map(|has| has != 0);
    FloatModes {
        denorm_preserve: widths(
            controls.shader_denorm_preserve_float16,
            controls.shader_denorm_preserve_float32,
            controls.shader_denorm_preserve_float64,
        ),
        denorm_flush_to_zero: widths(
            controls.shader_denorm_flush_to_zero_float16,
            controls.shader_denorm_flush_to_zero_float32,
            controls.shader_denorm_flush_to_zero_float64,
        ),
        signed_zero_inf_nan_preserve: widths(
            controls.shader_signed_zero_inf_nan_preserve_float16,
            controls.shader_signed_zero_inf_nan_preserve_float32,
            controls.shader_signed_zero_inf_nan_preserve_float64,
        ),
        rounding_rte: widths(
            controls.shader_rounding_mode_rte_float16,
            controls.shader_rounding_mode_rte_float32,
            controls.shader_rounding_mode_rte_float64,
        ),
        rounding_rtz: widths(
            controls.shader_rounding_mode_rtz_float16,
            controls.shader_rounding_mode_rtz_float32,
            controls.shader_rounding_mode_rtz_float64,
        ),
    }
}

/// The f32 part.
fn float_facts(modes: &FloatModes) -> FloatControls {
    FloatControls {
        preserves_signed_zero_inf_nan: modes.signed_zero_inf_nan_preserve[1],
        preserves_denormals: modes.denorm_preserve[1],
        flushes_denormals: modes.denorm_flush_to_zero[1],
        rounds_to_nearest_even: modes.rounding_rte[1],
        rounds_toward_zero: modes.rounding_rtz[1],
    }
}
