//! Uniform buffer of one frame: camera, sea state and maps. Positions relative to the eye are computed in f64, so that
//! f32 suffices in the shaders.

use super::frame_maps::{FrameCascade, FrameFoamGrid};
use super::scene::{Scene, SeaAppearance};
use super::water::mesh::{Mesh, MeshLattice};
use crate::gpu::layout::gpu_struct;
use crate::optics::rain;
use crate::sim::Maps;
use crate::sim::maps::{MAX_DRAWN_CASCADES, MapCascade};
use crate::waves::foam::FOAM_LEVEL_COUNT;
use crate::waves::second_order::ProductFactors;
use crate::waves::slopes::SlopeVariance;
use std::f64::consts::PI;

/// Largest fraction of the slope variance of unresolved waves (too short for any cascade) that ripples represent; the
/// rest is shaded as roughness.
const MAX_RIPPLE_VARIANCE_FRACTION: f64 = 0.8;
/// Largest slope variance of ripples relative to that of the cascade whose copy they are. In a strong wind the waves too
/// short for the cascades are much rougher than the shortest ones in them.
const MAX_RIPPLE_VARIANCE_RATIO: f64 = 1.5;
/// Scale heights of air molecules and of aerosol, m (WGSL `ATM_RAYLEIGH_SCALE_HEIGHT_KM`, `ATM_AEROSOL_SCALE_HEIGHT_KM`).
const AIR_SCALE_HEIGHTS_M: [f64; 2] = [8400.0, 1200.0];
/// Scale height of the layer of sea salt, m.
const SALT_SCALE_HEIGHT_M: f64 = 60.0;
/// Largest number of ripple layers, the shrunk copies of finest cascades: one for each of the two seas of a cross-fade.
const MAX_RIPPLE_LAYERS: usize = 2;
/// Most foam levels in which vertices look for breaking crests: in coarser ones, what breakers move is smaller than a
/// pixel. Near a coast, waves break in the first levels, however fine the waves of the open sea are.
const MOST_BREAKER_LEVELS: usize = 3;
const COAST_BREAKER_LEVELS: usize = 2;
/// Length of `cascades` in the frame uniform: room for the cascades and ripple layers of both seas of a cross-fade.
const MAX_FRAME_CASCADES: usize = MAX_DRAWN_CASCADES + MAX_RIPPLE_LAYERS;

