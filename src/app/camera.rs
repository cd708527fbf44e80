//! Mouse, touch and keyboard move the camera. Input on the panel never does.

use crate::state::Params;
use crate::state::camera::EARTH_RADIUS_M;
use crate::state::params::{Camera, CameraMode};
use egui::Key;

/// Speed of flight: a constant part, m/s, and a part proportional to the height, 1/s.
const SLOWEST_M_S: f64 = 6.0;
const SPEED_PER_HEIGHT: f64 = 0.8;
/// Factor of the speed while Shift is held.
const FASTER: f64 = 8.0;
/// Allowed heights of the camera, m.
const HEIGHTS_M: std::ops::RangeInclusive<f64> = 1.0..=5000.0;
/// Largest distance of the pivot of an orbit: this many camera heights plus this many metres.
const FAR_HEIGHTS: f64 = 12.0;
const FAR_M: f64 = 30.0;
/// Turn of an orbit per dragged point, degrees.
const ORBIT_DEG: f64 = 0.3;

/// A named view of the sea.
pub struct NamedView {
    /// Name on the button.
    pub name: &'static str,
    /// Tooltip.
    pub about: &'static str,
    camera: fn(&Params) -> Camera,
}

/// The named views. They keep the horizontal position and change height and direction.
pub const VIEWS: &[NamedView] = &[
    NamedView { name: "Deck", about: "Seven metres up, as at the start.", camera: |p| seen(p, 7.0, -4.0, 50.0) },
    NamedView {
        name: "Swimmer",
        about: "An eye just above the water, riding on it.",
        camera: |p| Camera { mode: CameraMode::Buoy, ..seen(p, 1.0, 2.0, 60.0) },
    },
    NamedView { name: "Bridge", about: "From the bridge of a large ship.", camera: |p| seen(p, 28.0, -8.0, 50.0) },
    NamedView {
        name: "Cliff",
        about: "From a hundred metres, with a long lens.",
        camera: |p| seen(p, 100.0, -7.0, 25.0),
    },
    NamedView {
        name: "Aeroplane",
        about: "From a kilometre: the pattern of the swell.",
        camera: |p| seen(p, 1000.0, -25.0, 50.0),
    },
    NamedView { name: "Straight down", about: "The water from above.", camera: |p| seen(p, 60.0, -89.0, 50.0) },
    NamedView {
        name: "Into the waves",
        about: "Against the direction that the waves run in.",
        camera: |p| Camera { heading_deg: p.sea.local().from_deg, ..seen(p, 4.0, -2.0, 50.0) },
    },
    NamedView {
        name: "Into the sun",
        about: "Along the path of glitter.",
        camera: |p| {
            let [x, up, z] = p.look.sky.sun_direction();
            let sun_deg = x.atan2(-z).to_degrees().rem_euclid(360.0);
            Camera {
                heading_deg: sun_deg.round(),
                ..seen(p, 7.0, (0.4 * up.asin().to_degrees() - 8.0).clamp(-20.0, 10.0), 50.0)
            }
        },
    },
];

fn seen(p: &Params, y_m: f64, pitch_deg: f64, fov_deg: f64) -> Camera {
    let mode = if p.camera.mode == CameraMode::Buoy { CameraMode::Fly } else { p.camera.mode };
    Camera { y_m, pitch_deg: pitch_deg.round(), fov_deg, mode, ..p.camera.clone() }
}

/// Goes to a named view.
pub fn turn_to(params: &mut Params, view: &NamedView) {
    params.camera = (view.camera)(params);
}

/// Dragging looks around, the wheel and pinching zoom, two fingers also move the camera over the sea.
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
        let (x, y) = (f64::from(delta.x), f64::from(delta.y));
        match camera.mode {
            CameraMode::Orbit => orbit(camera, -x * ORBIT_DEG, y * ORBIT_DEG),
            CameraMode::Fly | CameraMode::Buoy => turn(camera, -x * degrees_per_point, y * degrees_per_point),
        }
    }
    if response.hovered() {
        let wheel = ctx.input(|i| i.smooth_scroll_delta.y);
        let pinch = ctx.input(egui::InputState::zoom_delta);
        zoom(camera, (-0.002 * f64::from(wheel)).exp() / f64::from(pinch.max(0.1)));
    }
}

/// WASD and the arrows fly, Q and E sink and rise, Shift flies faster, C switches the mode.
pub fn keys(camera: &mut Camera, ctx: &egui::Context) {
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
    let aside = held([Key::D, Key::ArrowRight]) - held([Key::A, Key::ArrowLeft]);
    let rise = held([Key::E, Key::PageUp]) - held([Key::Q, Key::PageDown]);
    if (ahead, aside, rise) == (0.0, 0.0, 0.0) {
        return;
    }
    let (dt, hurry) = ctx.input(|i| (f64::from(i.stable_dt).min(0.1), i.modifiers.shift));
    let step = dt * (SLOWEST_M_S + SPEED_PER_HEIGHT * camera.y_m) * if hurry { FASTER } else { 1.0 };
    carry(camera, aside * step, ahead * step);
    camera.y_m = (camera.y_m + rise * step).clamp(*HEIGHTS_M.start(), *HEIGHTS_M.end());
    ctx.request_repaint();
}

fn turn(camera: &mut Camera, right_deg: f64, up_deg: f64) {
    camera.heading_deg = (camera.heading_deg + right_deg).rem_euclid(360.0);
    camera.pitch_deg = (camera.pitch_deg + up_deg).clamp(-89.0, 60.0);
}

