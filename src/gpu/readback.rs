//! Reads buffers and textures back from the GPU, natively and in the browser.

use super::Gpu;
use super::map_format::MapFormat;
use futures_channel::oneshot;

/// Records a copy of the whole buffer `source` into a new staging buffer. Returns the staging buffer, for [`read`].
pub fn stage_buffer(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, source: &wgpu::Buffer) -> wgpu::Buffer {
    let staging = create_staging_buffer(gpu, source.size());
    encoder.copy_buffer_to_buffer(source, 0, &staging, 0, source.size());
    staging
}

/// Copy of a texture's mip level in a buffer that the CPU can read, with rows padded to a multiple of 256 bytes.
pub struct StagedTexture {
    staging: wgpu::Buffer,
    format: wgpu::TextureFormat,
    row_bytes: usize,
    padded: usize,
}

/// Records a copy of mip level `mip_level` of all layers of a texture into a new buffer that the CPU can read.
pub fn stage_texture(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    mip_level: u32,
) -> StagedTexture {
    stage_layers(gpu, encoder, texture, mip_level, 0..texture.depth_or_array_layers())
}

/// Records a copy of mip level `mip_level` of the given layers of a texture to a new buffer that the CPU can read.
pub fn stage_layers(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    mip_level: u32,
    layers: std::ops::Range<u32>,
) -> StagedTexture {
    let width = (texture.width() >> mip_level).max(1);
    let height = (texture.height() >> mip_level).max(1);
    let (first, layers) = (layers.start, layers.end - layers.start);
    let texel = texture.format().block_copy_size(None).unwrap_or(4);
    let row_bytes = width * texel;
    let padded = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let staging = create_staging_buffer(gpu, u64::from(padded) * u64::from(height) * u64::from(layers));
    encoder.copy_texture_to_buffer(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level,
            origin: wgpu::Origin3d { x: 0, y: 0, z: first },
            aspect: wgpu::TextureAspect::All,
        },
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded),
                rows_per_image: Some(height),
            },
        },
        wgpu::Extent3d { width, height, depth_or_array_layers: layers },
    );
    StagedTexture { staging, format: texture.format(), row_bytes: row_bytes as usize, padded: padded as usize }
}

impl StagedTexture {
    /// Waits for the copy and returns the bytes of its texels, layer by layer and row by row, without padding. Call
    /// this once the copy is submitted.
    ///
    /// # Errors
    /// If mapping the staging buffer fails.
    pub async fn read(self, gpu: &Gpu) -> Result<Vec<u8>, String> {
        let (row, padded) = (self.row_bytes, self.padded);
        let bytes = read(gpu, self.staging).await?;
        if row == padded {
            return Ok(bytes);
        }
        let mut texels = Vec::with_capacity(bytes.len() / padded * row);
        bytes.chunks(padded).for_each(|line| texels.extend_from_slice(&line[..row]));
        Ok(texels)
    }

    /// Waits for the copy of a map, whose format is one of [`MapFormat`], and returns its texels as f32, layer by layer
    /// and row by row. Call this once the copy is submitted.
    ///
    /// # Errors
    /// If mapping the staging buffer fails.
    pub async fn read_map(self, gpu: &Gpu) -> Result<Vec<[f32; 4]>, String> {
        let format = self.format;
        Ok(MapFormat::texels_from_bytes(format, &self.read(gpu).await?))
    }
}

/// Waits until the submitted commands are done, and returns all bytes of a staging buffer that they wrote.
///
/// # Errors
/// If mapping the staging buffer fails.
pub async fn read(gpu: &Gpu, staging: wgpu::Buffer) -> Result<Vec<u8>, String> {
    let (sender, receiver) = oneshot::channel();
    staging.slice(..).map_async(wgpu::MapMode::Read, move |result| {
        // Sending cannot fail, because the receiver lives until the end of this function.
        let _ = sender.send(result);
    });
    poll_until_done(gpu)?;
    receiver.await.map_err(|e| e.to_string())?.map_err(|e| e.to_string())?;
    let bytes = staging.slice(..).get_mapped_range().map_err(|e| e.to_string())?.to_vec();
    staging.unmap();
    Ok(bytes)
}

/// Waits until the GPU has done all work that has been submitted so far.
///
/// # Errors
/// If the device is lost.
pub async fn wait_for_submitted_work(gpu: &Gpu) -> Result<(), String> {
    let (sender, receiver) = oneshot::channel();
    gpu.queue.on_submitted_work_done(move || {
        // Sending cannot fail, because the receiver lives until the end of this function.
        let _ = sender.send(());
    });
    poll_until_done(gpu)?;
    receiver.await.map_err(|e| e.to_string())
}

/// Natively blocks until the submitted work is done, so that wgpu calls its callbacks. A browser calls them by itself.
fn poll_until_done(gpu: &Gpu) -> Result<(), String> {
    #[cfg(not(target_arch = "wasm32"))]
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| e.to_string())?;
    #[cfg(target_arch = "wasm32")]
    let _ = gpu;
    Ok(())
}

fn create_staging_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.buffer("staging", size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)
}
