//! The sea: shaders/water/forward.wgsl lights it while its mesh is drawn, shaders/water/light.wgsl once a pixel after the
//! mesh was drawn.

use super::displace::DisplacePass;
use super::material;
use crate::gpu::Gpu;
use crate::gpu::kit::{Attachments, Depth, Program, Slot};
use crate::gpu::uniform::Uniform;
use crate::render::Scene;
use crate::render::frame::FrameUniform;
use crate::render::kit::{SceneGroup, Variants, part};
use crate::render::targets::{BEHIND, Film, NEAREST, SHOWN_FORMATS, Targets, attachments};
use crate::shaders::Shaders;
use crate::sim::Maps;
use crate::state::look::{Fresnel, Specular};

/// What a picture's water consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Parts {
    /// A bed can be seen.
    bed: bool,
    /// The waves focus light on it.
    caustics: bool,
    foam: bool,
    /// Blinn and Phong's lobe, or Trowbridge and Reitz's, in place of the Gaussian.
    phong: bool,
    ggx: bool,
    /// Schlick's reflectance in place of the exact one.
    schlick: bool,
    /// The sky is a file's.
    file: bool,
    fog: bool,
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
            foam: surface.foam.amount > 0.0,
            phong: surface.reflection.specular == Specular::BlinnPhong,
            ggx: surface.reflection.specular == Specular::Ggx,
            schlick: surface.reflection.fresnel == Fresnel::Schlick,
            file: scene.look.sky.panorama().is_some(),
            fog: scene.look.sky.fog_extinction_per_km > 0.0,
            samples: film == Film::Reference,
        }
    }

    fn constants(self) -> [(&'static str, f64); 9] {
        [
            part("WATER_BED", self.bed),
            part("WATER_CAUSTICS", self.caustics),
            part("WATER_FOAM", self.foam),
            part("WATER_PHONG", self.phong),
            part("WATER_GGX", self.ggx),
            part("WATER_SCHLICK", self.schlick),
            part("SKY_FILE", self.file),
            part("SKY_FOG", self.fog),
            part("WATER_SAMPLES", self.samples),
        ]
    }
}

/// The water's pipelines, mesh and maps.
pub struct WaterPass {
    /// Light, sky and frame.
    pub scene: SceneGroup,
    /// Its mesh.
    pub mesh: DisplacePass,
    module: wgpu::ShaderModule,
    pipelines: Variants<Parts>,
    deferred: Option<Deferred>,
    layout: wgpu::BindGroupLayout,
    /// Between levels of the maps, and of the nearest one.
    samplers: [wgpu::Sampler; 2],
    maps: Option<(u64, wgpu::BindGroup)>,
}

/// What lights the sea after its mesh was drawn.
struct Deferred {
    mesh: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    shown: Option<([wgpu::TextureView; 2], wgpu::BindGroup)>,
}

impl Deferred {
    fn new(gpu: &Gpu, module: &wgpu::ShaderModule, layouts: [&wgpu::BindGroupLayout; 3]) -> Self {
        let onto = Attachments { formats: &SHOWN_FORMATS, depth: Some(NEAREST) };
        let program = Program { entries: ["mesh_vertex", "mesh_fragment"], ..Program::new(module) };
        let mesh = gpu.render("water/mesh", &program, &layouts, &onto);
        let layout = gpu.layout("shown", wgpu::ShaderStages::FRAGMENT, &[Slot::TextureUint; 2]);
        Self { mesh, layout, shown: None }
    }

    /// Binds what the mesh shows in these targets, if it is not bound yet.
    fn bind(&mut self, gpu: &Gpu, targets: &Targets) {
        let Some(shown) = &targets.shown else { return };
        if self.shown.as_ref().is_some_and(|(bound, _)| bound == shown) {
            return;
        }
        let resources = shown.each_ref().map(wgpu::BindingResource::TextureView);
        self.shown = Some((shown.clone(), gpu.group("shown", &self.layout, &resources)));
    }
}

