//! Uniform buffer of the sky passes (WGSL `Sky`), and the light on the sea that they compute (WGSL `Light`).

use crate::gpu::layout::gpu_struct;
use crate::optics::rain;
use crate::render::frame::horizon_dip;
use crate::render::scene::Scene;
use crate::state::fields::linear_rgb;
use crate::state::look::{CloudKind, SkyLook};

/// Step in which clouds move in the environment map (the sky that the sea reflects), km. It is less than a texel, and
/// clouds take seconds to drift so far, so the map is computed again only every few seconds.
const REFLECTED_CLOUD_STEP_KM: f64 = 0.05;
/// Height up to which rain hides what is behind it, m, and the height over which it thins above. Rain falls from higher
/// up, but drops scatter light by small angles, which blurs a wave far away and not a cloud.
const RAIN_TOP_M: f64 = 50.0;
const RAIN_SCALE_HEIGHT_M: f64 = 30.0;

gpu_struct! {
    /// WGSL `Fog`: fog of constant density up to a height, with an exponential decrease above.
    pub struct FogUniform as "Fog" {
        /// Extinction coefficient below the top of the fog, 1/m; 0 without fog.
        extinction_per_m: f32,
        /// Distance from the eye at which the fog begins, m; nearer air is clear.
        start_m: f32,
        /// Scale height, m. The fog is uniform up to its top; above the top its density falls to 1/e over this height.
        scale_height_m: f32,
        /// Height above the water up to which the fog has its full density, m.
        top_m: f32,
    }
}

impl FogUniform {
    /// Fog and rain in one layer, whose shape is the mean of theirs, weighted by their extinctions.
    fn new(look: &SkyLook) -> Self {
        let fog = 0.001 * look.fog_extinction_per_km;
        let rain = rain::extinction_per_m(look.rain_mm_h);
        let rain_share = rain_share(look);
        let mean = |of_fog: f64, of_rain: f64| (of_fog + rain_share * (of_rain - of_fog)) as f32;
        Self {
            extinction_per_m: (fog + rain) as f32,
            start_m: mean(look.fog_start_m, 0.0),
            scale_height_m: mean(look.fog_scale_height_m, RAIN_SCALE_HEIGHT_M),
            top_m: mean(look.fog_top_m, RAIN_TOP_M),
        }
    }
}

/// Share of the rain in the extinction of fog and rain together, 0 to 1.
fn rain_share(look: &SkyLook) -> f64 {
    let rain = rain::extinction_per_m(look.rain_mm_h);
    if rain > 0.0 { rain / (0.001 * look.fog_extinction_per_km + rain) } else { 0.0 }
}

/// Linear RGB colour of the light that fog and rain scatter; rain is white.
fn fog_tint(look: &SkyLook) -> [f32; 3] {
    linear_rgb(look.fog_colour).map(|c| (c + rain_share(look) * (1.0 - c)) as f32)
}

gpu_struct! {
    /// WGSL `Sky`: uniform buffer of the passes that compute the sky's look-up tables: sun, air, fog, clouds, image.
    pub struct SkyUniform as "Sky" {
        /// Unit vector towards the sun.
        sun_direction: [f32; 3],
        /// Amount of aerosol in the air, relative to that of a clear day at sea.
        haze: f32,
        /// Linear RGB colour of the sun from the settings, divided by its squared distance in au, times `night_gain`.
        sun_tint: [f32; 3],
        /// Angular radius of the sun's disc, rad.
        sun_radius_rad: f32,
        /// Irradiance by the sun in the sky image on a plane that faces it: linear RGB, in units of 6400 lux.
        image_sun_irradiance: [f32; 3],
        /// 1 if the sky is an image from a file, else 0.
        has_image: f32,
        /// Irradiance of a horizontal plane by the sky image without its sun: linear RGB, in units of 6400 lux.
        image_sky_irradiance: [f32; 3],
        /// Factor, from the brightness setting, that turns values of the sky image into radiance (unit: 6400 cd/m2).
        image_gain: f32,
        fog: FogUniform,
        /// Height of the eye above the sea, km, in steps of 19 %, so that small movements leave the tables valid.
        eye_height_km: f32,
        /// Angle from the horizontal down to the visible horizon, rad.
        horizon_dip: f32,
        /// Cover of low clouds, 0 (clear) to 1 (closed deck); 0 with a sky image, which has its own clouds.
        overcast: f32,
        /// Limb darkening: at an emission angle a, the radiance of the sun's disc is that at its centre times cos(a) to
        /// this power; 0 is none.
        limb_darkening_exponent: f32,
        /// Distance by which the clouds have drifted along x and z since time 0, km.
        cloud_drift_km: [f32; 2],
        /// Cloud drift (x, z), km, for reflections: rounded to multiples of [`REFLECTED_CLOUD_STEP_KM`].
        reflected_cloud_drift_km: [f32; 2],
        /// Factor by which all light is scaled up at dusk and night; see [`night_gain`].
        night_gain: f32,
        /// Heading of the middle column of the sky image, as a fraction of a turn clockwise from north.
        image_heading_turns: f32,
        /// Unit vector (x, z) of the sun's azimuth.
        sun_heading: [f32; 2],
        /// 1 if there are volumetric clouds, else 0.
        has_cloud_dome: f32,
        /// Red, green and blue part of the light that the fog scatters, from the setting of its colour; 1 is white.
        fog_red: f32,
        fog_green: f32,
        fog_blue: f32,
        /// Part of the extinction coefficient of the fog that is by raindrops, which make the rainbow, 1/m.
        rain_extinction_per_m: f32,
        unused: [u32; 3],
    }
}

