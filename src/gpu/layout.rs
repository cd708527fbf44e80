//! Structs that Rust and WGSL share. Ordered so that no padding exists; a test compares them with the parsed shaders.

use bytemuck::{Pod, Zeroable};

/// Most cascades of a sea.
pub const MAX_CASCADES: usize = 4;
/// Most cascades that are drawn: those of a sea, and of the one that it fades out of.
pub const MAX_DRAWN: usize = 2 * MAX_CASCADES;
/// Levels of the foam clipmap.
pub const FOAM_LEVELS: usize = 4;

/// WGSL `SeaCascade`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct SeaCascade {
    /// Side of the patch, m.
    pub patch_m: f32,
    /// 2 pi / patch_m.
    pub dk: f32,
    /// Of the noise.
    pub key: u32,
    /// Unit of the slope moments in half floats.
    pub moment_scale: f32,
}

/// Most parts of the directional spectrum: three lobes for each of two systems.
pub const MAX_TERMS: usize = 6;

/// WGSL `SeaTerm`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct SeaTerm {
    /// Unit vector (x, z) that angles are measured from.
    pub travel: [f32; 2],
    /// 0 lobe, 1 lobe with cos^2, 2 lobe with forward cos^2, 3 measured.
    pub kind: u32,
    /// First quadruple in an entry of the table.
    pub slot: u32,
}

/// WGSL `Sea`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct SeaUniform {
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

/// WGSL `TilePlace`: the lattice of a patch's copies as seen from a point.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct TilePlace {
    /// Cosine and sine of its angle, over the side of a triangle.
    pub turn: [f32; 2],
    /// The point in lattice coordinates, beyond its cell.
    pub rest: [f32; 2],
    /// Whole lattice coordinates of the point.
    pub cell: [i32; 2],
    /// Of the shifts.
    pub key: u32,
    /// 0: the patch repeats.
    pub on: u32,
}

/// WGSL `FoamLevel`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct FoamLevelUniform {
    /// Texture coordinates of the first cell's corner on each cascade.
    pub uv: [[f32; 2]; MAX_DRAWN],
    /// And on the lattices of their copies.
    pub tiles: [TilePlace; MAX_DRAWN],
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

/// WGSL `FoamCascade`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct FoamCascade {
    /// Side of the patch, m.
    pub patch_m: f32,
    /// Of the maps.
    pub layer: u32,
    /// An element of a uniform's array is a multiple of 16 bytes.
    pub unused: [u32; 2],
}

/// WGSL `Foam`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct FoamUniform {
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

/// A WGSL struct as Rust sees it: its name, members with offsets in bytes, and size.
pub type Layout = (&'static str, &'static [(&'static str, usize)], usize);

macro_rules! layout {
    ($wgsl:literal, $rust:ty, $($field:ident as $name:literal),+) => {
        ($wgsl, &[$(($name, std::mem::offset_of!($rust, $field))),+], size_of::<$rust>())
    };
}

/// What the layout test compares with the shaders.
pub const LAYOUTS: &[Layout] = &[
    layout!("SeaCascade", SeaCascade, patch_m as "patch_m", dk as "dk", key as "key", moment_scale as "moment_scale"),
    layout!("SeaTerm", SeaTerm, travel as "travel", kind as "kind", slot as "slot"),
    layout!(
        "Sea", SeaUniform, cascades as "cascades", terms as "terms", weights as "weights", chop as "chop", n as "n", count as "count",
        seed as "seed", phase_time as "phase_time", keep_f32 as "keep_f32", term_count as "term_count",
        stride as "stride", first_layer as "first_layer", ease as "ease"
    ),
    layout!(
        "TilePlace", TilePlace, turn as "turn", rest as "rest", cell as "cell", key as "key", on as "on"
    ),
    layout!(
        "FoamLevel", FoamLevelUniform, uv as "uv", tiles as "tiles", cell as "cell", previous as "previous", texel_m as "texel_m",
        threshold as "threshold", slope as "slope", start as "start"
    ),
    layout!("FoamCascade", FoamCascade, patch_m as "patch_m", layer as "layer"),
    layout!(
        "Foam", FoamUniform, levels as "levels", cascades as "cascades", dt as "dt", decay as "decay", rate as "rate",
        size as "size", count as "count"
    ),
];
