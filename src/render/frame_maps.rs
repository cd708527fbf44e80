//! Parts of the frame's uniform buffer: how to sample the maps of the waves and of the foam, relative to the eye.

use crate::gpu::layout::gpu_struct;
use crate::sim::maps::{CascadeRole, FoamLevel, MapCascade, TileLatticePosition};
use crate::waves::second_order::{CascadeBoundWaves, ProductFactors};

/// Patch side of the finest cascade divided by that of its ripples, a shrunk copy that stands for shorter waves. No two
/// cascades have this ratio, so that their repetitions do not coincide.
const RIPPLE_PATCH_RATIO: f64 = 13.1;
/// Largest length of a wave, in texels, with which mesh vertices may carry its slopes (WGSL
/// `WATER_CARRIED_SPACINGS.y`).
const CARRIED_WAVE_TEXELS: f64 = 7.0;
/// Maps whose shortest wave is longer than this number of texels are smooth enough without a spline.
const SMOOTH_WAVE_TEXELS: f64 = 6.0;
/// Width of the front of a breaker, m.
const FRONT_WIDTH_M: f64 = 1.0 / 0.07;

gpu_struct! {
    /// WGSL `FrameCascade`: how to sample, relative to the eye, the maps of a cascade (a repeating patch of waves), or
    /// its ripples: a shrunk copy of the cascade whose slopes represent waves too short for any cascade.
    #[derive(Default)]
    pub struct FrameCascade as "FrameCascade" {
        /// Position of the point below the eye in a lattice of triangles. Each corner has a randomly shifted copy of
        /// the patch; the copies are blended, so that the cascade does not repeat visibly.
        pub tile_position: TileLatticePosition,
        /// Factors p and q, 1/m, on products of two elevations and of two horizontal displacements of this cascade, in
        /// the height of the bound waves (src/waves/second_order.rs).
        pub bound_own: [f32; 2],
        /// Factors p and q, 1/m, on products of a wave of this cascade with a wave of a finer cascade, in the height of
        /// the bound waves.
        pub bound_with_shorter: [f32; 2],
        /// Texture coordinates (u along x, v along z), in the cascade's maps, of the point straight below the eye.
        pub uv_below_eye: [f32; 2],
        /// Reciprocal of the side of the cascade's square patch, for ripples of the shrunk patch, 1/m.
        pub inverse_patch: f32,
        /// Mean square slope that the value 1 in the slope-moment map stands for: half that of the cascade's waves.
        pub moment_unit: f32,
        /// Number of texels of the maps per metre.
        pub texels_per_m: f32,
        /// Binary logarithm of `texels_per_m`.
        pub log_texels_per_m: f32,
        /// Length, m, with which the cascade's shortest wave counts when the shader chooses between mesh vertices and
        /// pixels to hold its slopes: at most seven texels (WGSL `WATER_CARRIED_SPACINGS.y`).
        pub shortest_carried_wave_m: f32,
        /// Smoothness of the interpolation between texels where the maps are magnified: 1 (Catmull-Rom spline) if the
        /// cascade has waves of few texels, else 0 (linear).
        pub spline_smoothness: f32,
        /// Factor on slopes read from the maps: 1 for a cascade; for ripples, what gives them their variance.
        pub slope_scale: f32,
        /// Factor on the slope variance read from the maps: the square of `slope_scale`; in a cross-fade of seas that
        /// share waves, also the correction for it.
        pub variance_factor: f32,
        /// Index of the cascade's layer in the array textures of displacement, gradients and slope moments.
        pub layer: u32,
        /// Height that belongs to the bound waves of this cascade, for which the mean level stays that of still water, m.
        pub bound_level_m: f32,
        /// Which of the three factors of a coast holds for this cascade (WGSL `coast_gains`): 1, the others 0.
        pub coast_gains: [f32; 3],
        unused: u32,
    }
}

gpu_struct! {
    /// WGSL `FrameFoamGrid`: one of the nested square foam grids (levels) around the camera, relative to the eye.
    #[derive(Default)]
    pub struct FrameFoamGrid as "FrameFoamGrid" {
        /// Centre (x, z) of the foam level's square relative to the point below the eye, m.
        pub centre: [f32; 2],
        /// Reciprocal, 1/m, of half the side of the square in which shaders read this level; the square leaves out two
        /// cells at each edge.
        pub inverse_half_side: f32,
        /// Reciprocal of the side of a foam cell, 1/m.
        pub inverse_cell: f32,
        /// Texture coordinates (u, v), 0 to 1, of the point below the eye, in this level's layer of the foam map.
        pub uv_below_eye: [f32; 2],
        /// Reciprocal of the side of the foam level's square, 1/m.
        pub inverse_side: f32,
        /// Fraction of a cell that the front of a breaker fills at most.
        pub front_fill: f32,
    }
}

