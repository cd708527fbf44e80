//! Textures of a sky from an image file: the full image for the background, and a copy without the sun for reflections.

use crate::files::panorama::{Panorama, SUNLESS_SIZE};
use crate::gpu::Gpu;
use crate::gpu::kit::BindingType;
use crate::render::targets::HDR_FORMAT;
use half::f16;
use std::sync::Arc;

/// Texture format of the full-size sky image, which is drawn behind the sea.
const PANORAMA_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgb9e5Ufloat;

/// GPU textures of the image from a file that replaces the computed sky; black or outdated while no image is in use.
pub struct PanoramaTextures {
    /// Sky image without its sun, for reflections, [`SUNLESS_SIZE`] texels; a new image overwrites it.
    without_sun: wgpu::Texture,
    pub without_sun_view: wgpu::TextureView,
    pub layout: wgpu::BindGroupLayout,
    /// Bind group of the full-size sky image with its mip levels; one black texel while no image is in use.
    pub group: wgpu::BindGroup,
    displayed: Option<Arc<Panorama>>,
}

impl PanoramaTextures {
    /// Creates the textures before there is a sky image: the full-size one is one black texel.
    pub fn new(gpu: &Gpu) -> Self {
        let without_sun = create_texture(gpu, "sky/calm", HDR_FORMAT, SUNLESS_SIZE.map(|s| s as u32), 1);
        let layout = gpu.bind_group_layout("sky/file", wgpu::ShaderStages::FRAGMENT, &[BindingType::Texture]);
        let group = image_bind_group(gpu, &layout, [1, 1], &[vec![0]]);
        let without_sun_view = without_sun.create_view(&wgpu::TextureViewDescriptor::default());
        Self { without_sun, without_sun_view, layout, group, displayed: None }
    }

    /// Uploads the sky image `wanted`; None switches back to the computed sky. Returns whether the image has changed.
    pub fn set_image(&mut self, gpu: &Gpu, wanted: Option<&Arc<Panorama>>) -> bool {
        if self.displayed.as_ref().map(Arc::as_ptr) == wanted.map(Arc::as_ptr) {
            return false;
        }
        if let Some(panorama) = wanted {
            let texels: Vec<[f16; 4]> =
                panorama.sunless.iter().map(|c| [c[0], c[1], c[2], 1.0].map(|v| f16::from_f32(v.min(6e4)))).collect();
            gpu.write_texture(&self.without_sun, 0, bytemuck::cast_slice(&texels));
        }
        let most = gpu.device.limits().max_texture_dimension_2d as usize;
        self.group = match wanted {
            Some(p) => {
                // If the image is larger than the device's largest texture, a coarser mip level takes its place.
                let first = (0..p.mips.len()).find(|k| p.width >> k <= most).unwrap_or(0);
                let size = [p.width >> first, p.height >> first].map(|s| s.max(1) as u32);
                image_bind_group(gpu, &self.layout, size, &p.mips[first..])
            }
            None => image_bind_group(gpu, &self.layout, [1, 1], &[vec![0]]),
        };
        self.displayed = wanted.cloned();
        true
    }
}

fn create_texture(gpu: &Gpu, label: &str, format: wgpu::TextureFormat, [w, h]: [u32; 2], mips: u32) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
    gpu.texture(label, [w, h, 1], mips, format, usage)
}

fn image_bind_group(gpu: &Gpu, layout: &wgpu::BindGroupLayout, size: [u32; 2], mips: &[Vec<u32>]) -> wgpu::BindGroup {
    let picture = create_texture(gpu, "sky/file", PANORAMA_FORMAT, size, mips.len() as u32);
    for (level, texels) in (0..).zip(mips) {
        gpu.write_texture(&picture, level, bytemuck::cast_slice(texels));
    }
    let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
    gpu.bind_group("sky/file", layout, &[wgpu::BindingResource::TextureView(&view)])
}
