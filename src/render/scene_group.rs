//! The bind group that all passes of the HDR picture share; shaders/common/scene.wgsl declares its bindings.

use super::frame::FrameUniform;
use super::sky::tables::SkyTables;
use super::sky::uniform::{LightBuffer, SkyUniform};
use super::targets::Film;
use super::water::material::MaterialUniform;
use super::water::noise::NoiseTexture;
use crate::gpu::Gpu;
use crate::gpu::kit::Slot;
use crate::gpu::uniform::Uniform;
use wgpu::BindingResource::{Sampler, TextureView};

/// Bind group with the uniform buffers of frame, sky, light and material, and with the sky and noise textures.
pub struct SceneGroup {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// Film of the picture, which gives the format of the render target.
    pub film: Film,
}

impl SceneGroup {
    /// Creates the bind group from its buffers and textures.
    pub fn new(
        gpu: &Gpu,
        frame: &Uniform<FrameUniform>,
        material: &Uniform<MaterialUniform>,
        sky: &SkyTables,
        noise: &NoiseTexture,
        film: Film,
    ) -> Self {
        let slots = [
            Slot::Uniform(size_of::<FrameUniform>()),
            Slot::Uniform(size_of::<SkyUniform>()),
            Slot::Uniform(size_of::<LightBuffer>()),
            Slot::Texture,
            Slot::Texture,
            Slot::Sampler,
            Slot::Texture,
            Slot::Sampler,
            Slot::Texture,
            Slot::Uniform(size_of::<MaterialUniform>()),
        ];
        let layout = gpu.layout("scene", wgpu::ShaderStages::VERTEX_FRAGMENT, &slots);
        let resources = [
            frame.buffer.as_entire_binding(),
            sky.uniform.buffer.as_entire_binding(),
            sky.light.as_entire_binding(),
            TextureView(&sky.view),
            TextureView(&sky.environment),
            Sampler(&sky.sampler),
            TextureView(&noise.view),
            Sampler(&noise.sampler),
            TextureView(&sky.transmittance),
            material.buffer.as_entire_binding(),
        ];
        Self { group: gpu.group("scene", &layout, &resources), layout, film }
    }
}
