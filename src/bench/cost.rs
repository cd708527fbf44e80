//! What the passes move and compute, counted from their shaders: the least that each has to, every value once, so that a cache
//! can make no pass better than its budget.

use crate::gpu::map_format::MapFormat;
use crate::ocean::FOAM_LEVELS;
use crate::waves::tiling::MEAN_COPIES;

/// A budget.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Bytes that are read and written.
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

/// Of so much for every texel of every cascade.
fn texels(n: u32, cascades: u32, bytes: f64, flops: f64) -> Cost {
    let count = f64::from(n) * f64::from(n) * f64::from(cascades);
    Cost { bytes: count * bytes, flops: count * flops }
}

/// Four complex transforms along one axis, for each point.
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

/// The waves: both together.
pub fn waves(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    rows(n, cascades) + columns(n, cascades, maps)
}

/// Mips: two texels in, a third of three out, four values of eleven channels added for each texel that comes out.
pub fn mips(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    texels(n, cascades, 3.0 * f64::from(maps.bytes()), 4.0 * 14.0 / 3.0)
}

/// Foam: history in and out (8), a texel out, and for each cascade and copy four texels of two maps, with the arithmetic of their
/// mixture and of the blend.
pub fn foam(foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let (samples, texel) = (f64::from(cascades) * MEAN_COPIES, f64::from(maps.bytes()));
    let flops = 40.0 + 60.0 * f64::from(cascades) + 60.0 * samples;
    texels(foam_n, FOAM_LEVELS as u32, 8.0 + texel + 8.0 * texel * samples, flops)
}

/// All of the simulation in a frame at rest, with foam of `foam_n` cells along a side.
pub fn step(n: u32, foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    waves(n, cascades, maps) + mips(n, cascades, maps) + foam(foam_n, cascades, maps)
}

/// Work of a shader for a vertex or a pixel that has all of the default picture: additions and multiplications, roots, quotients and
/// transcendental functions as four, and reads of textures. `tests/costs.rs` counts them in the shaders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shading {
    /// Arithmetic.
    pub flops: f64,
    /// Texels or filtered samples.
    pub reads: f64,
}

/// A vertex of the mesh that is displaced.
pub const VERTEX: Shading = Shading { flops: 3000.0, reads: 67.6 };
/// The same, drawn.
pub const DRAWN_VERTEX: Shading = Shading { flops: 32.0, reads: 0.0 };
/// A pixel of the mesh.
pub const SHOWN: Shading = Shading { flops: 36.0, reads: 0.0 };
/// A pixel of the sea that is lit.
pub const LIGHT: Shading = Shading { flops: 10900.0, reads: 90.7 };
/// A pixel of the sky.
pub const BACKGROUND: Shading = Shading { flops: 2200.0, reads: 8.0 };
/// A pixel that is presented.
pub const PRESENT: Shading = Shading { flops: 770.0, reads: 10.0 };

/// What a picture consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// Pixels.
    pub pixels: f64,
    /// Share of them that lies below the horizon.
    pub sea: f64,
    /// Vertices of the mesh.
    pub vertices: f64,
    /// Bytes of the displacement maps with their mips; slopes and their moments take as many each.
    pub map_bytes: f64,
}

impl Picture {
    /// The mesh: a vertex written, read and three times named by a triangle of the two that it stands for (120), the displacement and
    /// the slopes, and what a pixel shows (32) with its depth (4).
    pub fn mesh(&self) -> Cost {
        let seen = self.pixels * self.sea;
        Cost {
            bytes: 120.0 * self.vertices + 36.0 * seen + 2.0 * self.map_bytes,
            flops: (VERTEX.flops + DRAWN_VERTEX.flops) * self.vertices + SHOWN.flops * seen,
        }
    }

    /// The mesh and its light: what a pixel shows (32), its depth (4), the light (8), the three maps.
    pub fn water(&self) -> Cost {
        let seen = self.pixels * self.sea;
        let light = Cost { bytes: 44.0 * seen + 3.0 * self.map_bytes, flops: LIGHT.flops * seen };
        self.mesh() + light
    }

    /// The sky: light (8) and depth (4).
    pub fn background(&self) -> Cost {
        let seen = self.pixels * (1.0 - self.sea);
        Cost { bytes: 12.0 * seen, flops: BACKGROUND.flops * seen }
    }

    /// The light in (8), four bytes out.
    pub fn present(&self) -> Cost {
        Cost { bytes: 12.0 * self.pixels, flops: PRESENT.flops * self.pixels }
    }
}
