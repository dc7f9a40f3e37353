//! Does a cube's face sum to 4 pi/6? Every `pixel_cube` variant on the first Vulkan device, over all pixels of a face.
//!
//! `cargo run --release --example cube_face [SIZE]`. Results are f32 and summed in f64, so what is off is the variant's.

use std::error::Error;
use std::f64::consts::PI;

use rootq::catalog::Catalog;
use rootq::device::vulkan::{Instance, Options, VulkanDevice};
use rootq::device::{Device, Outputs};
use rootq::family::find;

/// The solid angle of a face.
pub(crate) const FACE: f64 = 4.0 * PI / 6.0;

/// Rows x0, y0, x1, y1 of all pixels of a face of `size` x `size`, at most 1024.
pub(crate) fn pixels(size: u32) -> Vec<f32> {
    let at = |k: u32| (2.0 * f64::from(k) / f64::from(size) - 1.0) as f32;
    (0..size * size)
        .flat_map(|pixel| {
            let (x, y) = (pixel % size, pixel / size);
            [at(x), at(y), at(x + 1), at(y + 1)]
        })
        .collect()
}

/// Each variant's name and its face's sum, on the device that `selector` names.
pub(crate) fn sums(selector: Option<&str>, size: u32) -> Result<Vec<(String, f64)>, Box<dyn Error>> {
    let instance = Instance::open(false)?;
    let device = VulkanDevice::open_with(&instance, instance.choose(selector)?, Options::default())?;
    let signature = find("pixel_cube").ok_or("no such family")?.signature();
    let rows = pixels(size);
    let mut sums = Vec::new();
    for variant in Catalog::embedded()?.family("pixel_cube") {
        let program = device.program(&variant.compile(&signature, false)?.kernel)?;
        let inputs = device.upload(&rows, signature.input_columns().len())?;
        let outputs = device.wait(device.submit(&program, &inputs)?)?;
        sums.push((variant.name.clone(), outputs.column(0).iter().map(|v| f64::from(*v)).sum()));
    }
    Ok(sums)
}

#[allow(dead_code, reason = "tests take the functions above")]
fn main() -> Result<(), Box<dyn Error>> {
    let size = std::env::args().nth(1).map_or(Ok(1024), |text| text.parse())?;
    println!("a face of {size} x {size}: {FACE:.9} sr expected");
    for (name, sum) in sums(None, size)? {
        println!("{name:24} {sum:.9}  off by {:+.1e}", sum / FACE - 1.0);
    }
    Ok(())
}
