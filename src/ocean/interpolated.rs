//! The drawn state of a sea during a transition: interpolated appearance, and the plans of the waves that are drawn.

use crate::render::SeaAppearance;
use crate::sim::transition::{Interpolate, interpolate, interpolate_pair};
use crate::state::Params;
use crate::waves::Plan;
use std::sync::Arc;

/// Largest number of plans whose waves are drawn together during a transition; more are merged with similar ones.
const MAX_WEIGHTED_PLANS: usize = 4;

/// Whether two sets of parameters have equal refractive indices, on which [`SeaAppearance::caustic_filter_m`] depends.
pub fn has_same_refraction(a: &Params, b: &Params) -> bool {
    let indices = |p: &Params| (p.look.surface.reflection.index_air, p.look.surface.reflection.index_water);
    indices(a) == indices(b)
}

impl Interpolate for SeaAppearance {
    fn interpolate(&self, to: &Self, fraction: f64) -> Self {
        let [x, z] = interpolate_pair(self.downwind, to.downwind, fraction);
        let length = x.hypot(z);
        Self {
            choppiness: interpolate_pair(self.choppiness, to.choppiness, fraction),
            hs_m: interpolate(self.hs_m, to.hs_m, fraction),
            surf_displacement_m: interpolate(self.surf_displacement_m, to.surf_displacement_m, fraction),
            peak_wavelength_m: interpolate(self.peak_wavelength_m, to.peak_wavelength_m, fraction),
            gravity_m_s2: interpolate(self.gravity_m_s2, to.gravity_m_s2, fraction),
            // Geometric, because a bed that rises from the deep sea would otherwise appear only at the very end.
            depth_m: self.depth_m * (to.depth_m / self.depth_m).powf(fraction),
            still_water_level_m: interpolate(self.still_water_level_m, to.still_water_level_m, fraction),
            wind_m_s: interpolate(self.wind_m_s, to.wind_m_s, fraction),
            downwind: if length > 1e-3 { [x / length, z / length] } else { to.downwind },
            breaker_speed_m_s: interpolate(self.breaker_speed_m_s, to.breaker_speed_m_s, fraction),
            cloud_velocity_m_s: interpolate_pair(self.cloud_velocity_m_s, to.cloud_velocity_m_s, fraction),
            unresolved_slope_variance: interpolate_pair(
                self.unresolved_slope_variance,
                to.unresolved_slope_variance,
                fraction,
            ),
            finest_cascade_slope_variance: interpolate_pair(
                self.finest_cascade_slope_variance,
                to.finest_cascade_slope_variance,
                fraction,
            ),
            resolved_slope_variance: interpolate_pair(
                self.resolved_slope_variance,
                to.resolved_slope_variance,
                fraction,
            ),
            caustic_filter_m: interpolate(self.caustic_filter_m, to.caustic_filter_m, fraction),
        }
    }
}

/// The plans that are drawn together while a sea changes into another one with equal wave numbers and frequencies, each
/// with its weight in the drawn wave amplitudes. The weights add up to 1.
#[derive(Clone, Debug)]
pub struct WeightedPlans(pub Vec<(Arc<Plan>, f64)>);

impl WeightedPlans {
    /// The waves of one plan, with weight 1.
    pub fn new(plan: &Plan) -> Self {
        Self(vec![(Arc::new(plan.clone()), 1.0)])
    }
}

impl Interpolate for WeightedPlans {
    fn interpolate(&self, to: &Self, fraction: f64) -> Self {
        let mut plans: Vec<_> = self.0.iter().map(|(plan, weight)| (plan.clone(), weight * (1.0 - fraction))).collect();
        for (plan, weight) in &to.0 {
            match plans.iter_mut().find(|(p, _)| Arc::ptr_eq(p, plan)) {
                Some((_, sum)) => *sum += fraction * weight,
                None => plans.push((plan.clone(), fraction * weight)),
            }
        }
        // Dragging a slider adds a plan per frame. Neighbouring plans are nearly equal, so one replaces both.
        while plans.len() > MAX_WEIGHTED_PLANS {
            let least = (1..plans.len() - 1).min_by(|&a, &b| plans[a].1.total_cmp(&plans[b].1)).unwrap_or(0);
            let (_, weight) = plans.remove(least);
            plans[least].1 += weight;
        }
        Self(plans)
    }
}

/// A plan whose waves are drawn, with the factors on their amplitudes.
#[derive(Clone, Debug)]
pub struct DrawnSea {
    /// Plan of the waves, as [`crate::point::StrongestWaves`] needs it. Its foam parameters may be out of date, because
    /// a change of only the foam keeps the plan.
    pub plan: Arc<Plan>,
    /// Factor on the wave amplitudes of each cascade of the plan; 1 except during a transition.
    pub amplitude_factors: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    #[test]
    fn dragged_plans_stay_short_and_whole() {
        let plan = Plan::new(&query::parse("wind=8&n=64").0);
        let mut drawn = WeightedPlans::new(&plan);
        let mut goal = drawn.clone();
        for _ in 0..50 {
            goal = WeightedPlans::new(&plan);
            drawn = drawn.interpolate(&goal, 0.06);
            assert!(drawn.0.len() <= MAX_WEIGHTED_PLANS);
            assert!((drawn.0.iter().map(|(_, w)| w).sum::<f64>() - 1.0).abs() < 1e-9);
        }
        assert!(Arc::ptr_eq(&drawn.0[drawn.0.len() - 1].0, &goal.0[0].0), "the goal is not merged away");
    }

    #[test]
    fn appearances_lie_between() {
        let appearance = |state: &str| {
            let params = query::parse(state).0;
            SeaAppearance::new(&Plan::new(&params), &params.look)
        };
        let (a, b) = (appearance("wind=8&depth=4000&dir=0"), appearance("wind=16&depth=5&dir=90"));
        let half = a.interpolate(&b, 0.5);
        assert!(half.hs_m > a.hs_m.min(b.hs_m) && half.hs_m < a.hs_m.max(b.hs_m));
        assert!((half.depth_m - (4000.0f64 * 5.0).sqrt()).abs() < 1e-9);
        assert!((half.downwind[0].hypot(half.downwind[1]) - 1.0).abs() < 1e-12);
        assert!(a.interpolate(&appearance("dir=180"), 0.5).downwind.iter().all(|d| d.is_finite()), "opposite winds");
    }
}
