//! How much foam a sea has: the threshold of the Jacobian from which it forms, and its mean coverage.

use super::plan::Plan;
use super::statistics::monahan_coverage;
use std::f64::consts::PI;

/// Mean foam over the mean source that the Gaussian estimate promises, with the default growth and decay; fitted to the
/// GPU over winds of 7 to 20 m/s and all levels. It holds two effects: foam outlives its source, and the Jacobian is
/// skewed (its determinant term lifts the low tail).
const GAIN: f64 = 2.8;
/// Width of the ramp from no source to full source, in standard deviations of the Jacobian.
const RAMP: f64 = 0.5;

/// Where foam forms: source = clamp((threshold - J) x slope, 0, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    /// Jacobian below which foam forms.
    pub threshold: f64,
    /// Source per unit of Jacobian below it.
    pub slope: f64,
}

/// Mean foam that the defaults aim at: the whitecap coverage of the wind (Monahan and O'Muircheartaigh 1980).
pub fn coverage(plan: &Plan) -> f64 {
    if plan.spectrum.is_calm() { 0.0 } else { monahan_coverage(plan.sea.wind_m_s) }
}

/// The source on a grid of `texel_m`. The threshold follows from the variance of the Jacobian of the waves that the
/// cascades hold and the grid resolves, so that the coverage depends neither on n nor on the level.
pub fn source(plan: &Plan, texel_m: f64) -> Source {
    let sigma = plan.sea.chop * plan.strain_variance(texel_m).sqrt();
    let wanted = coverage(plan) / GAIN;
    if sigma < 1e-6 || wanted <= 0.0 {
        return Source { threshold: -1e3, slope: 0.0 };
    }
    // J is nearly Gaussian around 1: find the z with E[clamp((Z - z) / RAMP, 0, 1)] = wanted.
    let (mut low, mut high) = (-2.0, 8.0);
    for _ in 0..60 {
        let z = 0.5 * (low + high);
        if ramp_mean(z) > wanted { low = z } else { high = z }
    }
    Source { threshold: 1.0 - low * sigma, slope: 1.0 / (RAMP * sigma) }
}

/// Mean of clamp((Z - z) / RAMP, 0, 1) for a standard normal Z.
fn ramp_mean(z: f64) -> f64 {
    let excess = |z: f64| (-0.5 * z * z).exp() / (2.0 * PI).sqrt() - z * upper_tail(z);
    (excess(z) - excess(z + RAMP)) / RAMP
}

/// P(Z > z) of a standard normal Z.
fn upper_tail(z: f64) -> f64 {
    0.5 * libm::erfc(z / 2f64.sqrt())
}
