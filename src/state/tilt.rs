//! A view that follows how a device is held.

use super::params::Camera;

/// Least horizontal part of the direction of sight for which its compass heading is known.
const LEAST_HORIZONTAL: f64 = 0.1;
/// Steepest pitch of the camera, degrees.
const MAX_PITCH_DEG: f64 = 89.0;

/// Direction of sight of a device through its back: compass heading, clockwise from north, `None` if it looks nearly
/// straight up or down; and pitch above the horizontal, both in degrees. The angles are those of the browser's event
/// `deviceorientation` (W3C, Device Orientation and Motion), degrees: the device is turned by `alpha` around its z axis,
/// which comes out of the screen, then by `beta` around its x axis, which goes to the right, then by `gamma` around its
/// y axis, which goes up the screen.
fn direction_of_sight_deg([alpha, beta, gamma]: [f64; 3]) -> (Option<f64>, f64) {
    let [(sin_a, cos_a), (sin_b, cos_b), (sin_g, cos_g)] = [alpha, beta, gamma].map(|deg| deg.to_radians().sin_cos());
    let east = -sin_g * cos_a - cos_g * sin_b * sin_a;
    let north = -sin_g * sin_a + cos_g * sin_b * cos_a;
    let up = -cos_g * cos_b;
    let heading = east.atan2(north).to_degrees().rem_euclid(360.0);
    ((east.hypot(north) >= LEAST_HORIZONTAL).then_some(heading), up.clamp(-1.0, 1.0).asin().to_degrees())
}

/// A view that follows the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// Heading and pitch to return to, degrees.
    before_deg: [f64; 2],
    /// Heading of the view minus that of the device, degrees; `None` before the first reading with a heading.
    offset_deg: Option<f64>,
    /// Heading that the last reading gave the view, degrees.
    last_deg: f64,
}

impl Following {
    /// Begins with the view of `camera`.
    pub fn new(camera: &Camera) -> Self {
        let before_deg = [camera.heading_deg, camera.pitch_deg];
        Self { before_deg, offset_deg: None, last_deg: camera.heading_deg }
    }

    /// Makes the camera look as the device does whose angles are `angles_deg`, those of the browser's event
    /// `deviceorientation`, degrees. The heading begins as it was: what the view showed at first is in front. A drag in
    /// between turns the view.
    pub fn follow(&mut self, camera: &mut Camera, angles_deg: [f64; 3]) {
        if !angles_deg.iter().all(|angle| angle.is_finite()) {
            return;
        }
        let (heading, pitch) = direction_of_sight_deg(angles_deg);
        if let Some(heading) = heading {
            let offset = match self.offset_deg {
                Some(offset) => offset + camera.heading_deg - self.last_deg,
                None => camera.heading_deg - heading,
            };
            camera.heading_deg = (heading + offset).rem_euclid(360.0);
            (self.offset_deg, self.last_deg) = (Some(offset), camera.heading_deg);
        }
        camera.pitch_deg = pitch.clamp(-MAX_PITCH_DEG, MAX_PITCH_DEG);
    }

    /// Gives the camera back the view with which this began.
    pub fn give_back(&self, camera: &mut Camera) {
        [camera.heading_deg, camera.pitch_deg] = self.before_deg;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: (Option<f64>, f64), want: (f64, f64)) {
        let (heading, pitch) = (found.0.expect("a heading"), found.1);
        let turned = (heading - want.0 + 180.0).rem_euclid(360.0) - 180.0;
        assert!(turned.abs() < 1e-9 && (pitch - want.1).abs() < 1e-9, "{found:?} instead of {want:?}");
    }

    #[test]
    fn a_held_device_looks_through_its_back() {
        // Upright, the top of the screen up: it looks at the horizon, and alpha turns it counter-clockwise.
        close(direction_of_sight_deg([0.0, 90.0, 0.0]), (0.0, 0.0));
        close(direction_of_sight_deg([90.0, 90.0, 0.0]), (270.0, 0.0));
        // Leaned back, it looks down; leaned forward, up.
        close(direction_of_sight_deg([0.0, 60.0, 0.0]), (0.0, -30.0));
        close(direction_of_sight_deg([30.0, 120.0, 0.0]), (330.0, 30.0));
        // On its side, the left edge down: gamma is -90 degrees where the device looks at the horizon.
        close(direction_of_sight_deg([0.0, 0.0, -90.0]), (90.0, 0.0));
        close(direction_of_sight_deg([0.0, 0.0, -60.0]), (90.0, -30.0));
        close(direction_of_sight_deg([0.0, 0.0, 60.0]), (270.0, -30.0));
        // Flat on a table, it looks straight down, and no heading is known.
        assert_eq!(direction_of_sight_deg([70.0, 0.0, 0.0]), (None, -90.0));
    }

    #[test]
    fn the_view_begins_where_it_was_follows_and_takes_drags() {
        let mut camera = Camera { heading_deg: 200.0, pitch_deg: -4.0, ..Camera::default() };
        let mut tilt = Following::new(&camera);
        tilt.follow(&mut camera, [70.0, 85.0, 0.0]);
        assert!((camera.heading_deg - 200.0).abs() < 1e-9 && (camera.pitch_deg + 5.0).abs() < 1e-9, "{camera:?}");
        // Turned by 20 degrees to the right.
        tilt.follow(&mut camera, [50.0, 85.0, 0.0]);
        assert!((camera.heading_deg - 220.0).abs() < 1e-9, "{camera:?}");
        // A drag of 170 degrees stays.
        camera.heading_deg = 30.0;
        tilt.follow(&mut camera, [40.0, 85.0, 0.0]);
        assert!((camera.heading_deg - 40.0).abs() < 1e-9, "{camera:?}");
        // Straight down the heading stays, and impossible readings change nothing.
        tilt.follow(&mut camera, [40.0, 0.0, 0.0]);
        assert!((camera.heading_deg - 40.0).abs() < 1e-9 && camera.pitch_deg == -MAX_PITCH_DEG, "{camera:?}");
        let before = camera.clone();
        tilt.follow(&mut camera, [f64::NAN, 85.0, 0.0]);
        assert_eq!(camera, before);
        tilt.give_back(&mut camera);
        assert_eq!([camera.heading_deg, camera.pitch_deg], [200.0, -4.0]);
    }
}
