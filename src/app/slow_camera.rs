//! The slow camera: while nobody touches anything, the view turns a little to and fro and rises and sinks a little. The
//! parameters, and so the link, stay as they are: only the drawn camera moves.

use super::App;
use crate::state::motion::{orbit, rotate_camera};
use crate::state::params::{Camera, CameraMode, Interface};
use std::f64::consts::TAU;

/// Time without input after which the camera begins to move, s.
const IDLE_TIME_S: f64 = 20.0;
/// Time in which the camera comes into motion, s.
const BEGIN_TIME_S: f64 = 8.0;
/// Time in which it returns to the view of the parameters, s.
const END_TIME_S: f64 = 0.7;
/// Largest angle by which the view turns to each side, degrees.
const YAW_DEG: f64 = 7.0;
/// Period of the turn to and fro, s.
const YAW_PERIOD_S: f64 = 100.0;
/// Largest change of the eye's height, relative to that height.
const HEIGHT_FRACTION: f64 = 0.05;
/// Period of the change of height, s: no simple multiple of the other period, so that the path does not repeat.
const HEIGHT_PERIOD_S: f64 = 37.0;
/// Least height above the still water to which the eye sinks, m: that to which a user can move it.
const MIN_EYE_HEIGHT_M: f64 = 1.0;
/// Longest time by which one frame advances the motion, s.
const MAX_STEP_S: f64 = 0.1;

/// State of the slow camera.
#[derive(Default)]
pub struct SlowCamera {
    /// Whether this shell lets the camera move at all: not in tests, in frames of other pages, or where the system asks
    /// for reduced motion.
    is_allowed: bool,
    /// Time since the last input, s.
    idle_s: f64,
    /// Time for which the camera has moved, s.
    moving_s: f64,
    /// How far the camera has come into motion, from 0 (at rest) to 1.
    strength: f64,
}

impl SlowCamera {
    /// Whether this shell lets the camera move.
    pub fn is_allowed(&self) -> bool {
        self.is_allowed
    }

    /// Whether the drawn camera is that of the parameters.
    pub fn is_at_rest(&self) -> bool {
        self.strength == 0.0
    }

    /// Brings the camera to rest at once, because a film begins.
    #[cfg(target_arch = "wasm32")]
    pub fn stop(&mut self) {
        (self.idle_s, self.strength) = (0.0, 0.0);
    }

    /// Advances by `dt_s` seconds. `is_left_alone`: there is no input, and nothing else forbids the motion.
    fn advance(&mut self, dt_s: f64, is_left_alone: bool) {
        self.idle_s = if is_left_alone { self.idle_s + dt_s } else { 0.0 };
        let change = if self.idle_s > IDLE_TIME_S { dt_s / BEGIN_TIME_S } else { -dt_s / END_TIME_S };
        self.strength = (self.strength + change).clamp(0.0, 1.0);
        // The next motion begins where the camera is.
        self.moving_s = if self.is_at_rest() { 0.0 } else { self.moving_s + dt_s };
    }

    /// Moves a camera as the time asks.
    pub fn apply(&self, camera: &mut Camera) {
        if self.is_at_rest() {
            return;
        }
        let share = self.strength * self.strength * (3.0 - 2.0 * self.strength);
        let wave = |period_s: f64| share * (TAU * self.moving_s / period_s).sin();
        let yaw_deg = YAW_DEG * wave(YAW_PERIOD_S);
        match camera.mode {
            CameraMode::Orbit => orbit(camera, yaw_deg, 0.0),
            CameraMode::Fly | CameraMode::Buoy => rotate_camera(camera, yaw_deg, 0.0),
        }
        if camera.dive_m == 0.0 {
            let least = camera.y_m.min(MIN_EYE_HEIGHT_M);
            camera.y_m = (camera.y_m * (1.0 + HEIGHT_FRACTION * wave(HEIGHT_PERIOD_S))).max(least);
        }
    }
}

/// Whether an event comes from the user.
fn is_input(event: &egui::Event) -> bool {
    !matches!(event, egui::Event::WindowFocused(_) | egui::Event::PointerGone)
}

