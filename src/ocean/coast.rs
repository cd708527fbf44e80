//! The coast up to which a sea runs.

use super::Ocean;
use crate::coast::Transfer;
use std::sync::Arc;

impl Ocean {
    /// Lets the sea run up to the coast with these transfer functions, or with None be the open sea, from the next recorded
    /// frame on. Returns false if the transfer functions belong to waves of another sea than the present one: the sea is
    /// then open. When the waves change so much that the transfer functions no longer belong to them, the sea opens by
    /// itself, and [`Self::transfer`] is None until new ones are set.
    ///
    /// A running cross-fade between two seas ends at once.
    pub fn set_coast(&mut self, transfer: Option<Arc<Transfer>>) -> bool {
        if self.sim.maps().fading_cascade_count > 0 {
            // The rest of the ocean must know that only one sea is left.
            let params = self.params.clone();
            let plan = self.sim.latest_plan().clone();
            self.sim.set_plan(&self.gpu, plan, &self.shaders);
            self.apply_transition_step(&params, &crate::sim::transition::TransitionFrameProgress::IMMEDIATE);
        }
        self.sim.set_coast(&self.gpu, &self.shaders, transfer)
    }

    /// Transfer functions of the coast up to which the present sea runs; None in the open sea.
    pub fn transfer(&self) -> Option<&Arc<Transfer>> {
        self.sim.transfer()
    }
}
