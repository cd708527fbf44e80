//! Reference pictures: the mean of many unfiltered samples per pixel, which the normal, filtered picture approximates.
//! Slopes that a pixel cannot resolve are sampled; only those that no cascade and no ripples hold remain roughness.
//!
//! A grid of samples is drawn as a larger picture, several times with shifted samples. The caller averages the linear
//! light ([`SampleGrid`] tells which samples belong to a pixel) and passes the mean to
//! [`ReferenceRenderer::set_linear_light`].

use super::Renderer;
use super::frame::FrameUniform;
use super::scene::Scene;
use super::targets::{HDR_FORMAT, OutputKind};
use super::water::displace;
use super::water::mesh::{self, Mesh};
use crate::gpu::Gpu;
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::sim::Maps;
use half::f16;

/// Number of vertices of the water mesh divided by the number of samples in one drawing of a reference picture (mean of
/// many samples per pixel); smaller if so many vertices do not fit into a buffer.
const VERTICES_PER_SAMPLE: f64 = 1.2;
/// Fraction of the largest possible storage buffer that the planned mesh vertices may fill. The rest is room for
/// rounding the numbers of columns and rows up.
const VERTEX_BUFFER_FILL: f64 = 0.95;

/// The unfiltered samples that one drawing adds to a reference picture (mean of many samples per pixel): each pixel is
/// divided into `cells_per_pixel_side` squared cells, with one sample in each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleGrid {
    /// Width and height of the picture, pixels.
    pub size: [u32; 2],
    /// Number of cells, and so of samples, along each side of a pixel.
    pub cells_per_pixel_side: u32,
    /// Position of every sample in its cell, as a fraction of the cell's side, 0 to 1, to the right and downwards.
    pub sample_position_in_cell: [f64; 2],
}

impl SampleGrid {
    /// Numbers of samples along the picture's width and height, and so the size of the render target, texels.
    pub fn sample_counts(&self) -> [u32; 2] {
        self.size.map(|s| s * self.cells_per_pixel_side)
    }

    /// Shift (x, y) of the picture in clip coordinates that moves samples from their cells' centres to
    /// `sample_position_in_cell`.
    fn clip_shift(&self) -> [f32; 2] {
        let [w, h] = self.sample_counts().map(f64::from);
        [
            (-2.0 * (self.sample_position_in_cell[0] - 0.5) / w) as f32,
            (2.0 * (self.sample_position_in_cell[1] - 0.5) / h) as f32,
        ]
    }
}

/// Draws the samples of reference pictures (mean of many unfiltered samples per pixel, with which the real-time picture
/// is compared), and shows the mean that the caller computes.
pub struct ReferenceRenderer {
    renderer: Renderer,
}

impl ReferenceRenderer {
    /// Compiles the passes of reference pictures. `target_format` is the format that [`Self::present`] draws into.
    pub fn new(gpu: &Gpu, target_format: wgpu::TextureFormat) -> Self {
        Self { renderer: Renderer::new(gpu, &Shaders::default(), target_format, OutputKind::Reference) }
    }

    /// Records the drawing of one grid of samples. Returns a texture with one sample per texel: linear light in rgb.
    /// Alpha is 0 for sky and hulls; for water it is the sample's weight in the mean of the pixel's water samples:
    /// projected area of the sample's surface divided by that of the mesh there.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        maps: &Maps,
        scene: &Scene,
        grid: &SampleGrid,
    ) -> wgpu::Texture {
        let renderer = &mut self.renderer;
        let size = grid.sample_counts();
        let texture = renderer.ensure_targets(gpu, size).hdr.texture().clone();
        let room = VERTEX_BUFFER_FILL * gpu.device.limits().max_storage_buffer_binding_size as f64
            / displace::MESH_VERTEX_BYTES as f64;
        let vertices = (VERTICES_PER_SAMPLE * f64::from(size[0]) * f64::from(size[1])).min(room);
        let density = vertices / mesh::DEFAULT_VERTICES;
        let mesh = Mesh::new(&scene.view, &scene.sea, density, scene.look.extent_km);
        let frame = FrameUniform::new(scene, maps, &mesh, size).for_point_samples(grid.clip_shift());
        renderer.prepare_frame(gpu, maps, scene, &mesh, &frame);
        renderer.record_picture(gpu, encoder, scene);
        texture
    }

    /// Uploads the mean of the samples, a picture of `width` x `height` pixels in linear light (RGB, row by row from
    /// the top), for [`Self::present`]. Exposure and film settings are those of `scene`.
    pub fn set_linear_light(&mut self, gpu: &Gpu, scene: &Scene, [width, height]: [u32; 2], light: &[[f32; 3]]) {
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let mean = gpu.texture("reference", [width, height, 1], 1, HDR_FORMAT, usage);
        // As in shaders/common/frame.wgsl: light is limited, and light that is no number has a negative alpha, so that
        // the tone pass paints it magenta.
        let texel = |l: &[f32; 3]| {
            let is_valid = l.iter().all(|x| *x > f32::NEG_INFINITY);
            let [r, g, b] = if is_valid { l.map(|x| x.min(6e4)) } else { [0.0; 3] };
            [r, g, b, if is_valid { 1.0 } else { -6e4 }].map(f16::from_f32)
        };
        let texels: Vec<[f16; 4]> = light.iter().map(texel).collect();
        gpu.write_texture(&mean, 0, bytemuck::cast_slice(&texels));
        let view = mean.create_view(&wgpu::TextureViewDescriptor::default());
        self.renderer.set_picture(gpu, scene, &view, false);
        let mut encoder = gpu.encoder("reference");
        self.renderer.tone.record_measures(&mut encoder, &Timer::default());
        self.renderer.tone.record(&mut encoder, &Timer::default());
        gpu.submit(encoder);
    }

    /// Draws the picture that was passed to [`Self::set_linear_light`] into the viewport of `pass`.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.renderer.present(pass);
    }
}
