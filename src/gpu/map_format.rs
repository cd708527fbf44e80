//! The format of textures with four components that compute passes write and that shaders filter.
//!
//! Half floats have half the memory traffic of floats, which limits GPUs and llvmpipe. Other software adapters convert
//! every half float that they read: SwiftShader takes five times as long to filter half-float textures as to filter
//! float textures.

use super::Gpu;
use half::f16;

/// A texture format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapFormat {
    /// Half floats.
    Half,
    /// Floats, for devices that can filter them.
    Float,
}

impl MapFormat {
    /// The feature that makes float textures filterable.
    pub const FEATURES: wgpu::Features = wgpu::Features::FLOAT32_FILTERABLE;

    /// The feature to request from an adapter, if it has it: [`Self::FEATURES`] where floats are the faster format.
    pub fn features(adapter: &wgpu::AdapterInfo) -> wgpu::Features {
        let is_cpu = adapter.device_type == wgpu::DeviceType::Cpu;
        if is_cpu && !adapter.name.contains("llvmpipe") { Self::FEATURES } else { wgpu::Features::empty() }
    }

    /// The faster format on a device.
    pub fn of(gpu: &Gpu) -> Self {
        Self::for_adapter(gpu.is_software(), gpu.device.features())
    }

    /// Floats on software adapters that can filter them. A graphics card keeps half floats, even if its device has the
    /// feature, as the device of a host program may.
    fn for_adapter(is_software: bool, features: wgpu::Features) -> Self {
        if is_software && features.contains(Self::FEATURES) { Self::Float } else { Self::Half }
    }

    /// The format as wgpu names it.
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

    /// The format as WGSL names it.
    pub const fn wgsl(self) -> &'static str {
        match self {
            Self::Half => "rgba16float",
            Self::Float => "rgba32float",
        }
    }

    /// Texels from the bytes of a texture of either format.
    pub fn texels(format: wgpu::TextureFormat, bytes: &[u8]) -> Vec<[f32; 4]> {
        if format == wgpu::TextureFormat::Rgba32Float {
            return bytemuck::pod_collect_to_vec(bytes);
        }
        let halves: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(bytes);
        halves.into_iter().map(|t| t.map(f16::to_f32)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_software_adapters_get_floats() {
        let with = MapFormat::FEATURES;
        assert_eq!(MapFormat::for_adapter(false, with), MapFormat::Half);
        assert_eq!(MapFormat::for_adapter(true, with), MapFormat::Float);
        assert_eq!(MapFormat::for_adapter(true, wgpu::Features::empty()), MapFormat::Half);
    }
}
