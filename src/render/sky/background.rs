//! The pass that draws the sky behind the sea (shaders/sky/background.wgsl).

use super::tables::SkyTables;
use crate::gpu::Gpu;
use crate::gpu::kit::RenderProgram;
use crate::render::scene::Scene;
use crate::render::scene_group::SceneGroup;
use crate::render::targets::{DEPTH_TEST_BACKGROUND, attachments};
use crate::render::variants::{PipelineVariants, switch_constant};
use crate::shaders::Shaders;
use crate::state::look::CloudKind;

/// Sine of the sun's elevation below which stars are drawn; shaders/sky/background.wgsl contains the same number.
const STARS_MAX_SUN_SINE: f64 = -0.05;

/// Draws the sky behind the sea: clear air, sun, clouds, stars and fog, or an image from a file.
pub struct BackgroundPass {
    module: wgpu::ShaderModule,
    pipelines: PipelineVariants<BackgroundVariant>,
}

/// Parts of the sky that a variant of the background pipeline draws; the other shader code is compiled out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct BackgroundVariant {
    sky_image: bool,
    /// The flat layer of clouds of an overcast sky.
    clouds: bool,
    /// The dome of volumetric clouds.
    cloud_dome: bool,
    stars: bool,
    fog: bool,
}

impl BackgroundPass {
    /// Creates only the shader module of the background; [`Self::select_pipeline`] compiles its render pipelines.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        Self { module: shaders.module(gpu, "sky/background"), pipelines: PipelineVariants::default() }
    }

    /// Selects the variant of the background pipeline that `scene` needs, for [`Self::draw`]; compiles it at first use.
    pub fn select_pipeline(&mut self, gpu: &Gpu, group: &SceneGroup, sky: &SkyTables, scene: &Scene) {
        let look = &scene.look.sky;
        let file = look.panorama().is_some();
        let cloud_dome = look.drawn_clouds() != CloudKind::None;
        let parts = BackgroundVariant {
            sky_image: file,
            clouds: !file && !cloud_dome && look.overcast > 0.0,
            cloud_dome,
            stars: !file && look.sun_direction()[1] < STARS_MAX_SUN_SINE,
            fog: look.has_fog(),
        };
        let (gpu, module, format) = (gpu.clone(), self.module.clone(), group.output.format());
        let layouts = [group.layout.clone(), sky.panorama.layout.clone(), sky.clouds.layout.clone()];
        self.pipelines.select(parts, scene.may_keep_pipelines, move || {
            let constants = [
                switch_constant("SKY_IMAGE", parts.sky_image),
                switch_constant("SKY_CLOUDS", parts.clouds),
                switch_constant("SKY_CLOUD_DOME", parts.cloud_dome),
                switch_constant("SKY_STARS", parts.stars),
                switch_constant("SKY_FOG", parts.fog),
            ];
            let program = RenderProgram { constants: &constants, ..RenderProgram::new(&module) };
            gpu.render_pipeline("sky", &program, &layouts.each_ref(), &attachments(&format, DEPTH_TEST_BACKGROUND))
        });
    }

    /// Draws the sky into the pixels of `pass` in which nothing nearer has been drawn.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneGroup, sky: &SkyTables) {
        let Some(pipeline) = self.pipelines.selected() else { return };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &scene.group, &[]);
        pass.set_bind_group(1, &sky.panorama.group, &[]);
        pass.set_bind_group(2, &sky.clouds.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
