//! Fits linearly transformed cosines to isotropic GGX.
//!
//! The procedure is the one published with Heitz, Dupuy, Hill and Neubelt, "Real-Time Polygonal-Light Shading with
//! Linearly Transformed Cosines" (2016): a square table over roughness and sqrt(1 - cos theta); in each cell the lobe's
//! magnitude, Fresnel term and mean direction by stratified sampling; then m11, m22 and m13 by Nelder-Mead on the L3
//! error, started from the neighbour's result. What differs is stated where it does: `measure` integrates the moments more
//! exactly, `search` goes on from the published search's result and lets the axis turn.
//!
//! Normal incidence is one chain from rough to smooth; from each of its cells a row towards grazing angles starts. Rows do
//! not depend on each other, so threads change no bit; neither does the platform, since transcendental functions come
//! from `libm`.
//!
//! `rootq fit ggx --out data/ggx.csv` made the embedded table, in 16 s of processor time. Its residuals under the published
//! measure (the integral of |GGX - LTC|^3 from 2 x 32 x 32 samples, [`Residual::error`]) next to those of the table that
//! the authors published (in f32, as shaders have it), each with its own magnitudes:
//!
//! | table     | min     | median | p95  | max    |
//! |-----------|---------|--------|------|--------|
//! | this      | 9.5e-11 | 6.1e-6 | 2.8  | 3.6e15 |
//! | published | 3.6e-9  | 3.5e-5 | 66   | 8.9e22 |
//!
//! relative to the L3 norm of GGX ([`Residual::relative`]):
//!
//! | table     | min     | median | p95  | max  |
//! |-----------|---------|--------|------|------|
//! | this      | 3.8e-8  | 0.029  | 0.20 | 0.41 |
//! | published | 3.8e-8  | 0.042  | 0.29 | 0.86 |
//!
//! Given the same magnitude, no cell is more than 1.6 % worse than the published one, the median cell's error is a quarter.
//! With their own, some published cells are nearer, up to 39 times at normal incidence around roughness 23/63: a magnitude
//! that misses the tail, as theirs do by up to 0.07, is easier to fit. On independent 256 x 256 strata seven grazing cells
//! of roughness 60/63 and more are 4 % to 59 % worse, which is how much 32 strata leave open there; the statistics are the
//! same.

mod ggx;
mod ltc;
mod measure;
mod search;

use std::fmt::Write;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec3;
use rayon::prelude::*;

use crate::sample::ggx::{COLUMNS, Cell, Table, cos_theta};
use search::{Parameters, Task};

pub use ggx::Ggx;
pub use ltc::Ltc;
pub use measure::{Moments, Residual, Strata, Target};

/// Why there is no table.
#[derive(Debug, thiserror::Error)]
pub enum Stopped {
    /// The caller's flag was raised.
    #[error("interrupted")]
    Interrupted,
    /// The optimiser refused its task.
    #[error("the optimiser failed: {0}")]
    Optimiser(argmin::core::Error),
}

/// A table and how well it fits.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The table.
    pub table: Table,
    /// Residuals of the cells in the table's order.
    pub residuals: Vec<Residual>,
}

/// Fits a table of `size` x `size` cells, at least 2. Calls `progress` after each cell; `stop` ends the fit at the next.
pub fn ggx(size: usize, progress: &(dyn Fn() + Sync), stop: &AtomicBool) -> Result<Fit, Stopped> {
    let fitter = Fitter::new(size);
    let starts = fitter.normal_incidence(stop)?;
    let rows = starts
        .into_par_iter()
        .enumerate()
        .map(|(roughness, start)| fitter.row(roughness, start, progress, stop))
        .collect::<Result<Vec<_>, _>>()?;
    let (cells, residuals) = rows.into_iter().flatten().unzip();
    Ok(Fit { table: Table::new(size, cells), residuals })
}

struct Fitter {
    size: usize,
    strata: Strata,
}

