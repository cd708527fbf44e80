//! Simple bodies in the shape of the floating objects. The water mirrors them and lies in their shadow
//! (shaders/water/hull_image.wgsl).

use crate::gpu::layout::gpu_struct;
use crate::point::floating::HullPose;
use crate::render::scene::Scene;
use crate::state::floats::{FloatingObjectKind, MAX_FLOATING_OBJECTS};
use glam::DVec3;
use std::f64::consts::TAU;

/// Largest number of sections of a body.
const MAX_HULL_SECTIONS: usize = 10;

gpu_struct! {
    /// WGSL `HullSection`: an ellipse that a floating object fills at one height, and the paint from there up to the
    /// next section.
    #[derive(Default)]
    pub struct HullSection as "HullSection" {
        /// Middle of the ellipse: x and z relative to the point below the eye, and height y above the still water, m.
        middle: [f32; 3],
        /// Half the length of the ellipse along the hull, m.
        half_length_m: f32,
        /// Half its width, m.
        half_width_m: f32,
        /// Paint, as `HullFacet::colour`.
        colour: u32,
        unused: [u32; 2],
    }
}

gpu_struct! {
    /// WGSL `HullImage`: a body that stands for a floating object, a stack of sections from below the water line up.
    #[derive(Default)]
    pub struct HullImage as "HullImage" {
        /// Position of the hull: x and z relative to the point below the eye, and height y above the still water, m.
        origin: [f32; 3],
        /// Radius of a vertical cylinder that contains the object, m.
        radius_m: f32,
        /// Horizontal unit vector (x, z) towards the bow.
        ahead: [f32; 2],
        /// 1 for a body of revolution, 0 for a hull whose sides look across.
        roundness: f32,
        section_count: u32,
        /// Speed through the water, m/s.
        speed_m_s: f32,
        /// Fraction of the water that foam covers right at the water line.
        line_foam: f32,
        /// Phase of the ripples around the hull, rad.
        ripple_phase: f32,
        /// Distance by which the water has moved astern, m.
        drift_m: f32,
        sections: [HullSection; MAX_HULL_SECTIONS],
    }
}

gpu_struct! {
    /// WGSL `HullImages`: the bodies that stand for all floating objects.
    #[derive(Default)]
    pub struct HullImages as "HullImages" {
        count: u32,
        unused: [u32; 3],
        hulls: [HullImage; MAX_FLOATING_OBJECTS],
    }
}

/// A section in the axes of a hull (x to starboard, y up, z to the stern): height, middle along x and z, half length and
/// half width, m, and paint.
type Section = (f64, [f64; 2], [f64; 2], u32);

const YELLOW: u32 = 0x0014_b0e8;
const RED: u32 = 0x0020_2ab0;
const WHITE: u32 = 0x00e8_ecec;
const NAVY: u32 = 0x0058_3418;
const DARK: u32 = 0x0040_4848;
const ANTIFOULING: u32 = 0x0080_6050;
/// Sailcloth, which lets light through.
const SAIL: u32 = 0x73e4_eef0;

const BUOY: &[Section] = &[
    (-0.4, [0.0; 2], [0.75, 0.75], DARK),
    (0.0, [0.0; 2], [0.95, 0.95], YELLOW),
    (0.42, [0.0; 2], [0.95, 0.95], YELLOW),
    (0.6, [0.0; 2], [0.6, 0.6], YELLOW),
    (0.61, [0.0; 2], [0.32, 0.32], YELLOW),
    (1.5, [0.0; 2], [0.16, 0.16], RED),
    (2.2, [0.0; 2], [0.12, 0.12], WHITE),
    (2.74, [0.0; 2], [0.15, 0.15], WHITE),
];

const BOAT: &[Section] = &[
    (-0.2, [0.0, 0.2], [2.9, 0.75], DARK),
    (0.0, [0.0, 0.2], [3.3, 0.9], WHITE),
    (0.62, [0.0, 0.15], [3.5, 1.02], WHITE),
    (0.75, [0.0, -1.0], [2.3, 0.8], WHITE),
    (1.05, [0.0, -3.2], [0.2, 0.05], WHITE),
];

