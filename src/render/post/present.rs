//! shaders/post/present.wgsl: exposure, tone curve, gamma, dither.

use crate::gpu::layout::Layout;
use crate::gpu::shaders::Shaders;
use crate::render::Scene;
use crate::render::kit::{Slot, Uniform, group, layout, screen_pipeline};
use crate::render::sky::LightBuffer;
use crate::render::targets::Targets;
use bytemuck::{Pod, Zeroable};
use std::mem::offset_of;

/// WGSL `Present`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct PresentUniform {
    size: [f32; 2],
    exposure_gain: f32,
    dither: f32,
}

/// For the layout test.
pub const LAYOUT: Layout = (
    "Present",
    &[
        ("size", offset_of!(PresentUniform, size)),
        ("exposure_gain", offset_of!(PresentUniform, exposure_gain)),
        ("dither", offset_of!(PresentUniform, dither)),
    ],
    size_of::<PresentUniform>(),
);

/// Draws the HDR picture into a pass of the screen.
pub struct PresentPass {
    uniform: Uniform<PresentUniform>,
    light: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    group: Option<wgpu::BindGroup>,
}

impl PresentPass {
    /// Compiles the pass for a format of the screen; `smooth` asks for smooth edges.
    pub fn new(
        device: &wgpu::Device,
        shaders: &Shaders,
        light: &wgpu::Buffer,
        target_format: wgpu::TextureFormat,
        smooth: bool,
    ) -> Self {
        let slots = [
            Slot::Uniform(size_of::<PresentUniform>()),
            Slot::Uniform(size_of::<LightBuffer>()),
            Slot::Texture,
            Slot::Sampler,
        ];
        let layout = layout(device, "present", wgpu::ShaderStages::FRAGMENT, &slots);
        let constants = [("PRESENT_SMOOTH", f64::from(u8::from(smooth)))];
        let module = shaders.module(device, "present");
        let pipeline = screen_pipeline(device, "present", &module, &layout, target_format, &constants);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("hdr"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self { uniform: Uniform::new(device, "present"), light: light.clone(), layout, pipeline, sampler, group: None }
    }

    /// Binds new targets.
    pub fn bind(&mut self, device: &wgpu::Device, targets: &Targets) {
        let resources = [
            self.uniform.buffer.as_entire_binding(),
            self.light.as_entire_binding(),
            wgpu::BindingResource::TextureView(&targets.hdr),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        self.group = Some(group(device, "present", &self.layout, &resources));
    }

    /// Sends what the film needs to know.
    pub fn write(&self, queue: &wgpu::Queue, scene: &Scene, size: [u32; 2]) {
        let exposure_gain = (scene.look.film.exposure_ev as f32).exp2();
        self.uniform.write(queue, &PresentUniform { size: size.map(|s| s as f32), exposure_gain, dither: 1.0 });
    }

    /// Draws into the current viewport.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(group) = &self.group else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }
}
