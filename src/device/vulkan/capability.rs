//! What a SPIR-V module asks of the device, held against what the device has.
//!
//! A driver may crash on a module that declares a capability it lacks, so this is asked before the driver is.

use ash::vk;
use rspirv::spirv::{Capability, ExecutionMode, MAGIC_NUMBER, Op};

/// Float widths that have modes of their own: 16, 32 and 64 bits.
pub(super) type ByWidth = [bool; 3];

/// The float modes a module may ask for, by width.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FloatModes {
    pub(super) denorm_preserve: ByWidth,
    pub(super) denorm_flush_to_zero: ByWidth,
    pub(super) signed_zero_inf_nan_preserve: ByWidth,
    pub(super) rounding_rte: ByWidth,
    pub(super) rounding_rtz: ByWidth,
}

/// What kernels may use on a device: supported by it, and enabled when it is opened.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Abilities {
    /// Highest SPIR-V version, in the module header's own form: `0x0001_0300`.
    pub(super) spirv: u32,
    pub(super) float64: bool,
    pub(super) float16: bool,
    pub(super) int64: bool,
    pub(super) int16: bool,
    pub(super) int8: bool,
    pub(super) storage16: bool,
    /// Subgroup operations in compute shaders.
    pub(super) subgroup: vk::SubgroupFeatureFlags,
    pub(super) float_modes: FloatModes,
    /// Debug information as non-semantic instructions.
    pub(super) non_semantic: bool,
}

impl Abilities {
    /// The first thing that `spirv` needs and the device lacks; an error if the words are no module.
    pub(super) fn missing(&self, spirv: &[u32]) -> Result<Option<String>, &'static str> {
        let &[MAGIC_NUMBER, version, _, _, _, ref body @ ..] = spirv else {
            return Err("its words are no SPIR-V module");
        };
        if version > self.spirv {
            return Ok(Some(format!("SPIR-V {}.{}", version >> 16 & 0xff, version >> 8 & 0xff)));
        }
        let mut rest = body;
        while let Some(&first) = rest.first() {
            let words = (first >> 16) as usize;
            if words == 0 || words > rest.len() {
                return Err("its SPIR-V is cut off");
            }
            let (instruction, tail) = rest.split_at(words);
            let missing = match (Op::from_u32(first & 0xffff), &instruction[1..]) {
                (Some(Op::Capability), &[capability]) => self.missing_capability(capability),
                (Some(Op::ExecutionMode), &[_, mode, width]) => self.missing_mode(mode, width),
                (Some(Op::Extension), name) => {
                    let needs_it = literal(name) == "SPV_KHR_non_semantic_info";
                    (needs_it && !self.non_semantic).then(|| "VK_KHR_shader_non_semantic_info".to_owned())
                }
                // Functions follow; requirements stand before them.
                (Some(Op::Function), _) => break,
                _ => None,
            };
            if missing.is_some() {
                return Ok(missing);
            }
            rest = tail;
        }
        Ok(None)
    }

    fn missing_capability(&self, number: u32) -> Option<String> {
        use Capability as C;
        let Some(capability) = C::from_u32(number) else {
            return Some(format!("the SPIR-V capability {number}"));
        };
        let subgroup = |feature| self.subgroup.contains(feature);
        let modes = &self.float_modes;
        let any = |widths: ByWidth| widths.contains(&true);
        let has = match capability {
            // Every Vulkan device.
            C::Matrix | C::Shader | C::ImageQuery | C::DerivativeControl => true,
            C::Sampled1D | C::Image1D | C::SampledBuffer | C::ImageBuffer => true,
            C::Float64 => self.float64,
            C::Float16 => self.float16,
            C::Int64 => self.int64,
            C::Int16 => self.int16,
            C::Int8 => self.int8,
            C::StorageBuffer16BitAccess => self.storage16,
            C::GroupNonUniform => subgroup(vk::SubgroupFeatureFlags::BASIC),
            C::GroupNonUniformVote => subgroup(vk::SubgroupFeatureFlags::VOTE),
            C::GroupNonUniformArithmetic => subgroup(vk::SubgroupFeatureFlags::ARITHMETIC),
            C::GroupNonUniformBallot => subgroup(vk::SubgroupFeatureFlags::BALLOT),
            C::GroupNonUniformShuffle => subgroup(vk::SubgroupFeatureFlags::SHUFFLE),
            C::GroupNonUniformShuffleRelative => subgroup(vk::SubgroupFeatureFlags::SHUFFLE_RELATIVE),
            C::GroupNonUniformClustered => subgroup(vk::SubgroupFeatureFlags::CLUSTERED),
            C::GroupNonUniformQuad => subgroup(vk::SubgroupFeatureFlags::QUAD),
            C::DenormPreserve => any(modes.denorm_preserve),
            C::DenormFlushToZero => any(modes.denorm_flush_to_zero),
            C::SignedZeroInfNanPreserve => any(modes.signed_zero_inf_nan_preserve),
            C::RoundingModeRTE => any(modes.rounding_rte),
            C::RoundingModeRTZ => any(modes.rounding_rtz),
            // Also what the device may have: what was not enabled must not be used.
            _ => false,
        };
        (!has).then(|| format!("the SPIR-V capability {capability:?}"))
    }

    fn missing_mode(&self, number: u32, width: u32) -> Option<String> {
        use ExecutionMode as M;
        let modes = &self.float_modes;
        let mode = M::from_u32(number)?;
        let widths = match mode {
            M::DenormPreserve => modes.denorm_preserve,
            M::DenormFlushToZero => modes.denorm_flush_to_zero,
            M::SignedZeroInfNanPreserve => modes.signed_zero_inf_nan_preserve,
            M::RoundingModeRTE => modes.rounding_rte,
            M::RoundingModeRTZ => modes.rounding_rtz,
            _ => return None,
        };
        let has = match width {
            16 => widths[0],
            32 => widths[1],
            64 => widths[2],
            _ => false,
        };
        (!has).then(|| format!("the execution mode {mode:?} for {width}-bit floats"))
    }
}

