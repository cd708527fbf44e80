//! How much foam a sea has: the threshold of the Jacobian from which it forms, and its mean coverage.

use super::plan::Plan;
use super::statistics::monahan_coverage;
use crate::state::params::Whitecaps;
use std::f64::consts::PI;

/// Mean foam F that a mean source m leaves: F / (1 - F) = FACTOR (growth x decay)^POWER m. Fitted to the GPU over winds of 7
/// to 30 m/s, all levels, and growth x decay of 1 to 50: foam outlives its source, but does not grow on what is white.
const FACTOR: f64 = 1.03;
const POWER: f64 = 0.73;
/// Growth times decay of the defaults, for which the whitecap coverage of the wind comes out.
const DEFAULT_LIFE: f64 = 8.0;
/// Width of the ramp from no source to full source, in standard deviations of the Jacobian.
const RAMP: f64 = 0.5;

/// More than this the whitecaps of no wind cover.
const MOST_COVERED: f64 = 0.9;
/// (1 - r2^2) / 4 for the spread of short waves.
const DETERMINANT: f64 = 0.2;
/// Texel at which a given threshold is meant, m; coarser levels are as rare.
const REFERENCE_TEXEL_M: f64 = 0.25;
/// Below this standard deviation of the Jacobian the water is flat.
const FLAT: f64 = 1e-6;

/// Where foam forms: source = clamp((threshold - J) x slope, 0, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    /// Jacobian below which foam forms.
    pub threshold: f64,
    /// Source per unit of Jacobian below it.
    pub slope: f64,
}

/// The foam of a sea: how rare the squeezed water is that it forms on, and how much comes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whiteness {
    /// Standard deviations of the strain below 0 at which foam begins; infinite where there is none.
    rarity: f64,
    /// Mean foam that is to be expected.
    pub coverage: f64,
}

impl Whiteness {
    /// By default foam is as rare as the whitecap coverage of the wind demands, so that the coverage depends neither on n
    /// nor on the level; a fixed threshold is taken at 25 cm.
    pub fn new(plan: &Plan) -> Self {
        let foam = &plan.sea.foam;
        let sigma = deviation(plan, REFERENCE_TEXEL_M);
        let covered = monahan_coverage(plan.sea.local().wind_m_s).min(MOST_COVERED);
        let wanted = covered / (1.0 - covered) / (FACTOR * DEFAULT_LIFE.powf(POWER));
        let none = Self { rarity: f64::INFINITY, coverage: 0.0 };
        if sigma < FLAT {
            return none;
        }
        let mut rarity = match foam.whitecaps {
            Whitecaps::Fixed => rarity_of(foam.threshold, sigma),
            Whitecaps::Monahan if wanted <= 0.0 => return none,
            Whitecaps::Monahan => {
                // Find the z with E[clamp((Z - z) / RAMP, 0, 1)] = wanted.
                let (mut low, mut high) = (-2.0, 8.0);
                for _ in 0..60 {
                    let z = 0.5 * (low + high);
                    if ramp_mean(z) > wanted { low = z } else { high = z }
                }
                low
            }
        };
        if foam.bias != 0.0 {
            rarity = rarity_of(jacobian(rarity, sigma) + foam.bias, sigma);
        }
        let foamy = FACTOR * (foam.rate_per_s * foam.decay_s).powf(POWER) * ramp_mean(rarity);
        Self { rarity, coverage: foamy / (1.0 + foamy) }
    }

    /// The source on a grid of `texel_m`, from the variance of the Jacobian of the waves that the cascades hold and the
    /// grid resolves.
    pub fn source(&self, plan: &Plan, texel_m: f64) -> Source {
        let sigma = deviation(plan, texel_m);
        if sigma < FLAT || self.rarity.is_infinite() {
            return Source { threshold: -1e3, slope: 0.0 };
        }
        let threshold = jacobian(self.rarity, sigma);
        Source { threshold, slope: 1.0 / (threshold - jacobian(self.rarity + RAMP, sigma)).max(0.05 * sigma) }
    }
}

/// The Jacobian where the strain dDx/dx + dDz/dz is `rarity` standard deviations below 0. It is 1 + strain + determinant;
/// given the strain s, the determinant's mean is (s^2 - sigma^2) (1 - r2^2) / 4 with r2 the second directional moment (0 for
/// long-crested waves, 1/4 for isotropic ones).
fn jacobian(rarity: f64, sigma: f64) -> f64 {
    1.0 - rarity * sigma + DETERMINANT * (rarity * rarity - 1.0) * sigma * sigma
}

/// Its inverse, on the branch where squeezed water is rare.
fn rarity_of(threshold: f64, sigma: f64) -> f64 {
    let (mut low, mut high) = (-8.0f64, (0.5 / (DETERMINANT * sigma)).min(12.0));
    for _ in 0..60 {
        let z = 0.5 * (low + high);
        if jacobian(z, sigma) > threshold { low = z } else { high = z }
    }
    low
}

/// Standard deviation of the strain on a grid of `texel_m`; strain along x and z counts with the chop there.
fn deviation(plan: &Plan, texel_m: f64) -> f64 {
    let [lx, lz] = plan.sea.lambda();
    // The pass reads the mips one level finer than its cells.
    (0.5 * (lx * lx + lz * lz) * plan.strain_variance(0.5 * texel_m)).sqrt()
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
