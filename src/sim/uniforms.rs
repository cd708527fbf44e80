//! The uniform structs of the simulation's passes, and the buffers that hold them.

use super::coast::uniform::CoastUniform;
use super::maps::{MAX_CASCADES, MAX_DRAWN_CASCADES, MAX_SEA_LAYERS, TileLatticePosition};
use crate::gpu::Gpu;
use crate::gpu::kit::BindingType;
use crate::gpu::layout::{StructDeclaration, gpu_struct};
use crate::gpu::uniform::DynamicUniformBuffer;
use crate::waves::foam::FOAM_LEVEL_COUNT;
use crate::waves::system::MAX_SPECTRUM_TERMS;

/// The simulation's two uniform buffers, with room for all foam time steps and wave computations of one submission.
pub struct SimulationUniforms {
    /// One uniform for each computation of a sea's waves at one time that the present submission to the GPU makes.
    pub sea: DynamicUniformBuffer<SeaUniform>,
    /// One uniform for each time step of the foam that the present submission to the GPU makes.
    pub foam: DynamicUniformBuffer<FoamUniform>,
}

impl SimulationUniforms {
    /// Binding type of the buffer `SimulationUniforms::sea`: a uniform at a dynamic offset.
    pub const SEA_BINDING: BindingType = BindingType::DynamicUniform(size_of::<SeaUniform>());
    /// Binding type of the buffer `SimulationUniforms::foam`: a uniform at a dynamic offset.
    pub const FOAM_BINDING: BindingType = BindingType::DynamicUniform(size_of::<FoamUniform>());

    /// Allocates both uniform buffers for submissions of at most `foam_steps` foam time steps, with the waves of each.
    pub fn new(gpu: &Gpu, foam_steps: usize) -> Self {
        // For two seas, two evaluations (one for the waves that a coast transforms) per foam time step and without foam;
        // besides, one for the spectrum pass.
        let evaluations = 4 * (foam_steps + 1) + 1;
        Self {
            sea: DynamicUniformBuffer::new(gpu, "sea", evaluations),
            foam: DynamicUniformBuffer::new(gpu, "foam", foam_steps),
        }
    }

    /// Discards the uniforms of the last submission, before the next submission adds its own.
    pub fn clear(&mut self) {
        self.sea.clear();
        self.foam.clear();
    }

    /// Sends the uniforms that have been added for the submission to the GPU.
    pub fn upload(&self, gpu: &Gpu) {
        self.sea.upload(gpu);
        self.foam.upload(gpu);
    }
}

gpu_struct! {
    /// WGSL `SeaCascade`: one cascade (patch of sea with an FFT of its own) in the uniform of a sea.
    #[derive(Default)]
    pub struct SeaCascade as "SeaCascade" {
        /// Side of the square patch of sea that the cascade's maps cover, m.
        pub patch_m: f32,
        /// Spacing of the cascade's wave vectors along kx and along kz: 2 pi / `patch_m`, rad/m.
        pub dk: f32,
        /// Key of the cascade's random numbers. Cascades with different keys have independent waves.
        pub noise_key: u32,
        /// Unit of the slope moments (means of slope products) in the maps: half the cascade's mean square slope.
        pub moment_unit: f32,
    }
}

gpu_struct! {
    /// WGSL `SpectrumTerm`: a spreading lobe or measured distribution. The sum of terms is the directional spectrum.
    #[derive(Default)]
    pub struct SpectrumTerm as "SpectrumTerm" {
        /// Unit vector (x, z) of the main direction in which a lobe's waves travel, from which the lobe's angles are
        /// counted. Measured distributions do not use it.
        pub reference_direction: [f32; 2],
        /// Form of the term: 0 spreading lobe, 1 lobe times cos^2 of the angle from `reference_direction`, 2 the same
        /// but 0 beyond 90 degrees, 3 directional distribution measured by a wave buoy, 4 densities over frequency and
        /// direction.
        pub kind: u32,
        /// Index of this term's first vec4f within each entry (one per wave number) of `WaveBuffers::spectrum_table`.
        pub first_vector: u32,
    }
}

