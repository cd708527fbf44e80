//! Uniform buffer of the sky passes (WGSL `Sky`), and the light on the sea that they compute (WGSL `Light`).

use crate::gpu::layout::gpu_struct;
use crate::render::frame::dip;
use crate::render::scene::Scene;
use crate::state::fields::linear_rgb;
use crate::state::look::SkyLook;

/// Step by which the clouds in reflections move, km: less than a texel of the environment map; it lasts seconds.
const MIRROR_STEP_KM: f64 = 0.05;

gpu_struct! {
    /// WGSL `Fog`: fog of constant density up to a height, with an exponential decrease above.
    pub struct FogUniform as "Fog" {
        /// Extinction coefficient below the top of the fog, 1/m; 0 without fog.
        extinction_per_m: f32,
        /// Distance from the eye at which the fog begins, m.
        start_m: f32,
        /// Height above the top of the fog over which its density falls to 1/e, m.
        falloff_m: f32,
        /// Height above the water up to which the fog has its full density, m.
        top_m: f32,
    }
}

gpu_struct! {
    /// WGSL `Sky`: uniform buffer on which the look-up tables of the sky depend.
    pub struct SkyUniform as "Sky" {
        /// Unit vector towards the sun.
        sun: [f32; 3],
        /// Amount of aerosol relative to a clear day at sea.
        haze: f32,
        /// Linear RGB colour of the sun, times its irradiance relative to the real sun at Earth, times `night_gain`.
        tint: [f32; 3],
        /// Angular radius of the sun's disc, rad.
        sun_radius: f32,
        /// Irradiance by the sun of a sky image, linear RGB, on a plane that faces this sun.
        file_sun: [f32; 3],
        /// 1 if the sky is an image from a file, else 0.
        file: f32,
        /// Irradiance of a horizontal plane by the sky image without its sun, linear RGB.
        file_sky: [f32; 3],
        /// Factor from the values of the sky image to radiance.
        file_gain: f32,
        fog: FogUniform,
        /// Height of the eye above the sea, km.
        eye_km: f32,
        /// Angle from the horizontal down to the visible horizon, rad.
        dip: f32,
        /// Cover of low clouds, 0 (clear) to 1 (closed deck).
        overcast: f32,
        /// Exponent of the limb darkening of the sun's disc.
        sun_falloff: f32,
        /// Distance by which the clouds have drifted along x and z, km.
        drift: [f32; 2],
        /// Distance by which the clouds in reflections have drifted along x and z, in coarse steps, km.
        mirror_drift: [f32; 2],
        /// Factor by which light is scaled up at dusk and night; see [`night_gain`].
        night_gain: f32,
        /// Heading of the middle column of the sky image, turns clockwise from north.
        turn: f32,
        unused: [u32; 2],
    }
}

impl SkyUniform {
    /// Values of the sky's uniform buffer for a scene.
    pub fn new(scene: &Scene) -> Self {
        // The eye's height is rounded to a quarter octave, so that small movements do not recompute the tables.
        let class = (4.0 * scene.view.eye.y.max(2.0).log2()).round() / 4.0;
        let mut sky = Self::of(&scene.look.sky, class.exp2());
        if sky.overcast > 0.0 {
            let km = scene.cloud_drift_m.map(|d| 0.001 * d);
            sky.drift = km.map(|d| d as f32);
            sky.mirror_drift = km.map(|d| ((d / MIRROR_STEP_KM).round() * MIRROR_STEP_KM) as f32);
        }
        sky
    }

    /// Whether `other` has the same tables of transmittance and multiple scattering.
    pub fn has_air_of(&self, other: &Self) -> bool {
        [self.haze, self.sun_radius] == [other.haze, other.sun_radius]
    }

    /// Whether `other` has the same look-up tables; the clouds of its background may have drifted.
    pub fn lights_like(&self, other: &Self) -> bool {
        Self { drift: other.drift, ..*self } == *other
    }

    /// The uniform of a sky seen from the height `eye_m` above the sea, m, before its clouds drift.
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
                falloff_m: look.fog_scale_height_m as f32,
                top_m: look.fog_top_m as f32,
            },
            eye_km: (0.001 * eye_m) as f32,
            dip: dip(eye_m) as f32,
            // A sky image contains its own clouds.
            overcast: if file.is_some() { 0.0 } else { look.overcast as f32 },
            sun_falloff: look.limb_darkening_exponent as f32,
            drift: [0.0; 2],
            mirror_drift: [0.0; 2],
            night_gain: night_gain as f32,
            turn: (look.file_heading_deg / 360.0) as f32,
            unused: [0; 2],
        }
    }
}

gpu_struct! {
    /// WGSL `Light`: the light on the sea, computed on the GPU when the sky changes. An irradiance of 1 is 6400 lux.
    pub struct LightBuffer as "Light" {
        /// Irradiance by the sun on a plane that faces it, after air, clouds and fog.
        pub sun: [f32; 3],
        /// Automatic exposure: factor from radiance to the input of the tone curve.
        pub exposure: f32,
        /// Irradiance of a horizontal plane by the sky without the sun.
        pub sky: [f32; 3],
        /// Luminance that determines the automatic exposure.
        pub key: f32,
        /// Radiance of a closed cloud deck at the zenith.
        pub deck: [f32; 3],
        /// Fraction of the sunlight that passes through the clouds, 0 to 1.
        pub direct: f32,
        /// Radiance of dense fog lit by the sky, equal in all directions.
        pub fog_sky: [f32; 3],
        unused_0: u32,
        /// Irradiance by the sun at half the height of the fog, on a plane that faces the sun.
        pub fog_sun: [f32; 3],
        unused_1: u32,
    }
}

/// Factor by which all light is scaled up at dusk and night, so that half floats can hold it; the exposure divides by
/// it. It is a power of two, so that scaling does not round.
pub fn night_gain(look: &SkyLook) -> f64 {
    let below_deg = if look.panorama().is_some() { 0.0 } else { -look.sun_elevation_azimuth_deg()[0] };
    (1.2 * below_deg).clamp(0.0, 18.0).floor().exp2()
}