impl FrameCascade {
    /// Values for sampling the maps of `cascade` (`n` texels a side); the eye is above the world position `below_eye`
    /// (x, z), m.
    pub fn new(cascade: &MapCascade, below_eye: [f64; 2], n: f64) -> Self {
        let texels_per_m = n / cascade.patch_m;
        let shortest_texels = cascade.shortest_wavelength_m * texels_per_m;
        Self {
            tile_position: cascade.tiling.lattice_position(below_eye).into(),
            uv_below_eye: below_eye.map(|x| ((x / cascade.patch_m).rem_euclid(1.0) + 0.5 / n) as f32),
            inverse_patch: (1.0 / cascade.patch_m) as f32,
            moment_unit: cascade.moment_unit,
            texels_per_m: texels_per_m as f32,
            log_texels_per_m: texels_per_m.log2() as f32,
            shortest_carried_wave_m: (shortest_texels.min(CARRIED_WAVE_TEXELS) / texels_per_m) as f32,
            spline_smoothness: f32::from(u8::from(shortest_texels < SMOOTH_WAVE_TEXELS)),
            slope_scale: 1.0,
            variance_factor: cascade.cross_fade_variance_factor,
            layer: cascade.layer,
            coast_gains: [CascadeRole::Ordinary, CascadeRole::Offshore, CascadeRole::Coast]
                .map(|role| f32::from(u8::from(cascade.role == role))),
            ..Self::default()
        }
    }

    /// A copy with the bound waves of the cascade. In a cross-fade its waves have `amplitude` times their height.
    pub fn with_bound_waves(self, bound: &CascadeBoundWaves, amplitude: f32) -> Self {
        let factors = |f: ProductFactors| [f.elevation as f32, f.displacement as f32];
        Self {
            bound_own: factors(bound.own),
            bound_with_shorter: factors(bound.with_shorter),
            bound_level_m: amplitude * amplitude * bound.level_m as f32,
            ..self
        }
    }

    /// Ripples: a copy of `cascade` (maps of `n` texels a side) shrunk by [`RIPPLE_PATCH_RATIO`], with `fraction` times
    /// its slope variance; the eye is above the world position `below_eye` (x, z), m.
    pub fn new_ripples(cascade: &MapCascade, fraction: f64, below_eye: [f64; 2], n: f64) -> Self {
        let patch_m = cascade.patch_m / RIPPLE_PATCH_RATIO;
        let texels_per_m = n / patch_m;
        Self {
            tile_position: cascade.tiling.with_smaller_patch(RIPPLE_PATCH_RATIO).lattice_position(below_eye).into(),
            // The offset keeps the copies of the cascade and of its ripples from coinciding at the world origin.
            uv_below_eye: below_eye.map(|x| ((x / patch_m).rem_euclid(1.0) + 0.381_966) as f32),
            inverse_patch: (1.0 / patch_m) as f32,
            texels_per_m: texels_per_m as f32,
            log_texels_per_m: texels_per_m.log2() as f32,
            slope_scale: fraction.sqrt() as f32,
            variance_factor: fraction as f32 * cascade.cross_fade_variance_factor,
            ..Self::new(cascade, below_eye, n)
        }
    }
}

impl FrameFoamGrid {
    /// A foam level with `cells` cells along a side, for an eye above the world position `below_eye` (x, z), m.
    pub fn new(level: &FoamLevel, below_eye: [f64; 2], cells: u32) -> Self {
        let side_m = f64::from(cells) * level.cell_m;
        Self {
            centre: [0, 1].map(|axis| (level.centre_m[axis] - below_eye[axis]) as f32),
            inverse_half_side: (0.5 * side_m - 2.0 * level.cell_m).recip() as f32,
            inverse_cell: (1.0 / level.cell_m) as f32,
            uv_below_eye: below_eye.map(|x| (x / side_m).rem_euclid(1.0) as f32),
            inverse_side: (1.0 / side_m) as f32,
            front_fill: (1.0 / (1.0 + level.cell_m / FRONT_WIDTH_M)) as f32,
        }
    }
}