/// A SPIR-V literal string: UTF-8 in little-endian words, ended by a zero byte.
fn literal(words: &[u32]) -> String {
    let bytes: Vec<u8> =
        words.iter().flat_map(|word| word.to_le_bytes()).take_while(|&byte| byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn module(version: u32, instructions: &[&[u32]]) -> Vec<u32> {
        let mut words = vec![MAGIC_NUMBER, version, 0, 1, 0];
        for instruction in instructions {
            words.push((instruction.len() as u32) << 16 | instruction[0]);
            words.extend(&instruction[1..]);
        }
        words
    }

    const CAPABILITY: u32 = Op::Capability as u32;
    const MODE: u32 = Op::ExecutionMode as u32;

    fn plain() -> Abilities {
        Abilities { spirv: 0x0001_0300, ..Abilities::default() }
    }

    #[test]
    fn a_plain_shader_needs_nothing() {
        let spirv = module(0x0001_0300, &[&[CAPABILITY, Capability::Shader as u32]]);
        assert_eq!(plain().missing(&spirv), Ok(None));
    }

    #[test]
    fn a_capability_the_device_lacks_is_named() {
        let spirv = module(0x0001_0000, &[&[CAPABILITY, 1], &[CAPABILITY, Capability::Float64 as u32]]);
        assert_eq!(plain().missing(&spirv), Ok(Some("the SPIR-V capability Float64".to_owned())));
        assert_eq!(Abilities { float64: true, ..plain() }.missing(&spirv), Ok(None));
        let unknown = module(0x0001_0000, &[&[CAPABILITY, 0xdead]]);
        assert_eq!(plain().missing(&unknown), Ok(Some("the SPIR-V capability 57005".to_owned())));
    }

    #[test]
    fn float_modes_are_asked_for_by_width() {
        let spirv = module(0x0001_0000, &[&[MODE, 1, ExecutionMode::DenormPreserve as u32, 32]]);
        let modes = FloatModes { denorm_preserve: [true, false, true], ..FloatModes::default() };
        let missing = Abilities { float_modes: modes, ..plain() }.missing(&spirv);
        assert_eq!(missing, Ok(Some("the execution mode DenormPreserve for 32-bit floats".to_owned())));
        let modes = FloatModes { denorm_preserve: [false, true, false], ..FloatModes::default() };
        assert_eq!(Abilities { float_modes: modes, ..plain() }.missing(&spirv), Ok(None));
    }

    #[test]
    fn a_newer_module_and_a_broken_one_are_told_apart() {
        assert_eq!(plain().missing(&module(0x0001_0600, &[])), Ok(Some("SPIR-V 1.6".to_owned())));
        assert!(plain().missing(&[]).is_err());
        assert!(plain().missing(&[1, 2, 3, 4, 5, 6]).is_err());
        let mut cut = module(0x0001_0000, &[&[CAPABILITY, 1]]);
        cut.pop();
        assert!(plain().missing(&cut).is_err());
    }
}
