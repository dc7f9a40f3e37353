//! Counts as users write them: `1M`, `250K`, `4G`, `1.5M`.

/// A count from 1 to 2^53.
pub(super) fn parse(text: &str) -> Result<u64, String> {
    let (digits, factor) = match text.to_ascii_uppercase().as_bytes().last() {
        Some(b'K') => (&text[..text.len() - 1], 1_000.0),
        Some(b'M') => (&text[..text.len() - 1], 1_000_000.0),
        Some(b'G') => (&text[..text.len() - 1], 1_000_000_000.0),
        _ => (text, 1.0),
    };
    let value: f64 = digits.parse().map_err(|_| "a count is a number, or one with K, M or G".to_owned())?;
    let value = value * factor;
    // 2^53: beyond it not every count is a value of f64.
    if !(1.0..=9_007_199_254_740_992.0).contains(&value) {
        return Err("a count is a whole number from 1 to 2^53 (9007199254740992)".to_owned());
    }
    if value.fract() != 0.0 {
        return Err("a count is a whole number, such as 1500 or 1.5K".to_owned());
    }
    Ok(value as u64)
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn suffixes_are_decimal() {
        assert_eq!(parse("1M"), Ok(1_000_000));
        assert_eq!(parse("1.5k"), Ok(1_500));
        assert_eq!(parse("17"), Ok(17));
        for wrong in ["0", "-1", "", "M", "1.5", "x", "nan", "1e30"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
