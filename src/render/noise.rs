//! A tile of noise with mips: foam's net (red), bubbles (green) and cloud (blue). Each is equalised: its values are
//! spread evenly over 0..1, so that a threshold of 1 - c covers the share c.

use crate::model::noise::pcg4d;

/// Texels along a side.
const SIDE: u32 = 512;

/// The texture and its sampler.
pub struct NoiseTexture {
    pub view: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
}

impl NoiseTexture {
    /// Computes and uploads the tile.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let mips = SIDE.ilog2() + 1;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("noise"),
            size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 },
            mip_level_count: mips,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let mut level = tile(SIDE);
        for mip_level in 0..mips {
            let side = SIDE >> mip_level;
            let bytes: Vec<u8> = level.iter().flatten().map(|x| (x * 255.0).round() as u8).collect();
            queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level,
                    origin: wgpu::Origin3d::ZERO,
                    aspect: wgpu::TextureAspect::All,
                },
                &bytes,
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * side), rows_per_image: Some(side) },
                wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
            );
            level = halve(&level, side as usize);
        }
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("noise"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self { view: texture.create_view(&wgpu::TextureViewDescriptor::default()), sampler }
    }
}

fn tile(side: u32) -> Vec<[f32; 4]> {
    let field = |f: &dyn Fn(f32, f32) -> f32| -> Vec<f32> {
        let at = |i: u32| (i as f32 + 0.5) / side as f32;
        let values: Vec<f32> = (0..side * side).map(|i| f(at(i % side), at(i / side))).collect();
        equalise(&values)
    };
    let net = field(&|x, y| {
        // Bent coordinates: no straight edges in foam.
        let (bx, by) = (gradient_noise(x, y, 6, 11), gradient_noise(x, y, 6, 12));
        let (fx, fy) = (gradient_noise(x, y, 23, 13), gradient_noise(x, y, 23, 14));
        let (x, y) = (x + 0.055 * bx + 0.012 * fx, y + 0.055 * by + 0.012 * fy);
        1.1 * edges(x, y, 7, 1)
            + 0.8 * edges(x, y, 17, 2)
            + 0.5 * edges(x, y, 41, 3)
            + 0.35 * gradient_noise(x, y, 5, 4)
    });
    let bubbles = field(&|x, y| edges(x, y, 37, 5) + 0.7 * edges(x, y, 83, 6) + 0.4 * gradient_noise(x, y, 19, 7));
    let cloud = field(&|x, y| {
        let bend = 0.03 * gradient_noise(x, y, 5, 20);
        let (x, y) = (x + bend, y - bend);
        (0..7).map(|o| 0.56f32.powi(o) * gradient_noise(x, y, 4 << o, 21 + o as u32)).sum()
    });
    (0..(side * side) as usize).map(|i| [net[i], bubbles[i], cloud[i], 1.0]).collect()
}

/// Ranks instead of values.
fn equalise(values: &[f32]) -> Vec<f32> {
    let mut order: Vec<u32> = (0..values.len() as u32).collect();
    order.sort_by(|&a, &b| values[a as usize].total_cmp(&values[b as usize]));
    let mut out = vec![0.0; values.len()];
    for (rank, i) in order.into_iter().enumerate() {
        out[i as usize] = (rank as f32 + 0.5) / values.len() as f32;
    }
    out
}

fn halve(level: &[[f32; 4]], side: usize) -> Vec<[f32; 4]> {
    let half = side / 2;
    let at = |x: usize, y: usize, c: usize| level[y * side + x][c];
    (0..half * half)
        .map(|i| {
            let (x, y) = (2 * (i % half), 2 * (i / half));
            std::array::from_fn(|c| 0.25 * (at(x, y, c) + at(x + 1, y, c) + at(x, y + 1, c) + at(x + 1, y + 1, c)))
        })
        .collect()
}

/// Two numbers in 0..1 for a cell of a periodic lattice.
fn cell(ix: i32, iy: i32, period: i32, key: u32) -> [f32; 2] {
    let h = pcg4d([ix.rem_euclid(period) as u32, iy.rem_euclid(period) as u32, key, 0x5ea]);
    [h[0], h[1]].map(|h| (h >> 8) as f32 / 16_777_216.0)
}

/// Worley noise: 0 in the middle of a cell, 1 on its edge.
fn edges(x: f32, y: f32, period: i32, key: u32) -> f32 {
    let (x, y) = (x * period as f32, y * period as f32);
    let (cx, cy) = (x.floor() as i32, y.floor() as i32);
    let (mut first, mut second) = (9.0f32, 9.0f32);
    for iy in cy - 1..=cy + 1 {
        for ix in cx - 1..=cx + 1 {
            let [a, b] = cell(ix, iy, period, key);
            let d = (ix as f32 + a - x).hypot(iy as f32 + b - y);
            if d < first {
                second = first;
                first = d;
            } else if d < second {
                second = d;
            }
        }
    }
    1.0 - (second - first).min(1.0).sqrt()
}

/// Perlin noise, about -0.7..0.7.
fn gradient_noise(x: f32, y: f32, period: i32, key: u32) -> f32 {
    let (x, y) = (x * period as f32, y * period as f32);
    let (ix, iy) = (x.floor() as i32, y.floor() as i32);
    let (fx, fy) = (x - ix as f32, y - iy as f32);
    let corner = |dx: i32, dy: i32| {
        let [a, _] = cell(ix + dx, iy + dy, period, key);
        let (sin, cos) = (a * std::f32::consts::TAU).sin_cos();
        cos * (fx - dx as f32) + sin * (fy - dy as f32)
    };
    let fade = |t: f32| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let (u, v) = (fade(fx), fade(fy));
    let mix = |a: f32, b: f32, t: f32| a + t * (b - a);
    mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_threshold_covers_its_share() {
        let tile = tile(64);
        for channel in 0..3 {
            let above = tile.iter().filter(|t| t[channel] > 0.75).count();
            assert!((above as f32 / tile.len() as f32 - 0.25).abs() < 1e-3);
        }
    }
}
