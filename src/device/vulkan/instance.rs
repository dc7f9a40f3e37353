//! The Vulkan instance: loader, validation layer, and the list of devices.

use std::ffi::CStr;
use std::sync::Arc;

use ash::{ext, khr, vk};

use super::adapter::Adapter;
use super::call::Named;
use super::messages::Messages;
use super::select;
use crate::device::{Error, Facts};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// An open Vulkan loader. Cheap to clone; devices keep it alive.
#[derive(Clone)]
pub struct Instance {
    loaded: Arc<Loaded>,
}

/// The instance and what must be torn down before it.
pub(super) struct Loaded {
    pub(super) instance: ash::Instance,
    /// The Vulkan version asked for; no device may be used beyond it.
    pub(super) api: u32,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    /// In an `Arc`, since the messenger holds its address. Dropped after `drop` has destroyed messenger and
    /// instance.
    messages: Option<Arc<Messages>>,
    /// The loader's library: unloaded last.
    _entry: ash::Entry,
}

/// Names another library than the system's Vulkan loader: a portability layer, or one under test.
const LOADER: &str = "ROOTQ_VULKAN_LOADER";

impl Instance {
    /// Opens the Vulkan loader, under the Khronos validation layer if `validation`.
    ///
    /// [`Error::NoLoader`] without a loader of Vulkan 1.1 or later, [`Error::NoValidationLayer`] without the
    /// layer, [`Error::NoDevice`] where the loader finds no driver at all.
    pub fn open(validation: bool) -> Result<Self, Error> {
        let loaded = match std::env::var_os(LOADER) {
            // SAFETY: the library that the user names as the Vulkan loader, whose initialisers are its own affair.
            Some(path) => unsafe { ash::Entry::load_from(path) },
            // SAFETY: the system's Vulkan loader, likewise.
            None => unsafe { ash::Entry::load() },
        };
        let entry = loaded.map_err(|error| Error::NoLoader { reason: error.to_string() })?;
        // SAFETY: `entry` is a loaded Vulkan library.
        let loader = unsafe { entry.try_enumerate_instance_version() }
            .named("vkEnumerateInstanceVersion")?
            .unwrap_or(vk::API_VERSION_1_0);
        if loader < vk::API_VERSION_1_1 {
            return Err(Error::NoLoader { reason: "it is older than Vulkan 1.1".to_owned() });
        }
        let api = loader.min(vk::API_VERSION_1_3);
        if validation && !has_validation(&entry)? {
            return Err(Error::NoValidationLayer);
        }
        // SAFETY: as above.
        let offered = unsafe { entry.enumerate_instance_extension_properties(None) }
            .named("vkEnumerateInstanceExtensionProperties")?;
        let portability = offered
            .iter()
            .any(|extension| extension.extension_name_as_c_str() == Ok(khr::portability_enumeration::NAME));

        let mut extensions = Vec::new();
        let mut layers = Vec::new();
        let mut flags = vk::InstanceCreateFlags::empty();
        if portability {
            extensions.push(khr::portability_enumeration::NAME.as_ptr());
            flags |= vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR;
        }
        if validation {
            extensions.push(ext::debug_utils::NAME.as_ptr());
            layers.push(VALIDATION_LAYER.as_ptr());
        }
        let application = vk::ApplicationInfo::default().application_name(c"rootq").api_version(api);
        let messages = validation.then(Arc::<Messages>::default);
        // Chained too, so that creation and destruction of the instance are watched as well.
        let mut chained = messages.as_deref().map(Messages::messenger);
        let mut create = vk::InstanceCreateInfo::default()
            .flags(flags)
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        if let Some(messenger) = &mut chained {
            create = create.push_next(messenger);
        }
        // SAFETY: every pointer in `create` is to a local that outlives the call; the messages outlive the
        // instance.
        let instance = match unsafe { entry.create_instance(&create, None) } {
            // What loaders answer when they know of no driver.
            Err(vk::Result::ERROR_INCOMPATIBLE_DRIVER) => return Err(Error::NoDevice),
            other => other.named("vkCreateInstance")?,
        };
        let mut loaded = Loaded { instance, api, messenger: None, messages, _entry: entry };
        if let Some(messages) = &loaded.messages {
            let debug = ext::debug_utils::Instance::new(&loaded._entry, &loaded.instance);
            // SAFETY: the extension is enabled; `Loaded` destroys the messenger before it drops the messages.
            let messenger = unsafe { debug.create_debug_utils_messenger(&messages.messenger(), None) }
                .named("vkCreateDebugUtilsMessengerEXT")?;
            loaded.messenger = Some((debug, messenger));
        }
        Ok(Self { loaded: Arc::new(loaded) })
    }

    /// Every usable device, in the loader's order; indices count these.
    ///
    /// Left out, since no kernel could run there: devices below Vulkan 1.1 or without a compute queue.
    pub fn devices(&self) -> Result<Vec<Facts>, Error> {
        Ok(self.adapters()?.into_iter().map(|adapter| adapter.facts).collect())
    }

    /// The index of the device that `selector` means: an index, a UUID or a part of a name; `None`: the
    /// first.
    pub fn choose(&self, selector: Option<&str>) -> Result<usize, Error> {
        select::choose(&self.devices()?, selector)
    }

    /// What the validation layer has said so far; empty without it.
    pub fn validation_messages(&self) -> Vec<String> {
        self.loaded.messages.as_deref().map(Messages::all).unwrap_or_default()
    }

    /// How many others keep the instance alive: clones, and devices that are open or kept so by a program or
    /// columns.
    pub fn users(&self) -> usize {
        Arc::strong_count(&self.loaded) - 1
    }

    pub(super) fn loaded(&self) -> &Arc<Loaded> {
        &self.loaded
    }

    pub(super) fn adapters(&self) -> Result<Vec<Adapter>, Error> {
        // SAFETY: the instance is alive.
        let physical = match unsafe { self.loaded.instance.enumerate_physical_devices() } {
            // The loader's answer when drivers are listed but none has a device.
            Err(vk::Result::ERROR_INITIALIZATION_FAILED) => Vec::new(),
            other => other.named("vkEnumeratePhysicalDevices")?,
        };
        let mut adapters = Vec::new();
        for physical in physical {
            if let Some(adapter) = Adapter::read(&self.loaded, physical, adapters.len())? {
                adapters.push(adapter);
            }
        }
        Ok(adapters)
    }
}

impl Loaded {
    pub(super) fn validating(&self) -> bool {
        self.messages.is_some()
    }
}

impl Drop for Loaded {
    fn drop(&mut self) {
        // SAFETY: every child holds an `Arc` of this, so none is left; messages and library are dropped
        // after.
        unsafe {
            if let Some((debug, messenger)) = self.messenger.take() {
                debug.destroy_debug_utils_messenger(messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}

/// Whether the validation layer is installed together with the extension that carries its messages.
fn has_validation(entry: &ash::Entry) -> Result<bool, Error> {
    // SAFETY: `entry` is a loaded Vulkan library.
    let layers =
        unsafe { entry.enumerate_instance_layer_properties() }.named("vkEnumerateInstanceLayerProperties")?;
    if !layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER)) {
        return Ok(false);
    }
    let mut offered = Vec::new();
    for layer in [None, Some(VALIDATION_LAYER)] {
        // SAFETY: as above; the layer is listed.
        offered.extend(
            unsafe { entry.enumerate_instance_extension_properties(layer) }
                .named("vkEnumerateInstanceExtensionProperties")?,
        );
    }
    Ok(offered.iter().any(|extension| extension.extension_name_as_c_str() == Ok(ext::debug_utils::NAME)))
}
