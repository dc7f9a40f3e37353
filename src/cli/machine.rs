//! Opening the device that a command asks for.

use anyhow::Result;
use clap::Args;

use crate::device::vulkan::{Instance, Options, VulkanDevice};

/// Options that choose the device.
#[derive(Args, Debug)]
pub(super) struct DeviceArguments {
    /// Device by index, part of its name, or UUID [default: the first one]
    #[arg(long, value_name = "SEL")]
    pub(super) device: Option<String>,
    /// Check every Vulkan call with the Khronos validation layer, and fail on any message
    #[arg(long)]
    pub(super) validation: bool,
}

/// An open device and the instance behind it.
pub(super) struct Machine {
    pub(super) instance: Instance,
    pub(super) device: VulkanDevice,
}

impl DeviceArguments {
    pub(super) fn open(&self) -> Result<Machine> {
        self.open_with(Options::default())
    }

    pub(super) fn open_with(&self, options: Options) -> Result<Machine> {
        let instance = Instance::open(self.validation)?;
        let index = instance.choose(self.device.as_deref())?;
        let device = VulkanDevice::open_with(&instance, index, options)?;
        Ok(Machine { instance, device })
    }
}

impl Machine {
    /// Fails if the validation layer had anything to say.
    pub(super) fn check_validation(&self) -> Result<()> {
        let messages = self.instance.validation_messages();
        match messages.first() {
            None => Ok(()),
            Some(first) => anyhow::bail!("{} validation messages, the first: {first}", messages.len()),
        }
    }
}
