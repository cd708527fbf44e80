//! Interpolation of the bound waves of the second order between two seas.

use super::transition::{Interpolate, interpolate};
use crate::waves::second_order::{BoundWaveTotals, BoundWaves, CascadeBoundWaves, ProductFactors};

impl Interpolate for BoundWaves {
    /// Cascades are interpolated in pairs, the longest waves first. In a cross-fade, in which each cascade is drawn with
    /// its own bound waves, only the totals have a meaning.
    fn interpolate(&self, to: &Self, fraction: f64) -> Self {
        let factors = |a: ProductFactors, b: ProductFactors| ProductFactors {
            elevation: interpolate(a.elevation, b.elevation, fraction),
            displacement: interpolate(a.displacement, b.displacement, fraction),
        };
        let cascade = |(a, b): (&CascadeBoundWaves, &CascadeBoundWaves)| CascadeBoundWaves {
            own: factors(a.own, b.own),
            with_shorter: factors(a.with_shorter, b.with_shorter),
            level_m: interpolate(a.level_m, b.level_m, fraction),
        };
        Self {
            cascades: self.cascades.iter().zip(&to.cascades).map(cascade).collect(),
            totals: BoundWaveTotals {
                elevation_gain: interpolate(self.totals.elevation_gain, to.totals.elevation_gain, fraction),
                mean: factors(self.totals.mean, to.totals.mean),
            },
        }
    }
}
