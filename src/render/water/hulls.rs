//! Floating buoys and boats (shaders/water/hulls.wgsl): a few small hulls, whose vertices the CPU transforms.

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
use std::f64::consts::TAU;

gpu_struct! {
    /// WGSL `HullVertex`: a corner of the triangles that draw a floating buoy or boat.
    pub struct HullVertex as "HullVertex" {
        /// Position x and z relative to the point below the eye, and height y above the still water, m.
        position: [f32; 3],
        /// Paint colour: sRGB, 8 bits per channel, red in the lowest byte.
        colour: u32,
        normal: [f32; 3],
        unused: u32,
    }
}

/// A triangle of a buoy's or boat's hull: corners, m, unit normals at the corners, and paint colour. Axes of the hull:
/// x to starboard, y up the mast, z to the stern.
#[derive(Clone, Copy)]
struct HullFacet {
    corners: [DVec3; 3],
    normals: [DVec3; 3],
    colour: u32,
}

/// Colour of yellow paint: like those of the other paints, sRGB as 0x00BBGGRR.
const YELLOW: u32 = 0x0014_b0e8;
const DARK_GREY: u32 = 0x0028_2828;
const WHITE: u32 = 0x00e8_ecec;
const RED: u32 = 0x0020_2ab0;
const WOOD: u32 = 0x0048_6a90;
const BLUE: u32 = 0x0070_4020;

/// The pass that draws floating buoys and boats.
pub struct HullPass {
    module: wgpu::ShaderModule,
    /// Render pipelines, for an eye above the water and for one that dives; compiled when something floats.
    pipelines: PipelineVariants<bool>,
    layout: wgpu::BindGroupLayout,
    vertices: Option<(wgpu::Buffer, wgpu::BindGroup)>,
    hulls: [Vec<HullFacet>; 2],
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
        Self {
            module,
            pipelines: PipelineVariants::default(),
            layout,
            vertices: None,
            hulls: [buoy_hull(), boat_hull()],
            vertex_count: 0,
        }
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
            let hull = &self.hulls[usize::from(pose.kind == FloatingObjectKind::Boat)];
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

/// Triangles of a surface of revolution around the y axis of a hull. `profile` has a ring of corners an entry, from
/// bottom to top: its radius (m), its height (m), and the paint of the band above it (0xBBGGRR).
fn surface_of_revolution(profile: &[(f64, f64, u32)]) -> Vec<HullFacet> {
    const LATHE_SIDES: usize = 20;
    let mut facets = Vec::new();
    for pair in profile.windows(2) {
        let ((r0, y0, colour), (r1, y1, _)) = (pair[0], pair[1]);
        let slope = DVec3::new(y1 - y0, r0 - r1, 0.0).normalize_or(DVec3::Y);
        let at = |r: f64, y: f64, i: usize| {
            let (sin, cos) = (TAU * i as f64 / LATHE_SIDES as f64).sin_cos();
            (DVec3::new(r * cos, y, r * sin), DVec3::new(slope.x * cos, slope.y, slope.x * sin))
        };
        for i in 0..LATHE_SIDES {
            let [a, b, c, d] = [at(r0, y0, i), at(r0, y0, i + 1), at(r1, y1, i + 1), at(r1, y1, i)];
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                facets.push(HullFacet { corners: [p.0, q.0, r.0], normals: [p.1, q.1, r.1], colour });
            }
        }
    }
    facets
}

/// Triangles of a moored buoy: float, tower and lantern.
fn buoy_hull() -> Vec<HullFacet> {
    surface_of_revolution(&[
        (0.0, -0.6, DARK_GREY),
        (0.7, -0.45, DARK_GREY),
        (0.95, 0.0, YELLOW),
        (0.95, 0.42, YELLOW),
        (0.8, 0.55, YELLOW),
        (0.0, 0.6, YELLOW),
        (0.34, 0.6, YELLOW),
        (0.16, 1.5, RED),
        (0.13, 1.75, YELLOW),
        (0.1, 2.2, YELLOW),
        (0.2, 2.22, DARK_GREY),
        (0.2, 2.3, WHITE),
        (0.19, 2.55, WHITE),
        (0.1, 2.7, DARK_GREY),
        (0.0, 2.74, DARK_GREY),
    ])
}

