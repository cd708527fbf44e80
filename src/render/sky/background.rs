//! shaders/sky/background.wgsl: the sky behind the sea.

use super::tables::SkyTables;
use crate::gpu::Gpu;
use crate::gpu::kit::Program;
use crate::render::scene::Scene;
use crate::render::scene_group::SceneGroup;
use crate::render::targets::{BEHIND, attachments};
use crate::render::variants::{Variants, part};
use crate::shaders::Shaders;

/// Sine of the sun's elevation below which there are stars; sky.wgsl has it too.
const STARS_SUN: f64 = -0.05;

/// What stands behind the sea.
pub struct BackgroundPass {
    module: wgpu::ShaderModule,
    pipelines: Variants<Parts>,
}

/// What a picture's background consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Parts {
    file: bool,
    clouds: bool,
    stars: bool,
    fog: bool,
}

impl BackgroundPass {
    /// Compiles the pass.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        Self { module: shaders.module(gpu, "sky/background"), pipelines: Variants::default() }
    }

    /// Makes the pipeline that the picture of a scene needs, if there is none yet.
    pub fn choose(&mut self, gpu: &Gpu, group: &SceneGroup, sky: &SkyTables, scene: &Scene) {
        let look = &scene.look.sky;
        let file = look.panorama().is_some();
        let parts = Parts {
            file,
            clouds: !file && look.overcast > 0.0,
            stars: !file && look.sun_direction()[1] < STARS_SUN,
            fog: look.fog_extinction_per_km > 0.0,
        };
        let layouts = [&group.layout, &sky.panorama.layout];
        self.pipelines.choose(parts, |parts| {
            let constants = [
                part("SKY_FILE", parts.file),
                part("SKY_CLOUDS", parts.clouds),
                part("SKY_STARS", parts.stars),
                part("SKY_FOG", parts.fog),
            ];
            let program = Program { constants: &constants, ..Program::new(&self.module) };
            gpu.render("sky", &program, &layouts, &attachments(&group.film.format(), BEHIND))
        });
    }

    /// Draws it.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneGroup, sky: &SkyTables) {
        let Some(pipeline) = self.pipelines.chosen() else { return };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &scene.group, &[]);
        pass.set_bind_group(1, &sky.panorama.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
