//! Minimum memory traffic and arithmetic of each pass, counted from its shader. Every value counts once, so no cache
//! can make a pass cheaper.

use crate::gpu::map_format::MapFormat;
use crate::ocean::FOAM_LEVEL_COUNT;
use crate::waves::tiling::MEAN_BLENDED_COPIES;

/// Minimum memory traffic and arithmetic of one pass, or of several together: no GPU can do with less.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Number of bytes that are read from memory plus those that are written to it, each value counted once.
    pub bytes: f64,
    /// Number of floating-point operations, mainly additions and multiplications.
    pub flops: f64,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { bytes: self.bytes + other.bytes, flops: self.flops + other.flops }
    }
}

/// Cost of a pass with `bytes` and `flops` per texel, for the n x n texels of each of `cascades` cascades.
fn cost_of_texels(n: u32, cascades: u32, bytes: f64, flops: f64) -> Cost {
    let count = f64::from(n) * f64::from(n) * f64::from(cascades);
    Cost { bytes: count * bytes, flops: count * flops }
}

/// Number of floating-point operations per lattice point of four complex FFTs of size `n` along one axis: 5 log2(n)
/// each.
fn fft_flops_per_point(n: u32) -> f64 {
    4.0 * 5.0 * f64::from(n.ilog2())
}

/// Cost of the row pass for FFT size `n`: the waves at a time and their FFT along x. Bytes per point: the amplitudes h0
/// of a wave and of the opposite one at time 0 (16), an eighth of an entry of `Maps::wave_table`, which eight waves
/// share (1), four complex results (32). Software adapters share some work between two rows; it counts in full here.
pub fn row_pass_cost(n: u32, cascades: u32) -> Cost {
    cost_of_texels(n, cascades, 49.0, 30.0 + 14.0 + 40.0 + fft_flops_per_point(n))
}

/// Cost of the column pass for FFT size `n`: FFT along z, and writing of the maps. Bytes per point: four complex inputs
/// (32), a texel of the displacement map and one of the gradient map.
pub fn column_pass_cost(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    cost_of_texels(n, cascades, 32.0 + 2.0 * f64::from(maps.bytes_per_texel()), fft_flops_per_point(n))
}

/// Cost of the row pass and the column pass together, which compute the waves' maps by an FFT.
pub fn row_and_column_pass_cost(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    row_pass_cost(n, cascades) + column_pass_cost(n, cascades, maps)
}

/// Minimum cost of the mip pass. Per texel of mip level 0, a texel of the displacement and of the gradient map is read,
/// and a third of three texels is written (all smaller levels of these two and of the slope moments). A texel of the
/// three written maps together takes 4 x 14 operations: sums over eleven channels, and three products of slopes.
pub fn mip_pass_cost(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    cost_of_texels(n, cascades, 3.0 * f64::from(maps.bytes_per_texel()), 4.0 * 14.0 / 3.0)
}

/// Cost of the foam pass. Bytes per foam cell: its foam read and written (8), a texel of the foam map written, and four
/// texels each of displacement and gradient map read for every cascade and blended, shifted copy of the cascade's
/// patch (`MEAN_COPIES` on average). Operations include weighting and blending of these texels.
pub fn foam_pass_cost(foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let (samples, texel) = (f64::from(cascades) * MEAN_BLENDED_COPIES, f64::from(maps.bytes_per_texel()));
    let flops = 40.0 + 60.0 * f64::from(cascades) + 60.0 * samples;
    cost_of_texels(foam_n, FOAM_LEVEL_COUNT as u32, 8.0 + texel + 8.0 * texel * samples, flops)
}

/// Cost of simulating one frame (waves, mip levels, foam): FFT size `n`, foam levels of `foam_n` x `foam_n` cells.
pub fn simulation_step_cost(n: u32, foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    row_and_column_pass_cost(n, cascades, maps)
        + mip_pass_cost(n, cascades, maps)
        + foam_pass_cost(foam_n, cascades, maps)
}

/// Operations and texture reads of a shader per vertex or pixel, with all features of the default picture. A root,
/// quotient or transcendental function counts as four operations. `tests/costs.rs` checks these counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaderCost {
    /// Number of floating-point operations of one vertex or pixel.
    pub flops: f64,
    /// Number of texture reads of one vertex or pixel, each of one texel or one filtered sample.
    pub texture_reads: f64,
}

