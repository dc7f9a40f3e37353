//! The worst configurations of a builtin, kept whole: a driver's accuracy is a number and the input that shows it.

use serde::{Deserialize, Serialize};

use super::exact_bits;
use super::judge::Measure;
use super::judgement::Row;

/// One configuration and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Specimen {
    /// What it is the worst by.
    #[serde(with = "exact_bits")]
    pub size: f64,
    pub index: u64,
    #[serde(with = "exact_bits")]
    pub inputs: Vec<f32>,
    /// Components of the one output.
    #[serde(with = "exact_bits")]
    pub output: Vec<f32>,
    #[serde(with = "exact_bits")]
    pub truth: Vec<f64>,
    /// The permitted error.
    #[serde(with = "exact_bits")]
    pub limit: f64,
}

/// The worst finite errors of one output; the smallest index among equals.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// By units in the last place, where the specification promises anything.
    pub ulp: Option<Specimen>,
    /// By the error over the permitted one.
    pub share: Option<Specimen>,
    /// By the absolute or the relative error, whichever is less, where the specification promises nothing though the
    /// function has a value.
    pub unspecified: Option<Specimen>,
}

impl Extremes {
    pub(super) fn add(&mut self, measure: &Measure, row: Row<'_>, output: &[f32], truth: &[f64], limit: f64) {
        let specimen = |size| Specimen {
            size,
            index: row.index,
            inputs: row.inputs.to_vec(),
            output: output.to_vec(),
            truth: truth.to_vec(),
            limit,
        };
        if limit == f64::INFINITY {
            offer(&mut self.unspecified, measure.error, row.index, specimen);
        } else {
            offer(&mut self.ulp, measure.ulp, row.index, specimen);
            offer(&mut self.share, measure.error, row.index, specimen);
        }
    }

    pub(super) fn merge(&mut self, other: &Extremes) {
        for (mine, theirs) in [
            (&mut self.ulp, &other.ulp),
            (&mut self.share, &other.share),
            (&mut self.unspecified, &other.unspecified),
        ] {
            if let Some(theirs) = theirs {
                offer(mine, theirs.size, theirs.index, |_| theirs.clone());
            }
        }
    }
}

fn offer(kept: &mut Option<Specimen>, size: f64, index: u64, specimen: impl FnOnce(f64) -> Specimen) {
    let better =
        kept.as_ref().is_none_or(|worst| size > worst.size || (size == worst.size && index < worst.index));
    if size.is_finite() && better {
        *kept = Some(specimen(size));
    }
}
