//! Quantities that follow from the parameters, computed when the parameters change instead of in every frame.

use super::plots::polar::Wheel;
use crate::point::Heights;
use crate::point::floating::HullWaves;
use crate::state::Params;
use crate::waves::Plan;
use crate::waves::statistics::{Resolved, Theory};
use std::cell::OnceCell;

/// Plan and statistics of one sea; the expensive ones are computed at their first use.
pub struct Derived {
    /// Parameters that the other fields were computed from.
    pub of: Params,
    /// Plan of the sea on the requested grid.
    pub plan: Plan,
    /// Statistics of the continuous spectrum.
    pub theory: Theory,
    /// Statistics of the waves on the grid, sums over all wave numbers.
    resolved: OnceCell<Resolved>,
    /// Waves that give the height of the sea at a point.
    waterline: OnceCell<HullWaves>,
    /// Directional spectrum as the plot shows it.
    wheel: OnceCell<Wheel>,
}

impl Derived {
    /// Computes plan and theory.
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

    /// Statistics of the waves on the grid.
    pub fn resolved(&self) -> &Resolved {
        self.resolved.get_or_init(|| Resolved::new(&self.plan, self.theory.m0_m2))
    }

    /// Heights of the sea at points.
    pub fn heights(&self) -> &Heights {
        self.waterline.get_or_init(|| HullWaves::new(&self.plan)).heights()
    }

    /// Directional spectrum for its plot.
    pub fn wheel(&self) -> &Wheel {
        self.wheel.get_or_init(|| Wheel::new(&self.plan))
    }
}