/// Floating-point operations and texture reads per vertex of the compute pass that displaces the sea mesh.
pub const DISPLACE_VERTEX_COST: ShaderCost = ShaderCost { flops: 2460.0, texture_reads: 67.6 };
/// Operations per vertex of the vertex shader that draws the already displaced sea mesh.
pub const MESH_VERTEX_COST: ShaderCost = ShaderCost { flops: 32.0, texture_reads: 0.0 };
/// Operations per pixel of the fragment shader that draws the sea mesh to the G-buffer (surface data per pixel).
pub const MESH_FRAGMENT_COST: ShaderCost = ShaderCost { flops: 36.0, texture_reads: 0.0 };
/// Floating-point operations and texture reads per pixel of the fragment shader that lights the sea in the G-buffer.
pub const LIGHT_FRAGMENT_COST: ShaderCost = ShaderCost { flops: 8400.0, texture_reads: 89.7 };
/// Floating-point operations and texture reads per pixel of the fragment shader that draws the sky above the sea.
pub const BACKGROUND_FRAGMENT_COST: ShaderCost = ShaderCost { flops: 2140.0, texture_reads: 8.0 };
/// Operations and texture reads per pixel of the tone pass, which turns the HDR picture into screen colours. They count
/// a pixel on an edge; off edges it takes about 190 operations and 5 reads.
pub const TONE_FRAGMENT_COST: ShaderCost = ShaderCost { flops: 500.0, texture_reads: 10.0 };
/// Operations and texture reads per pixel of the present pass if it enlarges the picture.
pub const PRESENT_FRAGMENT_COST: ShaderCost = ShaderCost { flops: 275.0, texture_reads: 5.0 };
/// Operations per pixel of the present pass if the picture has the size of the canvas, so that it is copied.
const PRESENT_COPY_FLOPS: f64 = 20.0;

/// Numbers of pixels, vertices and bytes in one picture, from which the cost of drawing it follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureContents {
    /// Number of pixels of the picture.
    pub pixels: f64,
    /// Fraction of the pixels that lie below the horizon, all of which count as sea, 0 to 1.
    pub sea_fraction: f64,
    /// Number of vertices of the sea mesh.
    pub vertices: f64,
    /// Size of all displacement maps with mip levels, bytes. Gradient maps together count as much, so do slope moments.
    pub map_bytes: f64,
}

impl PictureContents {
    /// Minimum cost of drawing the sea mesh to the G-buffer. Bytes: 120 per vertex (written, read, and six indices of
    /// triangle corners); displacement and gradient maps once; surface data (32) and depth (4) per sea pixel.
    pub fn mesh_cost(&self) -> Cost {
        let seen = self.pixels * self.sea_fraction;
        Cost {
            bytes: 120.0 * self.vertices + 36.0 * seen + 2.0 * self.map_bytes,
            flops: (DISPLACE_VERTEX_COST.flops + MESH_VERTEX_COST.flops) * self.vertices
                + MESH_FRAGMENT_COST.flops * seen,
        }
    }

    /// Minimum cost of drawing and lighting the sea mesh. Lighting a sea pixel reads its surface data (32 bytes) and
    /// depth (4), and writes its light (8). The maps (displacement, gradients, slope moments) are read once.
    pub fn water_cost(&self) -> Cost {
        let seen = self.pixels * self.sea_fraction;
        let light = Cost { bytes: 44.0 * seen + 3.0 * self.map_bytes, flops: LIGHT_FRAGMENT_COST.flops * seen };
        self.mesh_cost() + light
    }

    /// Cost of drawing the sky: a sky pixel writes its light (8 bytes) and reads its depth (4).
    pub fn background_cost(&self) -> Cost {
        let seen = self.pixels * (1.0 - self.sea_fraction);
        Cost { bytes: 12.0 * seen, flops: BACKGROUND_FRAGMENT_COST.flops * seen }
    }

    /// Cost of the tone pass (HDR picture to screen colours): a pixel reads light (8 bytes), writes colour (4).
    pub fn tone_cost(&self) -> Cost {
        Cost { bytes: 12.0 * self.pixels, flops: TONE_FRAGMENT_COST.flops * self.pixels }
    }

    /// Cost of the present pass (finished picture to a canvas of the same size): a pixel reads and writes a colour (4
    /// bytes each).
    pub fn present_cost(&self) -> Cost {
        Cost { bytes: 8.0 * self.pixels, flops: PRESENT_COPY_FLOPS * self.pixels }
    }
}
