//! Floating buoys, boats and yachts, and the seamarks of a coast (shaders/water/hulls.wgsl): a few small shapes, whose
//! vertices the CPU transforms.

use super::hull_images::{DRIFT_PERIOD_M, yacht_speed_m_s};
use super::hull_shapes::{HullFacet, HullLine, boat_hull, buoy_hull, in_shade, shade_of_triangle};
use super::seamark_shapes::{is_lamp, seamark_facets, seamark_lines};
use super::yacht_foam::{FoamCorner, roughness, yacht_foam};
use super::yacht_shape::{sail_shades, yacht_hull, yacht_lines, yacht_mast};
use crate::coast::{PlacedCoast, Seamark};
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, DepthState, RenderProgram};
use crate::gpu::layout::gpu_struct;
use crate::point::floating::HullPose;
use crate::render::scene::Scene;
use crate::render::scene_group::SceneGroup;
use crate::render::targets::{BLEND_OVER, DEPTH_TEST_BACKGROUND, DEPTH_TEST_OPAQUE, OutputKind, attachments};
use crate::render::variants::{PipelineVariants, switch_constant};
use crate::shaders::Shaders;
use crate::state::floats::FloatingObjectKind;
use crate::state::look::CloudKind;
use glam::{DMat3, DVec3};

gpu_struct! {
    /// WGSL `HullVertex`: a corner of the triangles that draw a floating object or a seamark.
    pub struct HullVertex as "HullVertex" {
        /// Position x and z relative to the point below the eye, and height y above the still water, m.
        position: [f32; 3],
        /// Paint colour, as in `HullFacet`; `FOAM_COLOUR` for white water.
        colour: u32,
        /// Unit normal; for a line, the unit vector along it; for white water, `FoamCorner::pattern`.
        normal: [f32; 3],
        /// Place on a sail (`HullFacet::cloth`) and shade (`in_shade`); for a line, the bits of half its width, m,
        /// negative on one side.
        detail: u32,
    }
}

/// Colour that tells white water from ropes and wires.
const FOAM_COLOUR: u32 = 0xffe8_e8e8;
/// Fraction of the sunlight that a sail takes from what lies in its shadow.
const SAIL_SHADE: f64 = 0.8;

/// What a variant of the pipelines of hulls can draw.
#[derive(Clone, Copy, PartialEq)]
struct HullVariant {
    /// Whether the eye dives, so that it may see hulls through water.
    dives: bool,
    /// Whether volumetric clouds shade the hulls.
    cloud_shadows: bool,
}

/// The pass that draws floating objects and seamarks.
pub struct HullPass {
    module: wgpu::ShaderModule,
    /// Render pipelines of the hulls and of their ropes and wires; compiled when there is something to draw.
    pipelines: PipelineVariants<HullVariant>,
    line_pipelines: PipelineVariants<HullVariant>,
    layout: wgpu::BindGroupLayout,
    vertices: Option<(wgpu::Buffer, wgpu::BindGroup)>,
    /// Triangles of each kind of object, in the order of [`FloatingObjectKind::ALL`].
    hulls: [Vec<HullFacet>; FloatingObjectKind::ALL.len()],
    lines: Vec<HullLine>,
    /// Seamarks of the last coast that was drawn, with their triangles and lines.
    seamarks: Vec<(Seamark, Vec<HullFacet>, Vec<HullLine>)>,
    /// Sails that shade the yacht, and their colours.
    sail_shades: [([DVec3; 3], u32); 2],
    /// Triangles of the mast, for pictures without lines.
    mast: Vec<HullFacet>,
    /// Numbers of vertices of the hulls and of the lines, which follow them in the buffer.
    vertex_count: u32,
    line_vertex_count: u32,
}