/// Triangles of an open boat with benches: cross-sections from bow to stern, each from keel to gunwale, are joined.
fn boat_hull() -> Vec<HullFacet> {
    // Cross-sections: distance from the bow, half-width at the gunwale, height of the gunwale, height of the keel, m.
    const CROSS_SECTIONS: [[f64; 4]; 7] = [
        [0.0, 0.02, 1.05, -0.05],
        [0.7, 0.42, 0.92, -0.28],
        [1.8, 0.82, 0.78, -0.36],
        [3.2, 1.02, 0.66, -0.4],
        [4.8, 1.0, 0.6, -0.38],
        [6.2, 0.86, 0.6, -0.32],
        [7.0, 0.72, 0.64, -0.24],
    ];
    let point = |s: [f64; 4], side: f64, row: usize| {
        let [along, half, rail, keel] = s;
        let z = along - 3.4;
        match row {
            0 => DVec3::new(0.0, keel, z),
            1 => DVec3::new(side * 0.72 * half, 0.12 + 0.35 * keel, z),
            2 => DVec3::new(side * 0.95 * half, 0.45 * rail + 0.1, z),
            3 => DVec3::new(side * half, rail, z),
            // Inside: the inner edge of the gunwale, one plank thickness in, and the edge of the floor.
            4 => DVec3::new(side * (half - 0.06).max(0.0), rail, z),
            _ => DVec3::new(side * (0.62 * half - 0.05).max(0.0), 0.12, z),
        }
    };
    let colours = [BLUE, WHITE, WHITE, WOOD, WOOD];
    let mut facets = Vec::new();
    let mut quad = |[a, b, c, d]: [DVec3; 4], colour: u32| {
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            let normal = (q - p).cross(r - p);
            if normal.length_squared() > 1e-12 {
                facets.push(HullFacet { corners: [p, q, r], normals: [normal.normalize(); 3], colour });
            }
        }
    };
    for pair in CROSS_SECTIONS.windows(2) {
        for side in [-1.0, 1.0] {
            for (row, colour) in colours.into_iter().enumerate() {
                let corners = [
                    point(pair[0], side, row),
                    point(pair[1], side, row),
                    point(pair[1], side, row + 1),
                    point(pair[0], side, row + 1),
                ];
                let [a, b, c, d] = corners;
                quad(if side > 0.0 { [a, d, c, b] } else { [a, b, c, d] }, colour);
            }
        }
        // The floor.
        let [a, b] = [pair[0], pair[1]].map(|s| point(s, -1.0, 5));
        let [c, d] = [pair[1], pair[0]].map(|s| point(s, 1.0, 5));
        quad([a, b, c, d], WOOD);
    }
    let stern = CROSS_SECTIONS[6];
    for row in 0..3 {
        let [a, b] = [point(stern, -1.0, row), point(stern, -1.0, row + 1)];
        let [c, d] = [point(stern, 1.0, row + 1), point(stern, 1.0, row)];
        quad([a, d, c, b], WHITE);
    }
    for along in [2.2, 3.8, 5.4] {
        let half = 0.86;
        let [z0, z1] = [along - 3.4 - 0.14, along - 3.4 + 0.14];
        quad(
            [
                DVec3::new(-half, 0.5, z0),
                DVec3::new(-half, 0.5, z1),
                DVec3::new(half, 0.5, z1),
                DVec3::new(half, 0.5, z0),
            ],
            WOOD,
        );
    }
    facets
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_face_outwards() {
        for hull in [buoy_hull(), boat_hull()] {
            let [mut out, mut inward] = [0, 0];
            for facet in &hull {
                // The bottom and the sides look away from the middle of the hull.
                let middle = (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
                if middle.y < 0.0 && facet.normals[0].z.abs() < 0.9 {
                    if facet.normals[0].dot(middle - DVec3::new(0.0, 0.3, middle.z)) > 0.0 {
                        out += 1;
                    } else {
                        inward += 1;
                    }
                }
            }
            assert!(out > 10 && inward == 0, "{out} {inward}");
        }
    }
}
