//! Camera motion by user input (looking around, orbiting, zooming, flying), and named camera views.

use super::Params;
use super::camera::{EARTH_RADIUS_M, View};
use super::params::{Camera, CameraMode};
use glam::DVec3;

/// Smallest height above the still water, m, to which input can move the camera.
const MIN_EYE_HEIGHT_M: f64 = 1.0;
/// Largest depth below the water, m, to which input can move the camera.
const MAX_DIVE_M: f64 = 60.0;
/// Largest height above the still water, m, to which input can move the camera.
const MAX_EYE_HEIGHT_M: f64 = 5000.0;
/// Largest distance from the camera to the point that it orbits: this many times its height above the still water, plus
/// [`MAX_PIVOT_OFFSET_M`].
const MAX_PIVOT_DISTANCE_EYE_HEIGHTS: f64 = 12.0;
/// Largest distance from a camera at the height 0 to the point that it orbits, m; higher cameras may be
/// [`MAX_PIVOT_DISTANCE_EYE_HEIGHTS`] times their height further away.
const MAX_PIVOT_OFFSET_M: f64 = 30.0;

/// A named camera view of the sea, which a button of the panel selects.
pub struct NamedView {
    /// Name of the view, shown on its button.
    pub name: &'static str,
    /// Description of the view, shown as the tooltip of its button.
    pub about: &'static str,
    camera: fn(&Params) -> Camera,
}

/// All named camera views. Each keeps the horizontal position of the camera and sets its height, pitch and field of
/// view; some also set its heading or control mode.
pub const CAMERA_VIEWS: &[NamedView] = &[
    NamedView {
        name: "Deck",
        about: "Seven metres up, as at the start.",
        camera: |p| standard_camera(p, 7.0, -4.0, 50.0),
    },
    NamedView {
        name: "Swimmer",
        about: "An eye just above the water, riding on it.",
        camera: |p| Camera { mode: CameraMode::Buoy, ..standard_camera(p, 1.0, 2.0, 60.0) },
    },
    NamedView {
        name: "Bridge",
        about: "From the bridge of a large ship.",
        camera: |p| standard_camera(p, 28.0, -8.0, 50.0),
    },
    NamedView {
        name: "Cliff",
        about: "From a hundred metres, with a long lens.",
        camera: |p| standard_camera(p, 100.0, -7.0, 25.0),
    },
    NamedView {
        name: "Aeroplane",
        about: "From a kilometre: the pattern of the swell.",
        camera: |p| standard_camera(p, 1000.0, -25.0, 50.0),
    },
    NamedView {
        name: "Straight down",
        about: "The water from above.",
        camera: |p| standard_camera(p, 60.0, -89.0, 50.0),
    },
    NamedView {
        name: "Into the waves",
        about: "Against the direction that the waves run in.",
        camera: |p| Camera { heading_deg: p.sea.first_system().from_deg, ..standard_camera(p, 4.0, -2.0, 50.0) },
    },
    NamedView {
        name: "Into the sun",
        about: "Along the path of glitter.",
        camera: |p| {
            let [x, up, z] = p.look.sky.at_time(p.clock.t_s).sun_direction();
            let sun_deg = x.atan2(-z).to_degrees().rem_euclid(360.0);
            Camera {
                heading_deg: sun_deg.round(),
                ..standard_camera(p, 7.0, (0.4 * up.asin().to_degrees() - 8.0).clamp(-20.0, 10.0), 50.0)
            }
        },
    },
];

/// The camera of `p` with the given height above the still water (m), pitch and vertical field of view (degrees).
/// Horizontal position, heading and control mode are kept, but buoy mode becomes fly mode.
fn standard_camera(p: &Params, y_m: f64, pitch_deg: f64, fov_deg: f64) -> Camera {
    let mode = if p.camera.mode == CameraMode::Buoy { CameraMode::Fly } else { p.camera.mode };
    Camera { y_m, dive_m: 0.0, pitch_deg: pitch_deg.round(), fov_deg, mode, ..p.camera.clone() }
}

/// Replaces the camera in `params` by that of a named view such as "Deck".
pub fn set_named_view(params: &mut Params, view: &NamedView) {
    params.camera = (view.camera)(params);
}