gpu_struct! {
    /// WGSL `Sea`: the uniform of all passes of the simulation, which describes one sea's waves at one time.
    #[derive(Default)]
    pub struct SeaUniform as "Sea" {
        /// Cascades (patches of sea) of one sea, longest waves first; the first `cascade_count` are used. The layers that
        /// a coast adds to the maps follow.
        pub cascades: [SeaCascade; MAX_SEA_LAYERS],
        /// Lobes or measured distributions whose sum is the directional spectrum; the first `term_count` are used.
        pub terms: [SpectrumTerm; MAX_SPECTRUM_TERMS],
        /// Factor by which the wave amplitudes of each cascade are multiplied: 1 except during a cross-fade.
        pub amplitude_factors: [f32; MAX_CASCADES],
        /// Choppiness along x and z: factors by which the maps' horizontal displacements Dx and Dz are multiplied.
        pub choppiness: [f32; 2],
        /// FFT size: number of points along a side of a cascade's lattice.
        pub n: u32,
        /// Number of entries at the start of `cascades` that are in use.
        pub cascade_count: u32,
        /// Seed of the random numbers for h0, set by the user: another seed gives other waves of the same spectrum.
        pub seed: u32,
        /// Time as a fraction of the sea's repeat period, in units of 2^-32. Its wrapping product with a wave's number
        /// of cycles per period is the wave's phase in units of 2^-32 cycles.
        pub period_fraction_u32: u32,
        /// If not 0, the column pass also writes the maps in f32 to `Resources::row_transforms`, to be read back.
        pub keeps_f32_maps: u32,
        /// Number of entries at the start of `terms` that are in use.
        pub term_count: u32,
        /// Number of vec4f in each entry of `WaveBuffers::spectrum_table`, which has one entry per wave number.
        pub vectors_per_entry: u32,
        /// Index of the sea's first cascade among the layers of each kind of map; its other cascades follow.
        pub first_layer: u32,
        /// Fraction of the way, 0 to 1, that the spectrum pass moves the stored amplitudes h0 towards the plan's.
        pub spectrum_blend: f32,
        /// Index in `WaveBuffers::spectrum_table` of the first vec4f behind the entries of all cascades: densities over
        /// frequency and direction of a measured spectrum, if the sea has one.
        pub direction_table_start: u32,
    }
}

gpu_struct! {
    /// WGSL `FoamLevelCorner`: where a foam level's corner with the lowest x and z lies on the patch of one cascade.
    #[derive(Default)]
    pub struct FoamLevelCorner as "FoamLevelCorner" {
        /// Position of the foam level's corner in the triangle lattice of the shifted copies of the patch.
        pub tile_position: TileLatticePosition,
        /// Texture coordinates (u, v) of the foam level's corner in the cascade's maps, modulo 1, plus half a texel.
        pub uv: [f32; 2],
        /// Unused; pads the struct to a multiple of 16 bytes, as an array element needs it.
        pub unused: [u32; 2],
    }
}