impl HullPass {
    /// Builds the shader module and the hulls' triangles; the pipeline is compiled when there is something to draw.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        let layout = gpu.bind_group_layout(
            "hulls",
            wgpu::ShaderStages::VERTEX,
            &[BindingType::StorageRead(size_of::<HullVertex>())],
        );
        let hulls = FloatingObjectKind::ALL.map(|kind| match kind {
            FloatingObjectKind::Buoy => buoy_hull(),
            FloatingObjectKind::Boat => boat_hull(),
            FloatingObjectKind::Yacht => yacht_hull(),
        });
        Self {
            module: shaders.module(gpu, "water/hulls"),
            pipelines: PipelineVariants::default(),
            line_pipelines: PipelineVariants::default(),
            layout,
            vertices: None,
            hulls,
            lines: yacht_lines(),
            seamarks: Vec::new(),
            sail_shades: sail_shades(),
            mast: yacht_mast(),
            vertex_count: 0,
            line_vertex_count: 0,
        }
    }

    /// Uploads the triangles of the hulls and seamarks of a scene. Uploaded positions are relative to the point of the
    /// still water below the eye.
    pub fn upload_hulls(&mut self, gpu: &Gpu, group: &SceneGroup, scene: &Scene) {
        let poses = &scene.hulls;
        let (mut vertices, mut lines) = (Vec::new(), Vec::new());
        if let Some(coast) = &scene.land {
            let marks = coast.seamarks();
            if !self.seamarks.iter().map(|(mark, ..)| mark).eq(marks) {
                self.seamarks = marks.iter().map(|m| (*m, seamark_facets(m.kind), seamark_lines(m.kind))).collect();
            }
            for (mark, mark_facets, mark_lines) in &self.seamarks {
                let axes = HullAxes::of_seamark(mark, coast, scene);
                let lamp = [in_shade(0, mark.kind.lamp_level(scene.t_s)); 3];
                let lit =
                    |facet: &HullFacet| HullFacet { cloth: if is_lamp(facet) { lamp } else { facet.cloth }, ..*facet };
                vertices.extend(mark_facets.iter().flat_map(|facet| axes.facet_vertices(&lit(facet))));
                if group.output != OutputKind::Reference {
                    lines.extend(mark_lines.iter().flat_map(|line| axes.line_vertices(line)));
                }
            }
        }
        for pose in poses {
            let axes = HullAxes::new(pose, scene);
            let yacht = pose.kind == FloatingObjectKind::Yacht;
            let to_sun = axes.turn.transpose() * DVec3::from_array(scene.look.sky.sun_direction());
            let shade = |facet: &HullFacet| {
                let mut facet = *facet;
                for (cloth, corner) in facet.cloth.iter_mut().zip(facet.corners).filter(|_| yacht) {
                    let shade = |&(sail, colour)| {
                        if facet.colour == colour { 0.0 } else { shade_of_triangle(sail, corner, to_sun) }
                    };
                    *cloth = in_shade(*cloth, SAIL_SHADE * self.sail_shades.iter().map(shade).fold(0.0, f64::max));
                }
                facet
            };
            let hull = self.hulls[pose.kind as usize].iter().map(shade);
            vertices.extend(hull.flat_map(|facet| axes.facet_vertices(&facet)));
            // The samples of a reference picture cannot be blended, so it has the mast as a solid, and no ropes.
            if yacht && group.output == OutputKind::Reference {
                vertices.extend(self.mast.iter().flat_map(|facet| axes.facet_vertices(facet)));
            } else if yacht {
                lines.extend(foam_vertices(pose, scene));
                lines.extend(self.lines.iter().flat_map(|line| axes.line_vertices(line)));
            }
        }
        (self.vertex_count, self.line_vertex_count) = (vertices.len() as u32, lines.len() as u32);
        if vertices.is_empty() {
            return;
        }
        vertices.append(&mut lines);
        let bytes = size_of_val(vertices.as_slice()) as u64;
        if self.vertices.as_ref().is_none_or(|(buffer, _)| buffer.size() < bytes) {
            let buffer = gpu.storage_buffer("hulls", bytes.next_power_of_two());
            let group = gpu.bind_group("hulls", &self.layout, &[buffer.as_entire_binding()]);
            self.vertices = Some((buffer, group));
        }
        if let Some((buffer, _)) = &self.vertices {
            gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(&vertices));
        }
        self.select_pipelines(gpu, group, scene);
    }

    fn select_pipelines(&mut self, gpu: &Gpu, group: &SceneGroup, scene: &Scene) {
        let parts =
            HullVariant { dives: scene.dives(), cloud_shadows: scene.look.sky.drawn_clouds() != CloudKind::None };
        let make = |entry_points: [&'static str; 2], depth: DepthState, blend: Option<wgpu::BlendState>| {
            let (gpu, module, format) = (gpu.clone(), self.module.clone(), group.output.format());
            let layouts = [group.layout.clone(), self.layout.clone()];
            move || {
                let constants = [
                    switch_constant("HULL_DIVES", parts.dives),
                    switch_constant("SKY_CLOUD_SHADOWS", parts.cloud_shadows),
                ];
                let program = RenderProgram { entry_points, constants: &constants, ..RenderProgram::new(&module) };
                let onto = AttachmentFormats { blend, ..attachments(&format, depth) };
                gpu.render_pipeline("hulls", &program, &layouts.each_ref(), &onto)
            }
        };
        let hulls = make(["vertex", "fragment"], DEPTH_TEST_OPAQUE, None);
        let lines = make(["line_vertex", "line_fragment"], DEPTH_TEST_BACKGROUND, Some(BLEND_OVER));
        self.pipelines.select(parts, scene.may_keep_pipelines, hulls);
        if self.line_vertex_count > 0 {
            self.line_pipelines.select(parts, scene.may_keep_pipelines, lines);
        }
    }

    /// Whether the picture has floating objects or seamarks.
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
        if let Some(lines) = self.line_pipelines.selected().filter(|_| self.line_vertex_count > 0) {
            pass.set_pipeline(lines);
            pass.draw(self.vertex_count..self.vertex_count + self.line_vertex_count, 0..1);
        }
    }
}

