//! The tier of the water's light: the governor tries the lean one where few pixels are left.

use super::*;

/// Factor on the GPU time that the lean light is taken to bring if no GPU time tells it.
pub(super) const UNKNOWN_LEAN_FACTOR: f64 = 0.5;
/// Factor on the resolution scale that fits the lean light, once its time is known. What a frame costs whatever its
/// pixels hides a part of the scale from below; a step down from above finds it.
const SCALE_BEYOND_LEAN_TRIAL: f64 = 1.2;
/// Number of frames after a change of the light that are not measured: the first one compiles a pipeline.
const FRAMES_OF_NEW_LIGHT: u32 = 4;

impl Governor {
    /// Whether the water has the lean light.
    pub fn is_lean(&self) -> bool {
        self.is_lean
    }

    /// Tells whether the user leaves the choice of the light.
    pub fn let_light_be_lean(&mut self, may_be_lean: bool) {
        self.may_be_lean = may_be_lean;
        if self.is_lean && !may_be_lean {
            self.set_lean(false, self.steps_down);
        }
    }

    /// Changes the light if that is due: to the lean one if too few pixels are left, and back if the full one leaves
    /// enough, or if the lean one has shown not to help. Returns whether it changed.
    pub(super) fn judge_light(&mut self, measured: Measured) -> bool {
        if let Some(before_s) = self.lean_trial_s.take()
            && (measured.has_gpu_time || !self.is_on_time(measured))
        {
            self.lean_factor = (measured.gpu_s / before_s).min(1.0);
            if self.lean_factor > NEEDED_SHORTENING {
                self.lean_is_useless = true;
                return self.set_lean(false, self.steps_down);
            }
            let may_take_s = GPU_TIME_FRACTION * self.aim_s;
            let steps = self.steps_for((SCALE_BEYOND_LEAN_TRIAL * self.scale_for(may_take_s, measured)).min(1.0));
            if steps < self.steps_down {
                self.change(steps, self.halvings);
                return true;
            }
        }
        let display_s = self.display.map_or(SMOOTH_FRAME_S, |(interval_s, _)| interval_s);
        let longest_s = display_s * (LONGEST_FRAME_S * (1.0 + FRAME_TIME_TOLERANCE) / display_s).floor().max(1.0);
        let factor = if self.is_lean { self.lean_factor } else { 1.0 };
        let mut full = self.scale_for(GPU_TIME_FRACTION * longest_s * factor, measured);
        if !self.is_lean {
            // Pixels are the quicker relief, and only frames that are on time tell how long the lean light takes.
            let is_settled = self.is_on_time(measured) || self.scale() <= self.min_scale;
            let is_due = full.max(self.scale()) < MIN_SCALE_FOR_SMOOTH_MOTION && is_settled;
            if is_due && self.may_be_lean && !self.lean_is_useless {
                self.lean_trial_s = Some(measured.gpu_s);
                return self.set_lean(true, self.steps_down);
            }
            return false;
        }
        if self.halvings > 0 || self.on_time_s <= self.time_before_raise_s {
            return false;
        }
        if !measured.has_gpu_time && self.steps_down == 0 && self.on_time_s > TIME_BEFORE_BLIND_RAISE_S {
            full = SCALE_TO_RETURN_TO_SMOOTH_MOTION;
        }
        let returns = full >= SCALE_TO_RETURN_TO_SMOOTH_MOTION && self.set_lean(false, self.steps_for(full));
        self.since_raise_s = if returns { Some(0.0) } else { self.since_raise_s };
        returns
    }

    /// Sets the light and the resolution. Returns true.
    fn set_lean(&mut self, is_lean: bool, steps_down: u32) -> bool {
        self.is_lean = is_lean;
        self.change(steps_down, self.halvings);
        self.unmeasured = FRAMES_OF_NEW_LIGHT;
        true
    }
}
