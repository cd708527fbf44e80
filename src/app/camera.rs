//! Mouse, touch and keyboard move the camera. Only what happens on the sea counts, never on the panel.

use crate::model::params::Camera;
use egui::Key;

/// Slowest and height-proportional speed of flight, m/s and 1/s.
const SLOWEST_M_S: f64 = 6.0;
const SPEED_PER_HEIGHT: f64 = 0.8;
const FASTER: f64 = 8.0;

/// Dragging looks around, the wheel and pinching zoom, two fingers also carry the camera.
pub fn pointer(camera: &mut Camera, response: &egui::Response, ctx: &egui::Context) {
    let height = f64::from(response.rect.height()).max(1.0);
    let degrees_per_point = camera.fov_deg / height;
    if let Some(touch) = ctx.multi_touch() {
        if response.hovered() || response.dragged() {
            zoom(camera, 1.0 / f64::from(touch.zoom_delta.max(0.1)));
            let metres = camera.y_m * 2.0 / height;
            carry(
                camera,
                -f64::from(touch.translation_delta.x) * metres,
                f64::from(touch.translation_delta.y) * metres,
            );
        }
        return;
    }
    if response.dragged_by(egui::PointerButton::Primary) {
        // The sea follows the finger.
        let delta = response.drag_delta();
        turn(camera, -f64::from(delta.x) * degrees_per_point, f64::from(delta.y) * degrees_per_point);
    }
    if response.hovered() {
        let wheel = ctx.input(|i| i.smooth_scroll_delta.y);
        let pinch = ctx.input(egui::InputState::zoom_delta);
        zoom(camera, (-0.002 * f64::from(wheel)).exp() / f64::from(pinch.max(0.1)));
    }
}

/// WASD and the arrows fly, Q and E sink and rise, shift hurries.
pub fn keys(camera: &mut Camera, ctx: &egui::Context) {
    let held = |keys: [Key; 2]| ctx.input(|i| f64::from(u8::from(keys.iter().any(|&k| i.key_down(k)))));
    let ahead = held([Key::W, Key::ArrowUp]) - held([Key::S, Key::ArrowDown]);
    let aside = held([Key::D, Key::ArrowRight]) - held([Key::A, Key::ArrowLeft]);
    let rise = held([Key::E, Key::PageUp]) - held([Key::Q, Key::PageDown]);
    if (ahead, aside, rise) == (0.0, 0.0, 0.0) {
        return;
    }
    let (dt, hurry) = ctx.input(|i| (f64::from(i.stable_dt).min(0.1), i.modifiers.shift));
    let step = dt * (SLOWEST_M_S + SPEED_PER_HEIGHT * camera.y_m) * if hurry { FASTER } else { 1.0 };
    carry(camera, aside * step, ahead * step);
    camera.y_m = (camera.y_m + rise * step).clamp(1.0, 5000.0);
    ctx.request_repaint();
}

fn turn(camera: &mut Camera, right_deg: f64, up_deg: f64) {
    camera.heading_deg = (camera.heading_deg + right_deg).rem_euclid(360.0);
    camera.pitch_deg = (camera.pitch_deg + up_deg).clamp(-89.0, 60.0);
}

fn zoom(camera: &mut Camera, factor: f64) {
    camera.fov_deg = (camera.fov_deg * factor).clamp(10.0, 100.0);
}

/// Moves over the sea, in metres to the right and ahead.
fn carry(camera: &mut Camera, right_m: f64, ahead_m: f64) {
    let (sin, cos) = camera.heading_deg.to_radians().sin_cos();
    camera.x_m = (camera.x_m + ahead_m * sin + right_m * cos).clamp(-1e6, 1e6);
    camera.z_m = (camera.z_m - ahead_m * cos + right_m * sin).clamp(-1e6, 1e6);
}