gpu_struct! {
    /// WGSL `Frame`: uniform buffer of one frame with camera, sea state, cascades and foam levels, relative to the eye.
    pub struct FrameUniform as "Frame" {
        /// Matrix from positions relative to the eye (x east, y up, z south, m) to clip space with reverse-Z depth.
        pub clip_from_relative: glam::Mat4,
        /// Unit vector to the right of the picture, multiplied by the tangent of half the horizontal field of view.
        pub right: [f32; 3],
        /// Height of the eye above the still water, m. The eye pass on the GPU may raise it above the waves.
        pub eye_height_m: f32,
        /// Unit vector to the top of the picture, multiplied by the tangent of half the vertical field of view.
        pub up: [f32; 3],
        /// Angle from the horizontal down to the visible horizon of the spherical Earth, rad.
        pub horizon_dip: f32,
        /// Unit vector of the viewing direction.
        pub forward: [f32; 3],
        /// Angle that a pixel in the middle of the picture subtends, rad.
        pub pixel_angle: f32,
        /// Unit vector towards the sun.
        pub sun_direction: [f32; 3],
        /// Slope variance along each axis (x, z) that is added to the water's where it reflects the sun, to widen the
        /// reflection by the size of the sun's disc.
        pub sun_slope_variance: f32,
        /// Covariances (xx, zz, xz) of the slopes along x and z of the waves that neither cascades nor ripples hold.
        pub residual_slope_covariance: [f32; 3],
        /// Mean radiance of the sun's disc divided by the irradiance that it causes on a plane facing it, 1/sr.
        pub sun_radiance_per_irradiance: f32,
        /// Choppiness: factors by which the horizontal displacements along x and z are multiplied; 1 is linear theory.
        pub choppiness: [f32; 2],
        /// Undisplaced position (x, z) of the water now below the eye, relative to the eye, m; written by the eye pass.
        pub undisplaced_below_eye: [f32; 2],
        /// Estimate of the largest distance by which the waves displace water horizontally, m.
        pub max_displacement_m: f32,
        /// 1 if the eye's height is measured from the moving water below it, 0 if from the still water.
        pub height_from_waves: f32,
        /// Number of texels along a side of a cascade's maps.
        pub n: f32,
        /// Number of cascades of all drawn seas, which are the first entries of `cascades`.
        pub cascade_count: u32,
        /// Number of ripple layers (shrunk copies of cascades) in use. They follow the cascades in `cascades`.
        pub ripple_count: u32,
        /// Number of entries of `foam_levels` in use.
        pub foam_level_count: u32,
        /// Significant wave height, m.
        pub hs_m: f32,
        /// Water depth, m.
        pub depth_m: f32,
        /// Expected mean of the foam, 0 (none) to 1 (fully covered), drawn beyond the foam levels (square grids).
        pub mean_foam: f32,
        /// Factor, from the settings, by which the simulated amount of foam is multiplied for drawing.
        pub foam_amount: f32,
        /// Factor on the sides of the area over which a pixel averages the waves: 1 for the usual filtered picture, 0
        /// for the point samples of a reference picture.
        pub footprint_scale: f32,
        /// Number of entries at the start of `cascades` that belong to the old sea of a cross-fade.
        pub fading_cascade_count: u32,
        /// Mean densities of air molecules (x) and aerosol (y) on a straight path from the eye down to the sea, relative
        /// to those at the sea.
        pub mean_air_density: [f32; 2],
        /// Fraction by which bound waves increase the elevation of the waves of first order. In a cross-fade, it and the
        /// slope factors go from the values of the old sea to those of the new one.
        pub bound_elevation_gain: f32,
        /// Sum of `bound_level_m` over all drawn cascades, m.
        pub bound_level_m: f32,
        /// Factors with which the slope of the bound waves follows from all waves at a point: on the height, and on the
        /// drawn horizontal displacement along x and z, 1/m.
        pub bound_slope_factors: [f32; 3],
        /// Unit vector (x, z) in which breaking crests travel, the wind's direction, as two 16-bit signed fractions.
        pub breaker_direction: u32,
        /// Height of the water surface above a diving eye, m, and its slope along x and z; written by the eye pass.
        pub water_at_eye: [f32; 3],
        /// Mean extinction coefficient of sea salt on a straight path from the eye down to the sea, 1/km. It is not
        /// in the tables of the sky, whose light near the horizon comes from far beyond it.
        pub salt_extinction_per_km: f32,
        /// Position (u, v) of the point below the eye in the square of a coast, in sides of the square.
        pub coast_uv_below_eye: [f32; 2],
        /// Reciprocal of the side of this square, 1/m; 0 in the open sea.
        pub coast_inverse_side: f32,
        /// Number of entries at the start of `foam_levels` that tell where crests break.
        pub breaker_level_count: u32,
        /// Polar lattice of the water mesh: positions of its vertices before displacement.
        pub mesh_lattice: MeshLattice,
        /// Cascades of all drawn seas, then their ripple layers (shrunk copies of cascades); the rest is unused.
        pub cascades: [FrameCascade; MAX_FRAME_CASCADES],
        /// Foam levels (nested square foam grids around the camera), the one with the smallest cells first.
        pub foam_levels: [FrameFoamGrid; FOAM_LEVEL_COUNT],
    }
}

