//! Replaces a running simulation's plan, at once or by a transition, with only the work that the change needs.

use super::Simulation;
use super::coast::tables::{is_consistent, lattice_key};
use super::foam::FoamParameters;
use super::planned_sea::SeaUniformSource;
use super::transition::{TransitionFrameProgress, TransitionKind};
use crate::coast::Transfer;
use crate::gpu::Gpu;
use crate::shaders::Shaders;
use crate::waves::overlap::SeaCovariance;
use crate::waves::{Plan, SeaChange};
use std::sync::Arc;

impl Simulation {
    /// Replaces the simulated sea by that of `plan` at once and ends any transition. The foam on the water is kept,
    /// unless the FFT size or the number of cascades changes or simulated time stands still.
    pub fn set_plan(&mut self, gpu: &Gpu, plan: Plan, shaders: &Shaders) {
        if plan == self.sea.plan && !self.in_transition() {
            return;
        }
        if (plan.n, plan.cascades.len()) != (self.sea.plan.n, self.sea.plan.cascades.len()) {
            let (generation, timer) = (self.maps.view_generation + 1, self.timer.clone());
            let transfer = self.transfer().cloned();
            *self = Self::with_fft_implementation(gpu, plan, shaders, self.passes.transform.implementation());
            (self.maps.view_generation, self.timer) = (generation, timer);
            self.set_coast(gpu, shaders, transfer);
            return;
        }
        self.next = None;
        self.start_transition(gpu, plan, TransitionKind::Immediate, 0.0);
        self.apply_transition_step(&TransitionFrameProgress::IMMEDIATE);
        self.foam.note_sea_change();
        if self.resources.coast.is_some() && !self.sea.has_coast {
            self.set_coast(gpu, shaders, None);
        }
    }

    /// Whether the current sea runs up to a coast.
    pub fn has_coast(&self) -> bool {
        self.sea.has_coast
    }

    /// Transfer functions of the coast up to which the current sea runs; None in the open sea.
    pub fn transfer(&self) -> Option<&Arc<Transfer>> {
        self.resources.coast.as_ref().filter(|_| self.sea.has_coast).map(|coast| &coast.transfer)
    }

    /// Lets the sea run up to the coast with these transfer functions, or with None be the open sea, from the next
    /// [`Self::encode`] on. Ends a cross-fade. Transfer functions on the lattice of another sea than the present one are
    /// not taken: the sea is then open, and the result is false. A later sea on another lattice is open, too.
    pub fn set_coast(&mut self, gpu: &Gpu, shaders: &Shaders, transfer: Option<Arc<Transfer>>) -> bool {
        let is_wanted = transfer.is_some();
        let transfer = transfer.filter(|transfer| self.fits(transfer));
        let has_coast = transfer.is_some();
        if !has_coast && self.resources.coast.is_none() {
            return !is_wanted;
        }
        if self.fading.is_some() {
            self.transition.start(TransitionKind::Immediate);
            self.apply_transition_step(&TransitionFrameProgress { ends_cross_fade: true, ..Default::default() });
        }
        self.sea.has_coast = has_coast;
        self.resources.set_coast(gpu, &self.sea.plan, transfer);
        self.passes.set_coast(gpu, shaders, &self.resources, &self.uniforms);
        self.maps.set_coast(&self.sea.plan, &self.resources);
        self.needs_split = has_coast;
        self.foam.note_sea_change();
        has_coast == is_wanted
    }

    /// Whether transfer functions are those of waves of the current sea.
    fn fits(&self, transfer: &Transfer) -> bool {
        self.sea.plan.has_coast && lattice_key(&self.sea.plan) == Some(transfer.lattice) && is_consistent(transfer)
    }

    /// Advances the running transition by `dt_s` seconds of wall time and returns its progress in this frame. If there
    /// is a `plan`, first starts a transition to its sea at simulated time `t_s`, s. Call this once per frame before
    /// [`Self::encode`]. A plan with another FFT size, or with tiling or a coast switched on or off, replaces the sea at once.
    ///
    /// Foam parameters, surface parameters (choppiness, water level) and wave amplitudes are interpolated. A sea with
    /// other wave numbers, frequencies or random numbers is cross-faded, for which memory for a second sea is allocated
    /// once. During a cross-fade, a plan that needs another cross-fade waits for its end.
    pub fn transition_to(
        &mut self,
        gpu: &Gpu,
        plan: Option<Plan>,
        shaders: &Shaders,
        t_s: f64,
        dt_s: f64,
    ) -> TransitionFrameProgress {
        let goal = plan.or_else(|| self.next.take_if(|_| self.fading.is_none()));
        let mut start = None;
        if let Some(plan) = goal {
            self.next = None;
            let tiling = |plan: &Plan| (plan.n, plan.blends_copies, plan.has_coast);
            if tiling(&plan) != tiling(&self.sea.plan) {
                self.set_plan(gpu, plan, shaders);
                return TransitionFrameProgress::IMMEDIATE;
            }
            start = self.needed_transition(&plan);
            if start == Some(TransitionKind::CrossFade) && self.fading.is_some() {
                self.next = Some(plan);
                start = None;
            } else if let Some(kind) = start {
                self.start_transition(gpu, plan, kind, t_s);
            }
        }
        self.advance_transition(start, dt_s)
    }

