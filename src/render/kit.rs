//! Helpers of the picture's passes: the bind group that they share, and pipelines by the parts that a picture has.

use super::frame::FrameUniform;
use super::sky::{LightBuffer, Sky, SkyUniform};
use super::targets::Film;
use super::water::material::MaterialUniform;
use super::water::noise::NoiseTexture;
use crate::gpu::Gpu;
use crate::gpu::kit::Slot;
use crate::gpu::uniform::Uniform;

/// The bind group that every pass of the HDR picture shares.
pub struct SceneGroup {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// What the passes draw into.
    pub film: Film,
}

impl SceneGroup {
    pub fn new(
        gpu: &Gpu,
        frame: &Uniform<FrameUniform>,
        material: &Uniform<MaterialUniform>,
        sky: &Sky,
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
        let group = gpu.group(
            "scene",
            &layout,
            &[
                frame.buffer.as_entire_binding(),
                sky.uniform.buffer.as_entire_binding(),
                sky.light.as_entire_binding(),
                wgpu::BindingResource::TextureView(&sky.view),
                wgpu::BindingResource::TextureView(&sky.environment),
                wgpu::BindingResource::Sampler(&sky.sampler),
                wgpu::BindingResource::TextureView(&noise.view),
                wgpu::BindingResource::Sampler(&noise.sampler),
                wgpu::BindingResource::TextureView(&sky.transmittance),
                material.buffer.as_entire_binding(),
            ],
        );
        Self { layout, group, film }
    }
}

/// The pipelines of a pass, one for each set of parts that was needed so far: what is not there is not in it, because a
/// software GPU pays for both sides of a branch, and any GPU for its registers.
pub struct Variants<P>(Vec<(P, wgpu::RenderPipeline)>);

impl<P> Default for Variants<P> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<P: Copy + PartialEq> Variants<P> {
    /// Turns to the pipeline of these parts, and makes it if there is none yet.
    pub fn choose(&mut self, parts: P, make: impl FnOnce(P) -> wgpu::RenderPipeline) {
        // The last is the one to draw with.
        match self.0.iter().position(|(made, _)| *made == parts) {
            Some(at) => {
                let last = self.0.len() - 1;
                self.0.swap(at, last);
            }
            None => self.0.push((parts, make(parts))),
        }
    }

    /// The pipeline to draw with.
    pub fn chosen(&self) -> Option<&wgpu::RenderPipeline> {
        self.0.last().map(|(_, pipeline)| pipeline)
    }
}

/// A constant of a module that says whether a part is there.
pub fn part(name: &str, is_there: bool) -> (&str, f64) {
    (name, f64::from(u8::from(is_there)))
}
