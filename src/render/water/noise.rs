//! A periodic noise texture with mip levels: net of foam (red), bubbles (green) and clouds (blue). The values of each
//! channel are spread evenly over 0..1, so that those above 1 - c cover the fraction c of the area.

use crate::gpu::Gpu;
use crate::waves::noise::pcg4d;
use std::sync::OnceLock;

/// Side of the noise texture, texels.
pub const NOISE_SIDE: u32 = 512;

/// Periodic noise texture (net-like pattern of foam in red, bubbles in green, clouds in blue) and its sampler.
pub struct NoiseTexture {
    texture: wgpu::Texture,
    pub view: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
}

impl NoiseTexture {
    /// Creates the texture without contents; [`Self::fill`] computes them.
    pub fn new(gpu: &Gpu) -> Self {
        let mips = NOISE_SIDE.ilog2() + 1;
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = gpu.texture("noise", [NOISE_SIDE, NOISE_SIDE, 1], mips, wgpu::TextureFormat::Rgba8Unorm, usage);
        let sampler = gpu.sampler("noise", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Linear);
        Self { view: texture.create_view(&wgpu::TextureViewDescriptor::default()), texture, sampler }
    }

    /// Computes the noise, at first use in the process, and uploads all mip levels to the texture.
    pub fn fill(&self, gpu: &Gpu) {
        for (mip_level, bytes) in (0..).zip(mip_levels()) {
            gpu.write_texture(&self.texture, mip_level, bytes);
        }
    }
}

/// RGBA bytes of all mip levels of the noise texture, finest first. They are computed once per process; a second GPU
/// device gets the same bytes.
fn mip_levels() -> &'static [Vec<u8>] {
    static MIP_LEVELS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    MIP_LEVELS.get_or_init(|| {
        let mut level = noise_tile(NOISE_SIDE);
        (0..=NOISE_SIDE.ilog2())
            .map(|mip_level| {
                let bytes = level.iter().flatten().map(|x| (x * 255.0).round() as u8).collect();
                level = half_size_level(&level, (NOISE_SIDE >> mip_level) as usize);
                bytes
            })
            .collect()
    })
}

fn noise_tile(side: u32) -> Vec<[f32; 4]> {
    let field = |f: &dyn Fn(f32, f32) -> f32| -> Vec<f32> {
        let at = |i: u32| (i as f32 + 0.5) / side as f32;
        let values: Vec<f32> = (0..side * side).map(|i| f(at(i % side), at(i / side))).collect();
        ranks_of_values(&values)
    };
    let [bend_x, bend_y, fray_x, fray_y, patches] =
        [(6, 11), (6, 12), (23, 13), (23, 14), (5, 4)].map(|(period, key)| NoiseLattice::gradients(period, key));
    let [wide, middle, narrow] =
        [(7, 1), (17, 2), (41, 3)].map(|(period, key)| NoiseLattice::feature_points(period, key));
    let net = field(&|x, y| {
        // Warped coordinates leave no straight edges in foam.
        let (bx, by) = (bend_x.perlin_noise(x, y), bend_y.perlin_noise(x, y));
        let (fx, fy) = (fray_x.perlin_noise(x, y), fray_y.perlin_noise(x, y));
        let (u, v) = (x + 0.055 * bx + 0.012 * fx, y + 0.055 * by + 0.012 * fy);
        1.1 * wide.worley_noise(u, v)
            + 0.8 * middle.worley_noise(u, v)
            + 0.5 * narrow.worley_noise(u, v)
            + 0.35 * patches.perlin_noise(u, v)
    });
    let (large, small, groups) =
        (NoiseLattice::feature_points(37, 5), NoiseLattice::feature_points(83, 6), NoiseLattice::gradients(19, 7));
    let bubbles =
        field(&|x, y| large.worley_noise(x, y) + 0.7 * small.worley_noise(x, y) + 0.4 * groups.perlin_noise(x, y));
    let wind = NoiseLattice::gradients(5, 20);
    let octaves: [NoiseLattice; 7] = std::array::from_fn(|o| NoiseLattice::gradients(4 << o, 21 + o as u32));
    let cloud = field(&|x, y| {
        let bend = 0.03 * wind.perlin_noise(x, y);
        let (x, y) = (x + bend, y - bend);
        let mut weight = 1.0;
        octaves.iter().fold(0.0, |sum, octave| {
            let part = weight * octave.perlin_noise(x, y);
            weight *= 0.56;
            sum + part
        })
    });
    (0..(side * side) as usize).map(|i| [net[i], bubbles[i], cloud[i], 1.0]).collect()
}

/// Rank of each value among all values, 0 (lowest) to 1, so that the results are spread evenly. Ranks come from a
/// histogram of 65536 bins; values in the same bin get the same rank.
pub(super) fn ranks_of_values(values: &[f32]) -> Vec<f32> {
    const BINS: usize = 1 << 16;
    let (low, high) = values.iter().fold((f32::MAX, f32::MIN), |(low, high), &v| (low.min(v), high.max(v)));
    let scale = (BINS - 1) as f32 / (high - low).max(f32::MIN_POSITIVE);
    let bin = |v: f32| ((v - low) * scale) as usize;
    let mut counts = vec![0u32; BINS];
    values.iter().for_each(|&v| counts[bin(v)] += 1);
    let mut before = 0;
    let ranks: Vec<f32> = counts
        .into_iter()
        .map(|count| {
            before += count;
            (before as f32 - 0.5 * count as f32) / values.len() as f32
        })
        .collect();
    values.iter().map(|&v| ranks[bin(v)]).collect()
}