    /// Computes the foam anew from the recent past of the present sea, or of the next one if a transition to it is
    /// running: at the end of that transition. Else the foam of a storm would lie on the calm sea that replaces it.
    pub fn restart_foam_after_transition(&mut self) {
        self.restarts_foam = self.in_transition();
        if !self.restarts_foam {
            self.foam.restart();
        }
    }

    /// Kind of transition that leads from the current sea to that of `plan`. None if both seas are the same.
    fn needed_transition(&self, plan: &Plan) -> Option<TransitionKind> {
        let now = &self.sea.plan;
        if !plan.has_same_waves(now) {
            return Some(TransitionKind::CrossFade);
        }
        SeaChange::between_seas(&now.sea, &plan.sea).map(|change| match change {
            SeaChange::Foam => TransitionKind::Foam,
            SeaChange::Surface => TransitionKind::Surface,
            SeaChange::Waves => TransitionKind::Amplitudes,
        })
    }

    /// Makes `plan` the current sea and starts a transition of the given kind to it from the previous one. For a
    /// cross-fade, computes the covariance of both seas' waves at the simulated time `t_s`, s.
    fn start_transition(&mut self, gpu: &Gpu, plan: Plan, kind: TransitionKind, t_s: f64) {
        let are_waves_new = match kind {
            TransitionKind::Foam | TransitionKind::Surface => false,
            TransitionKind::Amplitudes | TransitionKind::CrossFade => true,
            TransitionKind::Immediate => {
                matches!(self.needed_transition(&plan), Some(TransitionKind::Amplitudes | TransitionKind::CrossFade))
            }
        };
        let is_fade = kind == TransitionKind::CrossFade;
        let are_maps_new = is_fade && self.resources.swap_seas(gpu, &plan);
        let old = std::mem::replace(&mut self.sea, SeaUniformSource::new(plan));
        // The waves at the coast are those of the new sea, too, if it has them on the same lattice.
        self.sea.has_coast = self.resources.coast.as_ref().is_some_and(|coast| self.fits(&coast.transfer));
        if is_fade {
            self.overlaps = SeaCovariance::for_all_cascades(&old.plan, &self.sea.plan, t_s).concat();
            self.fading = Some(old);
        } else if kind == TransitionKind::Immediate {
            self.fading = None;
            self.overlaps.clear();
        }
        let replaces_h0 = match kind {
            TransitionKind::Immediate => are_waves_new || self.transition.interpolates_amplitudes(),
            _ => is_fade,
        };
        self.transition.start(kind);
        let are_buffers_new = are_waves_new && self.resources.upload_wave_tables(gpu, &self.sea.plan);
        if are_maps_new || are_buffers_new {
            self.passes.recreate_bind_groups(gpu, &self.resources, &self.uniforms);
        }
        if are_maps_new {
            self.maps.recreate_views(&self.resources);
        }
        self.maps.start_transition(&self.sea.plan, &self.resources, kind, self.sea.has_coast);
        if replaces_h0 {
            self.spectrum_blend = 1.0;
        }
    }

    /// Advances the transition by `dt_s` seconds of wall time; updates foam parameters and amplitude factors. Returns
    /// the progress in this frame, in which `started` is `start`: the kind of transition that just started, if any.
    fn advance_transition(&mut self, start: Option<TransitionKind>, dt_s: f64) -> TransitionFrameProgress {
        let was_in_transition = self.transition.is_running();
        let step = TransitionFrameProgress { started: start, ..self.transition.advance(dt_s) };
        self.spectrum_blend = 1.0 - (1.0 - self.spectrum_blend) * (1.0 - step.amplitude_fraction);
        self.apply_transition_step(&step);
        if was_in_transition && !self.in_transition() {
            self.foam.note_sea_change();
            if std::mem::take(&mut self.restarts_foam) {
                self.foam.restart();
            }
        }
        step
    }

    /// Applies one frame of a transition to the foam parameters and, in a cross-fade, to the amplitude factors of all
    /// drawn cascades. Drops the old sea if the cross-fade ends in this frame.
    fn apply_transition_step(&mut self, step: &TransitionFrameProgress) {
        if step.ends_cross_fade {
            self.fading = None;
            self.maps.end_cross_fade();
            self.overlaps.clear();
        }
        let (size, plan) = (self.resources.foam_n, &self.sea.plan);
        self.maps.apply_transition_step(step, plan);
        self.foam_parameters.apply_transition_step(step, |_| FoamParameters::new(size, plan));
        self.foam.set_parameters(self.foam_parameters.cross_faded_value(self.transition.cross_fade_weight()));
        self.maps.set_cross_fade_weights(&self.overlaps, self.transition.cross_fade_weight());
    }
}
