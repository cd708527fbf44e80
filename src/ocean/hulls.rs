//! The floating objects of an ocean.

use super::{DrawnSea, Ocean};
use crate::coast::Transfer;
use crate::point::floating::{HullPose, HullWaves, hull_pose};
use crate::waves::Plan;
use std::sync::Arc;

/// The waves of a drawn plan that move the floating objects.
pub(super) struct DrawnHullWaves {
    plan: Arc<Plan>,
    /// Transfer functions of the coast at which these waves are.
    transfer: Option<Arc<Transfer>>,
    waves: HullWaves,
}

impl Ocean {
    /// Positions and orientations of the floating objects at the time of the parameters, in the order in which the
    /// parameters list them; empty until a frame with them has been recorded.
    pub fn hull_poses(&self) -> Vec<HullPose> {
        let (seas, level_m) = (self.drawn_seas(), self.still_water_level_m());
        let on =
            |sea: &DrawnSea| self.hull_waves.iter().find(|of| Arc::ptr_eq(&of.plan, &sea.plan)).map(|of| &of.waves);
        let lines: Option<Vec<_>> = seas.iter().map(|sea| Some((on(sea)?, sea.amplitude_factors[0]))).collect();
        let Some(lines) = lines else { return Vec::new() };
        self.params.floating_objects.iter().map(|f| hull_pose(&lines, f, self.params.clock.t_s, level_m)).collect()
    }

    /// Updates the waves that move the floating objects, for the plans and the coast drawn now; none without objects.
    pub(super) fn select_hull_waves(&mut self) {
        if self.params.floating_objects.is_empty() {
            self.hull_waves.clear();
            return;
        }
        let seas = self.drawn_seas();
        let transfer = self.transfer().cloned();
        let is_present = |of: &DrawnHullWaves| {
            let has_coast = of.transfer.as_ref().map(Arc::as_ptr) == transfer.as_ref().map(Arc::as_ptr);
            has_coast && seas.iter().any(|sea| Arc::ptr_eq(&of.plan, &sea.plan))
        };
        self.hull_waves.retain(is_present);
        for DrawnSea { plan, .. } in seas {
            if !self.hull_waves.iter().any(|of| Arc::ptr_eq(&of.plan, &plan)) {
                let mut waves = HullWaves::new(&plan);
                if let Some(transfer) = &transfer {
                    waves = waves.with_coast(&plan, transfer);
                }
                self.hull_waves.push(DrawnHullWaves { plan, transfer: transfer.clone(), waves });
            }
        }
    }
}
