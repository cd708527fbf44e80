//! shaders/water/displace.wgsl: the vertices of the water's mesh, displaced once a frame by compute for all passes that draw it. Drawn
//! by index, a vertex is read several times; a software GPU would displace it as often.

use super::mesh::Mesh;
use crate::gpu::Gpu;
use crate::gpu::kit::{Slot, begin_compute};
use crate::gpu::layout::gpu_struct;
use crate::gpu::uniform::Uniform;
use crate::render::frame::FrameUniform;
use crate::shaders::Shaders;

gpu_struct! {
    /// A vertex of the water's mesh (WGSL `MeshVertex`).
    pub struct MeshVertex as "MeshVertex" {
        /// Place of the displaced point relative to the eye, m.
        place: [f32; 3],
        /// Height of the wave over the still sea, m.
        height: f32,
        /// Undisplaced point (x, z) beside the eye's foot, m.
        rest: [f32; 2],
        /// What the vertex carries of WGSL `WaterSums`.
        slope: [f32; 2],
        stretch: [f32; 2],
        shear: [f32; 2],
    }
}

/// Bytes of a vertex.
pub const VERTEX: u64 = size_of::<MeshVertex>() as u64;
/// Columns and rows of a workgroup, as the shader has them.
const THREADS: u32 = 8;

/// The displaced mesh.
pub struct DisplacePass {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    frame: wgpu::Buffer,
    /// Of the passes that draw: the vertices at binding 0.
    drawn_layout: wgpu::BindGroupLayout,
    buffers: Option<Buffers>,
    columns: u32,
    count: u32,
}

/// Buffers for all meshes of one density.
struct Buffers {
    rows: u32,
    most_columns: u32,
    indices: wgpu::Buffer,
    group: wgpu::BindGroup,
    drawn: wgpu::BindGroup,
}

impl DisplacePass {
    /// Compiles the pass; `maps` is the layout of the maps' bind group.
    pub fn new(gpu: &Gpu, shaders: &Shaders, frame: &Uniform<FrameUniform>, maps: &wgpu::BindGroupLayout) -> Self {
        let slots = [Slot::Uniform(size_of::<FrameUniform>()), Slot::Write(VERTEX as usize)];
        let layout = gpu.layout("mesh", wgpu::ShaderStages::COMPUTE, &slots);
        let module = shaders.module(gpu, "water/displace");
        let pipeline = gpu.compute("mesh", (&module, "main"), &[&layout, maps], &[]);
        let vertex = wgpu::ShaderStages::VERTEX;
        let drawn_layout = gpu.layout("mesh/drawn", vertex, &[Slot::Read(VERTEX as usize)]);
        let frame = frame.buffer.clone();
        Self { pipeline, layout, frame, drawn_layout, buffers: None, columns: 0, count: 0 }
    }

    /// Layout of the bind group that a pass needs to draw the mesh.
    pub fn drawn_layout(&self) -> &wgpu::BindGroupLayout {
        &self.drawn_layout
    }

    /// Takes a mesh; buffers are made anew only when its density changed.
    pub fn set(&mut self, gpu: &Gpu, mesh: &Mesh) {
        (self.columns, self.count) = (mesh.columns, mesh.index_count());
        let same = |b: &Buffers| (b.rows, b.most_columns) == (mesh.lattice.rows, mesh.most_columns);
        if self.buffers.as_ref().is_some_and(same) {
            return;
        }
        let indices = mesh.indices();
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let index_buffer = gpu.buffer("mesh/indices", size_of_val(&indices[..]) as u64, usage);
        gpu.queue.write_buffer(&index_buffer, 0, bytemuck::cast_slice(&indices));
        let size = VERTEX * u64::from(mesh.lattice.rows) * u64::from(mesh.most_columns + 1);
        let vertices = gpu.buffer("mesh/vertices", size, wgpu::BufferUsages::STORAGE);
        let resources = [self.frame.as_entire_binding(), vertices.as_entire_binding()];
        self.buffers = Some(Buffers {
            rows: mesh.lattice.rows,
            most_columns: mesh.most_columns,
            group: gpu.group("mesh", &self.layout, &resources),
            drawn: gpu.group("mesh/drawn", &self.drawn_layout, &[vertices.as_entire_binding()]),
            indices: index_buffer,
        });
    }

    /// Vertices that the view needs.
    pub fn vertices(&self) -> u32 {
        self.buffers.as_ref().map_or(0, |b| (self.columns + 1) * b.rows)
    }

    /// Records the displacement of the vertices that the view needs.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, maps: &wgpu::BindGroup) {
        let Some(buffers) = &self.buffers else { return };
        let mut pass = begin_compute(encoder, "mesh");
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &buffers.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.dispatch_workgroups((self.columns + 1).div_ceil(THREADS), buffers.rows.div_ceil(THREADS), 1);
    }

    /// Draws the mesh with the pipeline of the pass; its vertices stand in group 2.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(buffers) = &self.buffers else { return };
        pass.set_bind_group(2, &buffers.drawn, &[]);
        pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.count, 0, 0..1);
    }
}
