//! `rootq compare`: what changed between two recorded runs, and whether that keeps the rules.

use std::path::PathBuf;

use anyhow::{Context, Result, anyhow, bail};
use clap::{Args, ValueEnum};

use super::Outcome;
use crate::decide::{self, Rules, Tolerances};
use crate::{record, report};

/// Options of `rootq compare`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq compare before/ after/                        what changed\n  \
    rootq compare lavapipe/ nvidia/ --all               every row, two devices\n  \
    rootq compare main/ branch/ --gate rules.toml --format github\n\n\
A rule of the gate, all keys but one limit optional:\n  \
    [[rule]]\n  \
    select = \"ltc_disk/*\"            family, family/variant or a glob\n  \
    scenario = \"ggx\"                 a name or a glob\n  \
    max_failed = 1e-5                share wrong by the variant's own fault\n  \
    max_non_finite = 0               share that is NaN or infinite\n  \
    max_error = 1e-3                 of every output in its own measure\n  \
    max_ulp = 8                      of every output\n  \
    quantile = \"p999\"                for max_error and max_ulp: p50 p90 p99 p999 worst [default: worst]\n  \
    max_time_ratio = 1.1             B's time over A's; on a software device relative to all times' change\n  \
    no_worse = [\"accuracy\", \"time\"]  what may not get worse\n  \
    same_bits = true                 outputs as in A, to the last bit")]
pub(super) struct Arguments {
    /// Run folder to compare with
    #[arg(value_name = "A")]
    a: PathBuf,
    /// Run folder that is compared
    #[arg(value_name = "B")]
    b: PathBuf,
    /// Rules that B must keep; what breaks one is shown, and the exit status is 1
    #[arg(long, value_name = "RULES.toml")]
    gate: Option<PathBuf>,
    /// What goes to standard output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Show rows without a change too
    #[arg(long)]
    all: bool,
    /// Percent by which the times of two runs of the same thing may differ [default: 10, on a software device 25]
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true)]
    time_tolerance: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For a terminal
    Table,
    /// For a pull request or a wiki
    Markdown,
    /// Every row with all figures
    Json,
    /// Annotations of a GitHub Actions job: errors for the gate's breaches, warnings for what got worse
    Github,
}

pub(super) fn compare(arguments: &Arguments) -> Result<Outcome> {
    if let Some(percent) = arguments.time_tolerance
        && !(percent >= 0.0 && percent.is_finite())
    {
        bail!("--time-tolerance must not be negative");
    }
    // A mistake in the rules is told before runs are read.
    let rules = arguments.gate.as_ref().map(|path| {
        let text =
            std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
        Rules::parse(&text).map_err(|message| anyhow!("{}: {message}", path.display()))
    });
    let rules = rules.transpose()?;
    let (a, b) = (record::read(&arguments.a)?, record::read(&arguments.b)?);
    let drift = arguments.time_tolerance.map(|percent| percent / 100.0);
    let comparison = decide::compare(&a, &b, Tolerances { drift, ..Tolerances::default() });
    if comparison.rows.is_empty() {
        bail!(
            "{} and {} have no variant and scenario in common",
            arguments.a.display(),
            arguments.b.display()
        );
    }
    let breaches = rules.map(|rules| {
        rules.breaches(&comparison, &b).map_err(|message| {
            let path = arguments.gate.as_deref().unwrap_or(std::path::Path::new("--gate"));
            anyhow!("{}: {message}", path.display())
        })
    });
    let breaches = breaches.transpose()?;

    let told = breaches.as_deref();
    let text = match arguments.format {
        Format::Table => {
            let form = report::Form::Terminal { colour: super::colour() };
            report::compare(&comparison, told, arguments.all, form)
        }
        Format::Markdown => report::compare(&comparison, told, arguments.all, report::Form::Markdown),
        Format::Json => {
            let value = serde_json::json!({ "comparison": comparison, "breaches": breaches });
            format!("{value:#}\n")
        }
        Format::Github => report::github(&comparison, told),
    };
    super::print(&text)?;
    Ok(match breaches {
        Some(breaches) if !breaches.is_empty() => {
            eprintln!("rootq: {} breaches of the gate's rules", breaches.len());
            Outcome::Violated
        }
        _ => Outcome::Clean,
    })
}
