//! IEEE binary16 by its bits.

/// The binary16 nearest to `value`, ties to even; beyond the largest: infinity; a NaN stays one.
pub fn from_f32(value: f32) -> u16 {
    let bits = value.to_bits();
    let sign = (bits >> 16 & 0x8000) as u16;
    let magnitude = bits & 0x7fff_ffff;
    if magnitude > 0x7f80_0000 {
        return sign | 0x7e00;
    }
    // Halfway between the largest binary16 and the next that there would be.
    if magnitude >= 0x477f_f000 {
        return sign | 0x7c00;
    }
    // Below 2^-14, the smallest normal one: the sum's last place is 2^-24, the spacing of subnormals.
    if magnitude < 0x3880_0000 {
        let shifted = f32::from_bits(magnitude) + 0.5;
        return sign | (shifted.to_bits() - 0.5f32.to_bits()) as u16;
    }
    let odd = magnitude >> 13 & 1;
    let rounded = magnitude + 0xfff + odd;
    sign | ((rounded - (112 << 23)) >> 13) as u16
}

/// The value of a binary16, exactly.
pub fn to_f32(half: u16) -> f32 {
    let magnitude = u32::from(half & 0x7fff);
    let value = match magnitude >> 10 {
        0 => magnitude as f32 / 16_777_216.0,
        31 if magnitude > 0x7c00 => f32::NAN,
        31 => f32::INFINITY,
        _ => f32::from_bits((magnitude << 13) + (112 << 23)),
    };
    if half >> 15 == 1 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::spacing::f16_spacing;
    use proptest::prelude::*;

    #[test]
    fn every_finite_one_survives() {
        for half in (0..=u16::MAX).filter(|half| half & 0x7c00 != 0x7c00) {
            assert_eq!(from_f32(to_f32(half)), half);
        }
    }

    #[test]
    fn ends_and_ties() {
        assert_eq!(from_f32(f32::INFINITY), 0x7c00);
        assert_eq!(from_f32(65_519.996), 0x7bff);
        assert_eq!(from_f32(65_520.0), 0x7c00);
        assert_eq!(to_f32(from_f32(f32::NAN)).to_bits() & 0x7fff_ffff, f32::NAN.to_bits() & 0x7fff_ffff);
        // 2049 lies between 2048 and 2050, 2051 between 2050 and 2052.
        assert_eq!(to_f32(from_f32(2049.0)), 2048.0);
        assert_eq!(to_f32(from_f32(2051.0)), 2052.0);
    }

    proptest! {
        #[test]
        fn rounds_to_within_half_a_step(value in -65_000.0f32..65_000.0, scale in 0u32..40) {
            let value = value * 2f32.powi(-(scale as i32));
            let error = (f64::from(to_f32(from_f32(value))) - f64::from(value)).abs();
            // At a power of two the step above is twice the one that f16_spacing states.
            prop_assert!(error <= 0.5 * f16_spacing(f64::from(value) * (1.0 + 1e-9)), "{}", value);
        }
    }
}
