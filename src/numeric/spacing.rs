//! Distances between neighbouring values of f32 and binary16, as units of error; unit roundoffs.

/// f64's unit roundoff, 2^-53: what one rounding leaves of a result at most, relative to it.
pub const EPS: f64 = f64::EPSILON / 2.0;

/// f32's unit roundoff, 2^-24.
pub const UNIT_ROUNDOFF: f64 = 1.0 / 16_777_216.0;

/// The spacing of f32 at `value`: 2^(e-23) for 2^e < |value| <= 2^(e+1), so that a power of two has the smaller of its
/// two spacings; 2^-149 among the subnormals. Beyond the largest f32 the binades go on.
pub fn f32_spacing(value: f64) -> f64 {
    spacing(value, 23, -149)
}

/// The spacing of IEEE binary16 at `value`, likewise; 2^-24 among the subnormals.
pub fn f16_spacing(value: f64) -> f64 {
    spacing(value, 10, -24)
}

fn spacing(value: f64, mantissa_bits: i64, smallest: i64) -> f64 {
    // One below the magnitude's bits: a power of two falls into the binade beneath it.
    let below = (value.to_bits() & (u64::MAX >> 1)).saturating_sub(1);
    let exponent = (below >> 52) as i64 - 1023;
    let exponent = (exponent - mantissa_bits).clamp(smallest, 1023);
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn powers_of_two_have_the_smaller_spacing() {
        assert_eq!(f32_spacing(1.0), 2f64.powi(-24));
        assert_eq!(f32_spacing(-1.0), 2f64.powi(-24));
        assert_eq!(f32_spacing(1.0 + 1e-12), 2f64.powi(-23));
        assert_eq!(f32_spacing(0.0), 2f64.powi(-149));
        assert_eq!(f32_spacing(1e-300), 2f64.powi(-149));
        assert_eq!(f16_spacing(1.0), 2f64.powi(-11));
        assert_eq!(f16_spacing(1e-6), 2f64.powi(-24));
    }

    proptest! {
        #[test]
        fn is_the_distance_to_the_neighbour_below(bits in 1u32..f32::INFINITY.to_bits()) {
            let value = f32::from_bits(bits);
            let below = f64::from(value) - f64::from(f32::from_bits(bits - 1));
            prop_assert_eq!(f32_spacing(f64::from(value)), below);
        }
    }
}
