//! The precision of links: camera and time are rounded to the digits that a person can see.

use super::Params;
use super::params::Camera;

/// The camera, and the time while it is stopped, s.
pub type Pose = (Camera, Option<f64>);

/// Camera and stopped time of the parameters.
pub fn pose(params: &Params) -> Pose {
    (params.camera.clone(), params.clock.paused.then_some(params.clock.t_s))
}

/// The parameters as a link writes them: camera and running time to one decimal, a stopped time to three.
pub fn rounded(params: &Params) -> Params {
    let mut p = params.clone();
    // Dividing whole numbers gives the double whose shortest text is the decimal fraction.
    let round = |x: &mut f64, steps_per_unit: f64| *x = (*x * steps_per_unit).round() / steps_per_unit;
    // Single frames of a stopped time differ by 1/60 s.
    round(&mut p.clock.t_s, if p.clock.paused { 1000.0 } else { 10.0 });
    let c = &mut p.camera;
    for value in [&mut c.x_m, &mut c.y_m, &mut c.z_m, &mut c.heading_deg, &mut c.pitch_deg, &mut c.fov_deg] {
        round(value, 10.0);
    }
    p
}
