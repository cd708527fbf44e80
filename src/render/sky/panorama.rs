//! The textures of a sky from a file: all of it for the background, and a copy without its sun for what the sea mirrors.

use crate::files::panorama::{CALM, Panorama};
use crate::gpu::Gpu;
use crate::gpu::kit::Slot;
use crate::render::targets::HDR_FORMAT;
use half::f16;
use std::sync::Arc;

/// Format of the picture behind the sea.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgb9e5Ufloat;

/// The picture that is shown, if any.
pub struct PanoramaTextures {
    /// The sky image without its sun, [`CALM`] texels wide and high. A new image is written into the same texture.
    calm: wgpu::Texture,
    pub calm_view: wgpu::TextureView,
    pub layout: wgpu::BindGroupLayout,
    /// The picture at full size with mips; one texel when there is none.
    pub group: wgpu::BindGroup,
    shown: Option<Arc<Panorama>>,
}

impl PanoramaTextures {
    /// Without a picture.
    pub fn new(gpu: &Gpu) -> Self {
        let calm = texture(gpu, "sky/calm", HDR_FORMAT, CALM.map(|s| s as u32), 1);
        let layout = gpu.layout("sky/file", wgpu::ShaderStages::FRAGMENT, &[Slot::Texture]);
        let group = picture(gpu, &layout, [1, 1], &[vec![0]]);
        let calm_view = calm.create_view(&wgpu::TextureViewDescriptor::default());
        Self { calm, calm_view, layout, group, shown: None }
    }

    /// Turns to another picture; returns whether it is another one.
    pub fn show(&mut self, gpu: &Gpu, wanted: Option<&Arc<Panorama>>) -> bool {
        if self.shown.as_ref().map(Arc::as_ptr) == wanted.map(Arc::as_ptr) {
            return false;
        }
        if let Some(panorama) = wanted {
            let texels: Vec<[f16; 4]> =
                panorama.calm.iter().map(|c| [c[0], c[1], c[2], 1.0].map(|v| f16::from_f32(v.min(6e4)))).collect();
            gpu.write_texture(&self.calm, 0, bytemuck::cast_slice(&texels));
        }
        let most = gpu.device.limits().max_texture_dimension_2d as usize;
        self.group = match wanted {
            Some(p) => {
                // A device that is smaller than the picture gets one of its mips.
                let first = (0..p.mips.len()).find(|k| p.width >> k <= most).unwrap_or(0);
                let size = [p.width >> first, p.height >> first].map(|s| s.max(1) as u32);
                picture(gpu, &self.layout, size, &p.mips[first..])
            }
            None => picture(gpu, &self.layout, [1, 1], &[vec![0]]),
        };
        self.shown = wanted.cloned();
        true
    }
}

fn texture(gpu: &Gpu, label: &str, format: wgpu::TextureFormat, [w, h]: [u32; 2], mips: u32) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
    gpu.texture(label, [w, h, 1], mips, format, usage)
}

fn picture(gpu: &Gpu, layout: &wgpu::BindGroupLayout, size: [u32; 2], mips: &[Vec<u32>]) -> wgpu::BindGroup {
    let picture = texture(gpu, "sky/file", FORMAT, size, mips.len() as u32);
    for (level, texels) in (0..).zip(mips) {
        gpu.write_texture(&picture, level, bytemuck::cast_slice(texels));
    }
    let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
    gpu.group("sky/file", layout, &[wgpu::BindingResource::TextureView(&view)])
}
