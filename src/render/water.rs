//! shaders/water.wgsl: the mesh of the sea, displaced and lit.

use super::Scene;
use super::kit::{Program, SceneGroup, Slot, Variants, group, hdr_pipeline, layout, part};
use super::material;
use super::mesh::Mesh;
use super::targets::Film;
use crate::gpu::shaders::Shaders;
use crate::sim::Maps;

/// What a picture's water consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Parts {
    /// A bed can be seen.
    bed: bool,
    /// The waves focus light on it.
    caustics: bool,
    foam: bool,
    /// Samples of a reference, which are not filtered.
    samples: bool,
}

impl Parts {
    fn new(scene: &Scene, film: Film) -> Self {
        let surface = &scene.look.surface;
        let bed = material::bed_is_seen(scene);
        Self {
            bed,
            caustics: bed && surface.bed.caustics > 0.0,
            foam: surface.foam.shown > 0.0,
            samples: film == Film::reference(),
        }
    }

    fn pipeline(
        self,
        device: &wgpu::Device,
        module: &wgpu::ShaderModule,
        layouts: [&wgpu::BindGroupLayout; 2],
        film: Film,
    ) -> wgpu::RenderPipeline {
        let constants = [
            part("WATER_BED", self.bed),
            part("WATER_CAUSTICS", self.caustics),
            part("WATER_FOAM", self.foam),
            part("WATER_SAMPLES", self.samples),
        ];
        let program = Program { constants: &constants, ..Program::new(module) };
        hdr_pipeline(device, "water", &program, &layouts.map(Some), film, true)
    }
}

/// The water's pipelines, index buffer and maps.
pub struct WaterPass {
    /// Light, sky and frame.
    pub scene: SceneGroup,
    module: wgpu::ShaderModule,
    pipelines: Variants<Parts>,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    maps: Option<(u64, wgpu::BindGroup)>,
    indices: Option<Indices>,
    count: u32,
}

struct Indices {
    rows: u32,
    columns: u32,
    buffer: wgpu::Buffer,
}

impl WaterPass {
    /// Compiles the pass.
    pub fn new(device: &wgpu::Device, shaders: &Shaders, scene: SceneGroup) -> Self {
        let slots = [Slot::Array, Slot::Array, Slot::Array, Slot::Array, Slot::Sampler];
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
        let layout = layout(device, "maps", stages, &slots);
        let module = shaders.module(device, "water");
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("waves"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self { scene, module, pipelines: Variants::default(), layout, sampler, maps: None, indices: None, count: 0 }
    }

    /// Binds the maps, if they are new.
    pub fn bind_maps(&mut self, device: &wgpu::Device, maps: &Maps) {
        use wgpu::BindingResource::{Sampler, TextureView};
        if self.maps.as_ref().is_some_and(|(generation, _)| *generation == maps.generation) {
            return;
        }
        let resources = [
            TextureView(&maps.displacement),
            TextureView(&maps.gradients),
            TextureView(&maps.moments),
            TextureView(&maps.foam),
            Sampler(&self.sampler),
        ];
        self.maps = Some((maps.generation, group(device, "maps", &self.layout, &resources)));
    }

    /// Makes the pipeline that the picture of a scene needs, if there is none yet.
    pub fn choose(&mut self, device: &wgpu::Device, scene: &Scene) {
        let parts = Parts::new(scene, self.scene.film);
        let (module, layouts, film) = (&self.module, [&self.scene.layout, &self.layout], self.scene.film);
        self.pipelines.choose(parts, |parts| parts.pipeline(device, module, layouts, film));
    }

    /// Layout of the maps' bind group: displacement, gradients, moments, foam, sampler.
    pub fn maps_layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// The maps, once they are bound.
    pub fn maps_group(&self) -> Option<&wgpu::BindGroup> {
        self.maps.as_ref().map(|(_, group)| group)
    }

    /// Takes a mesh; the index buffer is made anew only when its density changed.
    pub fn set_mesh(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, mesh: &Mesh) {
        self.count = mesh.index_count();
        let same = |i: &Indices| (i.rows, i.columns) == (mesh.rows, mesh.most_columns);
        if self.indices.as_ref().is_some_and(same) {
            return;
        }
        let indices = mesh.indices();
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("mesh"),
            size: size_of_val(&indices[..]) as u64,
            usage: wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        queue.write_buffer(&buffer, 0, bytemuck::cast_slice(&indices));
        self.indices = Some(Indices { rows: mesh.rows, columns: mesh.most_columns, buffer });
    }

    /// Draws the sea.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(pipeline) = self.pipelines.chosen() else { return };
        pass.set_pipeline(pipeline);
        self.draw_mesh(pass);
    }

    /// Layouts of the bind groups that the mesh is drawn with.
    pub fn layouts(&self) -> [&wgpu::BindGroupLayout; 2] {
        [&self.scene.layout, &self.layout]
    }

    /// Draws the mesh with the pipeline of the pass.
    pub fn draw_mesh(&self, pass: &mut wgpu::RenderPass<'_>) {
        let (Some((_, maps)), Some(indices)) = (&self.maps, &self.indices) else { return };
        pass.set_bind_group(0, &self.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.set_index_buffer(indices.buffer.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.count, 0, 0..1);
    }
}
