//! What the validation layer says, kept for whoever asks.

use std::ffi::{CStr, c_void};
use std::sync::Mutex;

use ash::vk;

use super::call::lock;

/// The messages so far. Its address is given to the driver, so it lives in an `Arc` of its own.
#[derive(Default)]
pub(super) struct Messages(Mutex<Vec<String>>);

impl Messages {
    pub(super) fn all(&self) -> Vec<String> {
        lock(&self.0).clone()
    }

    /// A messenger that writes here. `self` must stay where it is for as long as the messenger lives.
    pub(super) fn messenger(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
        vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
            )
            // Not GENERAL: under that type the loader reports on manifests and drivers it found, which is not
            // about our use of Vulkan.
            .message_type(
                vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                    | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
            )
            .pfn_user_callback(Some(collect))
            .user_data(std::ptr::from_ref(self).cast_mut().cast())
    }
}

unsafe extern "system" fn collect(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _types: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes valid callback data, whose text, if any, is a C string; `user` is the
    // `Messages` that made the messenger, which outlives it (see `messenger`), and is only ever shared.
    let (message, messages) = unsafe {
        let text = data.as_ref().map(|data| data.p_message).filter(|text| !text.is_null());
        (text.map(|text| CStr::from_ptr(text)), user.cast::<Messages>().as_ref())
    };
    if let (Some(message), Some(messages)) = (message, messages) {
        lock(&messages.0).push(message.to_string_lossy().into_owned());
    }
    vk::FALSE
}
