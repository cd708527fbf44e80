//! The uniform structs of the simulation's passes, and the buffers that hold them.

use super::maps::{FOAM_LEVELS, MAX_CASCADES, MAX_DRAWN, TilePlace};
use crate::gpu::Gpu;
use crate::gpu::kit::Slot;
use crate::gpu::layout::{Declaration, gpu_struct};
use crate::gpu::uniform::UniformRing;

/// The uniforms of a submission.
pub struct UniformRings {
    /// One for each evaluation of a sea.
    pub sea: UniformRing<SeaUniform>,
    /// One for each time step of the foam.
    pub foam: UniformRing<FoamUniform>,
}

impl UniformRings {
    /// Binding of `sea`.
    pub const SEA: Slot = Slot::UniformAt(size_of::<SeaUniform>());
    /// Binding of `foam`.
    pub const FOAM: Slot = Slot::UniformAt(size_of::<FoamUniform>());

    /// Allocates both buffers, for submissions of at most `foam_steps` time steps of the foam.
    pub fn new(gpu: &Gpu, foam_steps: usize) -> Self {
        // An evaluation for each time step and one without foam, for two seas, and the spectrum pass.
        let evaluations = 2 * (foam_steps + 1) + 1;
        Self { sea: UniformRing::new(gpu, "sea", evaluations), foam: UniformRing::new(gpu, "foam", foam_steps) }
    }

    /// Discards the uniforms of the last submission.
    pub fn restart(&mut self) {
        self.sea.restart();
        self.foam.restart();
    }

    /// Sends the uniforms to the GPU.
    pub fn upload(&self, gpu: &Gpu) {
        self.sea.upload(gpu);
        self.foam.upload(gpu);
    }
}

gpu_struct! {
    /// A cascade in the uniform of a sea (WGSL `SeaCascade`).
    #[derive(Default)]
    pub struct SeaCascade as "SeaCascade" {
        /// Side of the patch, m.
        pub patch_m: f32,
        /// 2 pi / patch_m.
        pub dk: f32,
        /// Noise key.
        pub key: u32,
        /// Unit of the slope moments in the maps.
        pub moment_scale: f32,
    }
}

/// Largest number of terms of the directional spectrum: three lobes for each of two wave systems.
pub const MAX_TERMS: usize = 6;

gpu_struct! {
    /// A term of the directional spectrum (WGSL `SeaTerm`).
    #[derive(Default)]
    pub struct SeaTerm as "SeaTerm" {
        /// Unit vector (x, z) from which angles are measured.
        pub travel: [f32; 2],
        /// 0 lobe, 1 lobe with cos^2, 2 lobe with forward cos^2, 3 measured.
        pub kind: u32,
        /// First quadruple within an entry of the table.
        pub slot: u32,
    }
}

gpu_struct! {
    /// Uniform of one evaluation of a sea (WGSL `Sea`).
    #[derive(Default)]
    pub struct SeaUniform as "Sea" {
        /// Cascades, longest waves first.
        pub cascades: [SeaCascade; MAX_CASCADES],
        /// Terms of the directional spectrum.
        pub terms: [SeaTerm; MAX_TERMS],
        /// Amplitude of each cascade: 1 except during a cross-fade.
        pub weights: [f32; MAX_CASCADES],
        /// Horizontal displacement factor along x and z.
        pub chop: [f32; 2],
        /// FFT size.
        pub n: u32,
        /// Cascades in use.
        pub count: u32,
        /// Seed of the noise.
        pub seed: u32,
        /// t / period in units of 2^-32.
        pub phase_time: u32,
        /// Not 0: the column pass also leaves the maps in the intermediate buffer, in f32.
        pub keep_f32: u32,
        /// Terms in use.
        pub term_count: u32,
        /// Number of vec4f per entry of the wave table.
        pub stride: u32,
        /// Map layer of the first cascade.
        pub first_layer: u32,
        /// Weight of the tabulated amplitudes in the spectrum pass; 1 replaces the current h0.
        pub blend: f32,
        /// Pads the size to a multiple of 16 bytes.
        pub unused: u32,
    }
}

gpu_struct! {
    /// WGSL `FoamCorner`: a point of the plane on the maps of a cascade.
    #[derive(Default)]
    pub struct FoamCorner as "FoamCorner" {
        /// The point on the lattice of the patch's copies.
        pub tile: TilePlace,
        /// Texture coordinates of the point.
        pub uv: [f32; 2],
        /// Pads an array element to a multiple of 16 bytes.
        pub unused: [u32; 2],
    }
}

gpu_struct! {
    /// A foam level in the uniform of the foam (WGSL `FoamLevel`).
    #[derive(Default)]
    pub struct FoamLevelUniform as "FoamLevel" {
        /// Corner of the first cell in range on each drawn cascade.
        pub corners: [FoamCorner; MAX_DRAWN],
        /// First cell in range.
        pub cell: [i32; 2],
        /// First cell in range at the previous time step.
        pub previous: [i32; 2],
        /// Size of a cell, m.
        pub texel_m: f32,
        /// Jacobian below which foam forms.
        pub threshold: f32,
        /// Foam source per unit by which the Jacobian lies below the threshold.
        pub slope: f32,
        /// Initial foam of a cell that has just entered the area of its level, 0 to 1.
        pub start: f32,
    }
}

gpu_struct! {
    /// A cascade in the uniform of the foam (WGSL `FoamCascade`).
    #[derive(Default)]
    pub struct FoamCascade as "FoamCascade" {
        /// Side of the patch, m.
        pub patch_m: f32,
        /// Layer of the maps.
        pub layer: u32,
        /// Pads an array element to a multiple of 16 bytes.
        pub unused: [u32; 2],
    }
}

gpu_struct! {
    /// Uniform of one time step of the foam (WGSL `Foam`).
    #[derive(Default)]
    pub struct FoamUniform as "Foam" {
        /// Levels, finest first.
        pub levels: [FoamLevelUniform; FOAM_LEVELS],
        /// The drawn cascades.
        pub cascades: [FoamCascade; MAX_DRAWN],
        /// Time step, s.
        pub dt: f32,
        /// 1 / e-folding time, 1/s.
        pub decay: f32,
        /// Growth at full source, 1/s.
        pub rate: f32,
        /// Cells along a side.
        pub size: u32,
        /// Cascades in use.
        pub count: u32,
        /// Pads the size to a multiple of 16 bytes.
        pub unused: [u32; 3],
    }
}

/// The structs that the simulation shares with its shaders.
pub const STRUCTS: &[Declaration] = &[
    SeaCascade::DECLARATION,
    SeaTerm::DECLARATION,
    SeaUniform::DECLARATION,
    TilePlace::DECLARATION,
    FoamCorner::DECLARATION,
    FoamLevelUniform::DECLARATION,
    FoamCascade::DECLARATION,
    FoamUniform::DECLARATION,
];