/// Hull, cabin and sails of the yacht as src/render/water/yacht_shape.rs draws them.
const YACHT: &[Section] = &[
    (-0.3, [0.0, 0.1], [4.6, 1.1], ANTIFOULING),
    (0.1, [0.0, 0.1], [5.1, 1.45], WHITE),
    (0.85, [0.0, -0.05], [5.4, 1.7], NAVY),
    (1.1, [0.0, -0.1], [5.5, 1.72], WHITE),
    (1.3, [0.0, -1.8], [3.6, 1.0], WHITE),
    (1.7, [0.55, -1.8], [3.5, 0.9], SAIL),
    (2.3, [0.75, -0.7], [4.3, 0.75], SAIL),
    (7.5, [0.7, -1.0], [2.4, 0.6], SAIL),
    (13.0, [0.3, -0.45], [0.75, 0.3], SAIL),
    (15.0, [0.0, -0.85], [0.08, 0.06], WHITE),
];

/// Angular frequency of ripples of 0.55 m, rad/s.
const RIPPLE_RAD_S: f64 = 10.6;
/// Distance after which the pattern of the foam in a wake starts anew, m.
pub const DRIFT_PERIOD_M: f64 = 65_536.0;

/// Speed through the water of a yacht of 11 m that sails close-hauled, m/s. Above some 3.3 m/s its own waves hold it.
pub fn yacht_speed_m_s(wind_m_s: f64) -> f64 {
    3.3 * (1.0 - (-wind_m_s / 5.0).exp())
}

fn sections(kind: FloatingObjectKind) -> &'static [Section] {
    match kind {
        FloatingObjectKind::Buoy => BUOY,
        FloatingObjectKind::Boat => BOAT,
        FloatingObjectKind::Yacht => YACHT,
    }
}

impl HullImage {
    fn new(pose: &HullPose, scene: &Scene) -> Self {
        let (below_eye, level_m) = ([scene.view.eye.x, scene.view.eye.z], scene.sea.still_water_level_m);
        let [x, y, z] = pose.position_m;
        let origin = DVec3::new(x - below_eye[0], y - level_m, z - below_eye[1]);
        let [up, forward] = [pose.up, pose.forward].map(DVec3::from_array);
        let starboard = forward.cross(up);
        let ahead = DVec3::new(forward.x, 0.0, forward.z).normalize_or(DVec3::NEG_Z);
        let shape = sections(pose.kind);
        let speed_m_s = match pose.kind {
            FloatingObjectKind::Yacht => yacht_speed_m_s(scene.sea.wind_m_s),
            FloatingObjectKind::Buoy | FloatingObjectKind::Boat => 0.0,
        };
        let mut image = Self {
            origin: origin.as_vec3().to_array(),
            ahead: [ahead.x as f32, ahead.z as f32],
            roundness: f32::from(u8::from(pose.kind == FloatingObjectKind::Buoy)),
            section_count: shape.len() as u32,
            speed_m_s: speed_m_s as f32,
            line_foam: (0.12 * (scene.sea.wind_m_s - 1.0)).clamp(0.0, 0.7) as f32,
            ripple_phase: (RIPPLE_RAD_S * scene.t_s).rem_euclid(TAU) as f32,
            drift_m: (speed_m_s * scene.t_s).rem_euclid(DRIFT_PERIOD_M) as f32,
            ..Self::default()
        };
        let mut radius_m: f64 = 0.0;
        for (section, &(height_m, [right, astern], [half_length_m, half_width_m], colour)) in
            image.sections.iter_mut().zip(shape)
        {
            // A yacht that heels dips its wide side to leeward, so that its outline at the water is narrower and lies
            // there.
            let dips = if speed_m_s > 0.0 && height_m < 0.2 { -starboard.y } else { 0.0 };
            let (right, half_width_m) = (right + 0.9 * dips, half_width_m - 0.6 * dips.abs());
            let off = starboard * right + up * height_m - forward * astern;
            radius_m = radius_m.max(off.x.hypot(off.z) + half_length_m);
            *section = HullSection {
                middle: (origin + off).as_vec3().to_array(),
                half_length_m: half_length_m as f32,
                half_width_m: half_width_m as f32,
                colour,
                unused: [0; 2],
            };
        }
        image.radius_m = radius_m as f32;
        image
    }
}

impl HullImages {
    /// The bodies of the floating objects of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut images = Self { count: scene.hulls.len().min(MAX_FLOATING_OBJECTS) as u32, ..Self::default() };
        for (image, pose) in images.hulls.iter_mut().zip(&scene.hulls) {
            *image = HullImage::new(pose, scene);
        }
        images
    }
}