/// The axes of a hull or a seamark in the picture.
struct HullAxes {
    /// Position relative to the point of the still water below the eye, m.
    origin: DVec3,
    turn: DMat3,
}

impl HullAxes {
    fn new(pose: &HullPose, scene: &Scene) -> Self {
        let [up, ahead] = [pose.up, pose.forward].map(DVec3::from_array);
        let below_eye = DVec3::new(scene.view.eye.x, scene.sea.still_water_level_m, scene.view.eye.z);
        Self {
            origin: DVec3::from_array(pose.position_m) - below_eye,
            turn: DMat3::from_cols(ahead.cross(up), up, -ahead),
        }
    }

    /// The axes of a seamark: -z points out to sea.
    fn of_seamark(mark: &Seamark, coast: &PlacedCoast, scene: &Scene) -> Self {
        let placement = coast.placement();
        let [x, z] = placement.world_m(mark.at_m);
        let (sin, cos) = placement.turn_rad.sin_cos();
        let inland = DVec3::new(cos, 0.0, sin);
        Self {
            origin: DVec3::new(x - scene.view.eye.x, mark.ground_m, z - scene.view.eye.z),
            turn: DMat3::from_cols(DVec3::Y.cross(inland), DVec3::Y, inland),
        }
    }

    /// The axes of a hull without its heel, so that x lies along the water.
    fn upright(pose: &HullPose, scene: &Scene) -> Self {
        let ahead = DVec3::from_array(pose.forward);
        let starboard = ahead.cross(DVec3::Y).normalize_or(DVec3::X) + DVec3::Y * pose.water_roll;
        Self::new(&HullPose { up: starboard.cross(ahead).normalize_or(DVec3::Y).to_array(), ..*pose }, scene)
    }

    fn vertex(&self, at: DVec3, direction: DVec3, [colour, detail]: [u32; 2]) -> HullVertex {
        HullVertex {
            position: (self.origin + self.turn * at).as_vec3().to_array(),
            colour,
            normal: (self.turn * direction).as_vec3().to_array(),
            detail,
        }
    }

    fn facet_vertices(&self, facet: &HullFacet) -> [HullVertex; 3] {
        [0, 1, 2].map(|i| self.vertex(facet.corners[i], facet.normals[i], [facet.colour, facet.cloth[i]]))
    }

    /// Two triangles of a line, which the vertex shader widens.
    fn line_vertices(&self, line: &HullLine) -> [HullVertex; 6] {
        let along = (line.ends[1] - line.ends[0]).normalize_or(DVec3::Y);
        [(0, -1.0), (1, -1.0), (1, 1.0), (0, -1.0), (1, 1.0), (0, 1.0)].map(|(end, side)| {
            let half_width = (side * line.half_width_m) as f32;
            self.vertex(line.ends[end], along, [line.colour, half_width.to_bits()])
        })
    }
}

/// Triangles of the white water around a yacht, whose pattern moves astern.
fn foam_vertices(pose: &HullPose, scene: &Scene) -> impl Iterator<Item = HullVertex> {
    let axes = HullAxes::upright(pose, scene);
    let starboard = DVec3::from_array(pose.forward).cross(DVec3::from_array(pose.up));
    let heel_rad = -starboard.dot(axes.turn.y_axis).asin();
    let sag_m = pose.water_sag_m;
    let speed_m_s = yacht_speed_m_s(scene.sea.wind_m_s);
    let drift_m = (speed_m_s * scene.t_s).rem_euclid(DRIFT_PERIOD_M);
    let foam = yacht_foam(speed_m_s, heel_rad, roughness(scene.sea.wind_m_s));
    foam.into_iter().map(move |FoamCorner { at, pattern: [along_m, up, white] }| {
        let at = at + DVec3::Y * (sag_m * (at.z / 5.0).powi(2).min(1.5));
        let pattern = [along_m - drift_m, up, white].map(|x| x as f32);
        HullVertex { normal: pattern, ..axes.vertex(at, DVec3::Y, [FOAM_COLOUR, 0]) }
    })
}
