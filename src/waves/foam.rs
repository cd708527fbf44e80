//! Where foam forms and how much of it there is.
//!
//! Waves break where the horizontal displacement squeezes the surface, so foam forms where the Jacobian J of the
//! displacement falls below a threshold. By default the threshold makes the mean foam equal the whitecap coverage of
//! the wind, W = 3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980).

use super::plan::Plan;
use super::statistics::monahan_coverage;
use crate::state::params::Whitecaps;
use std::f64::consts::PI;

/// Mean foam F for a mean source s: F / (1 - F) = FACTOR (rate x decay time)^POWER s. Fitted to GPU results for winds
/// of 7 to 30 m/s, all levels, and rate x decay time from 1 to 50.
const FACTOR: f64 = 1.03;
const POWER: f64 = 0.73;
/// Default rate x decay time, for which the mean foam equals the whitecap coverage of the wind.
const DEFAULT_RATE_DECAY: f64 = 8.0;
/// Width of the source's ramp from 0 to 1, in standard deviations of the strain.
const RAMP: f64 = 0.5;

/// Upper limit of the whitecap coverage.
const MAX_COVERAGE: f64 = 0.9;
/// (1 - r2^2) / 4 in [`jacobian`], for the directional spread of short waves.
const DETERMINANT: f64 = 0.2;
/// Texel at which a fixed threshold applies, m. On coarser levels foam is equally rare.
const REFERENCE_TEXEL_M: f64 = 0.25;
/// Standard deviation of the strain below which the water counts as flat.
const MIN_SIGMA: f64 = 1e-6;

/// Foam source at a Jacobian J: clamp((threshold - J) x slope, 0, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FoamSource {
    /// Jacobian below which foam forms.
    pub threshold: f64,
    /// Foam source per unit by which the Jacobian lies below the threshold.
    pub slope: f64,
}

/// Foam threshold and mean foam of a sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamModel {
    /// Standard deviations of the strain below 0 at which foam starts to form; infinite without foam.
    sigmas: f64,
    /// Expected mean foam, 0 to 1.
    pub coverage: f64,
}

impl FoamModel {
    /// Derives the threshold from the whitecap coverage of the local wind, which makes the mean foam independent of the
    /// FFT size and the level, or takes the fixed threshold of the parameters at a texel of 25 cm.
    pub fn new(plan: &Plan) -> Self {
        let foam = &plan.sea.foam;
        let sigma = strain_deviation(plan, REFERENCE_TEXEL_M);
        let coverage = monahan_coverage(plan.sea.local().wind_m_s).min(MAX_COVERAGE);
        let source = coverage / (1.0 - coverage) / (FACTOR * DEFAULT_RATE_DECAY.powf(POWER));
        if sigma < MIN_SIGMA || (foam.whitecaps == Whitecaps::Monahan && source <= 0.0) {
            return Self { sigmas: f64::INFINITY, coverage: 0.0 };
        }
        let mut sigmas = match foam.whitecaps {
            Whitecaps::Fixed => sigmas_at(foam.threshold, sigma),
            Whitecaps::Monahan => bisect(-2.0, 8.0, |z| mean_source(z) > source),
        };
        if foam.bias != 0.0 {
            sigmas = sigmas_at(jacobian(sigmas, sigma) + foam.bias, sigma);
        }
        let ratio = FACTOR * (foam.rate_per_s * foam.decay_s).powf(POWER) * mean_source(sigmas);
        Self { sigmas, coverage: ratio / (1.0 + ratio) }
    }

    /// Foam source on a grid with texels of `texel_m`, for the variance of the Jacobian that the grid resolves.
    pub fn source(&self, plan: &Plan, texel_m: f64) -> FoamSource {
        let sigma = strain_deviation(plan, texel_m);
        if sigma < MIN_SIGMA || self.sigmas.is_infinite() {
            return FoamSource { threshold: -1e3, slope: 0.0 };
        }
        let threshold = jacobian(self.sigmas, sigma);
        let slope = 1.0 / (threshold - jacobian(self.sigmas + RAMP, sigma)).max(0.05 * sigma);
        FoamSource { threshold, slope }
    }
}

/// Mean Jacobian where the strain s = lx dDx/dx + lz dDz/dz is `sigmas` standard deviations below 0: J = 1 + s +
/// determinant of the strain tensor. Given s, the determinant has the mean (s^2 - sigma^2) (1 - r2^2) / 4, where r2 is
/// the second directional moment (1 for long-crested waves, 0 for isotropic ones).
fn jacobian(sigmas: f64, sigma: f64) -> f64 {
    1.0 - sigmas * sigma + DETERMINANT * (sigmas * sigmas - 1.0) * sigma * sigma
}

/// Inverse of [`jacobian`], on the branch where a low Jacobian is rare.
fn sigmas_at(threshold: f64, sigma: f64) -> f64 {
    bisect(-8.0, (0.5 / (DETERMINANT * sigma)).min(12.0), |z| jacobian(z, sigma) > threshold)
}

/// Largest value in [low, high] for which `holds` is true; it must hold below some value and fail above.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

/// Standard deviation of the strain lx dDx/dx + lz dDz/dz on a grid with texels of `texel_m`, by the mean square chop.
fn strain_deviation(plan: &Plan, texel_m: f64) -> f64 {
    let [lx, lz] = plan.sea.lambda();
    // The foam pass reads mips that are one level finer than its cells.
    (0.5 * (lx * lx + lz * lz) * plan.strain_variance(0.5 * texel_m)).sqrt()
}

/// Mean of clamp((Z - z) / RAMP, 0, 1) for a standard normal Z.
fn mean_source(z: f64) -> f64 {
    // Mean of max(Z - z, 0).
    let excess = |z: f64| (-0.5 * z * z).exp() / (2.0 * PI).sqrt() - z * 0.5 * libm::erfc(z / 2f64.sqrt());
    (excess(z) - excess(z + RAMP)) / RAMP
}
