//! Uniform buffer with the optical properties of water, foam and bed, from the look, the sea and the eye's position.

use super::bed::normal_quantile;
use super::noise::NOISE_SIDE;
use crate::gpu::layout::gpu_struct;
use crate::optics::rain;
use crate::optics::water::WaterOptics;
use crate::render::scene::Scene;
use crate::state::fields::linear_rgb;
use crate::state::look::Scattering;
use glam::{DMat2, DVec2};

/// Number of noise layers, each a periodic texture at its own size and angle: four for foam, four of the
/// bed's texture, two for the roughness of the water, and two for foam that the wind has not drawn out.
const NOISE_LAYERS: usize = 12;
/// Shape of a noise layer.
#[derive(Clone, Copy)]
struct LayerShape {
    /// Sides of its tile along and across its axis, m.
    along_m: f64,
    across_m: f64,
    /// Angle from the wind to the axis, degrees.
    turn_deg: f64,
    /// Relative lengthening of the tile along the axis in a storm.
    longer: f64,
    /// Weight of the layer in the pattern of all foam but fronts, before the factors for its age, and what a storm adds.
    weight: f64,
    gale_weight: f64,
    /// Speed along the wind, relative to the wind's speed at 10 m.
    speed: f64,
}

impl LayerShape {
    const fn foam([along_m, across_m, turn_deg, longer]: [f64; 4], [weight, gale_weight]: [f64; 2]) -> Self {
        Self { along_m, across_m, turn_deg, longer, weight, gale_weight, speed: 0.0 }
    }

    const fn bed(side_m: f64, turn_deg: f64) -> Self {
        Self::foam([side_m, side_m, turn_deg, 0.0], [0.0; 2])
    }

    const fn roughness(shape: [f64; 4], speed: f64) -> Self {
        Self { speed, ..Self::foam(shape, [0.0; 2]) }
    }
}

/// Shapes of the noise layers: four of foam (windrows, patches, strands, threads), four of the bed (banks and
/// channels, meadows, coral heads, ripples of the sand), gusts, slicks, and billows and strands of new foam and breakers.
/// Sides and angles have no common period, so that the sum of the layers does not repeat. Windrows gather old foam
/// between the rolls of the Langmuir circulation, 10 to 100 m apart, in winds above 8 m/s. Foam moves with the water that
/// it lies on, gusts are carried by the air, and slicks by the surface current.
const LAYER_SHAPES: [LayerShape; NOISE_LAYERS] = [
    LayerShape::foam([910.0, 190.0, 0.0, 3.5], [0.36, 0.5]),
    LayerShape::foam([53.0, 37.0, 4.0, 3.7], [0.64, 0.0]),
    LayerShape::foam([9.1, 7.3, -5.0, 1.9], [1.26, -0.2]),
    LayerShape::foam([1.63, 1.63, 41.0, 0.0], [0.45, 0.0]),
    // The smallest tile of the bed holds 38 ripples. Their crests lie across the waves, which follow the wind.
    LayerShape::bed(1130.0, 63.0),
    LayerShape::bed(310.0, 29.0),
    LayerShape::bed(43.7, 101.0),
    LayerShape::bed(15.1, -14.0),
    LayerShape::roughness([910.0, 620.0, 4.0, 0.5], 0.7),
    LayerShape::roughness([260.0, 149.0, -7.0, 2.0], 0.03),
    LayerShape::foam([37.0, 31.0, 17.0, 0.3], [0.0; 2]),
    // The wind has not drawn these two out yet: new foam would look combed, and strands would hang down a front like wool.
    LayerShape::foam([8.3, 10.7, 23.0, 0.0], [0.0; 2]),
];
/// Least density of texels that a layer counts with, relative to that along its denser axis: a longer tile would
/// flicker across its axis.
const MIN_DENSITY_RATIO: f64 = 0.4;
/// Part of a storm's mean foam that lies in streaks over the whole sea.
const MOST_FOAM_IN_STREAKS: f64 = 0.2;
/// Time for which a glint of the sun lasts, s.
const GLINT_MOMENT_S: f64 = 0.06;
/// Period of the cells of both layers of rings (shaders/water/rings.wgsl), m; area of the larger cells, m^2; and how
/// long a ring is seen, s.
const RING_PERIOD_M: f64 = 5.46;
const RING_CELL_M2: f64 = 0.273 * 0.273;
const RING_S: f64 = 0.5;
/// Diameter of the smallest drops whose rings are seen singly, mm.
const RING_DIAMETER_MM: f64 = 1.5;
/// Fraction of light that must remain after the way straight down to the bed and back, or else the bed is not drawn.
const MIN_BED_TRANSMITTANCE: f64 = 1e-3;
/// Share of reefs in what covers the bed; the rest is seagrass.
const REEF_SHARE: f64 = 0.3;
/// Widths of the edges of meadows and reefs, standard deviations of their noise, as in shaders/water/bed.wgsl.
const MEADOW_SOFTNESS: f64 = 0.3;
const REEF_SOFTNESS: f64 = 0.14;

