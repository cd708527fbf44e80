//! The compute pass that displaces the vertices of the water mesh once per frame (shaders/water/displace.wgsl). An
//! indexed draw reads a vertex several times; a software GPU would displace it each time.

use super::mesh::Mesh;
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, begin_compute};
use crate::gpu::layout::gpu_struct;
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::render::frame::FrameUniform;
use crate::render::variants::ComputeVariants;
use crate::shaders::Shaders;

gpu_struct! {
    /// WGSL `MeshVertex`: a displaced vertex of the water mesh.
    pub struct MeshVertex as "MeshVertex" {
        /// Displaced position (x east, y up, z south) relative to the eye, m, lowered by the curvature of the Earth.
        position: [f32; 3],
        /// Mean shear of the waves that are long compared with vertex spacing and pixels at this vertex, and the
        /// fraction of the sun's disc that waves leave visible (1 if they cast no shadows), as two half floats. Like
        /// `slope` and `stretch`, they are interpolated between vertices when the mesh is drawn (WGSL
        /// `WaterDerivatives`).
        shear_and_sun: u32,
        /// Undisplaced position (x, z) relative to the point below the eye, m.
        undisplaced: [f32; 2],
        /// Slope of the same waves along x and z, as two half floats.
        slope: u32,
        /// Stretch of the same waves along x and z, as two half floats.
        stretch: u32,
    }
}

/// Size of a [`MeshVertex`], bytes.
pub const MESH_VERTEX_BYTES: u64 = size_of::<MeshVertex>() as u64;
/// Bindings of the group of wave and foam maps: displacement, gradients, slope moments, foam, two samplers, and the gains
/// of a coast.
pub const WAVE_MAPS: [BindingType; 7] = [
    BindingType::TextureArray,
    BindingType::TextureArray,
    BindingType::TextureArray,
    BindingType::TextureArray,
    BindingType::Sampler,
    BindingType::Sampler,
    BindingType::Texture,
];
/// Side of a compute workgroup: it displaces 8 columns x 8 rows of vertices; equal to `workgroup_size` in the shader.
const WORKGROUP_SIDE: u32 = 8;

/// The displaced water mesh: compute pass that displaces its vertices by the waves, buffers, and draw call.
pub struct DisplacePass {
    /// Variants by whether the sea runs up to a coast, and whether waves shade each other.
    pipeline: ComputeVariants<2>,
    layout: wgpu::BindGroupLayout,
    frame: wgpu::Buffer,
    /// Bind group layout for passes that draw the mesh: vertices at binding 0.
    vertices_layout: wgpu::BindGroupLayout,
    buffers: Option<MeshBuffers>,
    columns: u32,
    index_count: u32,
}

/// Vertex and index buffers, with bind groups, for water meshes of one density; every view uses the same buffers.
struct MeshBuffers {
    rows: u32,
    index_buffer_columns: u32,
    indices: wgpu::Buffer,
    group: wgpu::BindGroup,
    draw_group: wgpu::BindGroup,
}

impl DisplacePass {
    /// Makes the pass; [`Self::select_pipeline`] compiles it. `maps` is the layout of the bind group with the wave
    /// maps.
    pub fn new(gpu: &Gpu, shaders: &Shaders, frame: &Uniform<FrameUniform>, maps: &wgpu::BindGroupLayout) -> Self {
        let bindings = [
            BindingType::Uniform(size_of::<FrameUniform>()),
            BindingType::StorageReadWrite(MESH_VERTEX_BYTES as usize),
        ];
        let layout = gpu.bind_group_layout("mesh", wgpu::ShaderStages::COMPUTE, &bindings);
        let module = shaders.module(gpu, "water/displace");
        let pipeline = ComputeVariants::new("mesh", module, &[&layout, maps], ["WATER_COAST", "WATER_SHADOWS"]);
        let vertex = wgpu::ShaderStages::VERTEX;
        let vertices_layout =
            gpu.bind_group_layout("mesh/drawn", vertex, &[BindingType::StorageRead(MESH_VERTEX_BYTES as usize)]);
        let frame = frame.buffer.clone();
        Self { pipeline, layout, frame, vertices_layout, buffers: None, columns: 0, index_count: 0 }
    }

    /// Layout of the bind group with the vertices, for passes that draw the mesh.
    pub fn vertices_layout(&self) -> &wgpu::BindGroupLayout {
        &self.vertices_layout
    }

