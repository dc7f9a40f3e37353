//! How much there is to read in a configuration. Minimization lowers this number with every step, and so ends.

use std::collections::BTreeSet;

/// The cost of reading all components, a sum over
///
/// - every component: 0 for 0, else 2, and 1 for a minus sign;
/// - every magnitude that occurs, once however often it does: 0 for 0 and 1, else 1 and the cheaper of two ways to
///   write it: in binary 2 a significant bit after the first and 1 a power of two away from 1; in decimal 3, 6 a digit
///   after the first and 3 a power of ten away from 1.
///
/// So 2 costs 4, 0.5 as well, 0.1 costs 9, and a number with all its bits about 50.
pub fn cost(values: &[f32]) -> u64 {
    let shape = |value: &f32| match *value {
        0.0 => 0,
        value if value < 0.0 => 3,
        _ => 2,
    };
    let magnitudes: BTreeSet<u32> = values.iter().map(|value| value.abs().to_bits()).collect();
    let written = magnitudes.into_iter().map(|bits| magnitude(f32::from_bits(bits)));
    values.iter().map(shape).sum::<u64>() + written.sum::<u64>()
}

fn magnitude(value: f32) -> u64 {
    if value == 0.0 || value == 1.0 {
        return 0;
    }
    let wide = f64::from(value);
    // Exact: as f64 every f32 is normal.
    let exponent = (wide.to_bits() >> 52) as i64 - 1023;
    let fraction = wide.to_bits() & ((1 << 52) - 1);
    let bits = if fraction == 0 { 1 } else { 53 - u64::from(fraction.trailing_zeros()) };
    let binary = 2 * (bits - 1) + exponent.unsigned_abs();
    let (digits, power) = decimal(value);
    1 + binary.min(3 + 6 * (digits - 1) + 3 * power.unsigned_abs())
}

/// Digits and power of ten of the shortest decimal that reads back to the same f32.
fn decimal(value: f32) -> (u64, i64) {
    let text = format!("{value:e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.bytes().filter(u8::is_ascii_digit).count() as u64;
    (digits, power.parse().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_easier_to_read_costs_less() {
        assert_eq!(cost(&[0.0, -0.0]), 0);
        assert_eq!(cost(&[1.0]), 2);
        assert_eq!(cost(&[-1.0]), 3);
        assert_eq!(cost(&[2.0]), 4);
        assert_eq!(cost(&[0.5]), 4);
        assert_eq!(cost(&[0.1]), 9);
        // Two digits in decimal, three bits in binary.
        assert_eq!(cost(&[0.625]), 2 + 1 + 4 + 1);
        // A magnitude is read once.
        assert_eq!(cost(&[0.1, 0.1, -0.1]), 9 + 2 + 3);
        let order = [0.0, 1.0, -1.0, 0.25, 3.0, 0.3, 0.35, 1e-6, 0.123_456];
        assert!(order.is_sorted_by(|a, b| cost(&[*a]) < cost(&[*b])), "{:?}", order.map(|x| cost(&[x])));
    }

    proptest! {
        #[test]
        fn every_number_has_a_cost(bits in any::<u32>()) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite());
            // The smallest subnormals: 149 powers of two away.
            prop_assert!(cost(&[value]) <= 3 + 1 + 2 * 23 + 149);
            prop_assert_eq!(cost(&[value]) == 0, value == 0.0);
        }
    }
}