gpu_struct! {
    /// WGSL `NoiseLayer`: transformation from positions on the water to texture coordinates of one noise layer.
    pub struct NoiseLayer as "NoiseLayer" {
        /// Matrix from positions (x, z) relative to the point below the eye, m, to texture coordinates relative to
        /// those of that point (`uv_below_eye`).
        uv_from_position: glam::Mat2,
        /// Texture coordinates, in the noise texture, of the point straight below the eye.
        uv_below_eye: [f32; 2],
        /// Binary logarithm of the number of texels of the noise texture per metre: the geometric mean of both axes, or
        /// nearly that of the denser one where the tile is long.
        log_texels_per_m: f32,
        /// Weight of the layer in the pattern of all foam but fronts, before the factors for its age.
        foam_weight: f32,
    }
}

impl NoiseLayer {
    /// The transformation for a noise layer and an eye above the position `below_eye` (x, z) on it, m. `gale` goes from
    /// 0 to 1 with the wind and lengthens the layer's tile along its axis.
    fn new(
        LayerShape { along_m, across_m, turn_deg, longer, weight, gale_weight, .. }: LayerShape,
        downwind: [f64; 2],
        gale: f64,
        below_eye: DVec2,
    ) -> Self {
        let axis = DVec2::from(downwind).rotate(DVec2::from_angle(turn_deg.to_radians()));
        let along = axis / (along_m * (1.0 + longer * gale));
        let across = axis.perp() / across_m;
        let at = |row: DVec2| row.dot(below_eye).rem_euclid(1.0) as f32;
        let densities = [along, across].map(|row| f64::from(NOISE_SIDE) * row.length());
        let texels_per_m = (densities[0] * densities[1]).sqrt().max(MIN_DENSITY_RATIO * densities[0].max(densities[1]));
        Self {
            uv_from_position: DMat2::from_cols(along, across).transpose().as_mat2(),
            uv_below_eye: [at(along), at(across)],
            log_texels_per_m: texels_per_m.log2() as f32,
            foam_weight: (weight + gale * gale_weight) as f32,
        }
    }
}

