//! The compute pass that displaces the vertices of the water mesh once per frame (shaders/water/displace.wgsl). An
//! indexed draw reads a vertex several times; a software GPU would displace it each time.

use super::mesh::Mesh;
use crate::gpu::Gpu;
use crate::gpu::kit::{Slot, begin_compute};
use crate::gpu::layout::gpu_struct;
use crate::gpu::uniform::Uniform;
use crate::render::frame::FrameUniform;
use crate::shaders::Shaders;

gpu_struct! {
    /// WGSL `MeshVertex`: a displaced vertex of the water mesh.
    pub struct MeshVertex as "MeshVertex" {
        /// Displaced position relative to the eye, m, lowered by the curvature of the Earth.
        place: [f32; 3],
        /// Height of the wave above the still water, m.
        height: f32,
        /// Undisplaced position (x, z) relative to the point below the eye, m.
        rest: [f32; 2],
        /// Slope, stretch and shear of long waves, which are interpolated between vertices (WGSL `WaterDerivatives`).
        slope: [f32; 2],
        stretch: [f32; 2],
        shear: [f32; 2],
    }
}

/// Size of a vertex, bytes.
pub const VERTEX: u64 = size_of::<MeshVertex>() as u64;
/// Side of a workgroup, in columns and rows of the mesh; equal to `workgroup_size` in the shader.
const THREADS: u32 = 8;

/// The displaced water mesh: its compute pass, its buffers and its draw call.
pub struct DisplacePass {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    frame: wgpu::Buffer,
    /// Bind group layout for passes that draw the mesh: vertices at binding 0.
    drawn_layout: wgpu::BindGroupLayout,
    buffers: Option<Buffers>,
    columns: u32,
    count: u32,
}

/// Vertex and index buffers for all meshes of one density.
struct Buffers {
    rows: u32,
    most_columns: u32,
    indices: wgpu::Buffer,
    group: wgpu::BindGroup,
    drawn: wgpu::BindGroup,
}

impl DisplacePass {
    /// Compiles the pass. `maps` is the layout of the bind group with the wave maps.
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

    /// Layout of the bind group with the vertices, for passes that draw the mesh.
    pub fn drawn_layout(&self) -> &wgpu::BindGroupLayout {
        &self.drawn_layout
    }

    /// Sets the mesh for the next frames. Buffers are allocated again only if its density has changed.
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

    /// Number of vertices that the current view needs.
    pub fn vertices(&self) -> u32 {
        self.buffers.as_ref().map_or(0, |b| (self.columns + 1) * b.rows)
    }

    /// Records the displacement of all vertices that the current view needs.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, maps: &wgpu::BindGroup) {
        let Some(buffers) = &self.buffers else { return };
        let mut pass = begin_compute(encoder, "mesh");
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &buffers.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.dispatch_workgroups((self.columns + 1).div_ceil(THREADS), buffers.rows.div_ceil(THREADS), 1);
    }

    /// Draws the mesh with the pipeline that is set on `pass`. Binds the vertices as group 2.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(buffers) = &self.buffers else { return };
        pass.set_bind_group(2, &buffers.drawn, &[]);
        pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.count, 0, 0..1);
    }
}
