//! Foam model: the Jacobian below which foam forms, and the mean foam that results.
//!
//! Waves break where the horizontal displacement squeezes the surface, so foam forms where the Jacobian J of the
//! displacement falls below a threshold. By default the threshold makes the mean foam equal the whitecap coverage of
//! the wind, W = 3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980).

use super::plan::Plan;
use super::statistics::monahan_coverage;
use crate::state::params::WhitecapRule;
use std::f64::consts::{PI, TAU};

/// Number of foam levels, square foam grids around the camera. Each is four times as wide as the next finer one.
pub const FOAM_LEVEL_COUNT: usize = 4;

/// Growth rate of a breaker's front, the thick foam where it breaks now, relative to that of all foam.
pub const FRONT_GROWTH_RATIO: f64 = 4.0;
/// Decay time of a breaker's front relative to that of all foam. Active whitecaps (stage A) last about a second, the
/// foam that they leave (stage B) several (Monahan and Lu 1990; Callaghan and others 2012).
pub const FRONT_DECAY_RATIO: f64 = 0.25;
/// Decay time of the plume of bubbles below foam, relative to that of the foam: bubbles rise for longer than the film
/// on the surface lasts (Callaghan and others 2012).
pub const PLUME_DECAY_RATIO: f64 = 1.5;
/// Mean of the fronts relative to that of all foam, measured in winds of 8 to 26 m/s: a cold start begins there.
pub const MEAN_FRONT_RATIO: f64 = 0.6;
/// Mean of the plumes relative to that of all foam, as [`MEAN_FRONT_RATIO`].
pub const MEAN_PLUME_RATIO: f64 = 1.4;

/// Factor of the fit F / (1 - F) = factor x (growth rate x decay time)^exponent x s, where F is the mean foam and s the
/// mean foam source, both 0 to 1. The fit was made to GPU results for winds of 7 to 30 m/s, all foam levels, and growth
/// rate x decay time from 1 to 50.
const MEAN_FOAM_FIT_FACTOR: f64 = 1.03;
/// Exponent of growth rate x decay time in the fit of [`MEAN_FOAM_FIT_FACTOR`].
const MEAN_FOAM_FIT_EXPONENT: f64 = 0.73;
/// Product of the default growth rate (1/s) and decay time (s) of foam, for which the default foam threshold makes the
/// mean foam equal the whitecap coverage of the wind.
const DEFAULT_GROWTH_RATE_TIMES_DECAY_TIME: f64 = 8.0;
/// Decrease of the strain of the horizontal displacement, in standard deviations of this strain, over which the foam
/// source rises from 0 (no foam forms) to 1.
const FOAM_SOURCE_RAMP_STRAIN_SIGMAS: f64 = 0.5;

/// Size of the texels on which the Jacobian of breakers is read, relative to the wavelength of the peak. Short waves
/// break without air, as microbreakers (Sutherland and Melville 2013). The shortest waves that count also set the speed
/// of the fronts, which travel at a quarter to a third of the phase speed of the peak.
const BREAKER_TEXEL_PER_PEAK_WAVELENGTH: f64 = 0.035;
/// Limits of these sizes, m.
const BREAKER_TEXEL_RANGE_M: [f64; 2] = [0.25, 8.0];

/// Upper limit of the whitecap coverage from which the foam threshold is derived, as a fraction of the surface.
const MAX_COVERAGE: f64 = 0.9;
/// Coefficient (1 - r2^2) / 4 in [`mean_jacobian_at_compression_sigmas`], where r2, about 0.45, is the second
/// directional moment of short waves.
const STRAIN_DETERMINANT_COEFFICIENT: f64 = 0.2;
/// Texel size, m, of the foam grid for which the threshold of `whitecaps=fixed` holds; it is converted for other grids.
const REFERENCE_TEXEL_M: f64 = 0.25;
/// Least standard deviation of the strain on a foam grid, relative to that on the texels of breakers, with which the
/// grid shows where waves break. On coarser grids hardly a wave is left: rounding and the seams between copies of a
/// patch would make most of the remaining strain, and foam everywhere.
const MIN_RESOLVED_STRAIN: f64 = 0.25;
/// Standard deviation (dimensionless) of the horizontal strain below which the water counts as flat and gets no foam.
const MIN_STRAIN_DEVIATION: f64 = 1e-6;