gpu_struct! {
    /// WGSL `Material`: optical properties of water, foam and bed. Add a new property here and in [`Self::new`].
    pub struct MaterialUniform as "Material" {
        /// Absorption coefficient of the water at red, green and blue, 1/m.
        absorption: [f32; 3],
        /// Factor on the skylight that the water scatters back; 1 is physical.
        skylight_scatter_factor: f32,
        /// Backscattering coefficient of the water at red, green and blue, 1/m.
        backscatter: [f32; 3],
        /// Refractive index of the water divided by that of the air.
        relative_index: f32,
        /// Total scattering coefficient of the water at red, green and blue, 1/m.
        scattering: [f32; 3],
        /// Density of the bubbles below foam; 1 is that of a typical plume under a breaking wave.
        bubble_density: f32,
        bubble_colour: [f32; 3],
        /// Factor on the sunlight and skylight that shine through wave crests from behind; 1 is physical.
        crest_transmission: f32,
        foam_colour: [f32; 3],
        /// How much the light scattered back by the water depends on the viewing direction: 0 not at all, 1 physically.
        scatter_view_dependence: f32,
        /// Irradiance reflectance, RGB, of deep water without bubbles, just below the surface: 0.33 bb / a for small
        /// backscattering bb and absorption a (Morel and Prieur 1977), and 1 if a is 0.
        deep_reflectance: [f32; 3],
        /// Sine of the sun's elevation as seen from below a level surface, by Snell's law.
        refracted_sun_sine: f32,
        bed_colour: [f32; 3],
        /// Factor on the sunlight that the water scatters back; 1 is physical.
        sunlight_scatter_factor: f32,
        noise_layers: [NoiseLayer; NOISE_LAYERS],
        /// Refractive index of the air divided by that of the water.
        inverse_relative_index: f32,
        /// Exponent of Schlick's approximation of the Fresnel reflectance, 5 in the original.
        schlick_exponent: f32,
        /// Factor on the Fresnel reflectance of the water; 1 is physical.
        fresnel_scale: f32,
        /// Factor on the surface slopes from which the Fresnel reflectance is computed; 1 is physical.
        fresnel_slope_factor: f32,
        /// Exponent of the Blinn-Phong lobe that shapes the sun's glitter, if it is selected.
        shininess: f32,
        /// Factor on the radiance of the sun's glitter; 1 is physical.
        glitter_strength: f32,
        /// Factor on the Fresnel reflectance in the sun's glitter; 1 is physical.
        glitter_fresnel_scale: f32,
        /// The sun's glitter fades where the cosine of the angle between surface normal and sun, or between normal and
        /// eye, is below this; it is gone at half this cosine. 0 turns the fading off.
        glitter_min_cosine: f32,
        /// Slope variance along each axis (x, z) that the roughness setting adds to that of the unresolved waves.
        roughness_variance: f32,
        foam_roughness: f32,
        /// Factor on the height of the bumps of foam, and so on their shading; 0 is flat foam.
        foam_relief: f32,
        /// Factor on the radiance of the reflected sky; 1 is physical.
        sky_reflection: f32,
        /// Strength of the caustics (sunlight focused by the waves) on the bed: 0 is even light, 1 is physical.
        caustic_strength: f32,
        /// Half the shortest wavelength of waves that form distinct caustics on the bed, m; shorter detail is ignored.
        caustic_filter_m: f32,
        /// Square of `relative_index`, less 1, and the reciprocal of that, or 0 if the indices are equal.
        index_contrast: [f32; 2],
        /// Strength of gusts and slicks, 0 to 1, which vary the slope variance of short waves from place to place.
        gust_strength: f32,
        /// Number of the moment, of some hundredths of a second, for which the sun's glints stay where they are.
        glint_moment: u32,
        /// Normal noise above minus this is a meadow of seagrass (x) or a reef (y) on the bed.
        bed_cover_edges: [f32; 2],
        /// Position (x, z) of the point below the eye among the cells of rings of raindrops: its remainder, m, and the
        /// number of whole periods of the cells.
        ring_origin: [f32; 2],
        ring_period: [i32; 2],
        /// Time in lives of a ring: its whole part, and its fraction.
        ring_moment: u32,
        ring_moment_fraction: f32,
        /// Fraction of the cells that have a ring, 0 to 1.
        ring_share: f32,
        /// Mean square slope of all rings.
        ring_slope_variance: f32,
        /// Diffuse attenuation coefficient Kd of downwelling light, RGB, 1/m.
        diffuse_attenuation: [f32; 3],
        /// Part of the mean foam that lies in streaks along the wind all over the sea, not around the breakers.
        foam_streak_share: f32,
        /// 1 in light wind, where new foam has round holes, and 0 in a storm, which draws it out at once.
        foam_calm: f32,
        /// Unused, as the next field: they pad the struct to a multiple of 16 bytes.
        unused: u32,
        unused_pair: [u32; 2],
    }
}

