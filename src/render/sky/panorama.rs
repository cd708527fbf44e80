//! The textures of a sky from a file: all of it for the background, and a copy without its sun for what the sea mirrors.

use crate::files::panorama::{CALM, Panorama};
use crate::render::kit::{Slot, group, layout};
use crate::render::targets::HDR_FORMAT;
use half::f16;
use std::sync::Arc;

/// Format of the picture behind the sea.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgb9e5Ufloat;

/// The picture that is shown, if any.
pub struct PanoramaTextures {
    /// [`CALM`] texels, rewritten in place.
    calm: wgpu::Texture,
    pub calm_view: wgpu::TextureView,
    pub layout: wgpu::BindGroupLayout,
    /// The picture at full size with mips; one texel when there is none.
    pub group: wgpu::BindGroup,
    shown: Option<Arc<Panorama>>,
}

impl PanoramaTextures {
    /// Without a picture.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let calm = texture(device, "sky/calm", HDR_FORMAT, CALM.map(|s| s as u32), 1);
        let layout = layout(device, "sky/file", wgpu::ShaderStages::FRAGMENT, &[Slot::Texture]);
        let group = picture(device, queue, &layout, [1, 1], &[vec![0]]);
        let calm_view = calm.create_view(&wgpu::TextureViewDescriptor::default());
        Self { calm, calm_view, layout, group, shown: None }
    }

    /// Turns to another picture; returns whether it is another one.
    pub fn show(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, wanted: Option<&Arc<Panorama>>) -> bool {
        if self.shown.as_ref().map(Arc::as_ptr) == wanted.map(Arc::as_ptr) {
            return false;
        }
        if let Some(panorama) = wanted {
            let texels: Vec<[f16; 4]> =
                panorama.calm.iter().map(|c| [c[0], c[1], c[2], 1.0].map(|v| f16::from_f32(v.min(6e4)))).collect();
            write(queue, &self.calm, 0, CALM.map(|s| s as u32), bytemuck::cast_slice(&texels));
        }
        let most = device.limits().max_texture_dimension_2d as usize;
        self.group = match wanted {
            Some(p) => {
                // A device that is smaller than the picture gets one of its mips.
                let first = (0..p.mips.len()).find(|k| p.width >> k <= most).unwrap_or(0);
                let size = [p.width >> first, p.height >> first].map(|s| s.max(1) as u32);
                picture(device, queue, &self.layout, size, &p.mips[first..])
            }
            None => picture(device, queue, &self.layout, [1, 1], &[vec![0]]),
        };
        self.shown = wanted.cloned();
        true
    }
}

fn texture(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    size: [u32; 2],
    mips: u32,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: mips,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn write(queue: &wgpu::Queue, texture: &wgpu::Texture, mip_level: u32, size: [u32; 2], bytes: &[u8]) {
    let place = wgpu::TexelCopyTextureInfo {
        texture,
        mip_level,
        origin: wgpu::Origin3d::ZERO,
        aspect: wgpu::TextureAspect::All,
    };
    let row = bytes.len() as u32 / size[1];
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: Some(size[1]) };
    let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
    queue.write_texture(place, bytes, layout, extent);
}

fn picture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    layout: &wgpu::BindGroupLayout,
    size: [u32; 2],
    mips: &[Vec<u32>],
) -> wgpu::BindGroup {
    let picture = texture(device, "sky/file", FORMAT, size, mips.len() as u32);
    for (level, texels) in (0..).zip(mips) {
        let size = size.map(|s| (s >> level).max(1));
        write(queue, &picture, level, size, bytemuck::cast_slice(texels));
    }
    let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
    group(device, "sky/file", layout, &[wgpu::BindingResource::TextureView(&view)])
}
