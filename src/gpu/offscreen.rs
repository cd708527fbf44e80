//! Draws pictures without a window, and reads their pixels back.

use super::Gpu;
use super::readback::{self, StagedTexture};

/// Creates a texture of `size` (width, height) texels on which render passes can draw, and which can be copied from.
pub fn create_target(gpu: &Gpu, format: wgpu::TextureFormat, size: [u32; 2]) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    gpu.texture("offscreen", [size[0], size[1], 1], 1, format, usage)
}

/// Records a render pass, without depth, that clears the texture `target` to black and draws on it what `draw` records.
pub fn clear_and_draw(
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

/// A picture drawn without a window, whose commands have been submitted and whose pixels can be read back.
pub struct PendingPicture {
    copy: StagedTexture,
    /// Whether a pixel stores blue first (BGRA), so that reading must swap blue and red.
    is_bgra: bool,
}

impl PendingPicture {
    /// Draws a picture of `size` (width, height) pixels without a window by `draw`, after the commands of `encoder`.
    /// Submits all commands, including a copy of the picture that [`Self::read`] reads.
    pub fn submit(
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        format: wgpu::TextureFormat,
        size: [u32; 2],
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Self {
        let target = create_target(gpu, format, size);
        clear_and_draw(&mut encoder, &target, draw);
        let copy = readback::stage_texture(gpu, &mut encoder, &target, 0);
        gpu.submit(encoder);
        Self { copy, is_bgra: format.remove_srgb_suffix() == wgpu::TextureFormat::Bgra8Unorm }
    }

    /// Waits for the picture and returns its pixels: four bytes each (RGBA), row by row from the top.
    ///
    /// # Errors
    /// If mapping the staging buffer fails.
    pub async fn read(self, gpu: &Gpu) -> Result<Vec<u8>, String> {
        let mut pixels = self.copy.read(gpu).await?;
        if self.is_bgra {
            pixels.chunks_exact_mut(4).for_each(|p| p.swap(0, 2));
        }
        Ok(pixels)
    }
}