impl SkyUniform {
    /// Values of the sky's uniform buffer for a scene.
    pub fn new(scene: &Scene) -> Self {
        // The eye's height is rounded to a quarter octave, so that small movements do not recompute the tables.
        let class = (4.0 * scene.view.eye.y.max(2.0).log2()).round() / 4.0;
        let mut sky = Self::for_look(&scene.look.sky, class.exp2());
        if sky.overcast > 0.0 && sky.has_cloud_dome == 0.0 {
            let km = scene.cloud_drift_m.map(|d| 0.001 * d);
            sky.cloud_drift_km = km.map(|d| d as f32);
            sky.reflected_cloud_drift_km =
                km.map(|d| ((d / REFLECTED_CLOUD_STEP_KM).round() * REFLECTED_CLOUD_STEP_KM) as f32);
        }
        sky
    }

    /// Whether the tables of transmittance and multiple scattering computed for `self` are also right for `other`.
    pub fn same_air_tables_as(&self, other: &Self) -> bool {
        [self.haze, self.sun_radius_rad] == [other.haze, other.sun_radius_rad]
    }

    /// Whether all look-up tables that were computed for `self` are also right for `other`. Ignores `cloud_drift_km`,
    /// because it moves only the clouds drawn behind the sea, which are in no table.
    pub fn same_tables_as(&self, other: &Self) -> bool {
        Self { cloud_drift_km: other.cloud_drift_km, ..*self } == *other
    }

    /// Unit vector towards the sun.
    pub fn sun_direction(&self) -> [f32; 3] {
        self.sun_direction
    }

    /// A copy without the values that volumetric clouds do not depend on.
    pub fn for_clouds(&self) -> Self {
        let none = [0.0; 2];
        Self {
            cloud_drift_km: none,
            reflected_cloud_drift_km: none,
            eye_height_km: 0.0,
            horizon_dip: 0.0,
            fog: FogUniform { extinction_per_m: 0.0, start_m: 0.0, scale_height_m: 0.0, top_m: 0.0 },
            fog_red: 1.0,
            fog_green: 1.0,
            fog_blue: 1.0,
            rain_extinction_per_m: 0.0,
            ..*self
        }
    }