impl App {
    /// Lets the camera move slowly while nobody touches anything, unless the visitor has switched it off.
    pub fn allow_slow_camera(&mut self) {
        self.visitor.slow_camera.is_allowed = true;
    }

    /// Advances the slow camera by one frame. It moves only over a running sea with the panel, while no hint is shown and
    /// the pointer rests over the sea, outside of the panel.
    pub(super) fn advance_slow_camera(&mut self, ctx: &egui::Context) {
        let (has_input, dt_s) = ctx.input(|i| {
            let is_held = i.pointer.any_down() || !i.keys_down.is_empty() || i.any_touches();
            (is_held || i.events.iter().any(is_input), f64::from(i.stable_dt).min(MAX_STEP_S))
        });
        let uses_panel = ctx.egui_wants_keyboard_input() || self.visitor.pointer_is_off_sea;
        let is_left_alone = self.visitor.slow_camera.is_allowed
            && self.visitor.preferences.slow_camera
            && !(has_input || uses_panel || self.help_is_open || self.placing.is_some())
            && !self.visitor.first_steps.is_shown()
            && self.params.screen.interface == Interface::Panel
            && !(self.stands_still() || self.is_filming() || self.progress.wants_frame());
        self.visitor.slow_camera.advance(dt_s, is_left_alone);
        if !self.visitor.slow_camera.is_at_rest() {
            ctx.request_repaint();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The camera after each frame of 1/60 s, for `s` seconds.
    fn run(slow: &mut SlowCamera, s: f64, is_left_alone: bool, camera: &Camera) -> Vec<Camera> {
        let frame = |_| {
            slow.advance(1.0 / 60.0, is_left_alone);
            let mut drawn = camera.clone();
            slow.apply(&mut drawn);
            drawn
        };
        (0..(60.0 * s) as usize).map(frame).collect()
    }

    fn turn_deg(a: &Camera, b: &Camera) -> f64 {
        ((a.heading_deg - b.heading_deg + 180.0).rem_euclid(360.0) - 180.0).abs()
    }

    #[test]
    fn it_begins_when_nobody_touches_and_ends_at_the_first_input_without_a_jump() {
        for camera in [
            Camera { heading_deg: 359.0, ..Camera::default() },
            Camera { mode: CameraMode::Orbit, pitch_deg: -20.0, y_m: 40.0, ..Camera::default() },
            Camera { mode: CameraMode::Buoy, y_m: 1.0, ..Camera::default() },
            Camera { dive_m: 2.0, pitch_deg: 10.0, ..Camera::default() },
        ] {
            let mut slow = SlowCamera::default();
            let still = run(&mut slow, IDLE_TIME_S - 1.0, true, &camera);
            assert!(still.iter().all(|drawn| *drawn == camera), "not before its time");
            let moving = run(&mut slow, 120.0, true, &camera);
            let ending = run(&mut slow, 2.0 * END_TIME_S, false, &camera);
            assert!(moving.iter().any(|drawn| turn_deg(drawn, &camera) > 0.9 * YAW_DEG), "{camera:?}");
            assert_eq!(ending.last(), Some(&camera), "it returns");
            for drawn in &moving {
                assert!(turn_deg(drawn, &camera) <= 1.001 * YAW_DEG && drawn.y_m >= 1.0, "{drawn:?}");
                assert!((drawn.y_m / camera.y_m - 1.0).abs() <= 1.001 * HEIGHT_FRACTION, "{drawn:?}");
            }
            let path: Vec<&Camera> = still.iter().chain(&moving).collect();
            for pair in path.windows(2) {
                assert!(turn_deg(pair[0], pair[1]) < 0.02, "at most about a degree in a second");
            }
            for pair in ending.windows(2) {
                assert!(turn_deg(&pair[0], &pair[1]) < 0.4, "no jump: {pair:?}");
            }
        }
    }

    #[test]
    fn any_input_begins_the_waiting_anew() {
        let (mut slow, camera) = (SlowCamera::default(), Camera::default());
        for _ in 0..5 {
            run(&mut slow, IDLE_TIME_S - 1.0, true, &camera);
            run(&mut slow, 0.1, false, &camera);
            assert!(slow.is_at_rest());
        }
    }
}
