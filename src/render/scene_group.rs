//! The bind group that all passes of the HDR picture share; shaders/common/scene.wgsl declares its bindings.

use super::frame::FrameUniform;
use super::land::map::LandUniform;
use super::sky::clouds::CloudView;
use super::sky::tables::SkyTables;
use super::sky::uniform::{LightBuffer, SkyUniform};
use super::targets::OutputKind;
use super::water::hull_images::HullImages;
use super::water::material::MaterialUniform;
use super::water::noise::NoiseTexture;
use crate::gpu::Gpu;
use crate::gpu::kit::BindingType;
use crate::gpu::uniform::Uniform;
use wgpu::BindingResource::{Sampler, TextureView};

/// Bind group with the uniform buffers of frame, sky, light and material, and with the textures of sky, noise and land.
pub struct SceneGroup {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// Purpose of the picture (screen, read-back or reference), which gives the format of its render target.
    pub output: OutputKind,
}

impl SceneGroup {
    /// Creates the bind group with the given buffers and textures. `output` is the purpose of the picture.
    pub fn new(gpu: &Gpu, resources: &SceneResources<'_>, output: OutputKind) -> Self {
        let bindings = [
            BindingType::Uniform(size_of::<FrameUniform>()),
            BindingType::Uniform(size_of::<SkyUniform>()),
            BindingType::Uniform(size_of::<LightBuffer>()),
            BindingType::Texture,
            BindingType::Texture,
            BindingType::Sampler,
            BindingType::TextureArray,
            BindingType::Sampler,
            BindingType::Texture,
            BindingType::Uniform(size_of::<MaterialUniform>()),
            BindingType::Texture3d,
            BindingType::Uniform(size_of::<CloudView>()),
            BindingType::Texture,
            BindingType::Texture,
            BindingType::Uniform(size_of::<HullImages>()),
            BindingType::Uniform(size_of::<LandUniform>()),
        ];
        let layout = gpu.bind_group_layout("scene", wgpu::ShaderStages::VERTEX_FRAGMENT, &bindings);
        Self { group: resources.bind(gpu, &layout), layout, output }
    }

    /// Binds other resources from now on.
    pub fn bind(&mut self, gpu: &Gpu, resources: &SceneResources<'_>) {
        self.group = resources.bind(gpu, &self.layout);
    }
}

/// Buffers and textures of the scene.
pub struct SceneResources<'a> {
    pub frame: &'a Uniform<FrameUniform>,
    pub material: &'a Uniform<MaterialUniform>,
    pub hull_images: &'a Uniform<HullImages>,
    pub sky: &'a SkyTables,
    pub noise: &'a NoiseTexture,
    /// Uniform and map of the land.
    pub land: (&'a Uniform<LandUniform>, &'a wgpu::TextureView),
}

impl SceneResources<'_> {
    fn bind(&self, gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        let Self { frame, material, hull_images, sky, noise, land: (land, land_map) } = self;
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
            TextureView(land_map),
            hull_images.buffer.as_entire_binding(),
            land.buffer.as_entire_binding(),
        ];
        gpu.bind_group("scene", layout, &resources)
    }
}
