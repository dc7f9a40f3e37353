//! Times on real drivers: what the harness says must agree with itself.

#![allow(unsafe_code, reason = "setting the environment")]
mod drivers;

use std::sync::atomic::AtomicBool;

use rootq::bench;
use rootq::device::vulkan::{Instance, VulkanDevice};

fn devices(test: impl Fn(&VulkanDevice)) {
    // SAFETY: nothing else in this process runs yet that reads the environment.
    unsafe { std::env::set_var("VK_DRIVER_FILES", drivers::both().unwrap()) };
    let instance = Instance::open(false).unwrap();
    for facts in instance.devices().unwrap() {
        test(&VulkanDevice::open(&instance, facts.index).unwrap());
    }
}

#[test]
fn ceilings_are_plausible() {
    devices(|device| {
        let start = std::time::Instant::now();
        let ceilings = bench::ceilings(device, &AtomicBool::new(false)).unwrap();
        println!("{ceilings:#?} {:?}", start.elapsed());
    });
}
