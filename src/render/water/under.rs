//! Pictures of a diving eye: the surface from below, the water in between, and the bed (shaders/water/under.wgsl).
//!
//! The water mesh is drawn as ever, but its pixels tell which side of the water they show. A pass over the whole picture
//! then lights the pixels whose rays begin under water; the others keep the light of an eye above it.

use super::light::{WaterLightVariant, WaterPass};
use super::material::water_optics;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, DepthState, RenderProgram};
use crate::gpu::timer::Timer;
use crate::render::scene::Scene;
use crate::render::targets::{
    DEPTH_TEST_BACKGROUND, DEPTH_TEST_OPAQUE, G_BUFFER_FORMATS, HDR_FORMAT, Targets, attachments, begin_pass,
    cleared_attachment,
};
use crate::render::variants::{PipelineVariants, switch_constant};
use crate::shaders::Shaders;
use wgpu::BindingResource::TextureView;

/// Number of directions (width) and of distances (height) in the map of light shafts.
const SHAFTS_SIZE: [u32; 2] = [512, 32];
/// The light under water covers all pixels; the shader leaves those that show air.
const DEPTH_TEST_NONE: DepthState = DepthState { compare: wgpu::CompareFunction::Always, ..DEPTH_TEST_BACKGROUND };
/// Fraction of scattering that leaves light in the image (WGSL `MEDIUM_NARROW_SCATTERING`).
const NARROW_SCATTERING: f64 = 0.5;
/// Weights of red, green and blue in the luminance.
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Draws what a diving eye sees. Nothing is compiled or allocated on the GPU before an eye dives.
pub struct UnderPass {
    shaders: Shaders,
    made: Option<Made>,
    /// Whether the eye of the current frame dives.
    dives: bool,
}

struct Made {
    module: wgpu::ShaderModule,
    g_buffer_pipeline: wgpu::RenderPipeline,
    shafts_pipeline: wgpu::RenderPipeline,
    /// Keyed by the parts of the picture and by whether a part of the lens may stand in the air.
    light_pipelines: PipelineVariants<(WaterLightVariant, bool)>,
    layout: wgpu::BindGroupLayout,
    /// Map of light shafts: irradiance by the sun relative to its mean, at four depths.
    shafts: wgpu::TextureView,
    /// Depth texture drawn with the bound G-buffer, and the bind group; None before the first frame.
    bound: Option<(wgpu::TextureView, wgpu::BindGroup)>,
    /// Whether the sea runs up to a coast.
    has_coast: bool,
}

impl Made {
    fn new(gpu: &Gpu, shaders: &Shaders, water: &WaterPass, has_coast: bool) -> Self {
        let module = shaders.module(gpu, "water/under");
        let [scene, maps, vertices] = water.mesh_layouts();
        let constants = [switch_constant("WATER_COAST", has_coast)];
        let program =
            |entry_points| RenderProgram { entry_points, constants: &constants, ..RenderProgram::new(&module) };
        let g_buffer = AttachmentFormats { formats: &G_BUFFER_FORMATS, depth: Some(DEPTH_TEST_OPAQUE), blend: None };
        let shafts = AttachmentFormats { formats: &[HDR_FORMAT], depth: None, blend: None };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let [width, height] = SHAFTS_SIZE;
        let map = gpu.texture("shafts", [width, height, 1], 1, HDR_FORMAT, usage);
        let bindings =
            [BindingType::DepthTexture, BindingType::TextureLoaded, BindingType::Texture, BindingType::TextureLoaded];
        Self {
            g_buffer_pipeline: gpu.render_pipeline(
                "water/under mesh",
                &program(["mesh_vertex", "under_mesh_fragment"]),
                &[scene, maps, vertices],
                &g_buffer,
            ),
            shafts_pipeline: gpu.render_pipeline(
                "water/shafts",
                &program(["light_vertex", "shafts_fragment"]),
                &[scene, maps],
                &shafts,
            ),
            light_pipelines: PipelineVariants::default(),
            layout: gpu.bind_group_layout("under", wgpu::ShaderStages::FRAGMENT, &bindings),
            shafts: map.create_view(&wgpu::TextureViewDescriptor::default()),
            bound: None,
            has_coast,
            module,
        }
    }
}

impl UnderPass {
    /// Keeps the shaders until an eye dives.
    pub fn new(shaders: Shaders) -> Self {
        Self { shaders, made: None, dives: false }
    }

