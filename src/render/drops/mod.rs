//! Drops in the air: spray of breaking crests (shaders/drops/spray.wgsl) and rain (shaders/drops/rain.wgsl). Each is
//! one draw of small quads over the finished light. Drops follow from their numbers, the time and the maps of that time,
//! so a still depends on its state alone, and nothing is stored between frames.

pub mod rain;
pub mod spray;

use super::scene::Scene;
use super::targets::{BLEND_OVER, DEPTH_TEST_BACKGROUND, OutputKind, Targets, attachments};
use super::variants::switch_constant;
use super::water::light::WaterPass;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, RenderProgram};
use crate::gpu::uniform::Uniform;
use crate::shaders::Shaders;
use crate::state::camera::View;
use rain::RainUniform;
use spray::SprayUniform;

/// A square grid of `side` x `side` cells of `cell_m`, m, which are anchored to the world. Its middle lies before the eye
/// of `view`, at `ahead` sides of the grid. Returns the world index (x, z) of its first cell, and the corner of that cell
/// relative to the point below the eye, m.
fn grid_before_eye(view: &View, cell_m: f64, side: u32, ahead: f64) -> ([i32; 2], [f32; 2]) {
    let below_eye = [view.eye.x, view.eye.z];
    let heading = [view.right.z, -view.right.x];
    let side = f64::from(side);
    let first: [f64; 2] = std::array::from_fn(|i| (below_eye[i] / cell_m + (ahead * heading[i] - 0.5) * side).floor());
    (first.map(|c| c as i32), std::array::from_fn(|i| (first[i] * cell_m - below_eye[i]) as f32))
}

/// One draw of quads, one for each drop or cloud of drops.
struct DropPass<T> {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    uniform: Uniform<T>,
    /// Depth texture that the bind group holds, and the group.
    group: Option<(wgpu::TextureView, wgpu::BindGroup)>,
    /// Number of quads in the next frame.
    quads: u32,
    /// Whether the sea runs up to a coast.
    has_coast: bool,
}

impl<T: bytemuck::Pod> DropPass<T> {
    fn new(gpu: &Gpu, shaders: &Shaders, module: &str, water: &WaterPass, has_coast: bool) -> Self {
        let bindings = [BindingType::Uniform(size_of::<T>()), BindingType::DepthTexture];
        let layout = gpu.bind_group_layout(module, wgpu::ShaderStages::VERTEX_FRAGMENT, &bindings);
        let text = shaders.module(gpu, module);
        let format = water.scene.output.format();
        let onto = AttachmentFormats { blend: Some(BLEND_OVER), ..attachments(&format, DEPTH_TEST_BACKGROUND) };
        let layouts = [&water.scene.layout, water.maps_layout(), &layout];
        // Where there are no clouds, the air has the same light as without this part; one pipeline serves both.
        let constants = [switch_constant("WATER_COAST", has_coast), switch_constant("SKY_CLOUD_SHADOWS", true)];
        // A strip runs the vertex shader for four corners of a quad; two single triangles would take six.
        let topology = wgpu::PrimitiveTopology::TriangleStrip;
        let program = RenderProgram { constants: &constants, topology, ..RenderProgram::new(&text) };
        let pipeline = gpu.render_pipeline(module, &program, &layouts, &onto);
        Self { pipeline, layout, uniform: Uniform::new(gpu, module), group: None, quads: 0, has_coast }
    }

    fn set(&mut self, gpu: &Gpu, targets: &Targets, value: &T, quads: u32) {
        self.uniform.write(gpu, value);
        self.quads = quads;
        if self.group.as_ref().is_none_or(|(depth, _)| *depth != targets.depth) {
            let depth = wgpu::BindingResource::TextureView(&targets.depth);
            let group = gpu.bind_group("drops", &self.layout, &[self.uniform.buffer.as_entire_binding(), depth]);
            self.group = Some((targets.depth.clone(), group));
        }
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, water: &WaterPass) {
        let (Some((_, group)), Some(maps)) = (&self.group, water.maps_group()) else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &water.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.set_bind_group(2, group, &[]);
        pass.draw(0..4, 0..self.quads);
    }
}

/// The draws of spray and rain, each compiled for the first picture that needs it.
pub struct DropPasses {
    shaders: Shaders,
    spray: Option<DropPass<SprayUniform>>,
    rain: Option<DropPass<RainUniform>>,
}

impl DropPasses {
    /// Creates no resources yet.
    pub fn new(shaders: &Shaders) -> Self {
        Self { shaders: shaders.clone(), spray: None, rain: None }
    }

    /// Sets the drops of `scene` for the next frame. A reference picture has none, because its samples cannot be blended,
    /// and the picture of a diving eye has none, because drops would be drawn over the water in front of them.
    pub fn prepare(&mut self, gpu: &Gpu, water: &WaterPass, targets: &Targets, scene: &Scene) {
        let has_drops = water.scene.output != OutputKind::Reference && !scene.dives();
        self.spray.iter_mut().for_each(|pass| pass.quads = 0);
        self.rain.iter_mut().for_each(|pass| pass.quads = 0);
        self.spray.take_if(|pass| pass.has_coast != scene.has_coast);
        self.rain.take_if(|pass| pass.has_coast != scene.has_coast);
        if let Some(value) = SprayUniform::new(scene).filter(|_| has_drops) {
            let make = || DropPass::new(gpu, &self.shaders, "drops/spray", water, scene.has_coast);
            self.spray.get_or_insert_with(make).set(gpu, targets, &value, spray::QUADS);
        }
        if let Some(value) = RainUniform::new(scene).filter(|_| has_drops) {
            let make = || DropPass::new(gpu, &self.shaders, "drops/rain", water, scene.has_coast);
            self.rain.get_or_insert_with(make).set(gpu, targets, &value, value.quads());
        }
    }

    /// Whether the next frame has any drops.
    pub fn are_needed(&self) -> bool {
        self.spray.as_ref().is_some_and(|pass| pass.quads > 0) || self.rain.as_ref().is_some_and(|pass| pass.quads > 0)
    }

    /// Draws the drops in a pass that does not write depth.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, water: &WaterPass) {
        self.spray.iter().filter(|spray| spray.quads > 0).for_each(|spray| spray.draw(pass, water));
        self.rain.iter().filter(|rain| rain.quads > 0).for_each(|rain| rain.draw(pass, water));
    }
}
