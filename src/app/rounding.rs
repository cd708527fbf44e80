//! The precision of links: camera and time are rounded to the digits that a person can see.

use super::App;
use crate::state::Params;
use crate::state::params::Camera;

/// The camera, and the time while it is stopped, s.
pub type Pose = (Camera, Option<f64>);

/// The values that [`App::round_when_idle`] rounds.
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

impl App {
    /// Rounds camera and stopped time once no input moves them, so that the picture is exactly the one that a link opens.
    pub(super) fn round_when_idle(&mut self, ctx: &egui::Context) {
        if ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty() || i.any_touches()) {
            return;
        }
        // More digits in a link are kept until the user moves the camera.
        if self.idle_pose.as_ref() == Some(&pose(&self.params)) {
            return;
        }
        let rounded = rounded(&self.params);
        self.params.camera = rounded.camera;
        if self.params.clock.paused {
            self.params.clock.t_s = rounded.clock.t_s;
        }
        self.idle_pose = Some(pose(&self.params));
    }
}
