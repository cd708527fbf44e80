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
    /// Number of texture reads, each of one texel or one filtered sample.
    pub reads: f64,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { bytes: self.bytes + other.bytes, flops: self.flops + other.flops, reads: self.reads + other.reads }
    }
}

impl Cost {
    /// Cost of `count` runs of a shader.
    fn of_shader(shader: &ShaderCost, count: f64) -> Self {
        Self { bytes: 0.0, flops: shader.ops * count, reads: shader.reads * count }
    }

    fn of_bytes(bytes: f64) -> Self {
        Self { bytes, ..Self::default() }
    }
}

/// Cost of a pass with the cost `texel` per texel, for the n x n texels of each of `cascades` cascades.
fn cost_of_texels(n: u32, cascades: u32, texel: Cost) -> Cost {
    let count = f64::from(n) * f64::from(n) * f64::from(cascades);
    Cost { bytes: count * texel.bytes, flops: count * texel.flops, reads: count * texel.reads }
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
    let flops = 30.0 + 14.0 + 40.0 + fft_flops_per_point(n);
    cost_of_texels(n, cascades, Cost { bytes: 49.0, flops, reads: 0.0 })
}

/// Cost of the column pass for FFT size `n`: FFT along z, and writing of the maps. Bytes per point: four complex inputs
/// (32), a texel of the displacement map and one of the gradient map.
pub fn column_pass_cost(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let bytes = 32.0 + 2.0 * f64::from(maps.bytes_per_texel());
    cost_of_texels(n, cascades, Cost { bytes, flops: fft_flops_per_point(n), reads: 0.0 })
}

/// Cost of the row pass and the column pass together, which compute the waves' maps by an FFT.
pub fn row_and_column_pass_cost(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    row_pass_cost(n, cascades) + column_pass_cost(n, cascades, maps)
}

/// Minimum cost of the mip pass. Per texel of mip level 0, a texel of the displacement and of the gradient map is read,
/// and a third of three texels is written (all smaller levels of these two and of the slope moments). A texel of the
/// three written maps together takes 4 x 14 operations: sums over eleven channels, and three products of slopes.
pub fn mip_pass_cost(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let bytes = 3.0 * f64::from(maps.bytes_per_texel());
    cost_of_texels(n, cascades, Cost { bytes, flops: 4.0 * 14.0 / 3.0, reads: 2.0 })
}

/// Numbers of waves, groups and grid points of a coast, from which the cost of its passes is counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoastSizes {
    /// Number of waves that the coast transforms.
    pub waves: u32,
    /// Number of points of the coast's grid.
    pub points: u32,
    /// Number of groups of waves.
    pub groups: u32,
}

/// Cost of the passes for the waves at a coast, with FFT size `n`. Per wave and point: an envelope of two half floats and
/// 17 operations. Per group and point: a texel written and read. Per group and texel of the map: a filtered sample and 62
/// operations, of which 39 are for the carrier's cosine and sine. Per texel: elevation and potential written and read (16
/// bytes; neighbours come from a cache), three texels of maps written, and 240 operations. Besides,
/// the row and the column pass run for one more cascade, and the mip pass for two.
pub fn coast_pass_cost(n: u32, sizes: CoastSizes, maps: MapFormat) -> Cost {
    let CoastSizes { waves, points, groups } = sizes;
    let texel = f64::from(maps.bytes_per_texel());
    let [waves, points, groups] = [waves, points, groups].map(f64::from);
    let sums =
        Cost { bytes: waves * points * 4.0 + groups * points * 2.0 * texel, flops: waves * points * 17.0, reads: 0.0 };
    let maps_cost = Cost { bytes: 16.0 + 3.0 * texel, flops: groups * 62.0 + 240.0, reads: groups + 1.0 };
    sums + cost_of_texels(n, 1, maps_cost) + row_and_column_pass_cost(n, 1, maps) + mip_pass_cost(n, 2, maps)
}

/// Cost of the foam pass. Bytes per foam cell: its foam read and written (8), a texel of the foam map written, and four
/// texels each of displacement and gradient map read for every cascade and blended, shifted copy of the cascade's
/// patch (`MEAN_COPIES` on average). Operations include weighting and blending of these texels.
pub fn foam_pass_cost(foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let (samples, texel) = (f64::from(cascades) * MEAN_BLENDED_COPIES, f64::from(maps.bytes_per_texel()));
    let flops = 40.0 + 60.0 * f64::from(cascades) + 60.0 * samples;
    let bytes = 8.0 + texel + 8.0 * texel * samples;
    cost_of_texels(foam_n, FOAM_LEVEL_COUNT as u32, Cost { bytes, flops, reads: 2.0 * samples })
}

/// Cost of simulating one frame (waves, mip levels, foam): FFT size `n`, foam levels of `foam_n` x `foam_n` cells.
pub fn simulation_step_cost(n: u32, foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    row_and_column_pass_cost(n, cascades, maps)
        + mip_pass_cost(n, cascades, maps)
        + foam_pass_cost(foam_n, cascades, maps)
}

/// Numbers of operations and texture reads that a shader executes per vertex or pixel of the default picture. A root,
/// quotient or transcendental function counts as four operations. `tests/costs.rs` measures these counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaderCost {
    /// Mean number of floating-point and integer operations.
    pub ops: f64,
    /// Mean number of texture reads, each of one texel or one filtered sample.
    pub reads: f64,
    /// Number of operations of the dearest vertex or pixel.
    pub max_ops: f64,
    /// Number of texture reads of the vertex or pixel that has most.
    pub max_reads: f64,
}

