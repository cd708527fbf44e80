//! What the sky's passes are told, and the light on the sea that they find: WGSL `Sky` and `Light`.

use crate::gpu::layout::gpu_struct;
use crate::render::frame::dip;
use crate::render::scene::Scene;
use crate::state::fields::linear_rgb;
use crate::state::look::SkyLook;

/// The mirrored clouds move in steps of this length, km: less than a texel of the environment, and a step every few seconds.
const MIRROR_STEP_KM: f64 = 0.05;

gpu_struct! {
    /// WGSL `Fog`: height fog, of full density up to its top and falling off exponentially above.
    pub struct FogUniform as "Fog" {
        /// Extinction at full density, 1/m; 0 for no fog.
        extinction_per_m: f32,
        /// Distance from the eye at which the fog begins, m.
        start_m: f32,
        /// Height above the top over which the density falls to 1 / e, m.
        falloff_m: f32,
        /// Height of the top over the sea, m.
        top_m: f32,
    }
}

gpu_struct! {
    /// WGSL `Sky`: what the look-up tables of the sky depend on.
    pub struct SkyUniform as "Sky" {
        /// Unit vector to the sun.
        sun: [f32; 3],
        /// Aerosol relative to a clear day at sea.
        haze: f32,
        /// Colour of the sun and its strength relative to ours as seen from Earth, times `night_gain`.
        tint: [f32; 3],
        /// Angular radius of the sun's disc, rad.
        sun_radius: f32,
        /// Irradiance of the sun in a sky from a file, on a plane that faces it.
        file_sun: [f32; 3],
        /// 1 if a file stands for the sky, else 0.
        file: f32,
        /// Irradiance on the horizontal of the rest of that sky.
        file_sky: [f32; 3],
        /// From the numbers of the file to radiance.
        file_gain: f32,
        fog: FogUniform,
        /// Height of the eye over the sea, km.
        eye_km: f32,
        /// Angle from the horizontal down to the horizon, rad.
        dip: f32,
        /// Cover of low clouds, 0 to 1.
        overcast: f32,
        /// Exponent of the limb darkening.
        sun_falloff: f32,
        /// Distance that the clouds have drifted along x and z, km.
        drift: [f32; 2],
        /// Distance that the mirrored clouds have drifted, in steps, km.
        mirror_drift: [f32; 2],
        /// See [`night_gain`].
        night_gain: f32,
        /// Heading of the middle of the file, turns.
        turn: f32,
        unused: [u32; 2],
    }
}

impl SkyUniform {
    /// The uniform of a scene.
    pub fn new(scene: &Scene) -> Self {
        // Classes of the eye's height, a quarter of an octave apart: the air seen from within one is the same.
        let class = (4.0 * scene.view.eye.y.max(2.0).log2()).round() / 4.0;
        let mut sky = Self::of(&scene.look.sky, class.exp2());
        if sky.overcast > 0.0 {
            let km = scene.cloud_drift_m.map(|d| 0.001 * d);
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
        let file_gain = look.file_gain_ev.exp2();
        let scaled = |e: [f64; 3]| e.map(|e| (e * file_gain) as f32);
        Self {
            sun: look.sun_direction().map(|x| x as f32),
            haze: look.haze as f32,
            tint: linear_rgb(look.sun_colour).map(|c| (c * near * near * night_gain) as f32),
            sun_radius: look.sun_radius_rad() as f32,
            file_sun: file.and_then(|f| f.sun.as_ref()).map_or([0.0; 3], |s| scaled(s.irradiance)),
            file: f32::from(u8::from(file.is_some())),
            file_sky: file.map_or([0.0; 3], |f| scaled(f.irradiance)),
            file_gain: file_gain as f32,
            fog: FogUniform {
                extinction_per_m: (0.001 * look.fog_extinction_per_km) as f32,
                start_m: look.fog_start_m as f32,
                falloff_m: look.fog_falloff_m as f32,
                top_m: look.fog_height_m as f32,
            },
            eye_km: (0.001 * eye_m) as f32,
            dip: dip(eye_m) as f32,
            // The file has clouds of its own.
            overcast: if file.is_some() { 0.0 } else { look.overcast as f32 },
            sun_falloff: look.sun_falloff as f32,
            drift: [0.0; 2],
            mirror_drift: [0.0; 2],
            night_gain: night_gain as f32,
            turn: (look.file_heading_deg / 360.0) as f32,
            unused: [0; 2],
        }
    }
}

gpu_struct! {
    /// WGSL `Light`: the light on the sea, written by the GPU when the sky changes.
    pub struct LightBuffer as "Light" {
        /// Irradiance of the sun behind air, clouds and fog, on a plane that faces it.
        pub sun: [f32; 3],
        /// Automatic exposure.
        pub exposure: f32,
        /// Irradiance of the sky on the horizontal.
        pub sky: [f32; 3],
        /// Luminance that the exposure follows.
        pub key: f32,
        /// Radiance of an overcast deck at the zenith.
        pub deck: [f32; 3],
        /// Share of the sun's light that the clouds let through.
        pub direct: f32,
        /// Radiance that thick fog scatters from all around.
        pub fog_sky: [f32; 3],
        unused_0: u32,
        /// Irradiance of the sun in the middle of the fog.
        pub fog_sun: [f32; 3],
        unused_1: u32,
    }
}

/// Factor by which all light of dusk and night is carried brighter than it is, so that half floats hold it; the exposure
/// divides by it. A power of two, so that nothing is rounded.
pub fn night_gain(look: &SkyLook) -> f64 {
    let below_deg = if look.panorama().is_some() { 0.0 } else { -look.sun_place_deg()[0] };
    (1.2 * below_deg).clamp(0.0, 18.0).floor().exp2()
}