    /// Selects the pipelines for the frame of `scene`, and compiles them at first use.
    pub fn prepare(&mut self, gpu: &Gpu, scene: &Scene, water: &WaterPass) {
        self.dives = scene.dives();
        if !self.dives {
            return;
        }
        self.made.take_if(|made| made.has_coast != scene.has_coast);
        let made = self.made.get_or_insert_with(|| Made::new(gpu, &self.shaders, water, scene.has_coast));
        let parts = WaterLightVariant::new(scene, water.scene.output);
        let (gpu, module, format) = (gpu.clone(), made.module.clone(), water.scene.output.format());
        let layouts = [&water.scene.layout, water.maps_layout(), &made.layout].map(Clone::clone);
        let sees_air = !scene.is_submerged();
        made.light_pipelines.select((parts, sees_air), scene.may_keep_pipelines, move || {
            // Schlick's approximation is for light that comes from the air.
            let exact = |(name, value)| (name, if name == "WATER_SCHLICK" { 0.0 } else { value });
            let mut constants = parts.constants().map(exact).to_vec();
            constants.push(switch_constant("UNDER_SEES_AIR", sees_air));
            let program = RenderProgram {
                entry_points: ["light_vertex", "under_fragment"],
                constants: &constants,
                ..RenderProgram::new(&module)
            };
            gpu.render_pipeline("water/under", &program, &layouts.each_ref(), &attachments(&format, DEPTH_TEST_NONE))
        });
    }

    /// Makes the bind group through which the light under water reads the G-buffer of `targets`, unless it exists.
    pub fn bind_targets(&mut self, gpu: &Gpu, targets: &Targets) {
        let Some(made) = self.made.as_mut().filter(|_| self.dives) else { return };
        if made.bound.as_ref().is_none_or(|(bound, _)| *bound != targets.depth) {
            let [undisplaced, _, shear_and_side] = &targets.g_buffer;
            let resources = [&targets.depth, undisplaced, &made.shafts, shear_and_side].map(TextureView);
            made.bound = Some((targets.depth.clone(), gpu.bind_group("under", &made.layout, &resources)));
        }
    }

    /// Pipeline that draws the mesh into the G-buffer; None if the eye does not dive.
    pub fn g_buffer_pipeline(&self) -> Option<&wgpu::RenderPipeline> {
        self.made.as_ref().filter(|_| self.dives).map(|made| &made.g_buffer_pipeline)
    }

    /// Records the pass that finds how the waves focus the sunlight around a diving eye.
    pub fn record_shafts(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, water: &WaterPass) {
        let (Some(made), Some(maps)) = (self.made.as_ref().filter(|_| self.dives), water.maps_group()) else { return };
        let target = cleared_attachment(&made.shafts, wgpu::Color::WHITE);
        let mut pass = begin_pass(encoder, ("shafts", timer.render_pass("shafts")), &[Some(target)], None);
        pass.set_pipeline(&made.shafts_pipeline);
        pass.set_bind_group(0, &water.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Draws the light of all pixels whose rays begin under water, over what the passes before have drawn there.
    pub fn draw_light(&self, pass: &mut wgpu::RenderPass<'_>, water: &WaterPass) {
        let Some(made) = self.made.as_ref().filter(|_| self.dives) else { return };
        let (Some(pipeline), Some(maps), Some((_, group))) =
            (made.light_pipelines.selected(), water.maps_group(), &made.bound)
        else {
            return;
        };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &water.scene.group, &[]);
        pass.set_bind_group(1, maps, &[]);
        pass.set_bind_group(2, group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Factor on the automatic exposure of a diving eye, for the light that its depth and the water leave: a camera opens its
/// aperture and shutter, though not so far that the deep looks like the shallows.
pub fn exposure_factor(scene: &Scene) -> f64 {
    let water = water_optics(&scene.look.surface.scattering);
    let depth_m = -scene.view.eye.y;
    let reflectance = water.reflectance();
    // Luminance in a level direction for a downward irradiance of 1 at the surface.
    let level: f64 = (0..3)
        .map(|i| {
            let wide = (1.0 - NARROW_SCATTERING) * water.scattering[i];
            let extinction = water.absorption[i] + wide;
            let kd = water.diffuse_attenuation[i];
            let source = 0.25 * reflectance[i] * (extinction + kd) + wide / (4.0 * std::f64::consts::PI);
            LUMINANCE[i] * source / extinction * (-kd * depth_m).exp()
        })
        .sum();
    // Luminance of a grey card under the same light above the water.
    const GREY: f64 = 0.018;
    // With the surface in the picture, the exposure is one that also suits the air.
    let below = (depth_m / 1.5).min(1.0);
    (GREY / level.max(1e-9)).powf(0.45 + 0.3 * below).clamp(1.0, 200.0)
}
