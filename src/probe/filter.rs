//! How finely a sampler interpolates.

use std::collections::BTreeSet;

use super::kernels::{Error, Source, run};
use crate::catalog::{Type, tables};
use crate::device::Device;

const FILTER: Source = Source {
    function: "filtered",
    text: include_str!("kernels/filter.comp"),
    inputs: &[("at", Type::Vec2)],
    results: &["texel"],
};

/// The table that the kernel samples.
const TABLE: &str = "sphere_lut";

/// Steps between two texels; weights finer than these are not told apart.
const STEPS: u32 = 1 << 12;

/// Bits of the weight with which two neighbouring texels are mixed, at most 12: the number of values between them.
/// `None` where the device filters no floats.
pub(super) fn bits<D: Device>(device: &D) -> Result<Option<u32>, Error> {
    if device.facts().table_image_bits == 0 {
        return Ok(None);
    }
    let (x, y) = steepest(TABLE).ok_or(Error::Table(TABLE))?;
    let rows: Vec<f32> =
        (0..STEPS).flat_map(|step| [x as f32 + step as f32 / STEPS as f32, y as f32]).collect();
    let values = run(device, &FILTER, &rows)?.swap_remove(0);
    let distinct: BTreeSet<u32> = values.iter().map(|value| value.to_bits()).collect();
    Ok(Some((distinct.len() as f64).log2().round() as u32))
}

/// The texel that differs most from its neighbour to the right: steps between them are far above f32's own.
fn steepest(name: &str) -> Option<(u32, u32)> {
    let table = tables().iter().find(|table| table.name == name)?;
    let texels = table.texels();
    let steepness = |(x, y): &(u32, u32)| {
        let at = (y * table.width + x) as usize;
        (texels[at + 1] - texels[at]).abs()
    };
    (0..table.height)
        .flat_map(|y| (0..table.width - 1).map(move |x| (x, y)))
        .max_by(|a, b| steepness(a).total_cmp(&steepness(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sampled_table_is_there() {
        assert!(steepest(TABLE).is_some() && FILTER.text.contains(TABLE));
        assert_eq!(steepest("another"), None);
    }
}
