//! The truth that a picture approximates: many samples a pixel, none of them filtered. Slopes that a pixel cannot resolve
//! are sampled, not turned into roughness; only those below the finest cascade stay a lobe.
//!
//! A grid of samples is drawn as a larger picture, several times with its samples moved. Whoever draws averages the linear
//! light ([`Grid`] says which samples are a pixel's) and hands the mean back to be shown by the usual film.

use super::Renderer;
use super::frame::FrameUniform;
use super::scene::Scene;
use super::targets::{Film, HDR_FORMAT};
use super::water::displace;
use super::water::mesh::{self, Mesh};
use crate::gpu::Gpu;
use crate::sim::Maps;
use half::f16;

/// Vertices of the mesh for each sample of a grid, as long as they fit into a buffer.
const VERTICES_PER_SAMPLE: f64 = 1.2;
/// Share of the largest buffer that they may fill: columns and rows are rounded up.
const FILLED: f64 = 0.95;

/// One sample in each cell of a grid of `side` x `side` cells a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// Cells along a side of a pixel.
    pub side: u32,
    /// Where in its cell the sample lies, from 0 to 1, to the right and down.
    pub offset: [f64; 2],
}

impl Grid {
    /// Width and height of the drawing, one texel a sample.
    pub fn samples(&self) -> [u32; 2] {
        self.size.map(|s| s * self.side)
    }

    /// The way from the middle of a cell to its sample in clip coordinates, as the picture has to be moved.
    fn shift(&self) -> [f32; 2] {
        let [w, h] = self.samples().map(f64::from);
        [(-2.0 * (self.offset[0] - 0.5) / w) as f32, (2.0 * (self.offset[1] - 0.5) / h) as f32]
    }
}

/// Draws samples of a reference picture, and shows their mean.
pub struct Reference {
    renderer: Renderer,
}

impl Reference {
    /// Compiles the passes. `target_format` is what [`Self::present`] draws into.
    pub fn new(gpu: &Gpu, target_format: wgpu::TextureFormat) -> Self {
        Self { renderer: Renderer::new(gpu, target_format, Film::Reference) }
    }

    /// Records a grid of samples. The texture holds their light; its w is 0 for the sky and, for water, the weight of the
    /// sample among those of the water in its pixel.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        maps: &Maps,
        scene: &Scene,
        grid: &Grid,
    ) -> wgpu::Texture {
        let renderer = &mut self.renderer;
        let size = grid.samples();
        let texture = renderer.target(gpu, size).hdr.texture().clone();
        let room = FILLED * gpu.device.limits().max_storage_buffer_binding_size as f64 / displace::VERTEX as f64;
        let vertices = (VERTICES_PER_SAMPLE * f64::from(size[0]) * f64::from(size[1])).min(room);
        let density = vertices / mesh::VERTICES;
        let mesh = Mesh::new(&scene.view, &scene.sea, density, scene.look.extent_km);
        let frame = FrameUniform::new(scene, maps, &mesh, size).unfiltered(grid.shift());
        renderer.prepare(gpu, maps, scene, &mesh, &frame);
        renderer.record_picture(gpu, encoder, scene);
        texture
    }

    /// Takes a picture in linear light, RGB row by row, to be presented as `scene` is.
    pub fn show(&mut self, gpu: &Gpu, scene: &Scene, [width, height]: [u32; 2], light: &[[f32; 3]]) {
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let mean = gpu.texture("reference", [width, height, 1], 1, HDR_FORMAT, usage);
        // The limit of shaders/common/frame.wgsl. A value that is not a number stays one, and the film paints it.
        let texel = |l: &[f32; 3]| [l[0], l[1], l[2], 1.0].map(|x| f16::from_f32(if x > 6e4 { 6e4 } else { x }));
        let texels: Vec<[f16; 4]> = light.iter().map(texel).collect();
        gpu.write_texture(&mean, 0, bytemuck::cast_slice(&texels));
        let present = &mut self.renderer.present;
        present.bind(gpu, &mean.create_view(&wgpu::TextureViewDescriptor::default()), &scene.look.film);
        present.write(gpu, scene, [width, height]);
        let mut encoder = gpu.encoder("reference");
        present.spread(&mut encoder);
        gpu.submit(encoder);
    }

    /// Draws the picture that was handed to [`Self::show`] into the current viewport.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.renderer.present(pass);
    }
}