gpu_struct! {
    /// WGSL `FoamLevel`: one foam level (square foam grid around the camera) in the uniform of a foam time step.
    #[derive(Default)]
    pub struct FoamLevelUniform as "FoamLevel" {
        /// Where the level's corner with the lowest x and z lies on the maps of each drawn cascade.
        pub corners: [FoamLevelCorner; MAX_DRAWN_CASCADES],
        /// World indices (x, z) of the cell of this level with the lowest x and z; cell i begins at i times `cell_m`.
        pub first_cell: [i32; 2],
        /// World indices (x, z) of the cell of this level that had the lowest x and z at the last foam step; far out of
        /// range if all earlier foam is to be discarded.
        pub previous_first_cell: [i32; 2],
        /// Side of a foam cell of this level, m.
        pub cell_m: f32,
        /// Jacobian of the horizontal displacement below which foam forms; the Jacobian of flat water is 1.
        pub jacobian_threshold: f32,
        /// Factor in the foam source, which is clamp((`jacobian_threshold` - Jacobian) x `source_slope`, 0, 1).
        pub source_slope: f32,
        /// Foam (0 to 1) in a cell that has just entered its level's area: the expected mean over the sea.
        pub initial_foam: f32,
        /// Position (u, v) of the level's corner in the square of a coast, in sides of the square.
        pub coast_uv: [f32; 2],
        /// Side of a foam cell, in sides of the square of a coast.
        pub coast_uv_per_cell: f32,
        /// Foam source, 0 to 1, in all cells of a level that is too coarse for the waves that break; else 0.
        pub even_source: f32,
    }
}

gpu_struct! {
    /// WGSL `FoamCascade`: what the foam pass needs to sample the maps of one cascade that is drawn.
    #[derive(Default)]
    pub struct FoamCascade as "FoamCascade" {
        /// Side of the square patch of sea that the cascade's maps cover, m.
        pub patch_m: f32,
        /// Index of the cascade's layer among the layers of each kind of map.
        pub layer: u32,
        /// What the layer holds: 0 an ordinary cascade, 1 offshore waves, 2 waves at a coast.
        pub role: u32,
        /// Unused; pads the struct to a multiple of 16 bytes, as an array element needs it.
        pub unused: u32,
    }
}

gpu_struct! {
    /// WGSL `Foam`: the uniform of one time step of the foam simulation.
    #[derive(Default)]
    pub struct FoamUniform as "Foam" {
        /// Foam levels (nested square foam grids around the camera), the one with the smallest cells first.
        pub levels: [FoamLevelUniform; FOAM_LEVEL_COUNT],
        /// Cascades that are drawn, including those of a cross-fade's old sea; the first `cascade_count` are used.
        pub cascades: [FoamCascade; MAX_DRAWN_CASCADES],
        /// Length of the time step, s.
        pub dt_s: f32,
        /// Rate at which foam decays exponentially: 1 / e-folding time, 1/s.
        pub decay_per_s: f32,
        /// Rate of growth of the foam (0 to 1) in a cell without foam where the foam source is 1, 1/s.
        pub growth_per_s: f32,
        /// Number of cells along a side of a foam level (one of the nested square foam grids).
        pub cells_per_side: u32,
        /// Number of entries at the start of `cascades` that are in use.
        pub cascade_count: u32,
        /// Rate of growth of a breaker's front (0 to 1) where the foam source is 1, 1/s.
        pub front_growth_per_s: f32,
        /// Rate at which a breaker's front decays exponentially, 1/s.
        pub front_decay_per_s: f32,
        /// Rate at which the plume of bubbles below foam decays exponentially, 1/s. It grows as fast as the foam.
        pub plume_decay_per_s: f32,
        /// Side of the smallest texels on which the Jacobian is read, m.
        pub breaker_texel_m: f32,
        /// Front, relative to the foam, in a cell that has just entered its level's area.
        pub initial_front_ratio: f32,
        /// Plume, relative to the foam, in such a cell.
        pub initial_plume_ratio: f32,
        /// Unused; pads the struct to a multiple of 16 bytes.
        pub unused: u32,
    }
}

/// Declarations of the structs that the simulation shares with its shaders, from which WGSL is generated.
pub const SHARED_STRUCTS: &[StructDeclaration] = &[
    SeaCascade::DECLARATION,
    SpectrumTerm::DECLARATION,
    SeaUniform::DECLARATION,
    TileLatticePosition::DECLARATION,
    FoamLevelCorner::DECLARATION,
    FoamLevelUniform::DECLARATION,
    FoamCascade::DECLARATION,
    FoamUniform::DECLARATION,
    CoastUniform::DECLARATION,
];
