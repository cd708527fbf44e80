//! The bind group that all passes of the HDR picture share; shaders/common/scene.wgsl declares its bindings.

use super::frame::FrameUniform;
use super::sky::clouds::CloudView;
use super::sky::tables::SkyTables;
use super::sky::uniform::{LightBuffer, SkyUniform};
use super::targets::OutputKind;
use super::water::bed::BedTexture;
use super::water::hull_images::HullImages;
use super::water::material::MaterialUniform;
use super::water::noise::NoiseTexture;
use crate::gpu::Gpu;
use crate::gpu::kit::BindingType;
use crate::gpu::uniform::Uniform;
use wgpu::BindingResource::{Sampler, TextureView};

/// Bind group with the uniform buffers of frame, sky, light and material, and with the textures of sky, noise and bed.
pub struct SceneGroup {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// Purpose of the picture (screen, read-back or reference), which gives the format of its render target.
    pub output: OutputKind,
}

impl SceneGroup {
    /// Creates the bind group with the given buffers and textures. `output` is the purpose of the picture.
    pub fn new(
        gpu: &Gpu,
        frame: &Uniform<FrameUniform>,
        (material, hull_images): (&Uniform<MaterialUniform>, &Uniform<HullImages>),
        sky: &SkyTables,
        (noise, bed): (&NoiseTexture, &BedTexture),
        output: OutputKind,
    ) -> Self {
        let bindings = [
            BindingType::Uniform(size_of::<FrameUniform>()),
            BindingType::Uniform(size_of::<SkyUniform>()),
            BindingType::Uniform(size_of::<LightBuffer>()),
            BindingType::Texture,
            BindingType::Texture,
            BindingType::Sampler,
            BindingType::Texture,
            BindingType::Sampler,
            BindingType::Texture,
            BindingType::Uniform(size_of::<MaterialUniform>()),
            BindingType::Texture3d,
            BindingType::Uniform(size_of::<CloudView>()),
            BindingType::Texture,
            BindingType::Texture,
            BindingType::Uniform(size_of::<HullImages>()),
        ];
        let layout = gpu.bind_group_layout("scene", wgpu::ShaderStages::VERTEX_FRAGMENT, &bindings);
        let resources = [
            frame.buffer.as_entire_binding(),
            sky.uniform.buffer.as_entire_binding(),
            sky.light_buffer.as_entire_binding(),
            TextureView(&sky.sky_view),
            TextureView(&sky.environment),
            Sampler(&sky.sampler),
            TextureView(&noise.view),
            Sampler(&noise.sampler),
            TextureView(&sky.transmittance),
            material.buffer.as_entire_binding(),
            TextureView(&sky.mirrored),
            sky.clouds.view.buffer.as_entire_binding(),
            TextureView(&sky.clouds.shadow),
            TextureView(&bed.view),
            hull_images.buffer.as_entire_binding(),
        ];
        Self { group: gpu.bind_group("scene", &layout, &resources), layout, output }
    }
}
