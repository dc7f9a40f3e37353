//! The logical device: what every handle on the device keeps alive.

use std::ffi::CString;
use std::sync::Arc;

use ash::{ext, vk};

use super::adapter::Adapter;
use super::call::Named;
use super::instance::Loaded;
use crate::device::Error;

/// An open device.
pub(super) struct Logical {
    pub(super) device: ash::Device,
    /// Names objects in validation messages; only under validation.
    names: Option<ext::debug_utils::Device>,
    /// Dropped after the device is destroyed.
    _loaded: Arc<Loaded>,
}

impl Logical {
    /// Opens the device with one queue and every ability that [`Abilities`](super::capability::Abilities)
    /// names.
    pub(super) fn open(loaded: &Arc<Loaded>, adapter: &Adapter) -> Result<Arc<Self>, Error> {
        let abilities = &adapter.abilities;
        let mut storage16 = vk::PhysicalDevice16BitStorageFeatures::default()
            .storage_buffer16_bit_access(abilities.storage16);
        let mut small_types = vk::PhysicalDeviceShaderFloat16Int8Features::default()
            .shader_float16(abilities.float16)
            .shader_int8(abilities.int8);
        let mut features = vk::PhysicalDeviceFeatures2::default()
            .features(
                vk::PhysicalDeviceFeatures::default()
                    .shader_float64(abilities.float64)
                    .shader_int64(abilities.int64)
                    .shader_int16(abilities.int16),
            )
            .push_next(&mut storage16);
        if abilities.float16 || abilities.int8 {
            features = features.push_next(&mut small_types);
        }
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(adapter.family)
            .queue_priorities(&[1.0])];
        let extensions: Vec<_> = adapter.extensions.iter().map(|name| name.as_ptr()).collect();
        let create = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&extensions)
            .push_next(&mut features);
        // SAFETY: the physical device is this instance's; it offers all that is enabled; the chain outlives
        // the call.
        let device = unsafe { loaded.instance.create_device(adapter.physical, &create, None) }
            .named("vkCreateDevice")?;
        let names = loaded.validating().then(|| ext::debug_utils::Device::new(&loaded.instance, &device));
        Ok(Arc::new(Self { device, names, _loaded: Arc::clone(loaded) }))
    }

    /// Names an object for validation messages; nothing without validation.
    pub(super) fn name(&self, handle: impl vk::Handle, name: &str) {
        if let (Some(names), Ok(name)) = (&self.names, CString::new(name)) {
            let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
            // A name that fails is only a message less readable.
            // SAFETY: the handle is of this device and alive, as every caller has just made it.
            let _ = unsafe { names.set_debug_utils_object_name(&info) };
        }
    }
}

impl Drop for Logical {
    fn drop(&mut self) {
        // SAFETY: every child holds an `Arc` of this, so none is left; submissions waited for their fences.
        unsafe { self.device.destroy_device(None) }
    }
}