/// Foam source, 0 (no foam forms) to 1, as a function of the Jacobian J of the displacement: the larger of `even` and
/// clamp((threshold - J) x slope, 0, 1). The foam pass multiplies it by the user's growth rate (1/s).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FoamSource {
    /// Jacobian of the displacement below which foam forms.
    pub jacobian_threshold: f64,
    /// Increase of the foam source for each decrease of the Jacobian by 1 below the threshold.
    pub source_slope: f64,
    /// Foam source everywhere, of a grid too coarse for the waves that break: it keeps the sea's mean foam. Else 0.
    pub even: f64,
}

impl FoamSource {
    /// Source of water without foam.
    const NONE: Self = Self { jacobian_threshold: -1e3, source_slope: 0.0, even: 0.0 };

    /// Foam source, 0 to 1, where the displacement has the Jacobian `jacobian`.
    pub fn at(&self, jacobian: f64) -> f64 {
        ((self.jacobian_threshold - jacobian) * self.source_slope).clamp(0.0, 1.0).max(self.even)
    }
}

/// Foam model of a sea: the Jacobian of the displacement below which foam forms, and the mean foam that this gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamModel {
    /// Compression (negative strain of the horizontal displacement) at which foam starts to form, in standard
    /// deviations of the strain; infinite if there is no foam.
    threshold_sigmas: f64,
    /// Expected fraction of the sea surface that foam covers, 0 to 1: the mean of the foam amount over the surface.
    pub expected_mean_foam: f64,
}

impl FoamModel {
    /// Derives the foam threshold of a sea so that its mean foam is the whitecap coverage expected for the wind, with
    /// every FFT size and foam grid. With `whitecaps=fixed` the threshold is the user's, for texels of 25 cm.
    pub fn new(plan: &Plan) -> Self {
        let foam = &plan.sea.foam;
        let sigma = strain_deviation(plan, REFERENCE_TEXEL_M);
        let expected_mean_foam = monahan_coverage(plan.sea.first_system().wind_m_s).min(MAX_COVERAGE);
        let source = expected_mean_foam
            / (1.0 - expected_mean_foam)
            / (MEAN_FOAM_FIT_FACTOR * DEFAULT_GROWTH_RATE_TIMES_DECAY_TIME.powf(MEAN_FOAM_FIT_EXPONENT));
        if sigma < MIN_STRAIN_DEVIATION || (foam.whitecaps == WhitecapRule::Monahan && source <= 0.0) {
            return Self { threshold_sigmas: f64::INFINITY, expected_mean_foam: 0.0 };
        }
        let mut threshold_sigmas = match foam.whitecaps {
            WhitecapRule::Fixed => compression_sigmas_at_jacobian(foam.threshold, sigma),
            WhitecapRule::Monahan => bisect(-2.0, 8.0, |z| mean_foam_source(z) > source),
        };
        if foam.bias != 0.0 {
            threshold_sigmas = compression_sigmas_at_jacobian(
                mean_jacobian_at_compression_sigmas(threshold_sigmas, sigma) + foam.bias,
                sigma,
            );
        }
        let ratio = MEAN_FOAM_FIT_FACTOR
            * (foam.rate_per_s * foam.decay_s).powf(MEAN_FOAM_FIT_EXPONENT)
            * mean_foam_source(threshold_sigmas);
        Self { threshold_sigmas, expected_mean_foam: ratio / (1.0 + ratio) }
    }

