//! The uniform structs of the simulation's passes, and the buffers that hold them.

use super::maps::{MAX_CASCADES, MAX_DRAWN_CASCADES, TileLatticePosition};
use crate::gpu::Gpu;
use crate::gpu::kit::BindingType;
use crate::gpu::layout::{StructDeclaration, gpu_struct};
use crate::gpu::uniform::DynamicUniformBuffer;
use crate::waves::foam::FOAM_LEVELS;

/// Uniform buffers of one submission, with room for several evaluations and foam time steps.
pub struct SimulationUniforms {
    /// One uniform for each evaluation of a sea in the submission.
    pub sea: DynamicUniformBuffer<SeaUniform>,
    /// One uniform for each time step of the foam in the submission.
    pub foam: DynamicUniformBuffer<FoamUniform>,
}

impl SimulationUniforms {
    /// Binding type of the buffer `sea`: a uniform at a dynamic offset.
    pub const SEA_BINDING: BindingType = BindingType::DynamicUniform(size_of::<SeaUniform>());
    /// Binding type of the buffer `foam`: a uniform at a dynamic offset.
    pub const FOAM_BINDING: BindingType = BindingType::DynamicUniform(size_of::<FoamUniform>());

    /// Allocates both buffers, for submissions with at most `foam_steps` foam time steps.
    pub fn new(gpu: &Gpu, foam_steps: usize) -> Self {
        // For two seas, one evaluation per foam time step and one without foam; besides, one for the spectrum pass.
        let evaluations = 2 * (foam_steps + 1) + 1;
        Self {
            sea: DynamicUniformBuffer::new(gpu, "sea", evaluations),
            foam: DynamicUniformBuffer::new(gpu, "foam", foam_steps),
        }
    }

    /// Discards the uniforms of the last submission. The next submission then adds its own.
    pub fn clear(&mut self) {
        self.sea.clear();
        self.foam.clear();
    }

    /// Sends the uniforms of the submission to the GPU.
    pub fn upload(&self, gpu: &Gpu) {
        self.sea.upload(gpu);
        self.foam.upload(gpu);
    }
}

gpu_struct! {
    /// WGSL `SeaCascade`: one cascade in the uniform of a sea.
    #[derive(Default)]
    pub struct SeaCascade as "SeaCascade" {
        /// Side of the cascade's square patch, m.
        pub patch_m: f32,
        /// Spacing of the cascade's wave vectors, 2 pi / patch_m, rad/m.
        pub dk: f32,
        /// Key of the cascade's random numbers, which makes cascades independent.
        pub noise_key: u32,
        /// Unit in which the maps store the slope moments.
        pub moment_unit: f32,
    }
}

/// Largest number of terms of a directional spectrum: three spreading lobes for each of two wave systems.
pub const MAX_SPECTRUM_TERMS: usize = 6;

gpu_struct! {
    /// WGSL `SpectrumTerm`: one term of the directional spectrum, which is a sum of such terms.
    #[derive(Default)]
    pub struct SpectrumTerm as "SpectrumTerm" {
        /// Unit vector (x, z) of the direction from which the angles of the spreading function are measured.
        pub reference_direction: [f32; 2],
        /// Form of the term: 0 spreading lobe, 1 lobe times cos^2, 2 lobe times cos^2 in its forward half only, 3
        /// distribution measured by a buoy.
        pub kind: u32,
        /// Index of the term's first vec4f within an entry of the wave table.
        pub first_vector: u32,
    }
}