    /// Values of the uniform for the sky settings `look`, `eye_m` metres above the sea, with the clouds of time 0.
    pub fn for_look(look: &SkyLook, eye_m: f64) -> Self {
        let night_gain = night_gain(look);
        let sun = look.sun_direction();
        let near = look.sun_distance_au.recip();
        let file = look.panorama();
        let image_gain = look.file_gain_ev.exp2();
        let scaled = |e: [f64; 3]| e.map(|e| (e * image_gain) as f32);
        let [fog_red, fog_green, fog_blue] = fog_tint(look);
        Self {
            sun_direction: sun.map(|x| x as f32),
            haze: look.haze as f32,
            sun_tint: linear_rgb(look.sun_colour).map(|c| (c * near * near * night_gain) as f32),
            sun_radius_rad: look.sun_radius_rad() as f32,
            image_sun_irradiance: file.and_then(|f| f.sun.as_ref()).map_or([0.0; 3], |s| scaled(s.irradiance)),
            has_image: f32::from(u8::from(file.is_some())),
            image_sky_irradiance: file.map_or([0.0; 3], |f| scaled(f.irradiance)),
            image_gain: image_gain as f32,
            fog: FogUniform::new(look),
            eye_height_km: (0.001 * eye_m) as f32,
            horizon_dip: horizon_dip(eye_m) as f32,
            // A sky image contains its own clouds.
            overcast: if file.is_some() { 0.0 } else { look.overcast as f32 },
            limb_darkening_exponent: look.limb_darkening_exponent as f32,
            cloud_drift_km: [0.0; 2],
            reflected_cloud_drift_km: [0.0; 2],
            night_gain: night_gain as f32,
            image_heading_turns: (look.file_heading_deg / 360.0) as f32,
            sun_heading: glam::dvec2(sun[0], sun[2]).normalize_or(glam::DVec2::X).as_vec2().to_array(),
            has_cloud_dome: f32::from(u8::from(look.drawn_clouds() != CloudKind::None)),
            fog_red,
            fog_green,
            fog_blue,
            rain_extinction_per_m: rain::extinction_per_m(look.rain_mm_h) as f32,
            unused: [0; 3],
        }
    }
}

gpu_struct! {
    /// WGSL `Light`: the light on the sea, computed on the GPU when the sky changes. Irradiance is in units of 6400 lux
    /// and radiance in units of 6400 cd/m2; both are then multiplied by `night_gain`.
    pub struct LightBuffer as "Light" {
        /// Irradiance (RGB; unit: 6400 lux / `night_gain`) by the sun, after air, clouds and fog, on a plane facing it.
        pub sun_irradiance: [f32; 3],
        /// Automatic exposure: factor from drawn radiance, with `night_gain`, to the input of the tone curve, at 0 EV.
        pub exposure: f32,
        /// Irradiance (RGB; unit: 6400 lux / `night_gain`) of a horizontal plane by the sky without the sun.
        pub sky_irradiance: [f32; 3],
        /// Luminance to which the exposure adapts, mostly of the low sky, in units of 6400 cd/m2, without `night_gain`.
        pub adaptation_luminance: f32,
        /// Radiance (RGB; unit: 6400 cd/m2 / `night_gain`) of a closed cloud deck at the zenith.
        pub overcast_zenith_radiance: [f32; 3],
        /// Mean fraction of the direct sunlight, after the veil of `overcast`, that passes between the volumetric
        /// clouds, 0 to 1; `sun_irradiance` is that between the clouds.
        pub cloud_sun_transmittance: f32,
        /// Radiance (RGB; unit: 6400 cd/m2 / `night_gain`) of dense fog lit by the sky, equal in all directions.
        pub fog_sky_radiance: [f32; 3],
        /// Sunlight above fog and rain divided by that below them, where `sun_irradiance` is; 1 without fog.
        pub sun_above_fog: f32,
        /// Irradiance (RGB; unit: 6400 lux / `night_gain`) by the sun at half the fog's height, on a plane facing it, where
        /// no cloud shades it.
        pub fog_sun_irradiance: [f32; 3],
        /// Share of the sky straight above that the volumetric clouds leave open, 0 to 1, averaged over their field: the
        /// gaps between clouds that no noise has roughened, or the transmittance of cirrus. 1 without clouds.
        pub cloud_gap_share: f32,
        /// Irradiance (RGB; unit: 6400 lux / `night_gain`) of a horizontal plane by the sky without clouds; with a
        /// sky image, by that image without its sun.
        pub clear_sky_irradiance: [f32; 3],
        unused_1: u32,
    }
}

/// Factor by which all light is scaled up at dusk and night, so that half floats can hold light so weak; the exposure
/// is divided by this factor, a power of two, so that scaling does not round. By day it is 1.
pub fn night_gain(look: &SkyLook) -> f64 {
    let below_deg = if look.panorama().is_some() { 0.0 } else { -look.sun_elevation_azimuth_deg()[0] };
    (1.2 * below_deg).clamp(0.0, 18.0).floor().exp2()
}