impl MaterialUniform {
    /// Values of the material's uniform buffer for a scene.
    pub fn new(scene: &Scene) -> Self {
        let surface = &scene.look.surface;
        let (scattering, reflection) = (&surface.scattering, &surface.reflection);
        let (foam, bed) = (&surface.foam, &surface.bed);
        let water = water_optics(scattering);
        let colour = |c: f64| linear_rgb(c).map(|x| x as f32);
        let single = |c: [f64; 3]| c.map(|x| x as f32);
        let gale = ((scene.sea.wind_m_s - 8.0) / 16.0).clamp(0.0, 1.0);
        let gale = gale * gale * (3.0 - 2.0 * gale);
        let below_eye = DVec2::new(scene.view.eye.x, scene.view.eye.z);
        let wind_path_m = DVec2::from(scene.sea.downwind) * (scene.sea.wind_m_s * scene.t_s);
        let into_water = reflection.index_air / reflection.index_water;
        let contrast = into_water.powi(-2) - 1.0;
        let (rain_mm_h, ring_moment) = (scene.look.sky.rain_mm_h, scene.moment(RING_S));
        let [sun_x, _, sun_z] = scene.look.sky.sun_direction();
        let sun_cosine = sun_x.hypot(sun_z);
        Self {
            absorption: single(water.absorption),
            skylight_scatter_factor: scattering.ambient_strength as f32,
            backscatter: single(water.backscatter),
            relative_index: (reflection.index_water / reflection.index_air) as f32,
            scattering: single(water.scattering),
            // Breakers that leave no foam leave no bubbles.
            bubble_density: if foam.coverage_factor > 0.0 { scattering.bubble_density as f32 } else { 0.0 },
            bubble_colour: colour(scattering.bubble_colour),
            crest_transmission: scattering.crest_transmission as f32,
            foam_colour: colour(foam.colour),
            scatter_view_dependence: scattering.scatter_view_dependence as f32,
            deep_reflectance: single(water.reflectance()),
            refracted_sun_sine: (1.0 - (into_water * sun_cosine).powi(2)).max(0.0).sqrt() as f32,
            bed_colour: colour(bed.colour),
            sunlight_scatter_factor: scattering.diffuse_strength as f32,
            noise_layers: std::array::from_fn(|i| {
                let on_layer = below_eye - LAYER_SHAPES[i].speed * wind_path_m;
                NoiseLayer::new(LAYER_SHAPES[i], scene.sea.downwind, gale, on_layer)
            }),
            inverse_relative_index: into_water as f32,
            schlick_exponent: reflection.schlick_exponent as f32,
            fresnel_scale: reflection.fresnel_scale as f32,
            fresnel_slope_factor: reflection.fresnel_slope_factor as f32,
            shininess: reflection.shininess as f32,
            glitter_strength: reflection.glitter_strength as f32,
            glitter_fresnel_scale: reflection.glitter_fresnel_scale as f32,
            glitter_min_cosine: reflection.glitter_min_cosine as f32,
            // GGX: alpha = roughness^2 and alpha^2 = 2 x slope variance.
            roughness_variance: (0.5 * reflection.roughness.powi(4)) as f32,
            foam_roughness: foam.roughness as f32,
            foam_relief: foam.relief as f32,
            sky_reflection: reflection.sky_strength as f32,
            caustic_strength: bed.caustics as f32,
            caustic_filter_m: scene.sea.caustic_filter_m as f32,
            index_contrast: [contrast, if contrast == 0.0 { 0.0 } else { contrast.recip() }].map(|x| x as f32),
            gust_strength: reflection.gusts as f32,
            glint_moment: scene.moment(GLINT_MOMENT_S).0,
            bed_cover_edges: bed_cover_edges(bed.cover),
            ring_origin: below_eye.to_array().map(|x| x.rem_euclid(RING_PERIOD_M) as f32),
            ring_period: below_eye.to_array().map(|x| x.div_euclid(RING_PERIOD_M) as i32),
            ring_moment: ring_moment.0,
            ring_moment_fraction: ring_moment.1,
            ring_share: (-rain::impacts_per_m2_s(rain_mm_h, RING_DIAMETER_MM) * RING_S * RING_CELL_M2).exp_m1().abs()
                as f32,
            ring_slope_variance: rain::ring_slope_variance(rain_mm_h) as f32,
            diffuse_attenuation: single(water.diffuse_attenuation),
            foam_streak_share: foam_streak_share(scene.sea.wind_m_s) as f32,
            foam_calm: (1.0 - gale) as f32,
            unused: 0,
            unused_pair: [0; 2],
        }
    }
}

/// Part of the mean foam, 0 to 1, that the wind has spread into streaks over the whole sea. On Beaufort's scale foam is
/// blown in streaks from 14 m/s on, and in dense streaks from 21 m/s.
fn foam_streak_share(wind_m_s: f64) -> f64 {
    let rise = ((wind_m_s - 14.0) / 10.0).clamp(0.0, 1.0);
    MOST_FOAM_IN_STREAKS * rise * rise * (3.0 - 2.0 * rise)
}

/// Thresholds of the noises of seagrass and reef that cover the share `cover` of the bed: reefs three tenths of it, and
/// seagrass the rest, between the reefs.
fn bed_cover_edges(cover: f64) -> [f32; 2] {
    let reef = REEF_SHARE * cover;
    let meadow = (cover - reef) / (1.0 - reef);
    // Soft edges shift the threshold that keeps the mean (shaders/water/bed.wgsl).
    [(meadow, MEADOW_SOFTNESS), (reef, REEF_SOFTNESS)].map(|(share, soft)| {
        let edge = if share <= 0.0 { -9.0 } else { normal_quantile(share) };
        (edge * (1.0 + soft * soft).sqrt()) as f32
    })
}

/// Absorption and scattering of the water that the settings `scattering` select: a water type, or water of a colour.
pub fn water_optics(scattering: &Scattering) -> WaterOptics {
    let water = WaterOptics::blend_with_next_type(scattering.water_type, scattering.water_type_blend);
    if scattering.scatter_colour > 0.0 {
        water.with_reflectance_colour(linear_rgb(scattering.scatter_colour))
    } else {
        water
    }
}

/// Whether the sea bed is drawn: more than `MIN_BED_TRANSMITTANCE` of some colour's light returns from it to the surface,
/// or to a diving eye. Before land it always is.
pub fn is_bed_visible(scene: &Scene) -> bool {
    if scene.land.is_some() {
        return true;
    }
    let depth_m = scene.sea.depth_m + 0.5 * scene.view.eye.y.min(0.0);
    let back = water_optics(&scene.look.surface.scattering).two_way_transmittance(depth_m);
    back.into_iter().any(|share| share > MIN_BED_TRANSMITTANCE)
}
