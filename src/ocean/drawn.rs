//! What is drawn of a sea that may be on its way to another: its appearance, and the seas that the waves are those of.

use crate::render::SeaAppearance;
use crate::sim::glide::{Mix, mix, mix2};
use crate::state::Params;
use crate::waves::Plan;
use std::sync::Arc;

/// Most seas that a glide of amplitudes is told as.
const MOST_SEAS: usize = 4;

/// Whether two states have the refractive indices in common on which [`SeaAppearance::focusing_m`] depends.
pub fn refracts_alike(a: &Params, b: &Params) -> bool {
    let indices = |p: &Params| (p.look.surface.mirror.index_air, p.look.surface.mirror.index_water);
    indices(a) == indices(b)
}

impl Mix for SeaAppearance {
    fn mix(&self, to: &Self, share: f64) -> Self {
        let [x, z] = mix2(self.downwind, to.downwind, share);
        let length = x.hypot(z);
        Self {
            chop: mix2(self.chop, to.chop, share),
            hs_m: mix(self.hs_m, to.hs_m, share),
            // By ratios: from the deep sea to a beach the bed should not come in the last moment.
            depth_m: self.depth_m * (to.depth_m / self.depth_m).powf(share),
            level_m: mix(self.level_m, to.level_m, share),
            wind_m_s: mix(self.wind_m_s, to.wind_m_s, share),
            downwind: if length > 1e-3 { [x / length, z / length] } else { to.downwind },
            clouds_m_s: mix2(self.clouds_m_s, to.clouds_m_s, share),
            residual: mix2(self.residual, to.residual, share),
            finest: mix2(self.finest, to.finest, share),
            focusing_m: mix(self.focusing_m, to.focusing_m, share),
        }
    }
}

/// Seas of the same waves, and what each gives to their amplitudes.
#[derive(Clone, Debug)]
pub struct Mixture(pub Vec<(Arc<Plan>, f64)>);

impl Mixture {
    /// One sea alone.
    pub fn new(plan: &Plan) -> Self {
        Self(vec![(Arc::new(plan.clone()), 1.0)])
    }
}

impl Mix for Mixture {
    fn mix(&self, to: &Self, share: f64) -> Self {
        let mut seas: Vec<_> = self.0.iter().map(|(plan, weight)| (plan.clone(), weight * (1.0 - share))).collect();
        for (plan, weight) in &to.0 {
            match seas.iter_mut().find(|(p, _)| Arc::ptr_eq(p, plan)) {
                Some((_, sum)) => *sum += share * weight,
                None => seas.push((plan.clone(), share * weight)),
            }
        }
        // A slider that is dragged leaves a sea a frame behind: neighbours are nearly the same.
        while seas.len() > MOST_SEAS {
            let least = (1..seas.len() - 1).min_by(|&a, &b| seas[a].1.total_cmp(&seas[b].1)).unwrap_or(0);
            let (_, weight) = seas.remove(least);
            seas[least].1 += weight;
        }
        Self(seas)
    }
}

/// A sea that is drawn.
#[derive(Clone, Debug)]
pub struct DrawnSea {
    /// Its plan, for [`crate::point::Heights`].
    pub plan: Arc<Plan>,
    /// Amplitude of each of its cascades; 1 for a sea at rest.
    pub weights: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    #[test]
    fn a_dragged_mixture_stays_short_and_whole() {
        let plan = Plan::new(&query::parse("wind=8&n=64").0);
        let mut drawn = Mixture::new(&plan);
        let mut goal = drawn.clone();
        for _ in 0..50 {
            goal = Mixture::new(&plan);
            drawn = drawn.mix(&goal, 0.06);
            assert!(drawn.0.len() <= MOST_SEAS);
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
        let half = a.mix(&b, 0.5);
        assert!(half.hs_m > a.hs_m.min(b.hs_m) && half.hs_m < a.hs_m.max(b.hs_m));
        assert!((half.depth_m - (4000.0f64 * 5.0).sqrt()).abs() < 1e-9);
        assert!((half.downwind[0].hypot(half.downwind[1]) - 1.0).abs() < 1e-12);
        assert!(a.mix(&appearance("dir=180"), 0.5).downwind.iter().all(|d| d.is_finite()), "opposite winds");
    }
}
