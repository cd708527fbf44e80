//! The water: its mesh is drawn into a G-buffer, and shaders/water/light.wgsl lights each pixel of water once.

use super::displace::{self, DisplacePass};
use super::material;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, DepthState, RenderProgram};
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::render::frame::FrameUniform;
use crate::render::land::LandPass;
use crate::render::scene::Scene;
use crate::render::scene_group::SceneGroup;
use crate::render::targets::{
    DEPTH_TEST_BACKGROUND, DEPTH_TEST_OPAQUE, G_BUFFER_FORMATS, OutputKind, Targets, attachments,
};
use crate::render::variants::{PipelineVariants, switch_constant};
use crate::shaders::Shaders;
use crate::sim::Maps;
use crate::state::look::{CloudKind, FresnelFormula, MicrofacetDistribution};
use crate::waves::slopes::SlopeVariance;
use wgpu::BindingResource::{Sampler, TextureView};

/// Depth test of the lighting pass. Its triangle lies behind all water and before the sky, so only water pixels pass.
const DEPTH_TEST_WATER_LIGHT: DepthState =
    DepthState { compare: wgpu::CompareFunction::LessEqual, ..DEPTH_TEST_BACKGROUND };

/// What a variant of the water's lighting pipeline can draw; the shader code for the rest is compiled out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WaterLightVariant {
    /// Whether the sea bed is visible through the water.
    bed: bool,
    /// Whether there is land, to which the water's depth belongs at each place.
    land: bool,
    /// Whether the land shades the water.
    land_shadows: bool,
    /// Whether waves focus sunlight into caustics on the bed.
    caustics: bool,
    foam: bool,
    /// Whether the sea runs up to a coast.
    coast: bool,
    /// Whether gusts and slicks vary the roughness of the water.
    gusts: bool,
    /// Whether the sun's glitter consists of separate glints.
    glints: bool,
    /// Whether waves shade each other (shaders/water/shadow.wgsl).
    shadows: bool,
    /// Whether the sun's glitter has a Blinn-Phong lobe instead of the Gaussian distribution of slopes.
    blinn_phong: bool,
    /// Whether a GGX (Trowbridge-Reitz) distribution of slopes replaces the Gaussian one.
    ggx: bool,
    /// Whether Schlick's approximation replaces the exact Fresnel reflectance.
    schlick: bool,
    /// Whether the sky is an image from a file.
    sky_image: bool,
    fog: bool,
    /// Whether raindrops make rings on the water.
    rain: bool,
    /// Whether volumetric clouds shade the sea.
    cloud_shadows: bool,
    /// Whether pixels take unfiltered point samples for a reference picture instead of averaging over their area.
    point_samples: bool,
    /// Whether something floats, which the water mirrors (shaders/water/hull_image.wgsl).
    hulls: bool,
    /// Whether the eye dives: the G-buffer then tells which side of the water a pixel shows.
    dives: bool,
    /// Whether the light is that of the lean tier (shaders/water/lean.wgsl); a reference never is.
    is_lean: bool,
}

/// Elevation of the sun's centre, degrees, below which its upper edge has set.
const SUNSET_DEG: f64 = -0.9;
/// Slope, in standard deviations, up to which water counts as casting shadows: 0.6 % of the surface is steeper.
const SHADOW_DEVIATIONS: f64 = 2.5;

/// Whether the sun is so low that some of the waves of the maps, with these slope variances, shade others.
pub fn waves_cast_shadows(elevation_deg: f64, [along, across]: SlopeVariance) -> bool {
    let steepest = SHADOW_DEVIATIONS * along.max(across).sqrt();
    elevation_deg > SUNSET_DEG && elevation_deg.to_radians().tan() < steepest
}

impl WaterLightVariant {
    pub fn new(scene: &Scene, output: OutputKind) -> Self {
        let surface = &scene.look.surface;
        let bed = material::is_bed_visible(scene);
        Self {
            bed,
            land: scene.land.is_some(),
            land_shadows: scene.land.is_some() && LandPass::shades_water(&scene.look.sky),
            caustics: bed && surface.bed.caustics > 0.0,
            foam: surface.foam.coverage_factor > 0.0,
            coast: scene.has_coast,
            gusts: surface.reflection.gusts > 0.0,
            glints: surface.reflection.glints && output != OutputKind::Reference,
            shadows: waves_cast_shadows(
                scene.look.sky.sun_elevation_azimuth_deg()[0],
                scene.sea.resolved_slope_variance,
            ),
            blinn_phong: surface.reflection.specular == MicrofacetDistribution::BlinnPhong,
            ggx: surface.reflection.specular == MicrofacetDistribution::Ggx,
            schlick: surface.reflection.fresnel == FresnelFormula::Schlick,
            sky_image: scene.look.sky.panorama().is_some(),
            fog: scene.look.sky.has_fog(),
            rain: scene.look.sky.rain_mm_h > 0.0,
            cloud_shadows: scene.look.sky.drawn_clouds() != CloudKind::None,
            point_samples: output == OutputKind::Reference,
            hulls: !scene.hulls.is_empty(),
            dives: scene.dives(),
            is_lean: scene.is_lean && output != OutputKind::Reference,
        }
    }