    /// Foam source on a foam grid with texels of `texel_m` (m), at least those of [`breaker_texel_m`]. A coarser grid
    /// resolves less variance of the Jacobian, so its threshold is nearer to 1. A grid that is too coarse for the waves
    /// that break has the mean foam of the sea in all cells.
    pub fn foam_source_for_texel(&self, plan: &Plan, texel_m: f64) -> FoamSource {
        let breaker_m = breaker_texel_m(plan);
        let breaker_sigma = strain_deviation(plan, breaker_m);
        let sigma = if texel_m > breaker_m { strain_deviation(plan, texel_m) } else { breaker_sigma };
        if self.threshold_sigmas.is_infinite() {
            return FoamSource::NONE;
        }
        if sigma < MIN_STRAIN_DEVIATION || sigma < MIN_RESOLVED_STRAIN * breaker_sigma {
            let mean = self.expected_mean_foam.min(MAX_COVERAGE);
            let gain = plan.sea.foam.rate_per_s * plan.sea.foam.decay_s;
            let even = if gain > 0.0 { (mean / (1.0 - mean) / gain).min(1.0) } else { 0.0 };
            return FoamSource { even, ..FoamSource::NONE };
        }
        let threshold = mean_jacobian_at_compression_sigmas(self.threshold_sigmas, sigma);
        let slope = 1.0
            / (threshold
                - mean_jacobian_at_compression_sigmas(self.threshold_sigmas + FOAM_SOURCE_RAMP_STRAIN_SIGMAS, sigma))
            .max(0.05 * sigma);
        FoamSource { jacobian_threshold: threshold, source_slope: slope, even: 0.0 }
    }
}

/// Side of the smallest texels, m, on which the Jacobian of breakers is read. Finer foam grids hold foam more finely, but
/// their waves break no finer.
pub fn breaker_texel_m(plan: &Plan) -> f64 {
    let [least, most] = BREAKER_TEXEL_RANGE_M;
    let peak_wavelength_m = TAU / plan.dispersion.wave_number(plan.omega_p).max(1e-6);
    (BREAKER_TEXEL_PER_PEAK_WAVELENGTH * peak_wavelength_m).clamp(least, most)
}

/// Mean Jacobian J of the horizontal displacement at points with the strain s = -`threshold_sigmas` x `sigma`, where s
/// is lx dDx/dx + lz dDz/dz with the chop factors lx, lz, and `sigma` is its standard deviation. It converts between a
/// foam threshold in standard deviations of s and one in J.
///
/// J is 1 + s + the determinant of the strain tensor. For a given s the mean of the determinant is
/// (s^2 - sigma^2) (1 - r2^2) / 4 with the second directional moment r2 (1 for long-crested, 0 for isotropic waves).
fn mean_jacobian_at_compression_sigmas(threshold_sigmas: f64, sigma: f64) -> f64 {
    1.0 - threshold_sigmas * sigma
        + STRAIN_DETERMINANT_COEFFICIENT * (threshold_sigmas * threshold_sigmas - 1.0) * sigma * sigma
}

/// Inverse of [`mean_jacobian_at_compression_sigmas`]: compression (negative strain) at which the mean Jacobian equals
/// `threshold`, as a multiple of the standard deviation `sigma` of the strain. Of the two solutions it returns the
/// smaller one.
fn compression_sigmas_at_jacobian(threshold: f64, sigma: f64) -> f64 {
    bisect(-8.0, (0.5 / (STRAIN_DETERMINANT_COEFFICIENT * sigma)).min(12.0), |z| {
        mean_jacobian_at_compression_sigmas(z, sigma) > threshold
    })
}

/// Finds by bisection the value in [low, high] up to which the condition `holds` is true and above which it is false.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

/// Standard deviation of the strain lx dDx/dx + lz dDz/dz of the horizontal displacement on a foam grid with texels of
/// `texel_m` (m), where both chop factors lx and lz are replaced by their rms value.
fn strain_deviation(plan: &Plan, texel_m: f64) -> f64 {
    let [lx, lz] = plan.sea.choppiness_xz();
    // The foam pass reads a mip level of the maps with half the texel size of the foam grid.
    (0.5 * (lx * lx + lz * lz) * plan.strain_variance(0.5 * texel_m)).sqrt()
}

/// Mean foam source (0 to 1) of a sea with Gaussian strain, if foam starts at a compression of `z` standard deviations:
/// the mean of clamp((Z - z) / SOURCE_RAMP_SIGMAS, 0, 1) for a standard normal Z.
fn mean_foam_source(z: f64) -> f64 {
    // Mean of max(Z - z, 0).
    let excess = |z: f64| (-0.5 * z * z).exp() / (2.0 * PI).sqrt() - z * 0.5 * libm::erfc(z / 2f64.sqrt());
    (excess(z) - excess(z + FOAM_SOURCE_RAMP_STRAIN_SIGMAS)) / FOAM_SOURCE_RAMP_STRAIN_SIGMAS
}
