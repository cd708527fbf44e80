//! The land of a coast: a mesh, stones and grass that are drawn into the G-buffer before the water, and a pass that lights
//! their pixels (shaders/land). The water reads its depth from the land's map.

mod cover;
pub mod map;
mod mesh;
mod relief;
mod stones;

use super::scene::Scene;
use super::targets::{DEPTH_TEST_BACKGROUND, DEPTH_TEST_OPAQUE, G_BUFFER_FORMATS, attachments};
use super::variants::{PipelineVariants, switch_constant};
use super::water::light::WaterPass;
use crate::coast::PlacedCoast;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, DepthState, RenderProgram};
use crate::gpu::uniform::Uniform;
use crate::shaders::Shaders;
use crate::state::look::{CloudKind, SkyLook};
use cover::{Cover, CoverPipelines};
use map::LandUniform;
use mesh::LandMesh;
use relief::Relief;
use std::sync::Arc;

pub use cover::CoverUniform;
pub use mesh::LandVertex;
pub use stones::LandStone;

/// Depth test of the light of the land: its triangle lies behind all land and before the sky.
const DEPTH_TEST_LIGHT: DepthState = DepthState { compare: wgpu::CompareFunction::LessEqual, ..DEPTH_TEST_BACKGROUND };
/// Elevation of the sun, degrees, below which its upper edge has set, and above which hardly any land shades other land.
const SHADING_SUN_DEG: std::ops::Range<f64> = -0.9..55.0;
/// Elevations of the sun at which land shades the water before it, degrees. A rubble mound is hardly steeper.
const WATER_SHADING_SUN_DEG: std::ops::Range<f64> = -0.9..32.0;

/// What a variant of the pipeline that lights the land can draw.
#[derive(Clone, Copy, PartialEq)]
struct LandVariant {
    sky_image: bool,
    fog: bool,
    cloud_shadows: bool,
    /// Whether the sun is so low that land shades land.
    shadows: bool,
}

/// Draws the land. Nothing is compiled or allocated on the GPU before a scene has some.
pub struct LandPass {
    shaders: Shaders,
    made: Option<Made>,
    /// The coast whose land is on the GPU; None if the scene has none.
    coast: Option<Arc<PlacedCoast>>,
    uniform: Uniform<LandUniform>,
    /// The map that shaders read: one texel of no meaning without land.
    map: wgpu::TextureView,
    /// What is drawn of the land; None without land.
    drawn: Option<Drawn>,
}

/// The triangles of the land, and what covers it, on the GPU.
struct Drawn {
    /// The vertices, and the stones and the grass of the cover.
    group: wgpu::BindGroup,
    indices: wgpu::Buffer,
    index_count: u32,
    cover: Cover,
}

struct Made {
    module: wgpu::ShaderModule,
    g_buffer_pipeline: wgpu::RenderPipeline,
    cover_pipelines: CoverPipelines,
    vertices_layout: wgpu::BindGroupLayout,
    light_pipelines: PipelineVariants<LandVariant>,
}

impl LandPass {
    /// Keeps the shaders until a scene has land.
    pub fn new(gpu: &Gpu, shaders: Shaders) -> Self {
        Self {
            shaders,
            made: None,
            coast: None,
            uniform: Uniform::new(gpu, "land"),
            map: map::no_land_map(gpu),
            drawn: None,
        }
    }

    /// The uniform buffer and the map of the land, for the bind group of the scene.
    pub fn resources(&self) -> (&Uniform<LandUniform>, &wgpu::TextureView) {
        (&self.uniform, &self.map)
    }

    /// Uploads the land of a scene if it differs from the last one's. Returns whether the map is another texture now.
    pub fn upload(&mut self, gpu: &Gpu, scene: &Scene) -> bool {
        let land = scene.land.as_ref();
        if let Some(land) = land {
            self.uniform.write(gpu, &LandUniform::new(land, scene));
        }
        let is_same = match (&self.coast, land) {
            (Some(old), Some(new)) => {
                Arc::ptr_eq(old, new) || (old.bathymetry == new.bathymetry && old.built_in == new.built_in)
            }
            (None, None) => true,
            _ => false,
        };
        self.coast = land.cloned();
        if is_same {
            return false;
        }
        self.map.texture().destroy();
        self.drawn = None;
        let Some(land) = land else {
            self.map = map::no_land_map(gpu);
            return true;
        };
        let relief = Relief::new(land);
        self.map = map::map_of(gpu, &relief);
        let mesh = LandMesh::new(&relief);
        let layout = vertices_layout(gpu);
        let vertices = gpu.storage_buffer("land", size_of_val(mesh.vertices.as_slice()).max(16) as u64);
        gpu.queue.write_buffer(&vertices, 0, bytemuck::cast_slice(&mesh.vertices));
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let indices = gpu.buffer("land", size_of_val(mesh.indices.as_slice()).max(4) as u64, usage);
        gpu.queue.write_buffer(&indices, 0, bytemuck::cast_slice(&mesh.indices));
        let cover = Cover::new(gpu, &relief);
        let resources = [&vertices, &cover.stones, &cover.corners, &cover.uniform.buffer];
        let group = gpu.bind_group("land", &layout, &resources.map(wgpu::Buffer::as_entire_binding));
        self.drawn = Some(Drawn { group, indices, index_count: mesh.indices.len() as u32, cover });
        true
    }

