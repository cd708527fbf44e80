//! View and projection of the camera: reverse-Z depth, infinite far plane, looking along -z in view space.

use super::params::Camera;
use glam::{DMat3, DMat4, DVec3, DVec4};

/// Mean radius of the Earth, m.
pub const EARTH_RADIUS_M: f64 = 6_371_000.0;
/// Distance from the eye to the near clipping plane, m.
const NEAR_M: f64 = 0.1;

/// Least height of a diving eye above the mean level of the bed, m.
const BED_CLEARANCE_M: f64 = 0.4;

/// Greatest depth of a diving eye below the still water, m, in water that is `depth_m` deep.
pub fn deepest_dive_m(depth_m: f64) -> f64 {
    (depth_m - BED_CLEARANCE_M).max(0.1)
}

/// Position, axes and field of view of a camera, from which the renderer takes its matrices. The renderer draws
/// relative to the eye, so f32 suffices far from the world origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Position of the eye in world axes (x east, y up, z south), m.
    pub eye: DVec3,
    /// Unit vector towards the right edge of the picture, in world axes.
    pub right: DVec3,
    /// Unit vector towards the top edge of the picture, in world axes.
    pub up: DVec3,
    /// Unit vector of the viewing direction, in world axes.
    pub forward: DVec3,
    /// Tangents of half the horizontal and half the vertical field of view, in this order.
    pub tan_half_fov: [f64; 2],
}

impl View {
    /// Makes the view of a camera for a picture with `aspect` = width / height. An eye whose height y is below
    /// `min_eye_height_m`, m, is raised to it, unless it dives.
    pub fn new(camera: &Camera, aspect: f64, min_eye_height_m: f64) -> Self {
        let (heading, pitch) = (camera.heading_deg.to_radians(), camera.pitch_deg.to_radians());
        let forward = DVec3::new(heading.sin() * pitch.cos(), pitch.sin(), -heading.cos() * pitch.cos());
        let right = DVec3::new(heading.cos(), 0.0, heading.sin());
        let tan_y = (0.5 * camera.fov_deg.to_radians()).tan();
        let y_m = if camera.dive_m > 0.0 { -camera.dive_m } else { camera.y_m.max(min_eye_height_m) };
        Self {
            eye: DVec3::new(camera.x_m, y_m, camera.z_m),
            right,
            up: right.cross(forward),
            forward,
            tan_half_fov: [tan_y * aspect, tan_y],
        }
    }

    /// Matrix from positions relative to the eye (world axes, m) to clip coordinates, with depth 1 at the near plane
    /// and 0 at infinity.
    pub fn clip_from_relative(&self) -> DMat4 {
        let view = DMat4::from_mat3(DMat3::from_cols(self.right, self.up, -self.forward).transpose());
        let [tx, ty] = self.tan_half_fov;
        // Depth = near / distance: 1 at the near plane, 0 at infinity.
        let clip = DMat4::from_cols(
            DVec4::new(1.0 / tx, 0.0, 0.0, 0.0),
            DVec4::new(0.0, 1.0 / ty, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, -1.0),
            DVec4::new(0.0, 0.0, NEAR_M, 0.0),
        );
        clip * view
    }

    /// Unit vector (world axes) from the eye through a picture point: (-1, -1) is bottom left, (1, 1) top right.
    pub fn ray(&self, x: f64, y: f64) -> DVec3 {
        (self.forward + self.right * (x * self.tan_half_fov[0]) + self.up * (y * self.tan_half_fov[1])).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_minus_z_and_up_is_up() {
        let view = View::new(&Camera { heading_deg: 0.0, pitch_deg: 0.0, ..Camera::default() }, 1.5, 0.0);
        let ahead = view.clip_from_relative() * DVec4::new(0.0, 1.0, -10.0, 1.0);
        assert!(ahead.w > 0.0 && ahead.y > 0.0 && ahead.x.abs() < 1e-12);
        let east = view.clip_from_relative() * DVec4::new(1.0, 0.0, -10.0, 1.0);
        assert!(east.x > 0.0);
        assert!((ahead.z / ahead.w - 0.01).abs() < 1e-12, "reverse-Z: near / distance");
    }

    #[test]
    fn rays_agree_with_the_matrix() {
        let view = View::new(&Camera { heading_deg: 77.0, pitch_deg: -20.0, ..Camera::default() }, 1.7, 0.0);
        let p = view.clip_from_relative() * view.ray(0.3, -0.6).extend(1.0);
        assert!((p.x / p.w - 0.3).abs() < 1e-12 && (p.y / p.w + 0.6).abs() < 1e-12);
    }
}