    /// Whether the vertices of the mesh tell how waves shade each other. The lean tier has no such shadows, and a
    /// reference finds them for each of its samples.
    fn shades_vertices(self) -> bool {
        self.shadows && !self.is_lean && !self.point_samples
    }

    pub fn constants(self) -> [(&'static str, f64); 19] {
        [
            switch_constant("WATER_BED", self.bed),
            switch_constant("WATER_LAND", self.land),
            switch_constant("LAND_SHADOWS", self.land_shadows),
            switch_constant("WATER_CAUSTICS", self.caustics),
            switch_constant("WATER_FOAM", self.foam),
            switch_constant("WATER_COAST", self.coast),
            switch_constant("WATER_GUSTS", self.gusts),
            switch_constant("WATER_GLINTS", self.glints),
            switch_constant("WATER_SHADOWS", self.shadows),
            switch_constant("WATER_PHONG", self.blinn_phong),
            switch_constant("WATER_GGX", self.ggx),
            switch_constant("WATER_SCHLICK", self.schlick),
            switch_constant("SKY_IMAGE", self.sky_image),
            switch_constant("SKY_FOG", self.fog),
            switch_constant("WATER_HULLS", self.hulls),
            switch_constant("WATER_RAIN", self.rain),
            switch_constant("SKY_CLOUD_SHADOWS", self.cloud_shadows),
            switch_constant("WATER_POINT_SAMPLES", self.point_samples),
            switch_constant("WATER_DIVES", self.dives),
        ]
    }
}

/// Draws the water: its mesh, the bound maps, and the pipelines that fill the G-buffer and light the pixels.
pub struct WaterPass {
    /// Bind group that all passes of the picture share: frame, sky, light and material.
    pub scene: SceneGroup,
    /// The displaced mesh of the water.
    pub mesh: DisplacePass,
    module: wgpu::ShaderModule,
    g_buffer_pipeline: wgpu::RenderPipeline,
    g_buffer_layout: wgpu::BindGroupLayout,
    /// Depth texture drawn with the bound G-buffer, and the bind group of both; None before the first frame.
    g_buffer: Option<(wgpu::TextureView, wgpu::BindGroup)>,
    light_pipelines: PipelineVariants<WaterLightVariant>,
    maps_layout: wgpu::BindGroupLayout,
    /// Samplers of the maps: the first interpolates between mip levels, the second takes the nearest level.
    samplers: [wgpu::Sampler; 2],
    /// Bind group of the map textures, and their generation number (new for new textures); None before the first frame.
    bound_maps: Option<(u64, wgpu::BindGroup)>,
}

impl WaterPass {
    /// Compiles the passes that displace the mesh and fill the G-buffer. [`Self::select_pipeline`] later compiles the
    /// lighting pipelines.
    pub fn new(gpu: &Gpu, shaders: &Shaders, scene: SceneGroup, frame: &Uniform<FrameUniform>) -> Self {
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
        let maps_layout = gpu.bind_group_layout("maps", stages, &displace::WAVE_MAPS);
        let samplers = [wgpu::MipmapFilterMode::Linear, wgpu::MipmapFilterMode::Nearest]
            .map(|mipmap_filter| gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], mipmap_filter));
        let mesh = DisplacePass::new(gpu, shaders, frame, &maps_layout);
        let module = shaders.module(gpu, "water/light");
        let program = RenderProgram { entry_points: ["mesh_vertex", "mesh_fragment"], ..RenderProgram::new(&module) };
        let onto = AttachmentFormats { formats: &G_BUFFER_FORMATS, depth: Some(DEPTH_TEST_OPAQUE), blend: None };
        let layouts = [&scene.layout, &maps_layout, mesh.vertices_layout()];
        Self {
            g_buffer_pipeline: gpu.render_pipeline("water/mesh", &program, &layouts, &onto),
            g_buffer_layout: gpu.bind_group_layout(
                "g-buffer",
                wgpu::ShaderStages::FRAGMENT,
                &[
                    BindingType::DepthTexture,
                    BindingType::TextureLoaded,
                    BindingType::TextureLoaded,
                    BindingType::TextureLoaded,
                ],
            ),
            scene,
            mesh,
            module,
            g_buffer: None,
            light_pipelines: PipelineVariants::default(),
            maps_layout,
            samplers,
            bound_maps: None,
        }
    }

    /// Makes the bind group of the wave and foam maps, unless the existing one has the same textures (same generation).
    pub fn bind_maps(&mut self, gpu: &Gpu, maps: &Maps) {
        if self.bound_maps.as_ref().is_some_and(|(generation, _)| *generation == maps.view_generation) {
            return;
        }
        let resources = [
            TextureView(&maps.displacement),
            TextureView(&maps.gradients),
            TextureView(&maps.slope_moments),
            TextureView(&maps.foam),
            Sampler(&self.samplers[0]),
            Sampler(&self.samplers[1]),
            TextureView(maps.coast.as_ref().map_or(&maps.no_coast, |coast| &coast.gains)),
        ];
        self.bound_maps = Some((maps.view_generation, gpu.bind_group("maps", &self.maps_layout, &resources)));
    }

    /// Makes the bind group through which the lighting reads the G-buffer of `targets`, unless it exists already.
    pub fn bind_targets(&mut self, gpu: &Gpu, targets: &Targets) {
        if self.g_buffer.as_ref().is_none_or(|(bound, _)| *bound != targets.depth) {
            let [undisplaced, slope_and_stretch, shear_and_side] = &targets.g_buffer;
            let resources = [&targets.depth, undisplaced, slope_and_stretch, shear_and_side].map(TextureView);
            self.g_buffer =
                Some((targets.depth.clone(), gpu.bind_group("g-buffer", &self.g_buffer_layout, &resources)));
        }
    }

    /// Selects the lighting pipeline's variant that `scene` needs, for [`Self::draw_light`]; compiles it at first use.
    pub fn select_pipeline(&mut self, gpu: &Gpu, scene: &Scene) {
        let (gpu, module, format) = (gpu.clone(), self.module.clone(), self.scene.output.format());
        let layouts = [&self.scene.layout, &self.maps_layout, &self.g_buffer_layout].map(Clone::clone);
        let parts = WaterLightVariant::new(scene, self.scene.output);
        self.mesh.select_pipeline(&gpu, parts.coast, parts.shades_vertices());
        self.light_pipelines.select(parts, scene.may_keep_pipelines, move || {
            let program = RenderProgram {
                entry_points: ["light_vertex", if parts.is_lean { "lean_fragment" } else { "light_fragment" }],
                constants: &parts.constants(),
                ..RenderProgram::new(&module)
            };
            let onto = attachments(&format, DEPTH_TEST_WATER_LIGHT);
            gpu.render_pipeline("water/light", &program, &layouts.each_ref(), &onto)
        });
    }

    /// Layout of the bind group of the maps: displacement, gradients, slope moments, foam, two samplers, gains of a coast.
    pub fn maps_layout(&self) -> &wgpu::BindGroupLayout {
        &self.maps_layout
    }

    /// Bind group of the wave and foam maps; None until maps are bound.
    pub fn maps_group(&self) -> Option<&wgpu::BindGroup> {
        self.bound_maps.as_ref().map(|(_, group)| group)
    }

    /// Records the compute pass that displaces the vertices of the water mesh by the maps; none if no maps are bound.
    pub fn displace(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        if let Some(maps) = self.maps_group() {
            self.mesh.run(encoder, timer, maps);
        }
    }

    /// Records the displacement of the water mesh, then its drawing into the G-buffer and depth texture of `targets`, after
    /// that of the land and with the pipeline `diving` if the eye dives.
    pub fn record_g_buffer(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        targets: &Targets,
        (land, diving): (&LandPass, Option<&wgpu::RenderPipeline>),
    ) {
        self.displace(encoder, timer);
        let mut pass = targets.begin_mesh(encoder, timer);
        land.draw_g_buffer(&mut pass, self);
        pass.set_pipeline(diving.unwrap_or(&self.g_buffer_pipeline));
        self.draw_mesh(&mut pass);
    }

    /// Draws the linear light of all water pixels into the target of `pass`; the G-buffer tells what water each shows.
    pub fn draw_light(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(pipeline) = self.light_pipelines.selected().filter(|_| self.bind_light_groups(pass)) {
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }

    /// Binds scene, maps and G-buffer as groups 0 to 2, with which pixels are lit. Returns false before the first frame.
    pub fn bind_light_groups(&self, pass: &mut wgpu::RenderPass<'_>) -> bool {
        let (Some(maps), Some((_, g_buffer))) = (self.maps_group(), &self.g_buffer) else { return false };
        pass.set_bind_group(0, &self.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.set_bind_group(2, g_buffer, &[]);
        true
    }

    /// Layout of the bind group of depth texture and G-buffer.
    pub fn g_buffer_layout(&self) -> &wgpu::BindGroupLayout {
        &self.g_buffer_layout
    }

    /// Layouts of the bind groups 0 to 2 with which the mesh is drawn: scene, maps, vertices.
    pub fn mesh_layouts(&self) -> [&wgpu::BindGroupLayout; 3] {
        [&self.scene.layout, &self.maps_layout, self.mesh.vertices_layout()]
    }

    /// Draws the displaced mesh with the pipeline set on `pass`; binds scene, maps and vertices as groups 0 to 2.
    pub fn draw_mesh(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(maps) = self.maps_group() else { return };
        pass.set_bind_group(0, &self.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        self.mesh.draw(pass);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;
    use crate::waves::{Plan, slopes};

    #[test]
    fn only_a_low_sun_on_a_steep_sea_casts_shadows() {
        let casts = |state: &str, elevation_deg: f64| {
            waves_cast_shadows(elevation_deg, slopes::resolved_slope_variance(&Plan::new(&query::parse(state).0)))
        };
        assert!(casts("", 5.0) && casts("", 12.0));
        assert!(!casts("", 30.0) && !casts("", -2.0));
        assert!(casts("wind=2", 1.0) && !casts("wind=2", 12.0) && !casts("wind=0", 1.0));
    }
}