/// The next coarser mip level of a level of `side` x `side` texels.
pub(super) fn half_size_level(level: &[[f32; 4]], side: usize) -> Vec<[f32; 4]> {
    let half = side / 2;
    let at = |x: usize, y: usize, c: usize| level[y * side + x][c];
    (0..half * half)
        .map(|i| {
            let (x, y) = (2 * (i % half), 2 * (i / half));
            std::array::from_fn(|c| 0.25 * (at(x, y, c) + at(x + 1, y, c) + at(x, y + 1, c) + at(x + 1, y + 1, c)))
        })
        .collect()
}

/// A periodic lattice of square cells with two random numbers per cell, from which Worley or Perlin noise is computed.
pub(super) struct NoiseLattice {
    period: i32,
    /// The two numbers of each cell, row by row: for Worley noise the place of a point in the cell, 0 to 1; for Perlin
    /// noise a unit vector at its corner of lowest x and y. Copies of the cells at the opposite edge surround the
    /// lattice, so that look-ups need no modulo.
    cells: Vec<[f32; 2]>,
}

impl NoiseLattice {
    /// A lattice of `period` x `period` cells with a random point in each, for Worley noise. `key` is the random seed.
    pub(super) fn feature_points(period: i32, key: u32) -> Self {
        Self::new(period, key, |cell| cell)
    }

    /// A lattice of `period` x `period` corners with a random unit vector at each, for Perlin noise. `key` is a seed.
    pub(super) fn gradients(period: i32, key: u32) -> Self {
        Self::new(period, key, |[a, _]| {
            let (sin, cos) = (a * std::f32::consts::TAU).sin_cos();
            [cos, sin]
        })
    }

    /// A lattice of `period` x `period` cells; their two numbers are `f` of two random numbers in 0..1, of seed `key`.
    fn new(period: i32, key: u32, f: impl Fn([f32; 2]) -> [f32; 2]) -> Self {
        let number = |h: u32| (h >> 8) as f32 / 16_777_216.0;
        let inner: Vec<_> = (0..period * period)
            .map(|i| {
                let h = pcg4d([(i % period) as u32, (i / period) as u32, key, 0x5ea]);
                f([number(h[0]), number(h[1])])
            })
            .collect();
        let wide = period + 2;
        let around = |i: i32| (i - 1).rem_euclid(period);
        let cells = (0..wide * wide).map(|i| inner[(around(i / wide) * period + around(i % wide)) as usize]).collect();
        Self { period, cells }
    }

    /// Finds the cell that contains the point (x, y) of a tile of side 1. Returns the index in `cells` of the cell one
    /// column and one row before it, where the 3 x 3 cells around it begin, and the point's place in its cell, 0..1.
    fn locate_cell(&self, x: f32, y: f32) -> (usize, [f32; 2]) {
        let [x, y] = [x, y].map(|x| (x - x.floor()) * self.period as f32);
        let [ix, iy] = [x, y].map(|x| (x as usize).min(self.period as usize - 1));
        (iy * self.stored_row_length() + ix, [x - ix as f32, y - iy as f32])
    }

    /// Number of entries in a row of `cells`: the period and a repeated cell at both ends.
    fn stored_row_length(&self) -> usize {
        self.period as usize + 2
    }

    /// Worley noise, 0 to 1, at (x, y) in a tile of side 1: 1 on the borders between the points' regions, less inside.
    pub(super) fn worley_noise(&self, x: f32, y: f32) -> f32 {
        let (before, [x, y]) = self.locate_cell(x, y);
        // Squared distances compared as bits, which sort alike: WebAssembly finds the minimum of integers faster.
        let (mut first, mut second) = (u32::MAX, u32::MAX);
        for dy in 0..3 {
            let row = &self.cells[before + dy * self.stored_row_length()..][..3];
            for (dx, [a, b]) in row.iter().enumerate() {
                let (dx, dy) = (dx as f32 - 1.0 + a - x, dy as f32 - 1.0 + b - y);
                let d = (dx * dx + dy * dy).to_bits();
                second = second.min(d.max(first));
                first = first.min(d);
            }
        }
        1.0 - (f32::from_bits(second).sqrt() - f32::from_bits(first).sqrt()).min(1.0).sqrt()
    }

    /// Perlin noise, about -0.7 to 0.7, at (x, y) in a periodic tile of side 1.
    pub(super) fn perlin_noise(&self, x: f32, y: f32) -> f32 {
        let (before, [fx, fy]) = self.locate_cell(x, y);
        let corner = |dx: usize, dy: usize| {
            let [cos, sin] = self.cells[before + (dy + 1) * self.stored_row_length() + dx + 1];
            cos * (fx - dx as f32) + sin * (fy - dy as f32)
        };
        let fade = |t: f32| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
        let (u, v) = (fade(fx), fade(fy));
        let mix = |a: f32, b: f32, t: f32| a + t * (b - a);
        mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_threshold_covers_its_share() {
        let tile = noise_tile(64);
        for channel in 0..3 {
            let above = tile.iter().filter(|t| t[channel] > 0.75).count();
            assert!((above as f32 / tile.len() as f32 - 0.25).abs() < 1e-3);
        }
    }
}
