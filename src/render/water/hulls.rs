//! Floating buoys, boats and yachts (shaders/water/hulls.wgsl): a few small hulls, whose vertices the CPU transforms.

use super::hull_shapes::{HullFacet, boat_hull, buoy_hull};
use super::yacht_shape::yacht_hull;
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, RenderProgram};
use crate::gpu::layout::gpu_struct;
use crate::render::scene::Scene;
use crate::render::scene_group::SceneGroup;
use crate::render::targets::{DEPTH_TEST_OPAQUE, attachments};
use crate::render::variants::{PipelineVariants, switch_constant};
use crate::shaders::Shaders;
use crate::state::floats::{FloatingObjectKind, MAX_FLOATING_OBJECTS};
use glam::{DMat3, DVec3};

gpu_struct! {
    /// WGSL `HullVertex`: a corner of the triangles that draw a floating object.
    pub struct HullVertex as "HullVertex" {
        /// Position x and z relative to the point below the eye, and height y above the still water, m.
        position: [f32; 3],
        /// Paint colour, as in `HullFacet`.
        colour: u32,
        normal: [f32; 3],
        unused: u32,
    }
}

/// The pass that draws floating objects.
pub struct HullPass {
    module: wgpu::ShaderModule,
    /// Render pipelines, for an eye above the water and for one that dives; compiled when something floats.
    pipelines: PipelineVariants<bool>,
    layout: wgpu::BindGroupLayout,
    vertices: Option<(wgpu::Buffer, wgpu::BindGroup)>,
    /// Triangles of each kind of object, in the order of [`FloatingObjectKind::ALL`].
    hulls: [Vec<HullFacet>; FloatingObjectKind::ALL.len()],
    vertex_count: u32,
}

impl HullPass {
    /// Builds the shader module and the hulls' triangles; the pipeline is compiled when the first object floats.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        let layout = gpu.bind_group_layout(
            "hulls",
            wgpu::ShaderStages::VERTEX,
            &[BindingType::StorageRead(size_of::<HullVertex>())],
        );
        let module = shaders.module(gpu, "water/hulls");
        let hulls = FloatingObjectKind::ALL.map(|kind| match kind {
            FloatingObjectKind::Buoy => buoy_hull(),
            FloatingObjectKind::Boat => boat_hull(),
            FloatingObjectKind::Yacht => yacht_hull(),
        });
        Self { module, pipelines: PipelineVariants::default(), layout, vertices: None, hulls, vertex_count: 0 }
    }

    /// Uploads the triangles of the hulls of a scene. Uploaded positions are relative to the point of the still water
    /// below the eye.
    pub fn upload_hulls(&mut self, gpu: &Gpu, group: &SceneGroup, scene: &Scene) {
        let poses = &scene.hulls;
        self.vertex_count = 0;
        if poses.is_empty() {
            return;
        }
        let level_m = scene.sea.still_water_level_m;
        let below_eye = [scene.view.eye.x, scene.view.eye.z];
        let mut vertices = Vec::new();
        for pose in poses {
            let [up, ahead] = [pose.up, pose.forward].map(DVec3::from_array);
            let turn = DMat3::from_cols(ahead.cross(up), up, -ahead);
            let origin = DVec3::new(
                pose.position_m[0] - below_eye[0],
                pose.position_m[1] - level_m,
                pose.position_m[2] - below_eye[1],
            );
            let hull = &self.hulls[pose.kind as usize];
            vertices.extend(hull.iter().flat_map(|facet| (0..3).map(move |i| (facet, i))).map(|(facet, i)| {
                HullVertex {
                    position: (origin + turn * facet.corners[i]).as_vec3().to_array(),
                    colour: facet.colour,
                    normal: (turn * facet.normals[i]).as_vec3().to_array(),
                    unused: 0,
                }
            }));
        }
        let most = MAX_FLOATING_OBJECTS * self.hulls.iter().map(|h| 3 * h.len()).max().unwrap_or(0);
        let (buffer, _) = self.vertices.get_or_insert_with(|| {
            let bytes = (most * size_of::<HullVertex>()) as u64;
            let buffer = gpu.storage_buffer("hulls", bytes);
            let group = gpu.bind_group("hulls", &self.layout, &[buffer.as_entire_binding()]);
            (buffer, group)
        });
        let vertices = &vertices[..vertices.len().min(most)];
        gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(vertices));
        self.vertex_count = vertices.len() as u32;
        let (gpu, module, format) = (gpu.clone(), self.module.clone(), group.output.format());
        let (dives, layouts) = (scene.dives(), [group.layout.clone(), self.layout.clone()]);
        self.pipelines.select(dives, scene.may_keep_pipelines, move || {
            let constants = [switch_constant("HULL_DIVES", dives)];
            let program = RenderProgram { constants: &constants, ..RenderProgram::new(&module) };
            gpu.render_pipeline("hulls", &program, &layouts.each_ref(), &attachments(&format, DEPTH_TEST_OPAQUE))
        });
    }

    /// Whether anything floats in the picture, so that hulls must be drawn.
    pub fn is_needed(&self) -> bool {
        self.vertex_count > 0
    }

    /// Draws the uploaded hulls in a pass that writes depth, after the pass that lights the water, which only reads it.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneGroup) {
        let (Some((_, group)), Some(pipeline)) = (&self.vertices, self.pipelines.selected()) else { return };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &scene.group, &[]);
        pass.set_bind_group(1, group, &[]);
        pass.draw(0..self.vertex_count, 0..1);
    }
}
