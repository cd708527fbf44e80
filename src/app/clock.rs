//! The simulated time runs with the wall clock.

use super::App;

/// Upper limit of the wall-clock time by which one frame advances the clock, s. It prevents a jump of the simulated
/// time after the window was in the background.
const MAX_TIME_STEP_S: f64 = 0.1;

impl App {
    /// Advances the simulated time by the wall-clock time since the last frame times the clock's speed, which the user
    /// sets. Time stands still while the user has stopped the clock, and until the GPU has finished the first picture.
    pub(super) fn advance_time(&mut self, ctx: &egui::Context) {
        if self.stands_still() || self.progress.is_first_picture_pending() {
            return;
        }
        let dt = f64::from(ctx.input(|i| i.stable_dt)).min(MAX_TIME_STEP_S);
        self.params.clock.t_s += dt * self.params.clock.speed;
        ctx.request_repaint();
    }
}
