//! The map of the land that shaders read: height, slopes and kind of the ground, in the frame of the coast.

use super::relief::{INNER, Relief};
use crate::coast::PlacedCoast;
use crate::coast::runup::RunUp;
use crate::gpu::Gpu;
use crate::gpu::layout::gpu_struct;
use crate::render::scene::Scene;
use glam::DVec2;
use half::f16;

/// Half floats: height, m, slopes along x and y of the coast's frame, and kind ([`super::relief::RUBBLE`]).
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Slope of the foreshore of the built-in coasts, up which waves run while the waves at the coast are not known.
const FORESHORE_SLOPE: f64 = 0.08;

gpu_struct! {
    /// WGSL `Land`: where the coast lies, and how its map is read.
    pub struct LandUniform as "Land" {
        /// Unit vector (x, z) of the coast's x axis, which points shoreward; its y axis lies 90 degrees clockwise from it.
        shoreward: [f32; 2],
        /// Position of the point below the eye in the frame of the coast, m.
        eye_place: [f32; 2],
        /// Texture coordinates of the map are a position in that frame times this, plus `uv_start`.
        uv_per_m: [f32; 2],
        uv_start: [f32; 2],
        /// Lengths of the coast's rectangle along x and y, m.
        side_m: [f32; 2],
        /// Horizontal unit vector towards the sun, in the frame of the coast.
        toward_sun: [f32; 2],
        /// Binary logarithm of the number of texels per metre.
        log_texels_per_m: f32,
        /// Height above the still water that the highest waves reach on open beaches, m.
        run_up_m: f32,
        /// 1 if the waves at the coast are drawn: their run-up at each place is in the map of gains. Else 0.
        has_waves: f32,
        unused: u32,
    }
}

impl LandUniform {
    /// Values for the land of a coast in a scene.
    pub fn new(coast: &PlacedCoast, scene: &Scene) -> Self {
        let placement = coast.placement();
        let (sin, cos) = placement.turn_rad.sin_cos();
        let steps = coast.side_m().map(|side_m| side_m / (INNER - 1) as f64);
        let [x, _, z] = scene.look.sky.sun_direction();
        let toward_sun = DVec2::from(placement.turned_into_frame([x, z])).normalize_or(DVec2::X);
        let run_up = RunUp::new(scene.sea.hs_m, scene.sea.peak_wavelength_m, FORESHORE_SLOPE);
        Self {
            shoreward: [cos as f32, sin as f32],
            eye_place: placement.in_frame_m([scene.view.eye.x, scene.view.eye.z]).map(|at| at as f32),
            uv_per_m: steps.map(|step_m| (1.0 / (step_m * INNER as f64)) as f32),
            uv_start: [(0.5 / INNER as f64) as f32; 2],
            side_m: coast.side_m().map(|side_m| side_m as f32),
            toward_sun: toward_sun.as_vec2().to_array(),
            log_texels_per_m: (-0.5 * (steps[0] * steps[1]).log2()) as f32,
            run_up_m: run_up.two_percent_m as f32,
            has_waves: f32::from(u8::from(scene.has_coast)),
            unused: 0,
        }
    }
}

/// The map of a coast's land, for tests that call WGSL functions of the renderer.
pub fn land_map(gpu: &Gpu, coast: &PlacedCoast) -> wgpu::TextureView {
    map_of(gpu, &Relief::new(coast))
}

/// A map of one texel, for scenes without land.
pub fn no_land_map(gpu: &Gpu) -> wgpu::TextureView {
    let map = gpu.texture("no land", [1, 1, 1], 1, FORMAT, wgpu::TextureUsages::TEXTURE_BINDING);
    map.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Uploads the map of a relief with all mip levels.
pub fn map_of(gpu: &Gpu, relief: &Relief) -> wgpu::TextureView {
    let side = INNER as u32;
    let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
    let map = gpu.texture("land", [side, side, 1], INNER.ilog2() + 1, FORMAT, usage);
    let mut level: Vec<[f32; 4]> = (0..INNER * INNER)
        .map(|i| {
            let at = Relief::inner_index(i % INNER, i / INNER);
            let [x, y] = relief.slope[at];
            [relief.height_m[at], x, y, relief.kind[at]]
        })
        .collect();
    let mut width = INNER;
    for mip_level in 0..=INNER.ilog2() {
        let texels: Vec<[f16; 4]> = level.iter().map(|texel| texel.map(f16::from_f32)).collect();
        gpu.write_texture(&map, mip_level, bytemuck::cast_slice(&texels));
        level = half_size(&level, width);
        width = (width / 2).max(1);
    }
    map.create_view(&wgpu::TextureViewDescriptor::default())
}

/// The next coarser level of a square of `width` x `width` texels. An odd last row or column is left out.
fn half_size(level: &[[f32; 4]], width: usize) -> Vec<[f32; 4]> {
    let half = (width / 2).max(1);
    let at = |x: usize, y: usize, c: usize| level[y.min(width - 1) * width + x.min(width - 1)][c];
    (0..half * half)
        .map(|i| {
            let (x, y) = (2 * (i % half), 2 * (i / half));
            std::array::from_fn(|c| 0.25 * (at(x, y, c) + at(x + 1, y, c) + at(x, y + 1, c) + at(x + 1, y + 1, c)))
        })
        .collect()
}
