//! shaders/water/eye.wgsl: the eye is kept above the water.

use super::light::WaterPass;
use crate::gpu::shaders::Shaders;
use crate::render::Scene;
use crate::render::frame::FrameUniform;
use crate::render::kit::{Slot, Uniform, group, layout};

/// Raises the eye of a frame over the waves around it.
pub struct EyePass {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

impl EyePass {
    /// Compiles the pass.
    pub fn new(device: &wgpu::Device, shaders: &Shaders, frame: &Uniform<FrameUniform>, water: &WaterPass) -> Self {
        let slots = [Slot::Write(size_of::<FrameUniform>())];
        let layout = layout(device, "eye", wgpu::ShaderStages::COMPUTE, &slots);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("eye"),
            bind_group_layouts: &[Some(&layout), Some(water.maps_layout())],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("eye"),
            layout: Some(&pipeline_layout),
            module: &shaders.module(device, "eye"),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let group = group(device, "eye", &layout, &[frame.buffer.as_entire_binding()]);
        Self { pipeline, group }
    }

    /// Records it, unless no wave can reach the eye.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene, water: &WaterPass) {
        let Some(maps) = water.maps_group().filter(|_| may_be_wet(scene)) else { return };
        let descriptor = wgpu::ComputePassDescriptor { label: Some("eye"), timestamp_writes: None };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.dispatch_workgroups(1, 1, 1);
    }
}

/// A crest of 1.5 Hs comes once in some 10^7 waves that are Rayleigh distributed.
fn may_be_wet(scene: &Scene) -> bool {
    scene.view.eye.y < 3.0 + 1.5 * f64::from(scene.sea.hs_m)
}
