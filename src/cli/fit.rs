//! `rootq fit`: tables that shaders sample.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use clap::{Args, Subcommand};

use super::draft::{deliver, draft, is_dash};
use super::progress::bar;
use crate::fit;

/// Fits tables that shaders sample.
#[derive(Args, Debug)]
pub(super) struct Arguments {
    #[command(subcommand)]
    material: Material,
}

#[derive(Debug, Subcommand)]
enum Material {
    Ggx(Ggx),
}

/// Fits linearly transformed cosines to isotropic GGX, by the procedure of Heitz et al. 2016.
///
/// The table is square over roughness (alpha = roughness^2) and sqrt(1 - cos theta), both from 0 to 1. A line of the CSV
/// is a cell: its two indices; four elements of the inverse matrix (minv_CR: column C, row R; minv_11 is 1, the others
/// are 0); the magnitude (directional albedo without Fresnel) and the Schlick-Fresnel term, so that reflectance is
/// f0 * (magnitude - fresnel) + fresnel; and how well the cell fits: the integral of |GGX - LTC|^3, and the L3 norm of
/// the difference over that of GGX. The same size gives the same bytes on any machine and number of threads.
///
/// The table with which the scenarios of rootq draw their matrices was made so, with the default size.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq fit ggx                        64 x 64 cells to ggx.csv, and the residuals' statistics\n  \
    rootq fit ggx --size 16 --out - | column -ts,")]
struct Ggx {
    /// Cells a side, 2 to 256
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u16).range(2..=256))]
    size: u16,
    /// CSV to write; '-' is standard output, the statistics then go to standard error
    #[arg(long, value_name = "OUT.csv", default_value = "ggx.csv")]
    out: PathBuf,
    /// Threads; changes no result [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

pub(super) fn fit(arguments: &Arguments, stop: &AtomicBool) -> Result<()> {
    match &arguments.material {
        Material::Ggx(arguments) => ggx(arguments, stop),
    }
}

fn ggx(arguments: &Ggx, stop: &AtomicBool) -> Result<()> {
    let start = Instant::now();
    if let Some(threads) = arguments.threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global().context("--threads")?;
    }
    // Before the work: a path that cannot be written should not cost it.
    let mut draft = draft(&arguments.out)?;
    let size = usize::from(arguments.size);
    let bar = bar((size * size) as u64, "fit ggx", "{human_pos}/{human_len} cells {eta}");
    let fit = fit::ggx(size, &|| bar.inc(1), stop);
    bar.finish_and_clear();
    let fit = fit?;
    let name = arguments.out.display();
    if let Err(error) = draft.write_all(fit.csv().as_bytes()) {
        bail!("cannot write {name}: {error}");
    }
    deliver(draft, &arguments.out)?;
    if is_dash(&arguments.out) {
        eprint!("{}", fit.statistics());
        return Ok(());
    }
    super::print(&fit.statistics())?;
    eprintln!("{name}: {0} x {0} cells ({1:.1} s)", size, start.elapsed().as_secs_f64());
    Ok(())
}
