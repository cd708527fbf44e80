//! How textures of four numbers are kept that shaders read between texels: the maps of the sea, the tables of the sky.
//!
//! **Half**: half the traffic, which is what a GPU waits for, and llvmpipe. **Float**: for other adapters that are CPUs, where the
//! numbers of every texel are converted one by one: SwiftShader reads half floats in five times the time of floats.

use super::Gpu;
use half::f16;

/// The two ways to keep them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapFormat {
    /// Half floats.
    Half,
    /// Floats; the device must be able to filter them.
    Float,
}

impl MapFormat {
    /// The feature without which floats cannot be read between texels.
    pub const FEATURES: wgpu::Features = wgpu::Features::FLOAT32_FILTERABLE;

    /// What to ask an adapter for, if it has it: a device has the feature where floats are the faster format.
    pub fn features(adapter: &wgpu::AdapterInfo) -> wgpu::Features {
        let is_cpu = adapter.device_type == wgpu::DeviceType::Cpu;
        if is_cpu && !adapter.name.contains("llvmpipe") { Self::FEATURES } else { wgpu::Features::empty() }
    }

    /// The one of a device.
    pub fn of(gpu: &Gpu) -> Self {
        if gpu.device.features().contains(Self::FEATURES) { Self::Float } else { Self::Half }
    }

    /// Of the textures.
    pub fn texture(self) -> wgpu::TextureFormat {
        match self {
            Self::Half => wgpu::TextureFormat::Rgba16Float,
            Self::Float => wgpu::TextureFormat::Rgba32Float,
        }
    }

    /// Bytes of a texel.
    pub const fn bytes(self) -> u32 {
        match self {
            Self::Half => 8,
            Self::Float => 16,
        }
    }

    /// The WGSL name of [`Self::texture`].
    pub const fn wgsl(self) -> &'static str {
        match self {
            Self::Half => "rgba16float",
            Self::Float => "rgba32float",
        }
    }

    /// Texels from bytes of a texture of either format.
    pub fn texels(format: wgpu::TextureFormat, bytes: &[u8]) -> Vec<[f32; 4]> {
        if format == wgpu::TextureFormat::Rgba32Float {
            return bytemuck::pod_collect_to_vec(bytes);
        }
        let halves: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(bytes);
        halves.into_iter().map(|t| t.map(f16::to_f32)).collect()
    }
}
