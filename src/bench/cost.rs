//! Least memory traffic and arithmetic of the passes, counted from their shaders. Every value counts once, so that no
//! cache makes a pass cheaper than its cost here.

use crate::gpu::map_format::MapFormat;
use crate::ocean::FOAM_LEVELS;
use crate::waves::tiling::MEAN_COPIES;

/// Memory traffic and arithmetic of a pass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Bytes read and written.
    pub bytes: f64,
    /// Additions and multiplications.
    pub flops: f64,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { bytes: self.bytes + other.bytes, flops: self.flops + other.flops }
    }
}

/// The cost of this many bytes and operations per texel of every cascade.
fn texels(n: u32, cascades: u32, bytes: f64, flops: f64) -> Cost {
    let count = f64::from(n) * f64::from(n) * f64::from(cascades);
    Cost { bytes: count * bytes, flops: count * flops }
}

/// Operations per point of four complex transforms along one axis.
fn transforms(n: u32) -> f64 {
    4.0 * 5.0 * f64::from(n.ilog2())
}

/// Waves at a time and their transform along x: h0 of a wave and of the opposite one (16), an eighth of an entry of the table
/// (1), four complex numbers out (32). Software adapters compute a wave once for two lines; that is not subtracted.
pub fn rows(n: u32, cascades: u32) -> Cost {
    texels(n, cascades, 49.0, 30.0 + 14.0 + 40.0 + transforms(n))
}

/// The transform along z and the maps: four complex numbers in (32), two texels out.
pub fn columns(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    texels(n, cascades, 32.0 + 2.0 * f64::from(maps.bytes()), transforms(n))
}

/// The waves: rows and columns together.
pub fn waves(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    rows(n, cascades) + columns(n, cascades, maps)
}

/// Mips: two texels in, a third of three out; each output texel adds four values of eleven channels.
pub fn mips(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    texels(n, cascades, 3.0 * f64::from(maps.bytes()), 4.0 * 14.0 / 3.0)
}

/// Foam: history in and out (8), a texel out, and four texels of two maps for each cascade and copy, with their
/// bilinear weights and the blend of the copies.
pub fn foam(foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let (samples, texel) = (f64::from(cascades) * MEAN_COPIES, f64::from(maps.bytes()));
    let flops = 40.0 + 60.0 * f64::from(cascades) + 60.0 * samples;
    texels(foam_n, FOAM_LEVELS as u32, 8.0 + texel + 8.0 * texel * samples, flops)
}

/// The whole simulation of a frame without a cross-fade, with foam of `foam_n` cells along a side.
pub fn step(n: u32, foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    waves(n, cascades, maps) + mips(n, cascades, maps) + foam(foam_n, cascades, maps)
}

/// Work of a shader for a vertex or pixel with all parts of the default picture. A root, quotient or transcendental
/// function counts as four operations. `tests/costs.rs` counts the shaders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaderCost {
    /// Operations.
    pub flops: f64,
    /// Texture reads: texels or filtered samples.
    pub reads: f64,
}

/// Displacing a vertex of the mesh.
pub const VERTEX: ShaderCost = ShaderCost { flops: 3000.0, reads: 67.6 };
/// Drawing a vertex of the mesh.
pub const DRAWN_VERTEX: ShaderCost = ShaderCost { flops: 32.0, reads: 0.0 };
/// Drawing a pixel of the mesh.
pub const SHOWN: ShaderCost = ShaderCost { flops: 36.0, reads: 0.0 };
/// Lighting a pixel of the sea.
pub const LIGHT: ShaderCost = ShaderCost { flops: 10550.0, reads: 89.7 };
/// Drawing a pixel of the sky.
pub const BACKGROUND: ShaderCost = ShaderCost { flops: 2200.0, reads: 8.0 };
/// Presenting a pixel.
pub const PRESENT: ShaderCost = ShaderCost { flops: 770.0, reads: 10.0 };

/// Contents of a picture that determine its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureContents {
    /// Number of pixels.
    pub pixels: f64,
    /// Share of the pixels below the horizon, 0 to 1.
    pub sea: f64,
    /// Number of vertices of the mesh.
    pub vertices: f64,
    /// Bytes of the displacement maps with their mips; the gradients and the moments take as many each.
    pub map_bytes: f64,
}

impl PictureContents {
    /// The mesh: a vertex is written, read, and indexed by six corners of triangles (120); the displacement and
    /// gradient maps are read; a pixel writes its surface data (32) and depth (4).
    pub fn mesh(&self) -> Cost {
        let seen = self.pixels * self.sea;
        Cost {
            bytes: 120.0 * self.vertices + 36.0 * seen + 2.0 * self.map_bytes,
            flops: (VERTEX.flops + DRAWN_VERTEX.flops) * self.vertices + SHOWN.flops * seen,
        }
    }

    /// The mesh and its lighting: a pixel reads its surface data (32) and depth (4), and writes its light (8); the
    /// three maps are read.
    pub fn water(&self) -> Cost {
        let seen = self.pixels * self.sea;
        let light = Cost { bytes: 44.0 * seen + 3.0 * self.map_bytes, flops: LIGHT.flops * seen };
        self.mesh() + light
    }

    /// The sky: a pixel writes its light (8) and reads its depth (4).
    pub fn background(&self) -> Cost {
        let seen = self.pixels * (1.0 - self.sea);
        Cost { bytes: 12.0 * seen, flops: BACKGROUND.flops * seen }
    }

    /// Presenting: a pixel reads its light (8) and writes four bytes.
    pub fn present(&self) -> Cost {
        Cost { bytes: 12.0 * self.pixels, flops: PRESENT.flops * self.pixels }
    }
}