/// Distance along the view to the pivot of an orbit, m: the sea in the middle of the picture, within a limit.
fn pivot_m(camera: &Camera) -> f64 {
    let far = FAR_HEIGHTS * camera.y_m + FAR_M;
    let down = -camera.pitch_deg.to_radians().sin();
    // The curvature of the Earth does not matter at this distance.
    debug_assert!(far < EARTH_RADIUS_M);
    if down > 0.0 { (camera.y_m / down).min(far) } else { far }
}

/// Unit vector of the view direction.
fn forward(camera: &Camera) -> [f64; 3] {
    let (sin, cos) = camera.heading_deg.to_radians().sin_cos();
    let (up, level) = camera.pitch_deg.to_radians().sin_cos();
    [sin * level, up, -cos * level]
}

/// Turns around the pivot at constant distance.
fn orbit(camera: &mut Camera, right_deg: f64, up_deg: f64) {
    let distance = pivot_m(camera);
    let before = forward(camera);
    let eye = [camera.x_m, camera.y_m, camera.z_m];
    let pivot: [f64; 3] = std::array::from_fn(|i| eye[i] + distance * before[i]);
    // The camera stays above its lowest height.
    let lowest = -((HEIGHTS_M.start() - pivot[1]) / distance).clamp(-1.0, 1.0).asin().to_degrees();
    camera.heading_deg = (camera.heading_deg + right_deg).rem_euclid(360.0);
    camera.pitch_deg = (camera.pitch_deg - up_deg).clamp(-89.0, lowest.max(-89.0));
    let after = forward(camera);
    let eye: [f64; 3] = std::array::from_fn(|i| pivot[i] - distance * after[i]);
    place(camera, eye);
}

/// Scales the field of view, or in orbit the distance to the pivot.
fn zoom(camera: &mut Camera, factor: f64) {
    if camera.mode != CameraMode::Orbit {
        camera.fov_deg = (camera.fov_deg * factor).clamp(10.0, 100.0);
        return;
    }
    let ahead = forward(camera);
    let distance = pivot_m(camera);
    // The allowed heights limit the distance.
    let down = (-ahead[1]).max(1e-3);
    let least = if -ahead[1] > 1e-3 { HEIGHTS_M.start() / down } else { 5.0 };
    let wanted = (distance * factor).clamp(least, HEIGHTS_M.end() / down);
    let eye = [camera.x_m, camera.y_m, camera.z_m];
    place(camera, std::array::from_fn(|i| eye[i] + (distance - wanted) * ahead[i]));
}

fn place(camera: &mut Camera, [x, y, z]: [f64; 3]) {
    camera.x_m = x.clamp(-1e6, 1e6);
    camera.y_m = y.clamp(*HEIGHTS_M.start(), *HEIGHTS_M.end());
    camera.z_m = z.clamp(-1e6, 1e6);
}

/// Moves horizontally, in metres to the right and ahead.
fn carry(camera: &mut Camera, right_m: f64, ahead_m: f64) {
    let (sin, cos) = camera.heading_deg.to_radians().sin_cos();
    camera.x_m = (camera.x_m + ahead_m * sin + right_m * cos).clamp(-1e6, 1e6);
    camera.z_m = (camera.z_m - ahead_m * cos + right_m * sin).clamp(-1e6, 1e6);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pivot(camera: &Camera) -> [f64; 3] {
        let (d, f) = (pivot_m(camera), forward(camera));
        let eye = [camera.x_m, camera.y_m, camera.z_m];
        std::array::from_fn(|i| eye[i] + d * f[i])
    }

    #[test]
    fn an_orbit_keeps_its_centre_and_its_distance() {
        let mut camera = Camera { mode: CameraMode::Orbit, pitch_deg: -30.0, y_m: 40.0, ..Camera::default() };
        let (centre, distance) = (pivot(&camera), pivot_m(&camera));
        assert!(centre[1].abs() < 1e-9, "on the water");
        for (right, up) in [(50.0, 0.0), (0.0, 20.0), (-200.0, -30.0), (10.0, 5.0)] {
            orbit(&mut camera, right, up);
            let now = pivot(&camera);
            assert!((0..3).all(|i| (now[i] - centre[i]).abs() < 1e-6), "{centre:?} {now:?}");
            assert!((pivot_m(&camera) - distance).abs() < 1e-6);
        }
        zoom(&mut camera, 0.5);
        let now = pivot(&camera);
        assert!((0..3).all(|i| (now[i] - centre[i]).abs() < 1e-6), "{centre:?} {now:?}");
        assert!((pivot_m(&camera) - 0.5 * distance).abs() < 1e-6);
    }

    #[test]
    fn no_camera_goes_under() {
        for pitch_deg in [-89.0, -30.0, -1.0, 0.0, 30.0] {
            let mut camera = Camera { mode: CameraMode::Orbit, pitch_deg, ..Camera::default() };
            for i in 0..200 {
                orbit(&mut camera, f64::from(i), if i % 7 < 4 { 25.0 } else { -30.0 });
                zoom(&mut camera, if i % 5 < 3 { 0.3 } else { 2.0 });
                assert!(HEIGHTS_M.contains(&camera.y_m) && camera.pitch_deg <= 60.0, "{camera:?}");
            }
        }
    }

    #[test]
    fn every_named_view_is_one_that_a_link_can_carry() {
        let mut params = Params::default();
        for view in VIEWS {
            turn_to(&mut params, view);
            let state = crate::state::query::write(&params);
            let (read, notices) = crate::state::query::parse(&state);
            assert_eq!((read, notices), (params.clone(), vec![]), "{}", view.name);
        }
    }
}
