//! The periodic noise of the sea bed with its mip levels: slope of sand ripples along the first side of the tile
//! (red), their height (green), and two noises of normal distribution, fractal (blue) and of heads of coral (alpha).

use super::noise::{NOISE_SIDE, NoiseLattice, half_size_level, ranks_of_values};
use crate::waves::noise::pcg4d;
use glam::DVec2;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Texels hold slopes of the ripples up to this, their heights up to 1.6 mean amplitudes, and noise up to
/// [`NOISE_RANGE`] standard deviations, as numbers from 0 to 1 (shaders/water/bed.wgsl).
const SLOPE_RANGE: f64 = 1.0;
/// Largest height of a ripple in a texel, amplitudes of its first harmonic.
const HEIGHT_RANGE: f64 = 1.6;
/// Largest noise in a texel, standard deviations.
const NOISE_RANGE: f64 = 3.2;
/// Number of ripples along the tile. Their crests lie across its first side.
const RIPPLES: i32 = 38;
/// Height of the ripples from trough to crest, relative to their wavelength: 0.15 is the steepest that waves build,
/// vortex ripples (Wiberg and Harris 1994).
const RIPPLE_STEEPNESS: f64 = 0.15;
/// Standard deviations, in periods per tile, of the wave vectors of the ripples along and across their mean.
const RIPPLE_SPREAD: [f64; 2] = [3.2, 4.2];

/// RGBA bytes of all mip levels, finest first, computed once per process.
pub fn mip_levels() -> &'static [Vec<u8>] {
    static MIP_LEVELS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    MIP_LEVELS.get_or_init(|| {
        let levels = bed_levels(NOISE_SIDE);
        levels.into_iter().map(|l| l.iter().flatten().map(|x| (x * 255.0).round() as u8).collect()).collect()
    })
}

/// All mip levels of a tile of `side` texels, finest first, with values from 0 to 1.
fn bed_levels(side: u32) -> Vec<Vec<[f32; 4]>> {
    let mut levels = vec![bed_tile(side)];
    for mip_level in 0..side.ilog2() {
        levels.push(half_size_level(&levels[mip_level as usize], (side >> mip_level) as usize));
    }
    levels
}

fn bed_tile(side: u32) -> Vec<[f32; 4]> {
    let normal = |f: &dyn Fn(f32, f32) -> f32| -> Vec<f32> {
        let at = |i: u32| (i as f32 + 0.5) / side as f32;
        let values: Vec<f32> = (0..side * side).map(|i| f(at(i % side), at(i / side))).collect();
        let scale = 0.5 / NOISE_RANGE;
        let encode = |rank: f32| (0.5 + scale * normal_quantile(f64::from(rank))).clamp(0.0, 1.0) as f32;
        ranks_of_values(&values).into_iter().map(encode).collect()
    };
    let [bend_x, bend_y, groups] = [(5, 40), (5, 41), (9, 42)].map(|(p, key)| NoiseLattice::gradients(p, key));
    let octaves: [NoiseLattice; 7] = std::array::from_fn(|o| NoiseLattice::gradients(4 << o, 43 + o as u32));
    let bend = |x: f32, y: f32| (bend_x.perlin_noise(x, y), bend_y.perlin_noise(x, y));
    let fractal = normal(&|x, y| {
        let (bx, by) = bend(x, y);
        let (x, y) = (x + 0.035 * bx, y + 0.035 * by);
        let mut weight = 1.0;
        octaves.iter().fold(0.0, |sum, octave| {
            let part = weight * octave.perlin_noise(x, y);
            weight *= 0.58;
            sum + part
        })
    });
    let [large, small] = [(19, 51), (53, 52)].map(|(period, key)| NoiseLattice::feature_points(period, key, 0.0));
    let coral = normal(&|x, y| {
        let (bx, by) = bend(x, y);
        let (fx, fy) = (octaves[3].perlin_noise(x, y), octaves[3].perlin_noise(y, x));
        let (u, v) = (x + 0.03 * bx + 0.014 * fx, y + 0.03 * by + 0.014 * fy);
        // Worley noise is largest on the borders between heads.
        1.1 * groups.perlin_noise(x, y) - large.ridge_noise(u, v) - 0.5 * small.ridge_noise(u, v)
            + 0.25 * octaves[5].perlin_noise(x, y)
    });
    let ripples = ripples(side);
    let encode = |part: f64| (0.5 + 0.5 * part).clamp(0.0, 1.0) as f32;
    (0..(side * side) as usize)
        .map(|i| {
            let [slope, height] = ripples[i];
            [encode(slope / SLOPE_RANGE), encode(height / HEIGHT_RANGE), fractal[i], coral[i]]
        })
        .collect()
}