gpu_struct! {
    /// WGSL `Sea`: the uniform of one evaluation of a sea.
    #[derive(Default)]
    pub struct SeaUniform as "Sea" {
        /// Cascades of the sea, longest waves first.
        pub cascades: [SeaCascade; MAX_CASCADES],
        /// Terms of the directional spectrum, which is their sum.
        pub terms: [SpectrumTerm; MAX_SPECTRUM_TERMS],
        /// Amplitude factor of each cascade: 1 except during a cross-fade.
        pub amplitude_factors: [f32; MAX_CASCADES],
        /// Choppiness: factor of the horizontal displacement along x and z.
        pub choppiness: [f32; 2],
        /// FFT size: number of points along a side of a cascade's lattice.
        pub n: u32,
        /// Number of entries of `cascades` in use.
        pub cascade_count: u32,
        /// Seed of the random wave amplitudes.
        pub seed: u32,
        /// Time as a fraction of the sea's period, in units of 2^-32. Its product with a wave's number of cycles per
        /// period is the phase.
        pub time_in_period_u32: u32,
        /// If not 0, the column pass also keeps the maps in f32, in the buffer `row_transforms`.
        pub keeps_f32_maps: u32,
        /// Number of entries of `terms` in use.
        pub term_count: u32,
        /// Number of vec4f per entry of the wave table.
        pub vectors_per_entry: u32,
        /// Index of the first cascade among the layers of each kind of map.
        pub first_layer: u32,
        /// Weight with which the spectrum pass moves h0 to the amplitudes of the plan, 0 to 1; 1 replaces h0.
        pub spectrum_blend: f32,
        /// Unused; pads the struct to a multiple of 16 bytes.
        pub unused: u32,
    }
}

gpu_struct! {
    /// WGSL `FoamLevelCorner`: where the corner of a foam level lies on the maps of a cascade.
    #[derive(Default)]
    pub struct FoamLevelCorner as "FoamLevelCorner" {
        /// Position of the corner on the triangle lattice of the patch's shifted copies.
        pub tile_position: TileLatticePosition,
        /// Texture coordinates of the corner in the cascade's maps.
        pub uv: [f32; 2],
        /// Unused; pads the struct to a multiple of 16 bytes, as an array element needs it.
        pub unused: [u32; 2],
    }
}

gpu_struct! {
    /// WGSL `FoamLevel`: one foam level in the uniform of the foam.
    #[derive(Default)]
    pub struct FoamLevelUniform as "FoamLevel" {
        /// Position of the corner of the level's first cell on each drawn cascade.
        pub corners: [FoamLevelCorner; MAX_DRAWN_CASCADES],
        /// Lowest cell index along x and z that the level covers.
        pub first_cell: [i32; 2],
        /// Lowest cell index along x and z that the level covered at the previous time step.
        pub previous_first_cell: [i32; 2],
        /// Side of a foam cell, m.
        pub cell_m: f32,
        /// Jacobian below which foam forms.
        pub jacobian_threshold: f32,
        /// Slope of the foam source: clamp((threshold - Jacobian) x slope, 0, 1).
        pub source_slope: f32,
        /// Initial foam of a cell that has just entered the area of its level, 0 to 1.
        pub initial_foam: f32,
    }
}

gpu_struct! {
    /// WGSL `FoamCascade`: one drawn cascade in the uniform of the foam.
    #[derive(Default)]
    pub struct FoamCascade as "FoamCascade" {
        /// Side of the cascade's square patch, m.
        pub patch_m: f32,
        /// Index of the cascade among the layers of each kind of map.
        pub layer: u32,
        /// Unused; pads the struct to a multiple of 16 bytes, as an array element needs it.
        pub unused: [u32; 2],
    }
}

gpu_struct! {
    /// WGSL `Foam`: the uniform of one time step of the foam.
    #[derive(Default)]
    pub struct FoamUniform as "Foam" {
        /// Foam levels, finest first.
        pub levels: [FoamLevelUniform; FOAM_LEVELS],
        /// Cascades that are drawn, including those of a sea that fades out.
        pub cascades: [FoamCascade; MAX_DRAWN_CASCADES],
        /// Length of the time step, s.
        pub dt_s: f32,
        /// Decay rate of foam: 1 / e-folding time, 1/s.
        pub decay_per_s: f32,
        /// Rate at which foam grows where its source is 1, 1/s.
        pub growth_per_s: f32,
        /// Number of cells along a side of a foam level.
        pub cells_per_side: u32,
        /// Number of entries of `cascades` in use.
        pub cascade_count: u32,
        /// Unused; pads the struct to a multiple of 16 bytes.
        pub unused: [u32; 3],
    }
}

/// The structs that the simulation shares with its shaders.
pub const SHARED_STRUCTS: &[StructDeclaration] = &[
    SeaCascade::DECLARATION,
    SpectrumTerm::DECLARATION,
    SeaUniform::DECLARATION,
    TileLatticePosition::DECLARATION,
    FoamLevelCorner::DECLARATION,
    FoamLevelUniform::DECLARATION,
    FoamCascade::DECLARATION,
    FoamUniform::DECLARATION,
];
