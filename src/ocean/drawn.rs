//! What is drawn of a sea that may be on its way to another: the numbers that the picture takes from a plan, and the seas
//! that the waves are those of.

use crate::sim::glide::{Mix, mix, mix2};
use crate::state::Params;
use crate::state::look::Look;
use crate::waves::Plan;
use crate::waves::slopes::{self, SlopeVariance};
use std::sync::Arc;

/// Speed of low clouds over the wind 10 m above the sea: the logarithmic profile up to the top of the boundary layer.
const CLOUDS_OVER_WIND: f64 = 1.4;
/// Most seas that a glide of amplitudes is told as.
const MOST_SEAS: usize = 4;

/// What the picture takes from a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    pub chop: [f64; 2],
    pub hs_m: f64,
    pub depth_m: f64,
    /// Of the still water over the origin.
    pub level_m: f64,
    pub wind_m_s: f64,
    pub downwind: [f64; 2],
    pub clouds_m_s: [f64; 2],
    /// Slopes along and across the wind of what no cascade holds, and of what the finest one holds.
    pub residual: SlopeVariance,
    pub finest: SlopeVariance,
    pub focusing_m: f64,
    pub lambda_p_m: f64,
}

impl Numbers {
    /// Those of a plan for a look.
    pub fn new(plan: &Plan, look: &Look) -> Self {
        let finest = plan.cascades.last().map_or([0.0; 2], |c| slopes::between(plan, c.k_low, c.k_high));
        let wind_m_s = plan.sea.local().wind_m_s;
        Self {
            chop: plan.sea.lambda(),
            hs_m: plan.hs_m(),
            depth_m: plan.sea.depth_m,
            level_m: plan.sea.level_m,
            wind_m_s,
            downwind: plan.downwind,
            clouds_m_s: plan.downwind.map(|w| w * CLOUDS_OVER_WIND * wind_m_s),
            residual: slopes::residual(plan, slopes::resolved(plan)),
            finest,
            focusing_m: focusing_m(plan, look),
            lambda_p_m: std::f64::consts::TAU / plan.dispersion.wave_number(plan.omega_p),
        }
    }
}

/// Waves shorter than this focus no light on the bed, m.
pub fn focusing_m(plan: &Plan, look: &Look) -> f64 {
    let reflection = &look.surface.reflection;
    let reach_m = plan.sea.depth_m * (1.0 - reflection.index_air / reflection.index_water);
    slopes::focusing_m(plan, reach_m.max(0.0))
}

/// Whether two states differ in what [`focusing_m`] takes from the look.
pub fn refracts_alike(a: &Params, b: &Params) -> bool {
    let indices = |p: &Params| (p.look.surface.reflection.index_air, p.look.surface.reflection.index_water);
    indices(a) == indices(b)
}

impl Mix for Numbers {
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
            lambda_p_m: mix(self.lambda_p_m, to.lambda_p_m, share),
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
    fn numbers_lie_between() {
        let numbers = |state: &str| {
            let params = query::parse(state).0;
            Numbers::new(&Plan::new(&params), &params.look)
        };
        let (a, b) = (numbers("wind=8&depth=4000&dir=0"), numbers("wind=16&depth=5&dir=90"));
        let half = a.mix(&b, 0.5);
        assert!(half.hs_m > a.hs_m.min(b.hs_m) && half.hs_m < a.hs_m.max(b.hs_m));
        assert!((half.depth_m - (4000.0f64 * 5.0).sqrt()).abs() < 1e-9);
        assert!((half.downwind[0].hypot(half.downwind[1]) - 1.0).abs() < 1e-12);
        assert!(a.mix(&numbers("dir=180"), 0.5).downwind.iter().all(|d| d.is_finite()), "opposite winds");
    }
}
