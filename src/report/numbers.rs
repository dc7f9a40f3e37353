//! Numbers in tables: short, and never rounded into a false zero.

use crate::record::Rate;

/// A rate in percent; a count of none as `0`, and what would round to 0 as a count, so that one failure in a million
/// still shows.
pub(super) fn percent(rate: &Rate) -> String {
    let percent = 100.0 * rate.rate;
    if rate.count == 0 {
        "0".to_owned()
    } else if percent < 0.01 {
        format!("{}x", rate.count)
    } else if percent < 10.0 {
        format!("{percent:.2} %")
    } else if percent < 99.95 || rate.rate == 1.0 {
        format!("{percent:.1} %")
    } else {
        format!("{percent:.3} %")
    }
}

/// A positive quantity with two or three significant digits; `inf` where there is none.
pub(super) fn short(value: Option<f64>) -> String {
    let Some(value) = value else {
        return "inf".to_owned();
    };
    match value {
        0.0 => "0".to_owned(),
        _ if (0.01..100.0).contains(&value) => format!("{value:.2}"),
        _ if (100.0..10_000.0).contains(&value) => format!("{value:.0}"),
        _ => format!("{value:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_failure_in_a_million_still_shows() {
        let rate =
            |count: u64, total: u64| Rate { count, rate: count as f64 / total as f64, low: 0.0, high: 1.0 };
        assert_eq!(percent(&rate(0, 1_000_000)), "0");
        assert_eq!(percent(&rate(1, 1_000_000)), "1x");
        assert_eq!(percent(&rate(53, 100)), "53.0 %");
        assert_eq!(percent(&rate(999_999, 1_000_000)), "100.000 %");
        assert_eq!(percent(&rate(10, 10)), "100.0 %");
    }

    #[test]
    fn quantities_stay_short() {
        assert_eq!(short(Some(0.0)), "0");
        assert_eq!(short(Some(4.567)), "4.57");
        assert_eq!(short(Some(1.0e-9)), "1.0e-9");
        assert_eq!(short(Some(123.4)), "123");
        assert_eq!(short(None), "inf");
    }
}
