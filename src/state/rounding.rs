//! Rounds camera and simulated time for links, so that a URL has no more digits than a person can see.

use super::Params;
use super::params::Camera;

/// Camera, and the simulated time in s if it is paused (`None` while it runs). The app compares two of these to see
/// whether the user has changed the view.
pub type CameraAndPausedTime = (Camera, Option<f64>);

/// Returns the camera of `params`, and their simulated time in s if it is paused, else `None`.
pub fn camera_pose(params: &Params) -> CameraAndPausedTime {
    (params.camera.clone(), params.clock.paused.then_some(params.clock.t_s))
}

/// Copy of the parameters for a link, rounded: camera (m, degrees) and running time (s) to one decimal, a depth to two, a
/// paused time to three decimals. All other parameters are unchanged.
pub fn with_rounded_pose(params: &Params) -> Params {
    let mut p = params.clone();
    // The quotient of two whole numbers is the f64 nearest to the decimal fraction, so its text is short.
    let round = |x: &mut f64, steps_per_unit: f64| *x = (*x * steps_per_unit).round() / steps_per_unit;
    // A paused time can be stepped by single frames of 1/60 s, so it needs milliseconds.
    round(&mut p.clock.t_s, if p.clock.paused { 1000.0 } else { 10.0 });
    let c = &mut p.camera;
    for value in [&mut c.x_m, &mut c.y_m, &mut c.z_m, &mut c.heading_deg, &mut c.pitch_deg, &mut c.fov_deg] {
        round(value, 10.0);
    }
    // Centimetres decide which part of the picture lies under water.
    round(&mut c.dive_m, 100.0);
    p
}
