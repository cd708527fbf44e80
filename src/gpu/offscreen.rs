//! A render target without a window, and its read-back.

use super::Gpu;
use super::readback::{self, TextureCopy};

/// A render target that can be copied from.
pub fn target(gpu: &Gpu, format: wgpu::TextureFormat, size: [u32; 2]) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    gpu.texture("offscreen", [size[0], size[1], 1], 1, format, usage)
}

/// Records a render pass that clears a target and draws on it.
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

/// A picture whose commands have been submitted.
pub struct Picture {
    copy: TextureCopy,
    /// Whether the format stores blue first.
    swapped: bool,
}

impl Picture {
    /// Records `draw` and the read-back of its picture after the commands of `encoder`, and submits them.
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

    /// Reads the pixels: RGBA, row by row from the top.
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
