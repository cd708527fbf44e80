//! The compute pass that keeps an eye that does not dive above the water (shaders/water/eye.wgsl).

use super::light::WaterPass;
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, begin_compute};
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::render::frame::FrameUniform;
use crate::render::scene::Scene;
use crate::render::variants::ComputeVariants;
use crate::shaders::Shaders;

/// Compute pass that changes the eye's height in the frame uniform: on a buoy, it adds the height of the water below;
/// then it raises the eye where needed to stay above the waves around it. If the eye dives, it measures the surface there
/// instead.
pub struct EyePass {
    pipeline: ComputeVariants<1>,
    group: wgpu::BindGroup,
}

impl EyePass {
    /// Makes the pass, which changes the eye's height in the uniform buffer `frame`.
    pub fn new(gpu: &Gpu, shaders: &Shaders, frame: &Uniform<FrameUniform>, water: &WaterPass) -> Self {
        let bindings = [BindingType::StorageReadWrite(size_of::<FrameUniform>())];
        let layout = gpu.bind_group_layout("eye", wgpu::ShaderStages::COMPUTE, &bindings);
        let module = shaders.module(gpu, "water/eye");
        let pipeline = ComputeVariants::new("eye", module, &[&layout, water.maps_layout()], ["WATER_COAST"]);
        let group = gpu.bind_group("eye", &layout, &[frame.buffer.as_entire_binding()]);
        Self { pipeline, group }
    }

    /// Selects the pipeline for a scene.
    pub fn select_pipeline(&mut self, gpu: &Gpu, scene: &Scene) {
        self.pipeline.select(gpu, [scene.has_coast]);
    }

    /// Records the pass for the frame of `scene`; nothing if the eye is at a fixed height that no wave reaches.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, scene: &Scene, water: &WaterPass) {
        let needs_waves = scene.height_from_waves || waves_may_reach_eye(scene);
        let (Some(maps), Some(pipeline)) = (water.maps_group().filter(|_| needs_waves), self.pipeline.selected())
        else {
            return;
        };
        let mut pass = begin_compute(encoder, "eye", timer.compute_pass("eye"));
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.dispatch_workgroups(1, 1, 1);
    }
}

/// Whether the eye is below 3 m + 1.5 Hs (significant wave height), so that a wave may reach it; one crest in 7 x 10^7
/// exceeds 1.5 Hs.
fn waves_may_reach_eye(scene: &Scene) -> bool {
    scene.view.eye.y < 3.0 + 1.5 * scene.sea.hs_m
}
