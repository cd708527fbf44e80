//! Moves the camera by mouse, touch and keyboard. Input over the panel does not move it.

use super::App;
use crate::app::language::tr;
use crate::state::camera::deepest_dive_m;
use crate::state::motion::{fly, orbit, rotate_camera, zoom};
use crate::state::params::{Camera, CameraMode};
use crate::state::rounding::{camera_pose, with_rounded_pose};
use egui::Key;

/// Speed at which keys fly the camera at height y = 0, m/s. The speed grows with the height: see [`SPEED_PER_HEIGHT`].
const MIN_SPEED_M_S: f64 = 6.0;
/// Speed at which keys move the camera under water, m/s.
const DIVE_SPEED_M_S: f64 = 2.0;
/// Increase of the camera's flight speed with its height, (m/s) per m.
const SPEED_PER_HEIGHT: f64 = 0.8;
/// Factor by which the camera flies faster while Shift is held.
const SHIFT_SPEED_FACTOR: f64 = 8.0;
/// In orbit mode, angle by which the camera moves around its pivot for each point that the pointer is dragged, degrees.
const DRAG_DEG_PER_POINT: f64 = 0.3;

/// Applies mouse and touch input over the sea to the camera: dragging turns it (in orbit mode it moves around its
/// pivot), wheel and pinching zoom, and two dragging fingers also move it over the water.
pub fn apply_pointer_to_camera(camera: &mut Camera, response: &egui::Response, ctx: &egui::Context) {
    let height = f64::from(response.rect.height()).max(1.0);
    let degrees_per_point = camera.fov_deg / height;
    if let Some(touch) = ctx.multi_touch() {
        if response.hovered() || response.dragged() {
            zoom(camera, 1.0 / f64::from(touch.zoom_delta.max(0.1)));
            let metres = camera.y_m * 2.0 / height;
            let [x, y] = [touch.translation_delta.x, touch.translation_delta.y].map(f64::from);
            fly(camera, -x * metres, y * metres, 0.0);
        }
        return;
    }
    if response.dragged_by(egui::PointerButton::Primary) {
        // The signs make the sea follow the finger.
        let delta = response.drag_delta();
        let (x, y) = (f64::from(delta.x), f64::from(delta.y));
        match camera.mode {
            CameraMode::Orbit => orbit(camera, -x * DRAG_DEG_PER_POINT, y * DRAG_DEG_PER_POINT),
            CameraMode::Fly | CameraMode::Buoy => rotate_camera(camera, -x * degrees_per_point, y * degrees_per_point),
        }
    }
    if response.hovered() {
        let wheel = ctx.input(|i| i.smooth_scroll_delta.y);
        let pinch = ctx.input(egui::InputState::zoom_delta);
        zoom(camera, (-0.002 * f64::from(wheel)).exp() / f64::from(pinch.max(0.1)));
    }
}

/// A sentence for the user about a camera mode: its name, and the effect of a drag.
pub fn mode_in_words(mode: CameraMode) -> &'static str {
    match mode {
        CameraMode::Fly => tr("Camera: fly. A drag looks around, the keys fly."),
        CameraMode::Orbit => tr("Camera: orbit. A drag turns around the sea in the middle."),
        CameraMode::Buoy => tr("Camera: ride. It rises and sinks with the waves."),
    }
}

/// Applies the keyboard to the camera: WASD and the arrows fly, Q and E sink and rise, Shift flies faster, C changes
/// the camera mode. The camera dives no deeper than to the bed of water that is `depth_m` deep. Without
/// `arrows_fly_aside`, the left and the right arrow do something else.
pub fn apply_keys_to_camera(camera: &mut Camera, depth_m: f64, arrows_fly_aside: bool, ctx: &egui::Context) {
    if ctx.input(|i| i.key_pressed(Key::C) && i.modifiers.is_none()) {
        camera.mode = match camera.mode {
            CameraMode::Fly => CameraMode::Orbit,
            CameraMode::Orbit => CameraMode::Buoy,
            CameraMode::Buoy => CameraMode::Fly,
        };
    }
    let held = |keys: [Key; 2]| ctx.input(|i| f64::from(u8::from(keys.iter().any(|&k| i.key_down(k)))));
    if ctx.input(|i| i.modifiers.command || i.modifiers.alt) {
        return;
    }
    let ahead = held([Key::W, Key::ArrowUp]) - held([Key::S, Key::ArrowDown]);
    let [right, left] = if arrows_fly_aside { [Key::ArrowRight, Key::ArrowLeft] } else { [Key::D, Key::A] };
    let aside = held([Key::D, right]) - held([Key::A, left]);
    let rise = held([Key::E, Key::PageUp]) - held([Key::Q, Key::PageDown]);
    if (ahead, aside, rise) == (0.0, 0.0, 0.0) {
        return;
    }
    let (dt, hurry) = ctx.input(|i| (f64::from(i.stable_dt).min(0.1), i.modifiers.shift));
    let speed = if camera.dive_m > 0.0 { DIVE_SPEED_M_S } else { MIN_SPEED_M_S + SPEED_PER_HEIGHT * camera.y_m };
    let step = dt * speed * if hurry { SHIFT_SPEED_FACTOR } else { 1.0 };
    fly(camera, aside * step, ahead * step, rise * step);
    camera.dive_m = camera.dive_m.min(deepest_dive_m(depth_m));
    ctx.request_repaint();
}

impl App {
    /// Once the user gives no input, rounds the camera's position and angles, and the time of a stopped clock, to the
    /// digits that a link holds. The picture is then exactly the one that a copied link opens.
    pub(super) fn round_pose_when_idle(&mut self, ctx: &egui::Context) {
        if self.tilt.is_on() || ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty() || i.any_touches()) {
            return;
        }
        // A link may have more digits; they are kept until the user moves the camera.
        if self.rounded_pose.as_ref() == Some(&camera_pose(&self.params)) {
            return;
        }
        let rounded = with_rounded_pose(&self.params);
        self.params.camera = rounded.camera;
        if self.params.clock.paused {
            self.params.clock.t_s = rounded.clock.t_s;
        }
        self.rounded_pose = Some(camera_pose(&self.params));
    }
}
