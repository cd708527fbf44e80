//! A texture that stands for the screen, and the picture that is drawn over it.

use super::Gpu;
use super::readback::{self, TextureCopy};

/// A texture that can be drawn over and copied from.
pub fn target(gpu: &Gpu, format: wgpu::TextureFormat, size: [u32; 2]) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("offscreen"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// Records a pass that draws over a target.
pub fn draw_over(
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::Texture,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("offscreen"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: None,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    draw(&mut pass);
}

/// A picture that has been handed to the GPU.
pub struct Picture {
    copy: TextureCopy,
    /// Blue comes first.
    swapped: bool,
}

impl Picture {
    /// Records what `draw` draws after what is recorded, and submits all of it.
    pub fn submit(
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        format: wgpu::TextureFormat,
        size: [u32; 2],
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Self {
        let target = target(gpu, format, size);
        draw_over(&mut encoder, &target, draw);
        let copy = readback::stage_texture(gpu, &mut encoder, &target, 0);
        gpu.submit(encoder);
        Self { copy, swapped: format.remove_srgb_suffix() == wgpu::TextureFormat::Bgra8Unorm }
    }

    /// Its pixels, RGBA, row by row from the top.
    ///
    /// # Errors
    /// If the GPU does not give its memory back.
    pub async fn read(self, gpu: &Gpu) -> Result<Vec<u8>, String> {
        let mut pixels = self.copy.read(gpu).await?;
        if self.swapped {
            pixels.chunks_exact_mut(4).for_each(|p| p.swap(0, 2));
        }
        Ok(pixels)
    }
}
