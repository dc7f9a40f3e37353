//! Order statistics of samples and intervals of rates.

use serde::{Deserialize, Serialize};
use statrs::statistics::{Data, OrderStatistics};

/// The middle half of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quartiles {
    pub lower: f64,
    pub median: f64,
    pub upper: f64,
}

impl Quartiles {
    /// Quartiles of a sample (Hyndman and Fan's type 8); `None` of an empty one.
    pub fn of(samples: &[f64]) -> Option<Quartiles> {
        if samples.is_empty() {
            return None;
        }
        let mut samples = Data::new(samples.to_vec());
        Some(Quartiles {
            lower: samples.lower_quartile(),
            median: samples.median(),
            upper: samples.upper_quartile(),
        })
    }
}

/// The 95 % interval of a rate of which `count` of `total` were seen: Wilson's score interval (JASA 22, 1927), whose
/// coverage stays near 95 % for rates near 0 and 1. With none or all of them the other end is exact and one-sided, so
/// that 0 of N is at most 3/N.
///
/// Exact two-sided intervals would need the inverse incomplete beta function, which public implementations do not
/// bring to an end for counts of 10^9.
pub fn rate_interval(count: u64, total: u64) -> (f64, f64) {
    /// The 97.5 % quantile of the normal distribution.
    const Z: f64 = 1.959_963_984_540_054;
    if total == 0 {
        return (0.0, 1.0);
    }
    let n = total as f64;
    // 1 - 0.05^(1/N), without cancellation.
    let one_sided = -f64::exp_m1(f64::ln(0.05) / n);
    if count == 0 {
        return (0.0, one_sided);
    }
    if count == total {
        return (1.0 - one_sided, 1.0);
    }
    let rate = count as f64 / n;
    let centre = rate + Z * Z / (2.0 * n);
    let half = Z * f64::sqrt(rate * (1.0 - rate) / n + Z * Z / (4.0 * n * n));
    let scale = 1.0 + Z * Z / n;
    ((centre - half) / scale, (centre + half) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_seen_in_n_is_at_most_three_over_n() {
        let (low, high) = rate_interval(0, 1_000_000);
        assert_eq!(low, 0.0);
        assert!((high * 1e6 - 3.0).abs() < 0.005, "{high}");
        let (low, high) = rate_interval(100, 100);
        assert_eq!(high, 1.0);
        assert!((low - 0.970_487).abs() < 1e-6, "{low}");
    }

    /// Values of the published examples: Newcombe, Statistics in Medicine 17 (1998), table I.
    #[test]
    fn intervals_agree_with_tables() {
        for (count, total, expected) in
            [(81, 263, (0.2553, 0.3662)), (15, 148, (0.0624, 0.1605)), (1, 29, (0.0061, 0.1718))]
        {
            let (low, high) = rate_interval(count, total);
            assert!(
                (low - expected.0).abs() < 5e-5 && (high - expected.1).abs() < 5e-5,
                "{count}/{total}: {low} {high}"
            );
        }
    }

    #[test]
    fn large_counts_do_not_fail() {
        let (low, high) = rate_interval(530_000, 1_000_000);
        assert!(low < 0.53 && 0.53 < high && high - low < 0.003, "{low} {high}");
        let (low, high) = rate_interval(1, 4_000_000_000);
        assert!(low > 0.0 && high < 1e-8, "{low} {high}");
    }

    #[test]
    fn quartiles_of_a_ramp() {
        let quartiles = Quartiles::of(&[5.0, 1.0, 3.0, 2.0, 4.0]).unwrap();
        assert_eq!(quartiles.median, 3.0);
        assert!((1.0..=2.0).contains(&quartiles.lower) && (4.0..=5.0).contains(&quartiles.upper));
        assert_eq!(Quartiles::of(&[]), None);
    }
}
