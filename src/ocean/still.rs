//! Still pictures: one state of the parameters, drawn and read back from the GPU.

use super::{Ocean, OutputKind};
use crate::gpu::Gpu;
use crate::gpu::offscreen::PendingPicture;
use crate::state::Params;

/// Texture format of the still pictures that are drawn and read back: 8 bits per channel.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Draws the sea with the given parameters, `size` (width, height) pixels. Returns RGBA bytes, row by row from the top.
///
/// # Errors
/// If the read-back from the GPU fails.
pub async fn draw_picture(gpu: &Gpu, params: &Params, size: [u32; 2]) -> Result<Vec<u8>, String> {
    draw_ocean_picture(gpu, &mut Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, params), size).await
}

/// Draws an ocean at its present parameters, `size` (width, height) pixels, with the waves of its coast. Returns RGBA bytes,
/// row by row from the top.
///
/// # Errors
/// If the read-back from the GPU fails.
pub async fn draw_ocean_picture(gpu: &Gpu, ocean: &mut Ocean, size: [u32; 2]) -> Result<Vec<u8>, String> {
    ocean.solve_coast();
    let mut encoder = gpu.encoder("picture");
    ocean.record_frame_with_complete_foam(&mut encoder, size);
    present_and_read_back(gpu, encoder, size, |pass| ocean.present(pass)).await
}

/// Submits `encoder` and a render pass in which `present` draws `size` (width, height) pixels. Returns these pixels:
/// RGBA bytes, row by row from the top.
///
/// # Errors
/// If the read-back from the GPU fails.
pub async fn present_and_read_back(
    gpu: &Gpu,
    encoder: wgpu::CommandEncoder,
    size: [u32; 2],
    present: impl FnOnce(&mut wgpu::RenderPass<'_>),
) -> Result<Vec<u8>, String> {
    PendingPicture::submit(gpu, encoder, PICTURE_FORMAT, size, present).read(gpu).await
}
