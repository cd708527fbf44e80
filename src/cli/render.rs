//! `seastate render`: a picture of a state, the same on every run.

use super::reference::{self, Sampling};
use crate::gpu::device::Gpu;
use crate::gpu::offscreen::Picture;
use crate::model::Params;
use crate::ocean::Ocean;
use std::path::Path;

/// Format of the pictures.
pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Renders a state at its time and writes a PNG: as a page shows it, or the reference of that picture.
///
/// # Errors
/// One sentence, if there is no adapter or the file cannot be written.
pub async fn run(params: &Params, size: [u32; 2], reference: Option<Sampling>, output: &Path) -> Result<(), String> {
    let gpu = Gpu::request().await?;
    let mut ocean = Ocean::new(&gpu.device, &gpu.queue, FORMAT, params);
    let mut pixels = picture_of(&gpu, &mut ocean, size).await?;
    if let Some(sampling) = reference {
        pixels = reference::picture_of(&gpu, &mut ocean, size, sampling).await?;
    }
    let image = image::RgbaImage::from_raw(size[0], size[1], pixels).ok_or("the picture has a wrong size")?;
    image
        .save_with_format(output, image::ImageFormat::Png)
        .map_err(|e| format!("cannot write {}: {e}", output.display()))
}

/// The pixels of a state, RGBA, row by row from the top.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn picture(gpu: &Gpu, params: &Params, size: [u32; 2]) -> Result<Vec<u8>, String> {
    picture_of(gpu, &mut Ocean::new(&gpu.device, &gpu.queue, FORMAT, params), size).await
}

/// The pixels of a sea that may have been running for a while.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn picture_of(gpu: &Gpu, ocean: &mut Ocean, size: [u32; 2]) -> Result<Vec<u8>, String> {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
    ocean.encode_fully(&gpu.device, &gpu.queue, &mut encoder, size);
    on_film(gpu, encoder, size, |pass| ocean.present(pass)).await
}

/// The pixels that `present` draws after what is recorded.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn on_film(
    gpu: &Gpu,
    encoder: wgpu::CommandEncoder,
    size: [u32; 2],
    present: impl FnOnce(&mut wgpu::RenderPass<'_>),
) -> Result<Vec<u8>, String> {
    Picture::submit(&gpu.device, &gpu.queue, encoder, FORMAT, size, present).read(&gpu.device).await
}
