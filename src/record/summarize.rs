//! From the audit's summaries to the record's words.

use super::schema;
use crate::audit::{Extremes, Histogram, OracleSummary, OutputSummary, Specimen, Summary, Verdict};
use crate::bench::rate_interval;
use crate::family::Problem;

/// A family's own facts; scenarios and variants are added by whoever runs them.
pub fn family(problem: &dyn Problem) -> schema::Family {
    schema::Family {
        name: problem.name().to_owned(),
        summary: problem.summary().to_owned(),
        outputs: problem
            .outputs()
            .iter()
            .map(|output| schema::Output {
                name: output.field.name.to_owned(),
                quantity: output.quantity.name().to_owned(),
                tolerance: output.tolerance,
                headline: output.headline,
            })
            .collect(),
        landmarks: problem
            .landmarks()
            .iter()
            .map(|landmark| schema::Landmark {
                name: landmark.name.to_owned(),
                summary: landmark.summary.to_owned(),
                edges: landmark.edges.to_vec(),
            })
            .collect(),
        scenarios: Vec::new(),
        variants: Vec::new(),
    }
}

/// One variant's audit on one scenario.
pub fn audit(problem: &dyn Problem, summary: &Summary) -> schema::Audit {
    let total = summary.configurations;
    let rate = |count| rate(count, total);
    let seen = |verdicts: &[u64]| {
        Verdict::ALL.into_iter().zip(verdicts.to_vec()).filter(|(_, count)| *count > 0).collect::<Vec<_>>()
    };
    schema::Audit {
        configurations: total,
        verdicts: seen(&summary.verdicts)
            .into_iter()
            .map(|(verdict, count)| (verdict, rate(count)))
            .collect(),
        failed: rate(summary.failed()),
        outputs: problem
            .outputs()
            .iter()
            .zip(&summary.outputs)
            .map(|(output, summary)| output_audit(output.field.name, summary, total))
            .collect(),
        landmarks: summary
            .landmarks
            .iter()
            .map(|bins| {
                let filled =
                    bins.iter().enumerate().filter(|(_, bin)| bin.verdicts.iter().any(|count| *count > 0));
                filled
                    .map(|(position, bin)| schema::Bin {
                        bin: position,
                        verdicts: seen(&bin.verdicts).into_iter().collect(),
                        beyond: bin.beyond[..problem.outputs().len()].to_vec(),
                    })
                    .collect()
            })
            .collect(),
    }
}

fn output_audit(name: &str, summary: &OutputSummary, total: u64) -> schema::OutputAudit {
    let [bits8, bits10, half] = summary.visible;
    schema::OutputAudit {
        name: name.to_owned(),
        beyond: rate(summary.beyond, total),
        visible: schema::Visible { bits8, bits10, half },
        error: distribution(&summary.error),
        ulp: distribution(&summary.ulp),
        conditioned: distribution(&summary.conditioned),
        worst: summary.worst.found.map(|(error, index)| schema::Worst {
            error,
            index,
            ulp: summary.worst.ulp,
        }),
        extremes: (summary.extremes != Extremes::default()).then(|| schema::Extremes {
            ulp: summary.extremes.ulp.as_ref().map(specimen),
            share: summary.extremes.share.as_ref().map(specimen),
            unspecified: summary.extremes.unspecified.as_ref().map(specimen),
        }),
    }
}

fn specimen(specimen: &Specimen) -> schema::Specimen {
    schema::Specimen {
        size: specimen.size,
        index: specimen.index,
        inputs: specimen.inputs.clone(),
        output: specimen.output.iter().map(|value| Some(*value).filter(|value| value.is_finite())).collect(),
        truth: specimen.truth.clone(),
        limit: Some(specimen.limit).filter(|limit| limit.is_finite()),
    }
}

fn distribution(histogram: &Histogram) -> schema::Distribution {
    let quantile = |q| Some(histogram.quantile(q)).filter(|value| value.is_finite());
    let counts = histogram.counts();
    let first = counts.iter().position(|count| *count > 0).unwrap_or(0);
    let last = counts.iter().rposition(|count| *count > 0).map_or(first, |last| last + 1);
    schema::Distribution {
        p50: quantile(0.5),
        p90: quantile(0.9),
        p99: quantile(0.99),
        p999: quantile(0.999),
        buckets: schema::Buckets { first, counts: counts[first..last].to_vec() },
    }
}

fn rate(count: u64, total: u64) -> schema::Rate {
    let (low, high) = rate_interval(count, total);
    schema::Rate { count, rate: if total == 0 { 0.0 } else { count as f64 / total as f64 }, low, high }
}

impl From<OracleSummary> for schema::Oracle {
    fn from(summary: OracleSummary) -> Self {
        schema::Oracle {
            escalations: summary.escalations,
            uncertified: summary.uncertified,
            worst_bound: summary.worst_bound,
        }
    }
}