    /// Sets the mesh for the next frames. Buffers are allocated again only if its density has changed.
    pub fn set_mesh(&mut self, gpu: &Gpu, mesh: &Mesh) {
        (self.columns, self.index_count) = (mesh.drawn_columns, mesh.index_count());
        let same = |b: &MeshBuffers| (b.rows, b.index_buffer_columns) == (mesh.lattice.rows, mesh.index_buffer_columns);
        if self.buffers.as_ref().is_some_and(same) {
            return;
        }
        let indices = mesh.indices();
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let index_buffer = gpu.buffer("mesh/indices", size_of_val(&indices[..]) as u64, usage);
        gpu.queue.write_buffer(&index_buffer, 0, bytemuck::cast_slice(&indices));
        let size = MESH_VERTEX_BYTES * u64::from(mesh.lattice.rows) * u64::from(mesh.index_buffer_columns + 1);
        let vertices = gpu.buffer("mesh/vertices", size, wgpu::BufferUsages::STORAGE);
        let resources = [self.frame.as_entire_binding(), vertices.as_entire_binding()];
        self.buffers = Some(MeshBuffers {
            rows: mesh.lattice.rows,
            index_buffer_columns: mesh.index_buffer_columns,
            group: gpu.bind_group("mesh", &self.layout, &resources),
            draw_group: gpu.bind_group("mesh/drawn", &self.vertices_layout, &[vertices.as_entire_binding()]),
            indices: index_buffer,
        });
    }

    /// Selects the pipeline for a sea that may run up to a coast, and whose waves may shade each other.
    pub fn select_pipeline(&mut self, gpu: &Gpu, has_coast: bool, has_shadows: bool) {
        self.pipeline.select(gpu, [has_coast, has_shadows]);
    }

    /// Number of mesh vertices that the current view displaces; 0 before a mesh is set.
    pub fn vertex_count(&self) -> u32 {
        self.buffers.as_ref().map_or(0, |b| (self.columns + 1) * b.rows)
    }

    /// Records the compute pass that displaces the vertices for the current view by the waves in `maps`.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, maps: &wgpu::BindGroup) {
        let (Some(buffers), Some(pipeline)) = (&self.buffers, self.pipeline.selected()) else { return };
        let mut pass = begin_compute(encoder, "mesh", timer.compute_pass("mesh"));
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &buffers.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.dispatch_workgroups((self.columns + 1).div_ceil(WORKGROUP_SIDE), buffers.rows.div_ceil(WORKGROUP_SIDE), 1);
    }

    /// Draws the displaced mesh with the pipeline that is set on `pass`. Binds the vertices as group 2.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(buffers) = &self.buffers else { return };
        pass.set_bind_group(2, &buffers.draw_group, &[]);
        pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::SHARED_STRUCTS;
    use crate::render::scene::SeaAppearance;
    use crate::render::water::mesh::mesh_density;
    use crate::state::camera::View;
    use crate::state::params::Camera;

    /// Buffers are made anew only where the density of the mesh takes a step: a turned camera and a picture that is a
    /// little smaller keep them.
    #[test]
    fn buffers_change_only_with_the_density() {
        let gpu = pollster::block_on(Gpu::request()).expect("a GPU adapter; install mesa-vulkan-drivers");
        let shaders = Shaders::default().with_structs(SHARED_STRUCTS);
        let maps = gpu.bind_group_layout("maps", wgpu::ShaderStages::COMPUTE, &WAVE_MAPS);
        let mut pass = DisplacePass::new(&gpu, &shaders, &Uniform::new(&gpu, "frame"), &maps);
        let mut buffer = |heading_deg: f64, pitch_deg: f64, width: f64| {
            let view = View::new(&Camera { heading_deg, pitch_deg, ..Camera::default() }, 16.0 / 9.0, 0.0);
            let density = mesh_density(width * width * 9.0 / 16.0);
            pass.set_mesh(&gpu, &Mesh::new(&view, &SeaAppearance::for_test(2.0), density, 0.0));
            pass.buffers.as_ref().map(|buffers| buffers.indices.clone())
        };
        let first = buffer(0.0, -5.0, 800.0);
        for (heading_deg, pitch_deg, width) in [(90.0, -5.0, 800.0), (0.0, -60.0, 800.0), (0.0, -5.0, 760.0)] {
            assert!(buffer(heading_deg, pitch_deg, width) == first, "{heading_deg} {pitch_deg} {width}");
        }
        assert!(buffer(0.0, -5.0, 640.0) != first, "a step of the density");
    }
}