impl Fitter {
    fn new(size: usize) -> Self {
        assert!(size >= 2, "a table has two ends");
        Fitter { size, strata: Strata::default() }
    }

    fn lobe(&self, roughness: usize, angle: usize) -> Ggx {
        Ggx::new(roughness as f64 / (self.size - 1) as f64, cos_theta(angle, self.size))
    }

    /// Parameters at normal incidence for each roughness, each search started from the next rougher result.
    fn normal_incidence(&self, stop: &AtomicBool) -> Result<Vec<Parameters>, Stopped> {
        let mut parameters = Parameters([1.0, 1.0, 0.0, 0.0]);
        let mut all = Vec::new();
        for roughness in (0..self.size).rev() {
            if stop.load(Ordering::Relaxed) {
                return Err(Stopped::Interrupted);
            }
            let ggx = self.lobe(roughness, 0);
            let magnitude = self.strata.moments(&ggx).magnitude;
            let target = self.strata.target(ggx);
            let task = Task { target: &target, axis: DVec3::Z, magnitude, symmetric: true };
            (parameters, _) = task.search(parameters).map_err(Stopped::Optimiser)?;
            all.push(parameters);
        }
        all.reverse();
        Ok(all)
    }

    /// The cells of one roughness, from normal incidence, whose parameters are `start`, to grazing.
    fn row(
        &self,
        roughness: usize,
        start: Parameters,
        progress: &(dyn Fn() + Sync),
        stop: &AtomicBool,
    ) -> Result<Vec<(Cell, Residual)>, Stopped> {
        let mut parameters = start;
        (0..self.size)
            .map(|angle| {
                if stop.load(Ordering::Relaxed) {
                    return Err(Stopped::Interrupted);
                }
                let ggx = self.lobe(roughness, angle);
                let Moments { magnitude, fresnel, axis } = self.strata.moments(&ggx);
                let target = self.strata.target(ggx);
                let symmetric = angle == 0;
                let axis = if symmetric { DVec3::Z } else { axis };
                let task = Task { target: &target, axis, magnitude, symmetric };
                let mut best = parameters;
                if !symmetric {
                    (parameters, best) = task.search(parameters).map_err(Stopped::Optimiser)?;
                }
                let cell = Cell::new(task.ltc(best).minv(), magnitude, fresnel);
                // Of what the table holds: rounding to f32 is part of the residual.
                let ltc = Ltc::new(cell.matrix().inverse(), f64::from(cell.magnitude));
                progress();
                Ok((cell, target.residual(&ltc)))
            })
            .collect()
    }
}

impl Fit {
    /// The table as text, with what made it and how well it fits; `sample::ggx` reads it.
    pub fn csv(&self) -> String {
        let last = self.table.size() - 1;
        let mut text = format!(
            "# rootq fit ggx --size {}\n\
             # Linearly transformed cosines of isotropic GGX: roughness/{last} (alpha = roughness^2), angle/{last} = \
             sqrt(1 - cos theta).\n\
             # minv_CR: column C, row R of the inverse matrix, minv_11 = 1; reflectance = f0 (magnitude - fresnel) + \
             fresnel.\n\
             # l3_error: integral of |GGX - LTC|^3; l3_relative: L3 norm of the difference over that of GGX.\n",
            self.table.size()
        );
        for line in self.statistics().lines() {
            _ = writeln!(text, "# {line}");
        }
        _ = writeln!(text, "{},l3_error,l3_relative", COLUMNS.join(","));
        for (at, (cell, residual)) in self.table.cells().iter().zip(&self.residuals).enumerate() {
            _ = write!(text, "{},{}", at / self.table.size(), at % self.table.size());
            for value in cell.values() {
                // The shortest decimal that reads back to the same bits.
                _ = write!(text, ",{value:?}");
            }
            _ = writeln!(text, ",{:.3e},{:.3e}", residual.error, residual.relative);
        }
        text
    }

