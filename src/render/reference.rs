//! The truth that a picture approximates: many samples a pixel, none of them filtered. Slopes that a pixel cannot resolve
//! are sampled, not turned into roughness; only those below the finest cascade stay a lobe.
//!
//! A grid of samples is drawn as a larger picture, several times with its samples moved. Whoever draws averages the linear
//! light ([`Grid`] says which samples are a pixel's) and hands the mean back to be shown by the usual film.

use super::frame::FrameUniform;
use super::targets::{Film, HDR_FORMAT, Targets};
use super::water::displace;
use super::water::mesh::{self, Mesh};
use super::{Renderer, Scene};
use crate::sim::Maps;
use half::f16;

/// Light of single samples.
const SAMPLES: Film = Film::reference();
/// Their mean, on its way to the present pass.
const MEAN: Film = Film { samples: 1, format: HDR_FORMAT, usage: wgpu::TextureUsages::COPY_DST, deferred: false };

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
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, target_format: wgpu::TextureFormat) -> Self {
        Self { renderer: Renderer::on_film(device, queue, target_format, SAMPLES, false) }
    }

    /// Records a grid of samples. The texture holds their light; its w is 0 for the sky and, for water, the weight of the
    /// sample among those of the water in its pixel.
    pub fn draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        maps: &Maps,
        scene: &Scene,
        grid: &Grid,
    ) -> wgpu::Texture {
        let renderer = &mut self.renderer;
        let size = grid.samples();
        let targets = match renderer.targets.take() {
            Some(targets) if targets.size == size && targets.hdr.texture().format() == SAMPLES.format => targets,
            _ => Targets::new(device, size, SAMPLES),
        };
        let texture = targets.hdr.texture().clone();
        renderer.targets = Some(targets);
        let room = FILLED * device.limits().max_storage_buffer_binding_size as f64 / displace::VERTEX as f64;
        let vertices = (VERTICES_PER_SAMPLE * f64::from(size[0]) * f64::from(size[1])).min(room);
        let density = vertices / mesh::VERTICES;
        let mesh = Mesh::new(&scene.view, &scene.sea, density, scene.look.extent_km);
        let frame = FrameUniform::new(scene, maps, &mesh, size).unfiltered(grid.shift());
        renderer.prepare((device, queue), maps, scene, &mesh, &frame);
        renderer.record_picture(device, queue, encoder, scene);
        texture
    }

    /// Takes a picture in linear light, RGB row by row, to be presented as `scene` is.
    pub fn show(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        size: [u32; 2],
        light: &[[f32; 3]],
    ) {
        let targets = Targets::new(device, size, MEAN);
        // The shader's own limit; what is not a number stays so and is painted.
        let texel = |l: &[f32; 3]| [l[0], l[1], l[2], 1.0].map(|x| f16::from_f32(if x > 6e4 { 6e4 } else { x }));
        let texels: Vec<[f16; 4]> = light.iter().map(texel).collect();
        queue.write_texture(
            targets.hdr.texture().as_image_copy(),
            bytemuck::cast_slice(&texels),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(8 * size[0]), rows_per_image: None },
            wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        );
        let present = &mut self.renderer.present;
        present.unbind();
        present.bind(device, &targets, &scene.look.film);
        present.write(queue, scene, size);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("lens") });
        present.spread(&mut encoder);
        queue.submit([encoder.finish()]);
    }

    /// Draws the picture that was handed to [`Self::show`] into the current viewport.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.renderer.present(pass);
    }
}
