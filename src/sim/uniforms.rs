//! The uniform structs of the simulation's passes.

use super::maps::{FOAM_LEVELS, MAX_CASCADES, MAX_DRAWN, TilePlace};
use crate::gpu::layout::{Declaration, gpu_struct};

gpu_struct! {
    /// WGSL `SeaCascade`.
    #[derive(Default)]
    pub struct SeaCascade as "SeaCascade" {
        /// Side of the patch, m.
        pub patch_m: f32,
        /// 2 pi / patch_m.
        pub dk: f32,
        /// Of the noise.
        pub key: u32,
        /// Unit of the slope moments in half floats.
        pub moment_scale: f32,
    }
}

/// Most parts of the directional spectrum: three lobes for each of two systems.
pub const MAX_TERMS: usize = 6;

gpu_struct! {
    /// WGSL `SeaTerm`.
    #[derive(Default)]
    pub struct SeaTerm as "SeaTerm" {
        /// Unit vector (x, z) that angles are measured from.
        pub travel: [f32; 2],
        /// 0 lobe, 1 lobe with cos^2, 2 lobe with forward cos^2, 3 measured.
        pub kind: u32,
        /// First quadruple in an entry of the table.
        pub slot: u32,
    }
}

gpu_struct! {
    /// WGSL `Sea`.
    #[derive(Default)]
    pub struct SeaUniform as "Sea" {
        /// Patches.
        pub cascades: [SeaCascade; MAX_CASCADES],
        /// Parts of the directional spectrum.
        pub terms: [SeaTerm; MAX_TERMS],
        /// Amplitude of each cascade: 1, unless one sea fades into another.
        pub weights: [f32; MAX_CASCADES],
        /// Horizontal displacement along x and z.
        pub chop: [f32; 2],
        /// FFT size.
        pub n: u32,
        /// Cascades in use.
        pub count: u32,
        /// Of the noise.
        pub seed: u32,
        /// t / period in units of 2^-32.
        pub phase_time: u32,
        /// Not 0: the column pass leaves an f32 copy of the maps in the intermediate buffer.
        pub keep_f32: u32,
        /// Parts in use.
        pub term_count: u32,
        /// Quadruples in an entry of the table.
        pub stride: u32,
        /// Layer of the maps that the first cascade goes to.
        pub first_layer: u32,
        /// How far the spectrum pass takes h0 from what it is to what the table says; 1 is all the way.
        pub ease: f32,
        /// The size is a multiple of 16 bytes.
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
    /// WGSL `FoamLevel`.
    #[derive(Default)]
    pub struct FoamLevelUniform as "FoamLevel" {
        /// Corner of the first cell in range, on each drawn cascade.
        pub corners: [FoamCorner; MAX_DRAWN],
        /// First cell in range.
        pub cell: [i32; 2],
        /// First cell in range at the last step.
        pub previous: [i32; 2],
        /// Size of a cell, m.
        pub texel_m: f32,
        /// Jacobian below which foam forms.
        pub threshold: f32,
        /// Source per unit of Jacobian below the threshold.
        pub slope: f32,
        /// Foam of a cell that comes into range.
        pub start: f32,
    }
}

gpu_struct! {
    /// WGSL `FoamCascade`.
    #[derive(Default)]
    pub struct FoamCascade as "FoamCascade" {
        /// Side of the patch, m.
        pub patch_m: f32,
        /// Of the maps.
        pub layer: u32,
        /// An element of a uniform's array is a multiple of 16 bytes.
        pub unused: [u32; 2],
    }
}

gpu_struct! {
    /// WGSL `Foam`.
    #[derive(Default)]
    pub struct FoamUniform as "Foam" {
        /// Levels, finest first.
        pub levels: [FoamLevelUniform; FOAM_LEVELS],
        /// The cascades that are drawn.
        pub cascades: [FoamCascade; MAX_DRAWN],
        /// Time step, s.
        pub dt: f32,
        /// 1 / e-folding time.
        pub decay: f32,
        /// Growth at full source, 1/s.
        pub rate: f32,
        /// Cells along a side.
        pub size: u32,
        /// Cascades in use.
        pub count: u32,
        /// The size is a multiple of 16 bytes.
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