    /// Quantiles of the residuals over all cells, as a table.
    pub fn statistics(&self) -> String {
        let mut text = format!("{:12}{:>11}{:>11}{:>11}{:>11}\n", "residual", "min", "median", "p95", "max");
        let mut row = |name: &str, of: &dyn Fn(&Residual) -> f64| {
            let [min, median, p95, max] = quantiles(self.residuals.iter().map(of).collect());
            _ = writeln!(text, "{name:12}{min:>11.2e}{median:>11.2e}{p95:>11.2e}{max:>11.2e}");
        };
        row("l3_error", &|residual| residual.error);
        row("l3_relative", &|residual| residual.relative);
        text
    }
}

/// Minimum, median, 95 % quantile (each the nearest rank) and maximum of at least one value.
fn quantiles(mut values: Vec<f64>) -> [f64; 4] {
    values.sort_by(f64::total_cmp);
    let rank = |share: f64| values[((share * values.len() as f64).ceil() as usize).max(1) - 1];
    [values[0], rank(0.5), rank(0.95), values[values.len() - 1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::ggx::table;

    #[allow(clippy::declare_interior_mutable_const, reason = "a fresh flag at each use")]
    const GO: AtomicBool = AtomicBool::new(false);

    #[test]
    fn rows_fitted_again_are_the_committed_ones() {
        let fitter = Fitter::new(64);
        let starts = fitter.normal_incidence(&GO).unwrap();
        for roughness in [3, 27, 63] {
            let row = fitter.row(roughness, starts[roughness], &|| (), &GO).unwrap();
            let committed = &table().cells()[64 * roughness..][..64];
            for (angle, ((cell, _), committed)) in row.iter().zip(committed).enumerate() {
                // The same bits: all of it is IEEE arithmetic and libm.
                assert_eq!(cell, committed, "{roughness} {angle}");
            }
        }
    }

    #[test]
    fn threads_change_no_bit() {
        let fit = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| ggx(7, &|| (), &GO).unwrap())
        };
        let (one, two) = (fit(1), fit(2));
        assert_eq!(one, two);
        assert_eq!(Table::parse(&one.csv()), Ok(two.table));
    }

    #[test]
    fn every_cell_is_counted_and_a_raised_flag_ends_it() {
        let count = std::sync::atomic::AtomicUsize::new(0);
        let progress = || {
            count.fetch_add(1, Ordering::Relaxed);
        };
        ggx(3, &progress, &GO).unwrap();
        assert_eq!(count.into_inner(), 9);
        assert!(matches!(ggx(3, &|| (), &AtomicBool::new(true)), Err(Stopped::Interrupted)));
    }

    #[test]
    fn rough_and_smooth_ends() {
        let fit = ggx(4, &|| (), &GO).unwrap();
        for roughness in 0..4 {
            let Cell { minv: [m00, m02, m20, m22], .. } = fit.table.cells()[4 * roughness];
            assert_eq!((m00, m02, m20), (1.0, 0.0, 0.0));
            assert!(m22 > 0.0);
        }
        // The smoothest lobe is twice as wide in angle as alpha, and keeps all light.
        let smooth = fit.table.cells()[0];
        assert!((smooth.minv[3] / 2e-5 - 1.0).abs() < 1e-4 && smooth.magnitude == 1.0, "{smooth:?}");
        // Closed form at alpha = 1, where D is 1/pi and G2 is 2 z/(z + 1): the integral of z/(1 + z) over 0..1.
        let rough = fit.table.cells()[12];
        assert!((f64::from(rough.magnitude) - (1.0 - core::f64::consts::LN_2)).abs() < 1e-6, "{rough:?}");
    }

    #[test]
    fn quantiles_are_nearest_ranks() {
        assert_eq!(quantiles((1..=100).rev().map(f64::from).collect()), [1.0, 50.0, 95.0, 100.0]);
        assert_eq!(quantiles(vec![7.0]), [7.0; 4]);
    }
}
