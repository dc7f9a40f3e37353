//! `rootq devices`: what could run variants here, and what its arithmetic does.

use anyhow::{Result, anyhow};
use clap::Args;
use serde_json::Value;

use crate::device::Facts;
use crate::device::vulkan::{Instance, VulkanDevice};
use crate::probe::{self, Probe};
use crate::report;

/// Options of `rootq devices`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq devices                            what there is\n  \
    rootq devices --probe --device llvmpipe  whether it fuses, flushes, rounds correctly, and keeps NaN")]
pub(super) struct Arguments {
    /// Everything known of each device, as a JSON array
    #[arg(long)]
    json: bool,
    /// Find out, by small kernels, what each device's arithmetic does where Vulkan leaves it a choice
    #[arg(long)]
    probe: bool,
    /// Only this device, by index, part of its name, or UUID [default: all]
    #[arg(long, value_name = "SEL")]
    device: Option<String>,
}

pub(super) fn devices(arguments: &Arguments) -> Result<()> {
    let instance = Instance::open(false)?;
    let chosen = instance.choose(arguments.device.as_deref())?;
    let mut devices = instance.devices()?;
    if arguments.device.is_some() {
        devices.retain(|facts| facts.index == chosen);
    }
    if arguments.probe {
        return probes(&instance, devices, arguments.json);
    }
    if arguments.json {
        return super::print(&(serde_json::to_string_pretty(&devices)? + "\n"));
    }
    super::print(&report::devices(&devices, super::colour()))
}

fn probes(instance: &Instance, devices: Vec<Facts>, json: bool) -> Result<()> {
    let probed: Vec<(Facts, Probe)> = devices
        .into_iter()
        .map(|facts| {
            let device = VulkanDevice::open(instance, facts.index)?;
            let probe = probe::probe(&device).map_err(|error| anyhow!("{}: {error}", facts.name))?;
            Ok((facts, probe))
        })
        .collect::<Result<_>>()?;
    if !json {
        return super::print(&report::probes(&probed, super::colour()));
    }
    let described = probed.iter().map(|(facts, probe)| {
        let mut device = serde_json::to_value(facts)?;
        if let Value::Object(fields) = &mut device {
            fields.insert("probe".to_owned(), serde_json::to_value(probe)?);
        }
        Ok(device)
    });
    let described = described.collect::<Result<Vec<Value>>>()?;
    super::print(&(serde_json::to_string_pretty(&described)? + "\n"))
}
