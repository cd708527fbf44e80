//! Texture format of the maps, which have four components, are written by compute passes and filtered by shaders.
//!
//! Half floats need half the memory traffic of 32-bit floats, and memory traffic limits GPUs and llvmpipe. Other
//! software adapters convert every half float that they read: SwiftShader takes five times as long to filter half-float
//! textures as to filter 32-bit float textures.

use super::Gpu;
use half::f16;

/// Texture format of the simulation's maps (displacement, gradients, slope moments, foam): four floats per texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapFormat {
    /// Four 16-bit floats per texel (`rgba16float`), for GPUs, llvmpipe and adapters that cannot filter 32-bit floats.
    Half,
    /// Four 32-bit floats per texel (`rgba32float`), for software adapters that filter them faster than 16-bit floats.
    Float,
}

impl MapFormat {
    /// wgpu feature of devices whose samplers can filter textures of 32-bit floats.
    pub const FILTERABLE_FLOATS: wgpu::Features = wgpu::Features::FLOAT32_FILTERABLE;

    /// Optional wgpu feature to request from an adapter: [`Self::FILTERABLE_FLOATS`] if it is a software adapter that
    /// filters 32-bit floats faster than 16-bit floats (all but llvmpipe), else none.
    pub fn wanted_features(adapter: &wgpu::AdapterInfo) -> wgpu::Features {
        let is_cpu = adapter.device_type == wgpu::DeviceType::Cpu;
        if is_cpu && !adapter.name.contains("llvmpipe") { Self::FILTERABLE_FLOATS } else { wgpu::Features::empty() }
    }

    /// The map format that is faster on a device: 32-bit floats on software adapters whose device can filter them,
    /// else 16-bit floats.
    pub fn for_device(gpu: &Gpu) -> Self {
        Self::for_adapter(gpu.is_software(), gpu.device.features())
    }

    /// Format for an adapter whose device has `features`: 32-bit floats if it is a software adapter and the device can
    /// filter them. A GPU gets 16-bit floats, even if the device was opened with [`Self::FILTERABLE_FLOATS`].
    fn for_adapter(is_software: bool, features: wgpu::Features) -> Self {
        if is_software && features.contains(Self::FILTERABLE_FLOATS) { Self::Float } else { Self::Half }
    }

    /// The texture format in wgpu that stands for this map format.
    pub fn texture_format(self) -> wgpu::TextureFormat {
        match self {
            Self::Half => wgpu::TextureFormat::Rgba16Float,
            Self::Float => wgpu::TextureFormat::Rgba32Float,
        }
    }

    /// Size of a texel, which has four components, bytes.
    pub const fn bytes_per_texel(self) -> u32 {
        match self {
            Self::Half => 8,
            Self::Float => 16,
        }
    }

    /// The name of this map format in WGSL, for the declaration of storage textures.
    pub const fn wgsl_format_name(self) -> &'static str {
        match self {
            Self::Half => "rgba16float",
            Self::Float => "rgba32float",
        }
    }

    /// Converts the bytes of a map texture to texels of four f32. `format` is `Rgba16Float` or `Rgba32Float`.
    pub fn texels_from_bytes(format: wgpu::TextureFormat, bytes: &[u8]) -> Vec<[f32; 4]> {
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
        let with = MapFormat::FILTERABLE_FLOATS;
        assert_eq!(MapFormat::for_adapter(false, with), MapFormat::Half);
        assert_eq!(MapFormat::for_adapter(true, with), MapFormat::Float);
        assert_eq!(MapFormat::for_adapter(true, wgpu::Features::empty()), MapFormat::Half);
    }
}
