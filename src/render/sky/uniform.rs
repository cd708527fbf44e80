//! What the sky's passes are told, and the light on the sea that they find: WGSL `Sky` and `Light`.

use crate::gpu::layout::gpu_struct;
use crate::render::frame::dip;
use crate::render::scene::Scene;
use crate::state::fields::linear_rgb;
use crate::state::look::SkyLook;

/// The mirrored clouds move in steps of this length, km: less than a texel of the environment, and a step every few seconds.
const MIRROR_STEP_KM: f64 = 0.05;

gpu_struct! {
    /// WGSL `Sky`.
    pub struct SkyUniform as "Sky" {
        sun: [f32; 3],
        haze: f32,
        tint: [f32; 3],
        sun_radius: f32,
        file_sun: [f32; 3],
        file: f32,
        file_sky: [f32; 3],
        file_gain: f32,
        fog: [f32; 4],
        eye_km: f32,
        dip: f32,
        overcast: f32,
        sun_falloff: f32,
        drift: [f32; 2],
        mirror_drift: [f32; 2],
        night_gain: f32,
        turn: f32,
        unused: [f32; 2],
    }
}

impl SkyUniform {
    /// The uniform of a scene.
    pub fn new(scene: &Scene) -> Self {
        // Classes of the eye's height, a quarter of an octave apart: the air seen from within one is the same.
        let class = (4.0 * scene.view.eye.y.max(2.0).log2()).round() / 4.0;
        let mut sky = Self::of(&scene.look.sky, class.exp2());
        if sky.overcast > 0.0 {
            let km = scene.sea.cloud_drift_m.map(|d| 0.001 * d);
            sky.drift = km.map(|d| d as f32);
            sky.mirror_drift = km.map(|d| ((d / MIRROR_STEP_KM).round() * MIRROR_STEP_KM) as f32);
        }
        sky
    }

    /// Whether the tables of this sky's air are those of another's.
    pub fn has_air_of(&self, other: &Self) -> bool {
        [self.haze, self.sun_radius] == [other.haze, other.sun_radius]
    }

    /// Whether all tables are those of another sky: the clouds of the background may have drifted.
    pub fn lights_like(&self, other: &Self) -> bool {
        Self { drift: other.drift, ..*self } == *other
    }

    /// The uniform of a sky seen from a height above the sea, its clouds at their origin.
    pub fn of(look: &SkyLook, eye_m: f64) -> Self {
        let night_gain = night_gain(look);
        let near = look.sun_distance_au.recip();
        let file = look.panorama();
        let file_gain = look.gain_ev.exp2();
        let scaled = |e: [f64; 3]| e.map(|e| (e * file_gain) as f32);
        let fog = &look.fog;
        Self {
            sun: look.sun_direction().map(|x| x as f32),
            haze: look.haze as f32,
            tint: linear_rgb(look.sun_colour).map(|c| (c * near * near * night_gain) as f32),
            sun_radius: look.sun_radius_rad() as f32,
            file_sun: file.and_then(|f| f.sun.as_ref()).map_or([0.0; 3], |s| scaled(s.irradiance)),
            file: f32::from(u8::from(file.is_some())),
            file_sky: file.map_or([0.0; 3], |f| scaled(f.irradiance)),
            file_gain: file_gain as f32,
            fog: [
                (0.001 * fog.extinction_per_km) as f32,
                fog.start_m as f32,
                fog.falloff_m as f32,
                fog.height_m as f32,
            ],
            eye_km: (0.001 * eye_m) as f32,
            dip: dip(eye_m) as f32,
            // The file has clouds of its own.
            overcast: if file.is_some() { 0.0 } else { look.overcast as f32 },
            sun_falloff: look.sun_falloff as f32,
            drift: [0.0; 2],
            mirror_drift: [0.0; 2],
            night_gain: night_gain as f32,
            turn: (look.turn_deg / 360.0) as f32,
            unused: [0.0; 2],
        }
    }
}

gpu_struct! {
    /// WGSL `Light`: written by the GPU alone.
    pub struct LightBuffer as "Light" {
        pub sun: [f32; 3],
        pub exposure: f32,
        pub sky: [f32; 3],
        pub key: f32,
        pub deck: [f32; 3],
        pub direct: f32,
        pub fog_sky: [f32; 3],
        pub unused_0: f32,
        pub fog_sun: [f32; 3],
        pub unused_1: f32,
    }
}

/// Factor by which all light of dusk and night is carried brighter than it is, so that half floats hold it; the exposure
/// divides by it. A power of two, so that nothing is rounded.
pub fn night_gain(look: &SkyLook) -> f64 {
    let below_deg = if look.panorama().is_some() { 0.0 } else { -look.sun_place_deg()[0] };
    (1.2 * below_deg).clamp(0.0, 18.0).floor().exp2()
}
