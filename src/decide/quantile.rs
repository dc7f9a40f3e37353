//! Which part of an error's distribution counts.

use serde::{Deserialize, Serialize};

use crate::record::{Audit, Distribution, OutputAudit};

/// A quantile of recorded errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantile {
    P50,
    P90,
    P99,
    P999,
    /// The largest.
    #[default]
    Worst,
}

impl Quantile {
    /// Every quantile, ascending.
    pub const ALL: [Quantile; 5] =
        [Quantile::P50, Quantile::P90, Quantile::P99, Quantile::P999, Quantile::Worst];

    /// As rules and options write it.
    pub fn name(self) -> &'static str {
        match self {
            Quantile::P50 => "p50",
            Quantile::P90 => "p90",
            Quantile::P99 => "p99",
            Quantile::P999 => "p999",
            Quantile::Worst => "worst",
        }
    }

    /// Of an output's error in its own measure; infinite where results are not finite.
    pub fn of_error(self, audit: &Audit, output: &OutputAudit) -> f64 {
        self.of(&output.error, audit.worst(output).map(|worst| worst.error))
    }

    /// Of an output's error in ULP; infinite where results are not finite.
    pub fn of_ulp(self, audit: &Audit, output: &OutputAudit) -> f64 {
        self.of(&output.ulp, audit.worst(output).map(|worst| worst.ulp))
    }

    fn of(self, distribution: &Distribution, worst: Option<f64>) -> f64 {
        let value = match self {
            Quantile::P50 => distribution.p50,
            Quantile::P90 => distribution.p90,
            Quantile::P99 => distribution.p99,
            Quantile::P999 => distribution.p999,
            Quantile::Worst => worst,
        };
        value.unwrap_or(f64::INFINITY)
    }
}
