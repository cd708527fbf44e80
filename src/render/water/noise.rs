//! A periodic noise texture with mip levels: lace of foam (red), bubbles (green), clouds (blue) and lumps of foam
//! (alpha). The values of bubbles and clouds are spread evenly over 0..1, so that those above 1 - c cover the fraction c
//! of the area. Those of lace and lumps are distributed normally, with a mean of 1/2 and a deviation of
//! [`NORMAL_DEVIATION`]: sums of them are normal, too, and so are their means in the mip levels, nearly.

use crate::gpu::Gpu;
use crate::waves::noise::pcg4d;
use std::sync::OnceLock;

/// Side of the noise texture, texels.
pub const NOISE_SIDE: u32 = 512;
/// Standard deviation of the channels lace and lumps, whose values are limited to 0..1, at three deviations.
const NORMAL_DEVIATION: f32 = 1.0 / 6.0;

/// Periodic noise in the two layers of a texture, and its sampler. The first layer has lace of foam in red, bubbles in
/// green, clouds in blue and lumps in alpha; the second is the sea bed ([`super::bed`]). One texture for both leaves
/// shaders room for others.
pub struct NoiseTexture {
    texture: wgpu::Texture,
    /// View of both layers with all mip levels.
    pub view: wgpu::TextureView,
    /// Repeats the noise, and interpolates between mip levels.
    pub sampler: wgpu::Sampler,
    has_bed: bool,
}

impl NoiseTexture {
    /// Creates the texture without contents; [`Self::fill`] computes them.
    pub fn new(gpu: &Gpu) -> Self {
        let mips = NOISE_SIDE.ilog2() + 1;
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = gpu.texture("noise", [NOISE_SIDE, NOISE_SIDE, 2], mips, wgpu::TextureFormat::Rgba8Unorm, usage);
        let sampler = gpu.sampler("noise", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Linear);
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view, sampler, has_bed: false }
    }

    /// Computes and uploads the layer of the sea bed when a bed is first seen; most seas are too deep for one.
    pub fn fill_bed_once(&mut self, gpu: &Gpu) {
        if !self.has_bed {
            for (mip_level, bytes) in (0..).zip(super::bed::mip_levels()) {
                gpu.write_texture_layer(&self.texture, 1, mip_level, bytes);
            }
            self.has_bed = true;
        }
    }

    /// Computes the noise, at first use in the process, and uploads all mip levels to the first layer.
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
    let lace = lace(&field);
    let lumps = lumps(&field);
    let (large, small, groups) = (
        NoiseLattice::feature_points(37, 5, 0.7),
        NoiseLattice::feature_points(83, 6, 0.7),
        NoiseLattice::gradients(19, 7),
    );
    let bubbles =
        field(&|x, y| large.ridge_noise(x, y) + 0.7 * small.ridge_noise(x, y) + 0.4 * groups.perlin_noise(x, y));
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
    let normal = |rank: f32| (0.5 + NORMAL_DEVIATION * normal_quantile(rank)).clamp(0.0, 1.0);
    (0..(side * side) as usize).map(|i| [normal(lace[i]), bubbles[i], cloud[i], normal(lumps[i])]).collect()
}

/// A function that computes the ranks of a function's values over the tile of noise.
type Field<'a> = dyn Fn(&dyn Fn(f32, f32) -> f32) -> Vec<f32> + 'a;

/// Ranks of the lace that is left of old foam: films that holes of all sizes have torn, down to threads.
///
/// The threads are the borders between bubbles of random sizes. Where the borders of several octaves meet, the strongest
/// one prevails, so that small holes lie between large ones, and at a high threshold a net of long threads is left. Each
/// octave is strong where another one is weak, so that no size of cell prevails anywhere, and the coordinates are warped
/// by currents of three scales.
fn lace(field: &Field<'_>) -> Vec<f32> {
    let warps = [(5, 11, 0.05), (11, 13, 0.028), (27, 15, 0.012)].map(|(period, key, strength)| {
        (NoiseLattice::gradients(period, key), NoiseLattice::gradients(period, key + 1), strength)
    });
    let octaves = [(9, 1, 1.0), (17, 2, 0.95), (31, 3, 0.88), (57, 4, 0.75), (97, 8, 0.55)]
        .map(|(period, key, strength)| (NoiseLattice::feature_points(period, key, 0.8), strength));
    let shares = [(5, 51), (8, 52), (14, 53)].map(|(period, key)| NoiseLattice::gradients(period, key));
    let films: [_; 4] = std::array::from_fn(|o| NoiseLattice::gradients(6 << o, 70 + o as u32));
    field(&|x, y| {
        let (mut u, mut v) = (x, y);
        for (along, across, strength) in &warps {
            u += strength * along.perlin_noise(x, y);
            v += strength * across.perlin_noise(x, y);
        }
        let [a, b, c] = [0, 1, 2].map(|i| 1.4 * shares[i].perlin_noise(u, v));
        // A high power makes the sum follow the strongest octave.
        let threads: f32 = octaves
            .iter()
            .zip([a, b, -a, c, -b])
            .map(|((octave, strength), share)| strength * (0.62 + share).clamp(0.0, 1.0) * octave.ridge_noise(u, v))
            .map(|thread| thread.powi(4))
            .sum();
        let mut weight = 0.5;
        films.iter().fold(threads.sqrt().sqrt(), |sum, film| {
            let part = weight * film.perlin_noise(u, v);
            weight *= 0.6;
            sum + part
        })
    })
}

