//! Numbers as users write them, to f32 with one rounding.

/// Reads a decimal (`1.5e-3`) or hexadecimal (`0x1.8p-10`) float, rounded once to the nearest f32, ties to even.
///
/// Too large a number gives infinity, as does `inf`; `nan` gives NaN. `None` if it is not a number at all.
pub fn parse_f32(text: &str) -> Option<f32> {
    let (negative, magnitude) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let hexadecimal = magnitude.strip_prefix("0x").or_else(|| magnitude.strip_prefix("0X"));
    let Some(digits) = hexadecimal else {
        return text.parse().ok();
    };
    let value = hexadecimal_f32(digits)?;
    Some(if negative { -value } else { value })
}

/// The shortest decimal that [`parse_f32`] reads back to the same bits: `0.25`, `1.1e-7`, `NaN`.
pub fn decimal_f32(value: f32) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e6).contains(&size) || !size.is_finite() {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// The exact value as a hexadecimal float that [`parse_f32`] reads: `0x1.8p-10`, `0x0.000002p-126`, `nan`, `-inf`.
pub fn hex_f32(value: f32) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    let (exponent, fraction) = (value.to_bits() >> 23 & 0xff, value.to_bits() & 0x7f_ffff);
    let (whole, exponent) = match exponent {
        0xff => return if fraction == 0 { format!("{sign}inf") } else { "nan".to_owned() },
        0 if fraction == 0 => return format!("{sign}0x0p+0"),
        0 => (0, -126),
        _ => (1, exponent as i32 - 127),
    };
    // 23 bits are six digits but for the last bit.
    let digits = format!("{:06x}", fraction << 1);
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}0x{whole}{point}{digits}p{exponent:+}")
}

/// `h.hhhhp[+-]d`, the exponent optional.
fn hexadecimal_f32(text: &str) -> Option<f32> {
    let (digits, exponent) = match text.split_once(['p', 'P']) {
        // Far beyond any exponent that matters, and far from overflow with the digits' own.
        Some((digits, exponent)) => (digits, exponent.parse::<i64>().ok()?.clamp(-100_000, 100_000)),
        None => (text, 0),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    // The value is mantissa * 2^exponent, and a little more if `sticky`.
    let (mut mantissa, mut exponent, mut sticky) = (0u64, exponent, false);
    for (place, digit) in whole.chars().chain(fraction.chars()).enumerate() {
        let digit = u64::from(digit.to_digit(16)?);
        let in_fraction = place >= whole.len();
        if mantissa >> 59 == 0 {
            mantissa = mantissa << 4 | digit;
            exponent -= if in_fraction { 4 } else { 0 };
        } else {
            sticky |= digit != 0;
            exponent += if in_fraction { 0 } else { 4 };
        }
    }
    if mantissa == 0 {
        return Some(0.0);
    }
    // The last place of the result: 24 bits below the leading one, but not below 2^-149.
    let leading = exponent + 63 - i64::from(mantissa.leading_zeros());
    let drop = (leading - 23).max(-149) - exponent;
    let mut kept = mantissa;
    if drop > 0 {
        let drop = drop.min(63) as u32;
        kept = if drop == 63 { 0 } else { mantissa >> drop };
        let (rest, half) = (mantissa - (kept << drop), 1u64 << (drop - 1));
        let up = rest > half || (rest == half && (sticky || kept & 1 == 1));
        kept += u64::from(up);
    }
    // `kept` has at most 24 bits (or is exact in f64 for its few bits) and the scaling is exact, but for overflow.
    let scale = (exponent + drop.max(0)).clamp(-2000, 2000) as i32;
    Some(libm::ldexp(kept as f64, scale) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn hexadecimal() {
        for (text, expected) in [
            ("0x1.8p+1", 3.0),
            ("-0x1p-149", -f32::from_bits(1)),
            ("0x1p-150", 0.0),
            ("0x1.8p-150", f32::from_bits(1)),
            ("0x1.000001p-150", f32::from_bits(1)),
            ("0x.8p0", 0.5),
            ("0xff", 255.0),
            ("0x1.fffffep127", f32::MAX),
            ("0x1.ffffffp127", f32::INFINITY),
            ("0x1.000001p0", 1.0),
            ("0x1.000003p0", 1.0 + 2.0 * f32::EPSILON),
            ("0x1.00000100000000000000000001p0", 1.0 + f32::EPSILON),
            ("0x0.00000000000000000000000000000000000000001p0", 2f32.powi(-132) * 2f32.powi(-32)),
            ("0x100000000000000000000000p0", 2f32.powi(92)),
        ] {
            assert_eq!(parse_f32(text).map(f32::to_bits), Some(expected.to_bits()), "{text}");
        }
        for text in ["0x", "0x.", "0x1.8p", "0xg", "1.5x", "", "one", "0x1p1.5"] {
            assert_eq!(parse_f32(text), None, "{text}");
        }
    }

    #[test]
    fn hexadecimal_is_written_short() {
        for (value, expected) in [
            (3.0, "0x1.8p+1"),
            (-0.5, "-0x1p-1"),
            (0.0, "0x0p+0"),
            (f32::from_bits(1), "0x0.000002p-126"),
            (f32::MAX, "0x1.fffffep+127"),
            (f32::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(hex_f32(value), expected);
        }
    }

    #[test]
    fn decimal_is_rounded_once() {
        // Half-way between two f32 but for the last digit; through f64 it would round down.
        assert_eq!(parse_f32("1.00000005960464477540"), Some(1.0 + f32::EPSILON));
        assert_eq!(parse_f32("1.00000005960464477539062500"), Some(1.0));
    }

    proptest! {
        #[test]
        fn every_f32_survives_as_hexadecimal(bits in 0u32..f32::INFINITY.to_bits()) {
            let value = f32::from_bits(bits);
            let text = format!("0x{:x}p{}", value.to_bits() & 0x7f_ffff | if bits >> 23 == 0 { 0 } else { 0x80_0000 },
                (bits >> 23).max(1) as i32 - 150);
            prop_assert_eq!(parse_f32(&text), Some(value));
        }

        #[test]
        fn what_is_written_is_read(bits in any::<u32>()) {
            let value = f32::from_bits(bits);
            for text in [hex_f32(value), decimal_f32(value)] {
                let read = parse_f32(&text).unwrap();
                prop_assert!(read.to_bits() == bits || (read.is_nan() && value.is_nan()), "{}", text);
            }
        }

        /// The rounding of f64 to f32 by the processor is the independent arithmetic here.
        #[test]
        fn agrees_with_the_processor(mantissa in any::<u64>().prop_map(|m| m >> 11), exponent in -210i32..90) {
            let exact = libm::ldexp(mantissa as f64, exponent);
            prop_assert_eq!(parse_f32(&format!("0x{mantissa:x}p{exponent}")), Some(exact as f32));
        }
    }
}
