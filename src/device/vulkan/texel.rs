//! Texel formats of image tables: what the device filters.

use ash::vk;

use crate::numeric::binary16;

/// Bits of a channel in sampled tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TexelWidth {
    Half,
    Single,
}

impl TexelWidth {
    /// The widest floats that the device filters linearly, with one channel and with four; `None`: not even
    /// halves, which every Vulkan device should.
    pub(super) fn widest(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Option<Self> {
        use vk::FormatFeatureFlags as F;
        let wanted = F::SAMPLED_IMAGE | F::SAMPLED_IMAGE_FILTER_LINEAR | F::TRANSFER_DST;
        let filters = |width: &Self| {
            [1, 4].into_iter().all(|channels| {
                // SAFETY: the physical device is this instance's.
                let properties = unsafe {
                    instance.get_physical_device_format_properties(physical, width.format(channels))
                };
                properties.optimal_tiling_features.contains(wanted)
            })
        };
        [Self::Single, Self::Half].into_iter().find(filters)
    }

    pub(super) fn bits(self) -> u32 {
        match self {
            Self::Half => 16,
            Self::Single => 32,
        }
    }

    /// The format of one channel or of four.
    pub(super) fn format(self, channels: u32) -> vk::Format {
        match (self, channels) {
            (Self::Half, 1) => vk::Format::R16_SFLOAT,
            (Self::Half, _) => vk::Format::R16G16B16A16_SFLOAT,
            (Self::Single, 1) => vk::Format::R32_SFLOAT,
            (Self::Single, _) => vk::Format::R32G32B32A32_SFLOAT,
        }
    }

    /// The texels' bytes, as words: what a buffer holds that is copied to an image.
    pub(super) fn words(self, texels: &[f32]) -> Vec<u32> {
        match self {
            Self::Single => texels.iter().map(|texel| texel.to_bits()).collect(),
            Self::Half => texels
                .chunks(2)
                .map(|pair| {
                    let half = |index: usize| pair.get(index).map_or(0, |texel| binary16::from_f32(*texel));
                    let [low, high] = [half(0), half(1)].map(u16::to_ne_bytes);
                    u32::from_ne_bytes([low[0], low[1], high[0], high[1]])
                })
                .collect(),
        }
    }
}
