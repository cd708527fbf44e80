//! Covariance of the old and the new sea in a cross-fade. Waves with equal random numbers are correlated.

use super::plan::{Cascade, Plan};
use std::f64::consts::TAU;

/// Number of logarithmic wave-number intervals over which the covariance of two cascades is summed.
const WAVE_NUMBER_BANDS: usize = 256;

/// Elevation variances (m^2) of the old and the new sea of a cross-fade in one cascade, and their covariance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeaCovariance {
    before: f64,
    after: f64,
    /// Covariance of the two seas, m^2, at least 0. Only waves with equal wave vectors and random numbers contribute,
    /// each in proportion to the cosine of its phase difference.
    covariance: f64,
}

impl SeaCovariance {
    /// Variances and covariance of the seas `before` and `after` at time `t_s` (s): first in the result for each
    /// cascade of `before`, second for each cascade of `after`. All are zero for a cascade if the other sea has none
    /// with the same patch size, random-number key and seed.
    pub fn for_all_cascades(before: &Plan, after: &Plan, t_s: f64) -> [Vec<Self>; 2] {
        let mut all = [before, after].map(|plan| vec![Self::default(); plan.cascades.len()]);
        for (i, old) in before.cascades.iter().enumerate() {
            let same = |c: &Cascade| {
                (c.patch_m, c.noise_key) == (old.patch_m, old.noise_key) && before.sea.seed == after.sea.seed
            };
            if let Some(j) = after.cascades.iter().position(same) {
                let covariance = Self::between((before, old), (after, &after.cascades[j]), t_s);
                (all[0][i], all[1][j]) = (covariance, covariance);
            }
        }
        all
    }

    fn between((before, old): (&Plan, &Cascade), (after, new): (&Plan, &Cascade), t_s: f64) -> Self {
        let variance = |plan: &Plan, c: &Cascade| plan.spectrum_integrals.m0_between_wave_numbers(c.k_low, c.k_high);
        let (low, high) = (old.k_low.max(new.k_low).max(old.dk()), old.k_high.min(new.k_high));
        let mut covariance = 0.0;
        if low < high {
            let edge = |i: usize| low * (high / low).powf(i as f64 / WAVE_NUMBER_BANDS as f64);
            for i in 0..WAVE_NUMBER_BANDS {
                let (a, b) = (edge(i), edge(i + 1));
                let ring = ((a * b).sqrt() / old.dk()).powi(2).round().max(1.0) as u32;
                // The drawn waves have frequencies that are rounded to the period of the sea.
                let cycles = |plan: &Plan, c: &Cascade| plan.wave_at_squared_index(c, ring).omega * t_s / TAU;
                let apart = TAU * (cycles(before, old) - cycles(after, new)).rem_euclid(1.0);
                let variances = before.spectrum_integrals.m0_between_wave_numbers(a, b)
                    * after.spectrum_integrals.m0_between_wave_numbers(a, b);
                covariance += variances.sqrt() * apart.cos();
            }
        }
        // With a negative covariance, normalising the variance of the sum would amplify both seas.
        Self { before: variance(before, old), after: variance(after, new), covariance: covariance.max(0.0) }
    }

    /// Ratio of the variance of the blended sea sqrt(1 - progress) x before + sqrt(progress) x after to the intended
    /// variance (1 - progress) x Var(before) + progress x Var(after). `progress` is the progress of the cross-fade, 0
    /// to 1. The ratio is 1 for uncorrelated seas and 2 halfway between two equal seas.
    pub fn blended_variance_ratio(&self, progress: f64) -> f64 {
        let mean = (1.0 - progress) * self.before + progress * self.after;
        if mean > 0.0 { 1.0 + 2.0 * (progress * (1.0 - progress)).sqrt() * self.covariance / mean } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    fn overlap(before: &str, after: &str, cascade: usize, t_s: f64) -> SeaCovariance {
        let [before, after] = [before, after].map(|s| Plan::new(&query::parse(s).0));
        SeaCovariance::for_all_cascades(&before, &after, t_s)[0][cascade]
    }

    #[test]
    fn a_sea_has_everything_in_common_with_itself() {
        for progress in [0.1, 0.5, 0.8] {
            let variance_gain = overlap("wind=9&n=64", "wind=9&n=64", 0, 1e6).blended_variance_ratio(progress);
            assert!((variance_gain - 1.0 - 2.0 * (progress * (1.0 - progress)).sqrt()).abs() < 1e-3, "{variance_gain}");
        }
        assert_eq!(overlap("wind=9&n=64", "wind=9&n=64&seed=2", 0, 5.0).blended_variance_ratio(0.5), 1.0);
        assert_eq!(
            overlap("wind=9&n=64", "wind=30&n=64", 0, 5.0).blended_variance_ratio(0.5),
            1.0,
            "no patch in common"
        );
        assert_eq!(overlap("wind=0&n=64", "wind=0&n=64", 0, 5.0).blended_variance_ratio(0.5), 1.0);
    }

    #[test]
    fn depth_parts_long_waves_and_late() {
        // The patch sizes are set by the state string, so that both seas have the same patches.
        let state = |depth: f64| format!("wind=9&n=64&cascades=2&patch1=300&patch2=40&depth={depth}");
        let variance_gain =
            |cascade, t_s| overlap(&state(200.0), &state(8.0), cascade, t_s).blended_variance_ratio(0.5);
        assert!(
            variance_gain(0, 0.0) > 1.5 && variance_gain(1, 0.0) > 1.95,
            "nothing has moved yet: {}",
            variance_gain(0, 0.0)
        );
        assert!(variance_gain(0, 1000.0) < 1.2, "{}", variance_gain(0, 1000.0));
        assert!(variance_gain(1, 20.0) > variance_gain(0, 20.0), "short waves do not feel the bed");
    }
}
