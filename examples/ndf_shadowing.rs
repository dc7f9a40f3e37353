//! Shadowing from a distribution of normals that is given as an image: G(k) = cos theta_k over the integral of max(k.h, 0) D(h)
//! over the hemisphere (Dupuy et al. 2015, equation 3), summed over the pixels of an orthographic image with their exact solid
//! angles, against Smith's closed form for GGX. `cargo run --release --example ndf_shadowing`
//!
//! Writes the image of G over all k to target/ndf_shadowing.png, contrast stretched as far as its darkest value.

use std::error::Error;
use std::f64::consts::PI;
use std::fs::File;
use std::path::Path;

use glam::DVec3;
use rayon::prelude::*;
use rootq::numeric::disk_rectangle::clipped;

/// Directions of an image's pixels, each with D(h) times its solid angle.
pub(crate) fn ndf_image(alpha: f64, size: u32) -> Vec<(DVec3, f64)> {
    let at = |k: f64| 2.0 * k / f64::from(size) - 1.0;
    let mut image = Vec::new();
    for line in (0..size).map(f64::from) {
        for column in (0..size).map(f64::from) {
            let solid_angle = clipped(at(column), at(line), at(column + 1.0), at(line + 1.0)).value;
            let (x, y) = (at(column + 0.5), at(line + 0.5));
            // A boundary pixel whose middle lies outside stands for directions at the horizon.
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            if solid_angle > 0.0 {
                let spread = alpha / (1.0 + (alpha * alpha - 1.0) * z * z);
                image.push((DVec3::new(x, y, z).normalize(), spread * spread / PI * solid_angle));
            }
        }
    }
    image
}

/// G of the image in the direction `k`; 0 below the horizon.
pub(crate) fn shadowing(image: &[(DVec3, f64)], k: DVec3) -> f64 {
    let projected: f64 = image.iter().map(|(h, weight)| k.dot(*h).max(0.0) * weight).sum();
    if k.z > 0.0 { k.z / projected } else { 0.0 }
}

/// Smith's G1 for GGX (Walter et al. 2007).
pub(crate) fn smith(alpha: f64, cos_theta: f64) -> f64 {
    let tan2 = (1.0 - cos_theta * cos_theta) / (cos_theta * cos_theta);
    2.0 / (1.0 + (1.0 + alpha * alpha * tan2).sqrt())
}

/// The direction of a polar angle's cosine.
pub(crate) fn direction(cos_theta: f64) -> DVec3 {
    DVec3::new((1.0 - cos_theta * cos_theta).sqrt(), 0.0, cos_theta)
}

/// Writes G over the disk of all directions as a grey picture of `size` x `size`; black outside.
fn picture(image: &[(DVec3, f64)], size: u32, path: &Path) -> Result<(), Box<dyn Error>> {
    let at = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(size) - 1.0;
    let values: Vec<f64> = (0..size * size)
        .into_par_iter()
        .map(|pixel| {
            let (x, y) = (at(pixel % size), at(pixel / size));
            let square = 1.0 - x * x - y * y;
            if square > 0.0 { shadowing(image, DVec3::new(x, y, square.sqrt())) } else { f64::NAN }
        })
        .collect();
    let darkest = values.iter().copied().fold(1.0, f64::min);
    let grey =
        |g: &f64| if g.is_nan() { 0 } else { (40.0 + 215.0 * (g - darkest) / (1.0 - darkest)).round() as u8 };
    let bytes: Vec<u8> = values.iter().map(grey).collect();
    let mut encoder = png::Encoder::new(File::create(path)?, size, size);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(())
}

#[allow(dead_code, reason = "tests take the functions above")]
fn main() -> Result<(), Box<dyn Error>> {
    let alpha = 0.6;
    let image = ndf_image(alpha, 512);
    println!("GGX, alpha = {alpha}, 512 x 512 pixels\ncos theta   image     Smith");
    for cos_theta in [1.0, 0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05] {
        println!(
            "{cos_theta:5}      {:.6}  {:.6}",
            shadowing(&image, direction(cos_theta)),
            smith(alpha, cos_theta)
        );
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/ndf_shadowing.png");
    picture(&ndf_image(alpha, 128), 128, &path)?;
    println!("picture: {}", path.display());
    Ok(())
}