    /// Decides which stones and grass the frame of a scene draws, selects its pipelines, and compiles them at first use.
    pub fn select_pipelines(&mut self, gpu: &Gpu, scene: &Scene, water: &WaterPass) {
        let (Some(coast), Some(Drawn { cover, .. })) = (&self.coast, &mut self.drawn) else { return };
        let made = self.made.get_or_insert_with(|| {
            let module = self.shaders.module(gpu, "land/light");
            let vertices_layout = vertices_layout(gpu);
            let program =
                RenderProgram { entry_points: ["mesh_vertex", "mesh_fragment"], ..RenderProgram::new(&module) };
            let onto = AttachmentFormats { formats: &G_BUFFER_FORMATS, depth: Some(DEPTH_TEST_OPAQUE), blend: None };
            let g_buffer_pipeline =
                gpu.render_pipeline("land/mesh", &program, &[&water.scene.layout, &vertices_layout], &onto);
            let (cover_pipelines, light_pipelines) = (CoverPipelines::default(), PipelineVariants::default());
            Made { module, g_buffer_pipeline, cover_pipelines, vertices_layout, light_pipelines }
        });
        cover.prepare(gpu, scene, coast);
        made.cover_pipelines.compile(gpu, &made.module, &[&water.scene.layout, &made.vertices_layout], cover);
        let sky = &scene.look.sky;
        let parts = LandVariant {
            sky_image: sky.panorama().is_some(),
            fog: sky.has_fog(),
            cloud_shadows: sky.drawn_clouds() != CloudKind::None,
            shadows: SHADING_SUN_DEG.contains(&sky.sun_elevation_azimuth_deg()[0]),
        };
        let (gpu, module, format) = (gpu.clone(), made.module.clone(), water.scene.output.format());
        let layouts = [&water.scene.layout, water.maps_layout(), water.g_buffer_layout()].map(Clone::clone);
        made.light_pipelines.select(parts, scene.may_keep_pipelines, move || {
            let constants = [
                switch_constant("SKY_IMAGE", parts.sky_image),
                switch_constant("SKY_FOG", parts.fog),
                switch_constant("SKY_CLOUD_SHADOWS", parts.cloud_shadows),
                switch_constant("LAND_SHADOWS", parts.shadows),
            ];
            let program = RenderProgram {
                entry_points: ["light_vertex", "light_fragment"],
                constants: &constants,
                ..RenderProgram::new(&module)
            };
            gpu.render_pipeline("land/light", &program, &layouts.each_ref(), &attachments(&format, DEPTH_TEST_LIGHT))
        });
    }

    /// Whether the sun of `sky` is so low that land shades the water before it.
    pub fn shades_water(sky: &SkyLook) -> bool {
        WATER_SHADING_SUN_DEG.contains(&sky.sun_elevation_azimuth_deg()[0])
    }

    /// Draws the land, and what covers it, into the G-buffer; its pixels have the undisplaced position of no water.
    pub fn draw_g_buffer(&self, pass: &mut wgpu::RenderPass<'_>, water: &WaterPass) {
        let (Some(made), Some(drawn)) = (&self.made, &self.drawn) else { return };
        pass.set_pipeline(&made.g_buffer_pipeline);
        pass.set_bind_group(0, &water.scene.group, &[]);
        pass.set_bind_group(1, &drawn.group, &[]);
        pass.set_index_buffer(drawn.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..drawn.index_count, 0, 0..1);
        drawn.cover.draw(pass, &made.cover_pipelines);
    }

    /// Draws the light of all pixels that show land.
    pub fn draw_light(&self, pass: &mut wgpu::RenderPass<'_>, water: &WaterPass) {
        let Some(made) = self.made.as_ref().filter(|_| self.drawn.is_some()) else { return };
        let Some(pipeline) = made.light_pipelines.selected() else { return };
        if water.bind_light_groups(pass) {
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }
}

fn vertices_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let [stones, corners, cover] = Cover::bindings();
    let bindings = [BindingType::StorageRead(size_of::<LandVertex>()), stones, corners, cover];
    gpu.bind_group_layout("land", wgpu::ShaderStages::VERTEX, &bindings)
}