/// Turns the camera at its place: its viewing direction to the right and upwards (negative: downwards) by the given
/// angles, degrees. Above the water the pitch does not rise beyond 60, under water not beyond 89.
pub fn rotate_camera(camera: &mut Camera, right_deg: f64, up_deg: f64) {
    camera.heading_deg = (camera.heading_deg + right_deg).rem_euclid(360.0);
    let highest_deg = if camera.dive_m > 0.0 { 89.0 } else { camera.pitch_deg.max(60.0) };
    camera.pitch_deg = (camera.pitch_deg + up_deg).clamp(-89.0, highest_deg);
}

/// Distance, m, along the viewing direction from the camera to the point that it orbits: to the still water, but at
/// most [`MAX_PIVOT_DISTANCE_EYE_HEIGHTS`] camera heights + [`MAX_PIVOT_OFFSET_M`], which is also taken where there is
/// only sky.
fn pivot_distance_m(camera: &Camera) -> f64 {
    let far = MAX_PIVOT_DISTANCE_EYE_HEIGHTS * camera.y_m + MAX_PIVOT_OFFSET_M;
    let down = -camera.pitch_deg.to_radians().sin();
    // The curvature of the Earth does not matter at this distance.
    debug_assert!(far < EARTH_RADIUS_M);
    if down > 0.0 { (camera.y_m / down).min(far) } else { far }
}

/// Position of the camera (m) and unit vector of its viewing direction, both in world axes (x east, y up, z south).
fn eye_and_forward(camera: &Camera) -> (DVec3, DVec3) {
    let view = View::new(camera, 1.0, f64::NEG_INFINITY);
    (view.eye, view.forward)
}

/// Moves the camera at constant distance around the point of the sea in the middle of the picture, by angles in
/// degrees: `right_deg` is added to its heading; `up_deg` raises it and tilts it down, but not into the water. Under
/// water it turns at its place.
pub fn orbit(camera: &mut Camera, right_deg: f64, up_deg: f64) {
    if camera.dive_m > 0.0 {
        return rotate_camera(camera, right_deg, -up_deg);
    }
    let distance = pivot_distance_m(camera);
    let (eye, before) = eye_and_forward(camera);
    let pivot = eye + distance * before;
    // Pitch at which the camera reaches its smallest allowed height, degrees.
    let lowest = -((MIN_EYE_HEIGHT_M - pivot.y) / distance).clamp(-1.0, 1.0).asin().to_degrees();
    camera.heading_deg = (camera.heading_deg + right_deg).rem_euclid(360.0);
    camera.pitch_deg = (camera.pitch_deg - up_deg).clamp(-89.0, lowest.max(-89.0));
    let (_, after) = eye_and_forward(camera);
    set_position(camera, pivot - distance * after);
}

/// Multiplies the vertical field of view by `factor`, or in orbit mode the distance to the point that the camera
/// orbits, within the allowed ranges; a factor below 1 zooms in.
pub fn zoom(camera: &mut Camera, factor: f64) {
    if camera.mode != CameraMode::Orbit || camera.dive_m > 0.0 {
        camera.fov_deg = (camera.fov_deg * factor).clamp(10.0, 100.0);
        return;
    }
    let (eye, ahead) = eye_and_forward(camera);
    let distance = pivot_distance_m(camera);
    // The distance is limited so that the camera stays within its allowed heights.
    let down = (-ahead.y).max(1e-3);
    let least = if -ahead.y > 1e-3 { MIN_EYE_HEIGHT_M / down } else { 5.0 };
    let wanted = (distance * factor).clamp(least, MAX_EYE_HEIGHT_M / down);
    set_position(camera, eye + (distance - wanted) * ahead);
}