impl FrameUniform {
    /// Values of the frame's uniform buffer for a scene and a picture of `size` (width, height) pixels.
    pub fn new(scene: &Scene, maps: &Maps, mesh: &Mesh, size: [u32; 2]) -> Self {
        let (view, look, sea) = (&scene.view, &scene.look, &scene.sea);
        let below_eye = [view.eye.x, view.eye.z];
        let bound = maps.bound_wave_totals();
        let n = f64::from(maps.n);
        let (shown, residual) = ripple_layers(scene, maps);
        let ripples =
            shown.iter().map(|(cascade, fraction)| FrameCascade::new_ripples(cascade, *fraction, below_eye, n));
        let drawn = maps.cascades.iter().zip(maps.bound_waves_of_cascades()).map(|(cascade, bound)| {
            FrameCascade::new(cascade, below_eye, n).with_bound_waves(&bound, cascade.cross_fade_amplitude_factor)
        });
        let cascades: Vec<FrameCascade> = drawn.collect();
        let levels =
            maps.foam_levels.iter().map(|level| FrameFoamGrid::new(level, below_eye, maps.foam_cells_per_side));
        let [tx, ty] = view.tan_half_fov;
        let disc = look.sky.sun_radius_rad().sin().powi(2);
        Self {
            clip_from_relative: view.clip_from_relative().as_mat4(),
            right: (view.right * tx).as_vec3().to_array(),
            eye_height_m: view.eye.y as f32,
            up: (view.up * ty).as_vec3().to_array(),
            horizon_dip: horizon_dip(view.eye.y) as f32,
            forward: view.forward.as_vec3().to_array(),
            pixel_angle: (2.0 * ty / f64::from(size[1])) as f32,
            sun_direction: look.sky.sun_direction().map(|x| x as f32),
            sun_slope_variance: (disc / 8.0) as f32,
            residual_slope_covariance: residual,
            sun_radiance_per_irradiance: (PI * disc).recip() as f32,
            choppiness: sea.choppiness.map(|l| l as f32),
            undisplaced_below_eye: [0.0; 2],
            max_displacement_m: (1.0 + 0.8 * sea.max_choppiness() * sea.hs_m + sea.surf_displacement_m) as f32,
            height_from_waves: f32::from(u8::from(scene.height_from_waves)),
            n: maps.n as f32,
            cascade_count: maps.cascades.len() as u32,
            ripple_count: shown.len() as u32,
            foam_level_count: maps.foam_levels.len() as u32,
            hs_m: sea.hs_m as f32,
            depth_m: sea.depth_m as f32,
            mean_foam: scene.mean_foam as f32,
            foam_amount: look.surface.foam.coverage_factor as f32,
            footprint_scale: 1.0,
            fading_cascade_count: maps.fading_cascade_count as u32,
            mean_air_density: AIR_SCALE_HEIGHTS_M.map(|scale_m| mean_density_below(view.eye.y, scale_m) as f32),
            bound_elevation_gain: bound.elevation_gain as f32,
            bound_level_m: cascades.iter().map(|cascade| cascade.bound_level_m).sum(),
            bound_slope_factors: bound_slope_factors(bound.mean, sea.choppiness),
            breaker_direction: packed_direction(sea.downwind),
            water_at_eye: [(-view.eye.y) as f32, 0.0, 0.0],
            salt_extinction_per_km: (look.sky.haze.sqrt()
                * salt_extinction_per_km(sea.wind_m_s)
                * mean_density_below(view.eye.y, SALT_SCALE_HEIGHT_M)) as f32,
            coast_uv_below_eye: maps.coast.as_ref().map_or([0.0; 2], |c| c.square.uv(below_eye).map(|x| x as f32)),
            coast_inverse_side: maps.coast.as_ref().map_or(0.0, |coast| coast.square.side_m.recip() as f32),
            breaker_level_count: breaker_level_count(maps),
            mesh_lattice: mesh.lattice,
            cascades: padded_array(cascades.into_iter().chain(ripples)),
            foam_levels: padded_array(levels),
        }
    }

    /// A copy of this uniform for the point samples of a reference picture: pixels do not average, and the picture is
    /// shifted by (x, y) in clip coordinates.
    pub fn for_point_samples(self, [x, y]: [f32; 2]) -> Self {
        let moved = glam::Mat4::from_translation(glam::vec3(x, y, 0.0)) * self.clip_from_relative;
        let forward = std::array::from_fn(|i| self.forward[i] - x * self.right[i] - y * self.up[i]);
        Self { clip_from_relative: moved, forward, footprint_scale: 0.0, ..self }
    }
}

/// A unit vector as two 16-bit signed fractions (WGSL `unpack2x16snorm`).
fn packed_direction(unit: [f64; 2]) -> u32 {
    let [x, z] = unit.map(|v| u32::from((32767.0 * v.clamp(-1.0, 1.0)).round() as i16 as u16));
    x | z << 16
}

/// WGSL `bound_slope_factors` for the factors `mean` of the whole sea. The shader knows the horizontal displacement only
/// after multiplication by the choppiness, so that its part is left out along an axis without choppiness.
fn bound_slope_factors(mean: ProductFactors, choppiness: [f64; 2]) -> [f32; 3] {
    let [x, z] = choppiness.map(|chop| if chop > 0.05 { mean.displacement / chop } else { 0.0 });
    [mean.elevation, x, z].map(|v| v as f32)
}

/// An array that starts with the given values and is filled up with defaults.
fn padded_array<T: Copy + Default, const N: usize>(values: impl Iterator<Item = T>) -> [T; N] {
    let mut out = [T::default(); N];
    out.iter_mut().zip(values).for_each(|(out, value)| *out = value);
    out
}