/// Cost per vertex of the compute pass that displaces the sea mesh.
pub const DISPLACE_VERTEX_COST: ShaderCost = ShaderCost { ops: 1122.4, reads: 16.2, max_ops: 2427.0, max_reads: 47.0 };
/// As [`DISPLACE_VERTEX_COST`], with the shadows that waves cast on each other while the sun stands at 5 degrees.
pub const SHADED_DISPLACE_VERTEX_COST: ShaderCost =
    ShaderCost { ops: 2861.1, reads: 37.1, max_ops: 6777.0, max_reads: 121.0 };
/// Cost per vertex of the vertex shader that draws the already displaced sea mesh.
pub const MESH_VERTEX_COST: ShaderCost = ShaderCost { ops: 38.0, reads: 0.0, max_ops: 38.0, max_reads: 0.0 };
/// Cost per pixel of the fragment shader that draws the sea mesh to the G-buffer (surface data per pixel).
pub const MESH_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 31.0, reads: 0.0, max_ops: 31.0, max_reads: 0.0 };
/// Cost per pixel of the fragment shader that lights the sea in the G-buffer.
pub const LIGHT_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 2995.1, reads: 30.4, max_ops: 5206.0, max_reads: 60.0 };
/// Cost per pixel of the fragment shader that lights the sea in the lean tier.
pub const LEAN_LIGHT_FRAGMENT_COST: ShaderCost =
    ShaderCost { ops: 1458.2, reads: 13.3, max_ops: 2498.0, max_reads: 19.0 };
/// Cost per pixel of the fragment shader that draws the sky above the sea.
pub const BACKGROUND_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 249.4, reads: 1.2, max_ops: 331.0, max_reads: 2.0 };
/// Cost per pixel of the tone pass, which turns the HDR picture into screen colours.
pub const TONE_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 317.1, reads: 3.1, max_ops: 613.0, max_reads: 11.0 };
/// Cost per pixel of the tone pass with local exposure.
pub const TONE_LOCAL_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 459.1, reads: 7.2, max_ops: 755.0, max_reads: 15.0 };
/// Cost per pixel of the present pass if the picture has the size of the canvas, so that it is copied.
pub const COPY_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 20.0, reads: 1.0, max_ops: 20.0, max_reads: 1.0 };
/// Cost per pixel of the present pass if it enlarges the picture.
pub const ENLARGE_FRAGMENT_COST: ShaderCost = ShaderCost { ops: 276.0, reads: 5.0, max_ops: 276.0, max_reads: 5.0 };

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
    /// Cost per sea pixel of the light's shader: [`LIGHT_FRAGMENT_COST`] or [`LEAN_LIGHT_FRAGMENT_COST`].
    pub light: ShaderCost,
    /// Cost per vertex of displacing the mesh: [`DISPLACE_VERTEX_COST`] or [`SHADED_DISPLACE_VERTEX_COST`].
    pub displace: ShaderCost,
    /// Cost per pixel of the tone pass: [`TONE_FRAGMENT_COST`] or [`TONE_LOCAL_FRAGMENT_COST`].
    pub tone: ShaderCost,
}

impl PictureContents {
    /// Minimum cost of drawing the sea mesh to the G-buffer. Bytes: 88 per vertex (written, read, and six indices of
    /// triangle corners); displacement and gradient maps once; surface data (20) and depth (4) per sea pixel.
    pub fn mesh_cost(&self) -> Cost {
        let seen = self.pixels * self.sea_fraction;
        Cost::of_bytes(88.0 * self.vertices + 24.0 * seen + 2.0 * self.map_bytes)
            + Cost::of_shader(&self.displace, self.vertices)
            + Cost::of_shader(&MESH_VERTEX_COST, self.vertices)
            + Cost::of_shader(&MESH_FRAGMENT_COST, seen)
    }

    /// Minimum cost of lighting the sea. A sea pixel reads its surface data (20 bytes) and depth (4), and writes its
    /// light (8). The maps (displacement, gradients, slope moments) are read once.
    pub fn light_cost(&self) -> Cost {
        let seen = self.pixels * self.sea_fraction;
        Cost::of_bytes(32.0 * seen + 3.0 * self.map_bytes) + Cost::of_shader(&self.light, seen)
    }

    /// Minimum cost of drawing and lighting the sea mesh.
    pub fn water_cost(&self) -> Cost {
        self.mesh_cost() + self.light_cost()
    }

    /// Cost of drawing the sky: a sky pixel writes its light (8 bytes) and reads its depth (4).
    pub fn background_cost(&self) -> Cost {
        let seen = self.pixels * (1.0 - self.sea_fraction);
        Cost::of_bytes(12.0 * seen) + Cost::of_shader(&BACKGROUND_FRAGMENT_COST, seen)
    }

    /// Cost of the tone pass (HDR picture to screen colours): a pixel reads light (8 bytes), writes colour (4).
    pub fn tone_cost(&self) -> Cost {
        Cost::of_bytes(12.0 * self.pixels) + Cost::of_shader(&self.tone, self.pixels)
    }

    /// Cost of the present pass (finished picture to a canvas of the same size): a pixel reads and writes a colour (4
    /// bytes each).
    pub fn present_cost(&self) -> Cost {
        Cost::of_bytes(8.0 * self.pixels) + Cost::of_shader(&COPY_FRAGMENT_COST, self.pixels)
    }
}
