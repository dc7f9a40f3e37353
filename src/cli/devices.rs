//! `rootq devices`: what could run variants here.

use anyhow::Result;
use clap::Args;

use crate::device::vulkan::Instance;
use crate::report;

/// Options of `rootq devices`.
#[derive(Args, Debug)]
pub(super) struct Arguments {
    /// Everything known of each device, as a JSON array
    #[arg(long)]
    json: bool,
}

pub(super) fn devices(arguments: &Arguments) -> Result<()> {
    let instance = Instance::open(false)?;
    instance.choose(None)?;
    let devices = instance.devices()?;
    if arguments.json {
        return super::print(&(serde_json::to_string_pretty(&devices)? + "\n"));
    }
    super::print(&report::devices(&devices, super::colour()))
}