/// Mean over the altitudes from 0 to `eye_height_m`, m, of a density that falls to 1/e over `scale_m`, m, relative to the
/// density at altitude 0.
fn mean_density_below(eye_height_m: f64, scale_m: f64) -> f64 {
    let thickness = eye_height_m.max(0.0) / scale_m + 1e-9;
    -(-thickness).exp_m1() / thickness
}

/// Extinction coefficient of sea salt and moist salt close to the water, 1/km, at a wind speed, for a haze of 1. That it
/// grows with the square of the wind is measured (Mulcahy et al. 2008, the optical depth at Mace Head). The coefficients
/// are our choice: with the other aerosol, one sees about 20 km far in a fresh breeze and 6 km in a storm. Half of the haze
/// takes less than half of the salt, because the wind lifts salt on clear days, too: the caller multiplies by the root.
fn salt_extinction_per_km(wind_m_s: f64) -> f64 {
    0.05 + 8e-4 * wind_m_s * wind_m_s
}

/// Angle from the horizontal down to the horizon of the spherical Earth, rad, seen from the height `eye_height_m`.
pub fn horizon_dip(eye_height_m: f64) -> f64 {
    let r = crate::state::camera::EARTH_RADIUS_M;
    (r / (r + eye_height_m.max(0.0))).min(1.0).acos()
}

/// Chooses the ripples, shrunk copies of cascades that stand for shorter waves. Returns the cascades to shrink, each
/// with the ratio of its ripples' slope variance to the cascade's; and the covariances (xx, zz, xz) of the slopes along
/// x and z of waves that neither cascades nor ripples hold, with the rings of raindrops.
fn ripple_layers<'a>(scene: &Scene, maps: &'a Maps) -> (Vec<(&'a MapCascade, f64)>, [f32; 3]) {
    let sea = &scene.sea;
    let rain = scene.look.sky.rain_mm_h;
    let unresolved = sea.unresolved_slope_variance.map(|v| v * rain::short_wave_factor(rain));
    let mut left = unresolved;
    let mut shown = Vec::new();
    let own = (
        maps.cascades.last(),
        sea.finest_cascade_slope_variance,
        1.0 - scene.fading_sea.map_or(0.0, |f| f.variance_fraction),
    );
    let fading = scene.fading_sea.map(|f| {
        (maps.cascades[..maps.fading_cascade_count].last(), f.finest_cascade_slope_variance, f.variance_fraction)
    });
    for (cascade, finest, weight) in std::iter::once(own).chain(fading) {
        // Ripples scale both slope components of their cascade alike; neither may exceed the unresolved variance.
        let fraction = |i: usize| if finest[i] > 1e-5 { unresolved[i] / finest[i] } else { 0.0 };
        let fraction = (MAX_RIPPLE_VARIANCE_FRACTION * fraction(0).min(fraction(1))).min(MAX_RIPPLE_VARIANCE_RATIO);
        if let Some(cascade) = cascade.filter(|_| fraction > 0.0) {
            shown.push((cascade, fraction));
            left = [left[0] - fraction * weight * finest[0], left[1] - fraction * weight * finest[1]];
        }
    }
    // Rings of drops run in all directions.
    let rings = 0.5 * rain::ring_slope_variance(rain);
    (shown, covariance_in_world_axes(sea, left.map(|l| l.max(0.0) + rings)))
}

/// Number of foam levels, from the finest on, in which a vertex of the water looks for breaking crests.
fn breaker_level_count(maps: &Maps) -> u32 {
    let in_open_sea = maps.foam_levels.iter().take_while(|level| level.has_breakers).count().min(MOST_BREAKER_LEVELS);
    let at_coast = if maps.coast.is_some() { COAST_BREAKER_LEVELS } else { 0 };
    in_open_sea.max(at_coast).min(maps.foam_levels.len()) as u32
}

/// Variances along x (east) and z (south) and covariance, in the order xx, zz, xz, of slopes that have the given
/// variances along and across the wind of `sea`.
fn covariance_in_world_axes(sea: &SeaAppearance, [along, across]: SlopeVariance) -> [f32; 3] {
    let [x, z] = sea.downwind;
    [along * x * x + across * z * z, along * z * z + across * x * x, (along - across) * x * z].map(|v| v as f32)
}