impl WaterPass {
    /// Compiles the pass.
    pub fn new(gpu: &Gpu, shaders: &Shaders, scene: SceneGroup, frame: &Uniform<FrameUniform>) -> Self {
        let slots = [
            Slot::TextureArray,
            Slot::TextureArray,
            Slot::TextureArray,
            Slot::TextureArray,
            Slot::Sampler,
            Slot::Sampler,
        ];
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
        let layout = gpu.layout("maps", stages, &slots);
        let deferred = scene.film.is_deferred();
        let module = shaders.module(gpu, if deferred { "water_deferred" } else { "water_forward" });
        let samplers = [wgpu::MipmapFilterMode::Linear, wgpu::MipmapFilterMode::Nearest]
            .map(|mipmap_filter| gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], mipmap_filter));
        let mesh = DisplacePass::new(gpu, shaders, frame, &layout);
        let deferred = deferred.then(|| Deferred::new(gpu, &module, [&scene.layout, &layout, mesh.drawn_layout()]));
        Self { scene, mesh, module, pipelines: Variants::default(), deferred, layout, samplers, maps: None }
    }

    /// Binds the maps, if they are new.
    pub fn bind_maps(&mut self, gpu: &Gpu, maps: &Maps) {
        use wgpu::BindingResource::{Sampler, TextureView};
        if self.maps.as_ref().is_some_and(|(generation, _)| *generation == maps.generation) {
            return;
        }
        let resources = [
            TextureView(&maps.displacement),
            TextureView(&maps.gradients),
            TextureView(&maps.moments),
            TextureView(&maps.foam),
            Sampler(&self.samplers[0]),
            Sampler(&self.samplers[1]),
        ];
        self.maps = Some((maps.generation, gpu.group("maps", &self.layout, &resources)));
    }

    /// Binds what the mesh shows in these targets, if the sea is lit afterwards.
    pub fn bind_targets(&mut self, gpu: &Gpu, targets: &Targets) {
        if let Some(deferred) = &mut self.deferred {
            deferred.bind(gpu, targets);
        }
    }

    /// Makes the pipeline that the picture of a scene needs, if there is none yet.
    pub fn choose(&mut self, gpu: &Gpu, scene: &Scene) {
        let parts = Parts::new(scene, self.scene.film);
        let (module, format) = (&self.module, self.scene.film.format());
        let shown = self.deferred.as_ref().map(|d| &d.layout);
        let layouts = [&self.scene.layout, &self.layout, shown.unwrap_or(self.mesh.drawn_layout())];
        let entries = if shown.is_some() { ["light_vertex", "light_fragment"] } else { ["vertex", "fragment"] };
        self.pipelines.choose(parts, |parts| {
            let constants = parts.constants();
            let program = Program { module, entries, constants: &constants };
            // What is lit afterwards stands behind what is drawn, before the sky.
            let onto = match shown {
                Some(_) => attachments(&format, Depth { compare: wgpu::CompareFunction::LessEqual, ..BEHIND }),
                None => attachments(&format, NEAREST),
            };
            gpu.render("water", &program, &layouts, &onto)
        });
    }

    /// Layout of the maps' bind group: displacement, gradients, moments, foam, samplers.
    pub fn maps_layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// The maps, once they are bound.
    pub fn maps_group(&self) -> Option<&wgpu::BindGroup> {
        self.maps.as_ref().map(|(_, group)| group)
    }

    /// Records the displacement of the mesh and, if the sea is lit afterwards, what it shows: whether it did.
    pub fn prepare(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) -> bool {
        let Some(maps) = self.maps_group() else { return false };
        self.mesh.run(encoder, maps);
        let Some(deferred) = &self.deferred else { return false };
        let Some(mut pass) = targets.begin_mesh(encoder) else { return false };
        pass.set_pipeline(&deferred.mesh);
        self.draw_mesh(&mut pass);
        true
    }

    /// Draws the sea that [`Self::prepare`] prepared.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(pipeline) = self.pipelines.chosen() else { return };
        pass.set_pipeline(pipeline);
        let Some(deferred) = &self.deferred else { return self.draw_mesh(pass) };
        let (Some(maps), Some((_, shown))) = (self.maps_group(), &deferred.shown) else { return };
        pass.set_bind_group(0, &self.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.set_bind_group(2, shown, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Layouts of the bind groups that the mesh is drawn with.
    pub fn layouts(&self) -> [&wgpu::BindGroupLayout; 3] {
        [&self.scene.layout, &self.layout, self.mesh.drawn_layout()]
    }

    /// Draws the displaced mesh with the pipeline of the pass.
    pub fn draw_mesh(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(maps) = self.maps_group() else { return };
        pass.set_bind_group(0, &self.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        self.mesh.draw(pass);
    }
}
