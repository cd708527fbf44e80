//! Quantities derived from the parameters. They are computed when the parameters change, not in every frame.

use super::plots::polar::Wheel;
use crate::point::Heights;
use crate::point::floating::HullWaves;
use crate::state::Params;
use crate::waves::statistics::{Resolved, Theory};
use crate::waves::{Plan, SeaChange};
use std::cell::OnceCell;

/// Plan, statistics and plot data of one sea. The expensive ones are computed at their first use.
pub struct Derived {
    /// Parameters from which the other fields were computed.
    pub of: Params,
    /// Plan for the FFT size that the user requested; adaptive quality may draw the sea with a smaller one.
    pub plan: Plan,
    /// Statistics by theory, from integrals of the continuous spectrum.
    pub theory: Theory,
    /// Statistics of the waves on the FFT grids, as sums over all wave numbers.
    resolved: OnceCell<Resolved>,
    /// The waves that are summed on the CPU for the height of the sea at a point.
    waterline: OnceCell<HullWaves>,
    /// Directional spectrum, sampled for the polar plot.
    wheel: OnceCell<Wheel>,
}

impl Derived {
    /// Computes the plan and the statistics of its spectrum.
    pub fn new(params: &Params) -> Self {
        let plan = Plan::new(params);
        let theory = Theory::new(&plan);
        Self {
            of: params.clone(),
            plan,
            theory,
            resolved: OnceCell::new(),
            waterline: OnceCell::new(),
            wheel: OnceCell::new(),
        }
    }

    /// Updates the derived quantities to new parameters, and recomputes only those that depend on the change. Returns
    /// the kind of the change; `None` if the sea is the same.
    pub fn follow(&mut self, params: &Params) -> Option<SeaChange> {
        let change = SeaChange::between(&self.of, params);
        match change {
            None => return None,
            Some(SeaChange::Waves) => *self = Self::new(params),
            Some(SeaChange::Surface) => {
                self.plan = self.plan.with_surface(&params.sea);
                self.waterline = OnceCell::new();
            }
            Some(SeaChange::Foam) => self.plan = self.plan.with_surface(&params.sea),
        }
        self.of = params.clone();
        change
    }

    /// Statistics of the waves on the FFT grids.
    pub fn resolved(&self) -> &Resolved {
        self.resolved.get_or_init(|| Resolved::new(&self.plan, self.theory.m0_m2))
    }

    /// The sum of waves that gives the height of the sea at any point, on the CPU.
    pub fn heights(&self) -> &Heights {
        self.waterline.get_or_init(|| HullWaves::new(&self.plan)).heights()
    }

    /// Directional spectrum, sampled for the polar plot.
    pub fn wheel(&self) -> &Wheel {
        self.wheel.get_or_init(|| Wheel::new(&self.plan))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn foam_leaves_theory_and_heights_as_they_are() {
        let mut params = Params::default();
        params.grid.n = 64;
        let mut derived = Derived::new(&params);
        let first = derived.plan.clone();
        derived.heights();
        params.sea.foam.decay_s = 9.0;
        assert_eq!(derived.follow(&params), Some(SeaChange::Foam));
        assert_eq!(derived.follow(&params), None);
        assert!(Arc::ptr_eq(&derived.plan.energy, &first.energy) && derived.waterline.get().is_some());
        assert_eq!(derived.plan, Plan::new(&params));
        params.sea.chop = 0.5;
        assert_eq!(derived.follow(&params), Some(SeaChange::Surface));
        assert!(Arc::ptr_eq(&derived.plan.energy, &first.energy) && derived.waterline.get().is_none());
        assert_eq!(derived.plan, Plan::new(&params));
        params.sea.depth_m = 10.0;
        assert_eq!(derived.follow(&params), Some(SeaChange::Waves));
        assert!(!Arc::ptr_eq(&derived.plan.energy, &first.energy));
    }
}