/// Moves the camera by distances in metres: to its right, ahead (horizontally, whatever its pitch) and up. From the least
/// height above the water it dives, and it comes up again at that height.
pub fn fly(camera: &mut Camera, right_m: f64, ahead_m: f64, up_m: f64) {
    let (sin, cos) = camera.heading_deg.to_radians().sin_cos();
    let mut step = DVec3::new(ahead_m * sin + right_m * cos, up_m, right_m * sin - ahead_m * cos);
    if camera.dive_m > 0.0 || (up_m < 0.0 && camera.y_m <= MIN_EYE_HEIGHT_M) {
        camera.dive_m = (camera.dive_m - up_m).clamp(0.0, MAX_DIVE_M);
        if camera.dive_m == 0.0 {
            camera.y_m = MIN_EYE_HEIGHT_M;
        }
        step.y = 0.0;
    }
    set_position(camera, DVec3::new(camera.x_m, camera.y_m, camera.z_m) + step);
}

/// Moves the camera to `eye` (world axes, m), clamped to the ranges of the position parameters.
fn set_position(camera: &mut Camera, eye: DVec3) {
    camera.x_m = eye.x.clamp(-1e6, 1e6);
    camera.y_m = eye.y.clamp(MIN_EYE_HEIGHT_M, MAX_EYE_HEIGHT_M);
    camera.z_m = eye.z.clamp(-1e6, 1e6);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pivot(camera: &Camera) -> DVec3 {
        let (eye, forward) = eye_and_forward(camera);
        eye + pivot_distance_m(camera) * forward
    }

    #[test]
    fn an_orbit_keeps_its_centre_and_its_distance() {
        let mut camera = Camera { mode: CameraMode::Orbit, pitch_deg: -30.0, y_m: 40.0, ..Camera::default() };
        let (centre, distance) = (pivot(&camera), pivot_distance_m(&camera));
        assert!(centre.y.abs() < 1e-9, "on the water");
        for (right, up) in [(50.0, 0.0), (0.0, 20.0), (-200.0, -30.0), (10.0, 5.0)] {
            orbit(&mut camera, right, up);
            let now = pivot(&camera);
            assert!((now - centre).abs().max_element() < 1e-6, "{centre:?} {now:?}");
            assert!((pivot_distance_m(&camera) - distance).abs() < 1e-6);
        }
        zoom(&mut camera, 0.5);
        let now = pivot(&camera);
        assert!((now - centre).abs().max_element() < 1e-6, "{centre:?} {now:?}");
        assert!((pivot_distance_m(&camera) - 0.5 * distance).abs() < 1e-6);
    }

    #[test]
    fn no_camera_goes_under() {
        for pitch_deg in [-89.0, -30.0, -1.0, 0.0, 30.0] {
            let mut camera = Camera { mode: CameraMode::Orbit, pitch_deg, ..Camera::default() };
            for i in 0..200 {
                orbit(&mut camera, f64::from(i), if i % 7 < 4 { 25.0 } else { -30.0 });
                zoom(&mut camera, if i % 5 < 3 { 0.3 } else { 2.0 });
                assert!(
                    (MIN_EYE_HEIGHT_M..=MAX_EYE_HEIGHT_M).contains(&camera.y_m) && camera.pitch_deg <= 60.0,
                    "{camera:?}"
                );
            }
        }
    }

    #[test]
    fn keys_dive_and_come_up_again() {
        let mut camera = Camera { y_m: 1.5, ..Camera::default() };
        fly(&mut camera, 0.0, 0.0, -2.0);
        assert_eq!((camera.y_m, camera.dive_m), (MIN_EYE_HEIGHT_M, 0.0), "first to the least height");
        fly(&mut camera, 0.0, 0.0, -2.0);
        assert_eq!(camera.dive_m, 2.0);
        fly(&mut camera, 0.0, 0.0, -1e3);
        assert_eq!(camera.dive_m, MAX_DIVE_M);
        rotate_camera(&mut camera, 0.0, 200.0);
        assert_eq!(camera.pitch_deg, 89.0, "straight up");
        fly(&mut camera, 0.0, 0.0, 1e3);
        assert_eq!((camera.y_m, camera.dive_m), (MIN_EYE_HEIGHT_M, 0.0));
    }

    #[test]
    fn every_named_view_is_one_that_a_link_can_carry() {
        let mut params = Params::default();
        for view in CAMERA_VIEWS {
            set_named_view(&mut params, view);
            let state = crate::state::query::write(&params);
            let (read, notices) = crate::state::query::parse(&state);
            assert_eq!((read, notices), (params.clone(), vec![]), "{}", view.name);
        }
    }
}
