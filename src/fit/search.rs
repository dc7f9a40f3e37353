//! Nelder-Mead over the parameters of an LTC.

use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::neldermead::NelderMead;
use argmin_math::{ArgminAdd, ArgminMul, ArgminSub};
use glam::DVec3;

use super::ltc::Ltc;
use super::measure::Target;

/// Iterations of the published search and the least relative spread of errors in its simplex.
const PUBLISHED: (u64, f64) = (100, 1e-5);

/// The same for further searches. An error within 1e-9 of its minimum puts parameters within about 3e-5 of theirs.
const FURTHER: (u64, f64) = (200, 1e-9);

/// Offset of the first simplex: absolute for the published search, relative for the others.
const OFFSET: f64 = 0.05;

/// Least width, so that lobes do not collapse. The published 1e-7 is wider than the smoothest lobe at grazing angles,
/// 2e-5 cos(1.57).
const MIN_WIDTH: f64 = 1e-9;

/// What turning the axis must take off the relative residual. The lobes of smooth surfaces look the same
/// with any turn that their shear undoes; without this their matrices would be noise.
const WORTH_TURNING: f64 = 1e-4;

/// m11, m22, m13 and m31 of [`Ltc::in_frame`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameters(pub(super) [f64; 4]);

impl ArgminAdd<Parameters, Parameters> for Parameters {
    fn add(&self, other: &Parameters) -> Parameters {
        Parameters(std::array::from_fn(|at| self.0[at] + other.0[at]))
    }
}

impl ArgminSub<Parameters, Parameters> for Parameters {
    fn sub(&self, other: &Parameters) -> Parameters {
        Parameters(std::array::from_fn(|at| self.0[at] - other.0[at]))
    }
}

impl ArgminMul<f64, Parameters> for Parameters {
    fn mul(&self, factor: &f64) -> Parameters {
        Parameters(self.0.map(|parameter| parameter * factor))
    }
}

/// The lobe to approximate, in the frame and with the magnitude that the LTC takes from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task<'a> {
    pub(super) target: &'a Target<'a>,
    pub(super) axis: DVec3,
    pub(super) magnitude: f64,
    /// Whether the lobe is symmetric about its axis: only m11 counts.
    pub(super) symmetric: bool,
}

impl CostFunction for &Task<'_> {
    type Param = Parameters;
    type Output = f64;

    /// The logarithm of the error: Nelder-Mead only compares, so it decides as it would by the error itself, but its
    /// tolerance becomes relative.
    fn cost(&self, parameters: &Parameters) -> Result<f64, Error> {
        let error = self.target.error(&self.ltc(*parameters));
        // A matrix without an inverse is no lobe at all.
        Ok(if error.is_finite() { libm::log(error.max(f64::MIN_POSITIVE)) } else { f64::MAX })
    }
}

impl Task<'_> {
    /// The LTC of `parameters`.
    pub(super) fn ltc(&self, parameters: Parameters) -> Ltc {
        let Parameters([m11, m22, m13, m31]) = self.allowed(parameters);
        Ltc::in_frame(self.axis, m11, m22, m13, m31, self.magnitude)
    }

    /// Widths are kept from vanishing, as published.
    fn allowed(&self, Parameters([m11, m22, m13, m31]): Parameters) -> Parameters {
        let m11 = m11.max(MIN_WIDTH);
        Parameters(if self.symmetric { [m11, m11, 0.0, 0.0] } else { [m11, m22.max(MIN_WIDTH), m13, m31] })
    }

    /// Parameters near `start` without a turn, for the next search to start from, and the best ones.
    ///
    /// First the published search; then one from where that ended, with a simplex in proportion to the widths and a
    /// narrower tolerance: what narrow lobes and collapsed simplices need. Last one with m31 free, since the mean
    /// direction is not the best axis.
    pub(super) fn search(&self, start: Parameters) -> Result<(Parameters, Parameters), Error> {
        let free = if self.symmetric { 1 } else { 3 };
        let first = self.descend(self.nearer(start, self.mirror()), &[OFFSET; 3][..free], PUBLISHED)?;
        let [m11, m22, ..] = first.0;
        // Shears are in units of the width along them.
        let offsets = [OFFSET * m11, OFFSET * m22, OFFSET * m11, OFFSET * m11];
        let straight = self.descend(first, &offsets[..free], FURTHER)?;
        if self.symmetric {
            return Ok((straight, straight));
        }
        let mut turned = straight;
        // The valley is flat where shear and turn nearly undo each other; a fresh simplex goes on where the last collapsed.
        for _ in 0..2 {
            turned = self.descend(turned, &offsets, FURTHER)?;
        }
        let relative = |parameters| self.target.residual(&self.ltc(parameters)).relative;
        let worth = relative(straight) - relative(turned) > WORTH_TURNING;
        Ok((straight, if worth { turned } else { straight }))
    }

    /// The widths of a nearly smooth surface's lobe: a micronormal's slope turns light by twice its angle in the plane of
    /// incidence, by less across.
    fn mirror(&self) -> Parameters {
        let ggx = self.target.ggx();
        Parameters([2.0 * ggx.alpha(), 2.0 * ggx.alpha() * ggx.view().z, 0.0, 0.0])
    }

    /// Whichever has the smaller error.
    fn nearer(&self, one: Parameters, other: Parameters) -> Parameters {
        let error = |parameters| self.target.error(&self.ltc(parameters));
        if error(other) < error(one) { other } else { one }
    }

    /// One search over the leading parameters, as many as there are offsets of the first simplex.
    fn descend(
        &self,
        start: Parameters,
        offsets: &[f64],
        (iterations, tolerance): (u64, f64),
    ) -> Result<Parameters, Error> {
        let mut simplex = vec![start];
        for (at, offset) in offsets.iter().enumerate() {
            let mut vertex = start;
            vertex.0[at] += offset;
            simplex.push(vertex);
        }
        let solver = NelderMead::new(simplex).with_sd_tolerance(tolerance)?;
        let result =
            Executor::new(self, solver).configure(|state| state.max_iters(iterations)).timer(false).run()?;
        Ok(self.allowed(result.state.get_best_param().copied().unwrap_or(start)))
    }
}