/// Ranks of the height of fresh foam: lumps like those of cauliflower, with sharp creases between them.
fn lumps(field: &Field<'_>) -> Vec<f32> {
    let (bend_x, bend_y) = (NoiseLattice::gradients(9, 31), NoiseLattice::gradients(9, 32));
    let octaves = [(11, 61, 1.0), (23, 62, 0.55), (47, 63, 0.34)]
        .map(|(period, key, strength)| (NoiseLattice::feature_points(period, key, 0.5), strength));
    field(&|x, y| {
        let (u, v) = (x + 0.02 * bend_x.perlin_noise(x, y), y + 0.02 * bend_y.perlin_noise(x, y));
        octaves
            .iter()
            .map(|(octave, height)| {
                let [nearest, _] = octave.squared_distances(u, v);
                height * (1.0 - nearest).max(0.0).sqrt()
            })
            .sum()
    })
}

/// Inverse of the cumulative normal distribution (Abramowitz and Stegun 26.2.23, accurate to 5e-4).
fn normal_quantile(share: f32) -> f32 {
    let t = (-2.0 * share.min(1.0 - share).max(1e-7).ln()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + 0.010_328 * t);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + 0.001_308 * t));
    (share - 0.5).signum() * (t - above / below)
}

/// Rank of each value among all values, 0 (lowest) to 1, so that the results are spread evenly. Ranks come from a
/// histogram of 65536 bins; values in the same bin get the same rank.
pub fn ranks_of_values(values: &[f32]) -> Vec<f32> {
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
pub fn half_size_level(level: &[[f32; 4]], side: usize) -> Vec<[f32; 4]> {
    let half = side / 2;
    let at = |x: usize, y: usize, c: usize| level[y * side + x][c];
    (0..half * half)
        .map(|i| {
            let (x, y) = (2 * (i % half), 2 * (i / half));
            std::array::from_fn(|c| 0.25 * (at(x, y, c) + at(x + 1, y, c) + at(x, y + 1, c) + at(x + 1, y + 1, c)))
        })
        .collect()
}

/// A periodic lattice of square cells with three random numbers per cell, for Worley or Perlin noise.
pub struct NoiseLattice {
    period: i32,
    /// The numbers of each cell, row by row: for Worley noise the place of a point in the cell, 0 to 1, and the factor on
    /// squared distances from it; for Perlin noise a unit vector at its corner of lowest x and y. Copies of the cells at
    /// the opposite edge surround the lattice, so that look-ups need no modulo.
    cells: Vec<[f32; 3]>,
}

impl NoiseLattice {
    /// A lattice of `period` x `period` cells with a random point in each, for Worley noise. `key` is the random seed.
    /// Distances from the points are longer or shorter by up to the factor e^`variety`, so that the regions differ in
    /// size, and have round borders.
    pub fn feature_points(period: i32, key: u32, variety: f32) -> Self {
        Self::new(period, key, |[a, b, c]| [a, b, (variety * (4.0 * c - 2.0)).exp()])
    }

    /// A lattice of `period` x `period` corners with a random unit vector at each, for Perlin noise. `key` is a seed.
    pub fn gradients(period: i32, key: u32) -> Self {
        Self::new(period, key, |[a, ..]| {
            let (sin, cos) = (a * std::f32::consts::TAU).sin_cos();
            [cos, sin, 0.0]
        })
    }

    /// A lattice of `period` x `period` cells; their numbers are `f` of three random numbers in 0..1, of seed `key`.
    fn new(period: i32, key: u32, f: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let number = |h: u32| (h >> 8) as f32 / 16_777_216.0;
        let inner: Vec<_> = (0..period * period)
            .map(|i| {
                let h = pcg4d([(i % period) as u32, (i / period) as u32, key, 0x5ea]);
                f([number(h[0]), number(h[1]), number(h[2])])
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

    /// Squares of the weighted distances, in cells, from (x, y) in a tile of side 1 to the nearest and second nearest
    /// point. Only the points of the 3 x 3 cells around it are searched.
    fn squared_distances(&self, x: f32, y: f32) -> [f32; 2] {
        let (before, [x, y]) = self.locate_cell(x, y);
        // Squared distances compared as bits, which sort alike: WebAssembly finds the minimum of integers faster.
        let (mut first, mut second) = (u32::MAX, u32::MAX);
        for dy in 0..3 {
            let row = &self.cells[before + dy * self.stored_row_length()..][..3];
            for (dx, [a, b, factor]) in row.iter().enumerate() {
                let (dx, dy) = (dx as f32 - 1.0 + a - x, dy as f32 - 1.0 + b - y);
                let d = (factor * (dx * dx + dy * dy)).to_bits();
                second = second.min(d.max(first));
                first = first.min(d);
            }
        }
        [first, second].map(f32::from_bits)
    }

    /// Worley noise, 0 to 1, at (x, y) in a tile of side 1: 1 on the borders between the points' regions, less inside.
    pub fn ridge_noise(&self, x: f32, y: f32) -> f32 {
        let [first, second] = self.squared_distances(x, y).map(f32::sqrt);
        1.0 - (second - first).min(1.0).sqrt()
    }

    /// Perlin noise, about -0.7 to 0.7, at (x, y) in a periodic tile of side 1.
    pub fn perlin_noise(&self, x: f32, y: f32) -> f32 {
        let (before, [fx, fy]) = self.locate_cell(x, y);
        let corner = |dx: usize, dy: usize| {
            let [cos, sin, _] = self.cells[before + (dy + 1) * self.stored_row_length() + dx + 1];
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
        let upper_quartile =
            [0, 1, 2, 3].map(|channel| if channel % 3 == 0 { 0.5 + 0.6745 * NORMAL_DEVIATION } else { 0.75 });
        for (channel, threshold) in upper_quartile.into_iter().enumerate() {
            let above = tile.iter().filter(|t| t[channel] > threshold).count();
            assert!((above as f32 / tile.len() as f32 - 0.25).abs() < 1e-3, "{channel}");
        }
    }

    /// The constants with which the shader fades the layers of foam, against the mip levels between which it reads.
    #[test]
    fn the_mip_levels_lose_variance_as_the_shader_counts() {
        let source = include_str!("../../../shaders/water/material.wgsl");
        let constants = |name: &str| -> Vec<f64> {
            let from = source.find(&format!("const {name} = vec4f(")).expect("the constant");
            let text = &source[from..][source[from..].find('(').unwrap() + 1..];
            text[..text.find(')').unwrap()].split(',').map(|x| x.trim().parse().unwrap()).collect()
        };
        let [half, steepness] = ["MATERIAL_HALF_VARIANCE_LOD", "MATERIAL_VARIANCE_STEEPNESS"].map(constants);
        let mut levels = vec![noise_tile(NOISE_SIDE)];
        while levels.last().is_some_and(|level| level.len() > 4) {
            let last = levels.last().unwrap();
            levels.push(half_size_level(last, last.len().isqrt()));
        }
        let variance = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / values.len() as f64
        };
        // Layers in the order of the constants: windrows, patches, strands and threads.
        for (layer, channel) in [2, 0, 0, 0].into_iter().enumerate() {
            let read = |lod: f64| -> Vec<f64> {
                let bilinear = |level: &[[f32; 4]], at: [f64; 2]| {
                    let side = level.len().isqrt();
                    let at = at.map(|x| (x * side as f64 - 0.5).rem_euclid(side as f64));
                    let texel = |dx: usize, dy: usize| {
                        let [x, y] = [at[0] as usize + dx, at[1] as usize + dy].map(|i| i % side);
                        f64::from(level[y * side + x][channel])
                    };
                    let [u, v] = at.map(f64::fract);
                    let row = |dy| texel(0, dy) * (1.0 - u) + texel(1, dy) * u;
                    row(0) * (1.0 - v) + row(1) * v
                };
                let (fine, coarse) = (&levels[lod as usize], &levels[(lod as usize + 1).min(levels.len() - 1)]);
                (0..40_000)
                    .map(|i| {
                        let h = pcg4d([i, 3, 5, 7]);
                        let at = [h[0], h[1]].map(|h| f64::from(h) / 4_294_967_296.0);
                        bilinear(fine, at) * (1.0 - lod.fract()) + bilinear(coarse, at) * lod.fract()
                    })
                    .collect()
            };
            let whole = variance(&levels[0].iter().map(|t| f64::from(t[channel])).collect::<Vec<_>>());
            let mut worst: f64 = 0.0;
            for step in 0..28 {
                let lod = 0.25 * f64::from(step);
                let left = variance(&read(lod)) / whole;
                let counted = 1.0 / (1.0 + (steepness[layer] * (lod - half[layer])).exp2());
                worst = worst.max((left - counted).abs());
            }
            assert!(worst < 0.06, "layer {layer}: {worst}");
        }
    }
}
