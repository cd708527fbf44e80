//! `seastate render`: a picture of a state, the same on every run.

use super::reference::{self, Sampling};
use crate::gpu::device::Gpu;
use crate::gpu::readback;
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
    mut encoder: wgpu::CommandEncoder,
    size: [u32; 2],
    present: impl FnOnce(&mut wgpu::RenderPass<'_>),
) -> Result<Vec<u8>, String> {
    let target = target(&gpu.device, size);
    on_target(&mut encoder, &target, present);
    let copy = readback::stage_texture(&gpu.device, &mut encoder, &target, 0);
    gpu.queue.submit([encoder.finish()]);
    copy.read(&gpu.device).await
}

/// A texture that stands for the screen.
pub fn target(device: &wgpu::Device, size: [u32; 2]) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// Records a pass that draws over a target.
pub fn on_target(
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::Texture,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("picture"),
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