/// Slopes of sand ripples along the first side of a tile, and their heights in amplitudes. Their phase is that of a
/// narrow band of random waves, so that crests wander, fork and end as those in sand do; their profile has sharp crests
/// between broad troughs.
fn ripples(side: u32) -> Vec<[f64; 2]> {
    let n = side as i32;
    let reach = RIPPLE_SPREAD.map(|s| (2.5 * s) as i32);
    let turns: Vec<DVec2> = (0..n).map(|i| DVec2::from_angle(TAU * f64::from(i) / f64::from(n))).collect();
    let turn = |periods: i32, at: i32| turns[(periods * at).rem_euclid(n) as usize];
    let waves: Vec<(i32, Vec<(i32, DVec2)>)> = (-reach[0]..=reach[0])
        .map(|a| {
            let across = (-reach[1]..=reach[1]).map(|c| {
                let [u, v] = [f64::from(a) / RIPPLE_SPREAD[0], f64::from(c) / RIPPLE_SPREAD[1]];
                let h = pcg4d([(a + 64) as u32, (c + 64) as u32, 60, 0x5ea]);
                let phase = TAU * f64::from(h[0]) / f64::from(u32::MAX);
                (c, (-0.5 * (u * u + v * v)).exp() * DVec2::from_angle(phase))
            });
            (RIPPLES + a, across.collect())
        })
        .collect();
    let power: f64 = waves.iter().flat_map(|(_, across)| across).map(|(_, wave)| wave.length_squared()).sum();
    let mut heights = Vec::with_capacity((n * n) as usize);
    for y in 0..n {
        let row: Vec<(i32, DVec2)> = waves
            .iter()
            .map(|(along, across)| (*along, across.iter().map(|&(c, wave)| wave.rotate(turn(c, y))).sum()))
            .collect();
        for x in 0..n {
            let sum: DVec2 = row.iter().map(|&(along, wave)| wave.rotate(turn(along, x))).sum();
            // Where the phase is not defined, the ripples are flat.
            let strength = (sum.length_squared() / power).min(0.08) / 0.08;
            let phase = sum.to_angle();
            let profile = phase.cos() + 0.3 * (2.0 * phase).cos() + 0.1 * (3.0 * phase).cos();
            heights.push(strength * profile);
        }
    }
    // Slope of a difference of heights over two texels, from the number of texels in a wavelength.
    let scale = 0.5 * RIPPLE_STEEPNESS * 0.5 * f64::from(n) / f64::from(RIPPLES);
    let height = |x: i32, y: i32| heights[(y * n + x.rem_euclid(n)) as usize];
    (0..n * n)
        .map(|i| {
            let (x, y) = (i % n, i / n);
            [scale * (height(x + 1, y) - height(x - 1, y)), height(x, y)]
        })
        .collect()
}

/// Inverse of the cumulative normal distribution (Abramowitz and Stegun 26.2.23, accurate to 5e-4).
pub fn normal_quantile(share: f64) -> f64 {
    let t = (-2.0 * share.min(1.0 - share).max(1e-9).ln()).sqrt();
    let top = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let bottom = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    (share - 0.5).signum() * (t - top / bottom)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and variance of a channel of a mip level as the sampler interpolates it, in deviations of the noise.
    fn noise_moments(level: &[[f32; 4]], channel: usize) -> (f64, f64) {
        const POINTS: u32 = 20_000;
        let side = level.len().isqrt();
        let texel = |x: usize, y: usize| f64::from(level[(y % side) * side + x % side][channel]);
        let (mut sum, mut squares) = (0.0, 0.0);
        for i in 0..POINTS {
            let [u, v] = [0.754_877_67, 0.569_840_29].map(|step: f64| (step * f64::from(i)).fract() * side as f64);
            let (x, y) = (u as usize, v as usize);
            let mix = |a: f64, b: f64, t: f64| a + t * (b - a);
            let row = |y: usize| mix(texel(x, y), texel(x + 1, y), u.fract());
            let value = 2.0 * NOISE_RANGE * (mix(row(y), row(y + 1), v.fract()) - 0.5);
            sum += value;
            squares += value * value;
        }
        let mean = sum / f64::from(POINTS);
        (mean, squares / f64::from(POINTS) - mean * mean)
    }

    /// The shader's estimate of the variance that a mip level keeps (shaders/water/bed.wgsl).
    fn variance_left(lod: f64, half_lod: f64, steepness: f64) -> f64 {
        1.0 / (1.0 + (steepness * (lod - half_lod)).exp2())
    }

    #[test]
    fn noises_are_normal_and_lose_their_variance_as_the_shader_expects() {
        let levels = bed_levels(NOISE_SIDE);
        for (channel, half_lod, steepness) in [(2, 5.45, 1.65), (3, 3.45, 1.35)] {
            for (lod, level) in levels.iter().enumerate() {
                let (mean, got) = noise_moments(level, channel);
                let want = variance_left(lod as f64, half_lod, steepness);
                assert!(mean.abs() < 0.03, "channel {channel}, level {lod}: {mean}");
                assert!((got - want).abs() < 0.05, "channel {channel}, level {lod}: {got:.3}, not {want:.3}");
            }
        }
    }

    #[test]
    fn ripples_are_level_and_as_steep_as_those_in_sand() {
        let ripples = ripples(256);
        let mean = |f: &dyn Fn(&[f64; 2]) -> f64| ripples.iter().map(f).sum::<f64>() / ripples.len() as f64;
        assert!(mean(&|r| r[0]).abs() < 1e-6 && mean(&|r| r[1]).abs() < 0.02);
        let deviation = mean(&|r| r[0] * r[0]).sqrt();
        assert!((0.2..0.45).contains(&deviation), "{deviation}");
    }
}
