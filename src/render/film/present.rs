//! shaders/film/present.wgsl: bloom, exposure, tone curve, gamma, dither.

use super::bloom::Bloom;
use crate::gpu::Gpu;
use crate::gpu::kit::{Attachments, Program, Slot};
use crate::gpu::layout::gpu_struct;
use crate::gpu::uniform::Uniform;
use crate::render::scene::Scene;
use crate::render::sky::uniform::{LightBuffer, night_gain};
use crate::shaders::Shaders;
use crate::state::look::FilmLook;

gpu_struct! {
    /// Uniform of the pass that presents the picture (WGSL `Present`).
    pub struct PresentUniform as "Present" {
        /// Width and height of the picture, pixels.
        size: [f32; 2],
        /// Factor of the exposure.
        exposure_gain: f32,
        /// Exposure that does not follow the light, or 0.
        fixed_exposure: f32,
        /// The tone curve: the place of the variant in `Tone`.
        tone: u32,
        /// Share of the light that the lens spreads.
        bloom: f32,
        /// 1 if the picture is dithered, else 0.
        dither: f32,
        unused: u32,
    }
}

/// Automatic exposure of a clear noon with the sun 60 degrees high; the fixed exposure of a film that does not adapt.
pub const NOON_EXPOSURE: f32 = 0.444;

/// Draws the HDR picture into a pass of the screen.
pub struct PresentPass {
    uniform: Uniform<PresentUniform>,
    light: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    bloom: Bloom,
    /// The picture that is bound, and whether it has bloom.
    bound: Option<(wgpu::TextureView, bool)>,
    group: Option<wgpu::BindGroup>,
}

impl PresentPass {
    /// Compiles the pass for a format of the screen. `light` holds the exposure; `smooth` asks for smooth edges.
    pub fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        light: &wgpu::Buffer,
        target_format: wgpu::TextureFormat,
        smooth: bool,
    ) -> Self {
        let slots = [
            Slot::Uniform(size_of::<PresentUniform>()),
            Slot::Uniform(size_of::<LightBuffer>()),
            Slot::Texture,
            Slot::Sampler,
            Slot::Texture,
        ];
        let layout = gpu.layout("present", wgpu::ShaderStages::FRAGMENT, &slots);
        let constants = [("PRESENT_SMOOTH", f64::from(u8::from(smooth)))];
        let module = shaders.module(gpu, "film/present");
        let program = Program { constants: &constants, ..Program::new(&module) };
        let onto = Attachments { formats: &[target_format], depth: None };
        let pipeline = gpu.render("present", &program, &[&layout], &onto);
        let clamp = [wgpu::AddressMode::ClampToEdge; 2];
        let sampler = gpu.sampler("hdr", clamp, wgpu::MipmapFilterMode::Nearest);
        Self {
            uniform: Uniform::new(gpu, "present"),
            light: light.clone(),
            layout,
            pipeline,
            sampler,
            bloom: Bloom::new(gpu, shaders),
            bound: None,
            group: None,
        }
    }

    /// Binds a picture in linear light, and the chain of its bloom, if they are not bound yet.
    pub fn bind(&mut self, gpu: &Gpu, hdr: &wgpu::TextureView, film: &FilmLook) {
        let wanted = Some((hdr.clone(), film.bloom > 0.0));
        if self.bound == wanted {
            return;
        }
        let size = [hdr.texture().width(), hdr.texture().height()];
        self.bloom.bind(gpu, (film.bloom > 0.0).then_some((hdr, size)));
        let resources = [
            self.uniform.buffer.as_entire_binding(),
            self.light.as_entire_binding(),
            wgpu::BindingResource::TextureView(hdr),
            wgpu::BindingResource::Sampler(&self.sampler),
            wgpu::BindingResource::TextureView(self.bloom.result().unwrap_or(hdr)),
        ];
        self.group = Some(gpu.group("present", &self.layout, &resources));
        self.bound = wanted;
    }

    /// Sends the numbers of a scene's film.
    pub fn write(&self, gpu: &Gpu, scene: &Scene, size: [u32; 2]) {
        let film = &scene.look.film;
        let fixed = NOON_EXPOSURE / night_gain(&scene.look.sky) as f32;
        let uniform = PresentUniform {
            size: size.map(|s| s as f32),
            exposure_gain: (film.exposure_ev as f32).exp2(),
            fixed_exposure: if film.auto_exposure { 0.0 } else { fixed },
            tone: film.tone as u32,
            bloom: film.bloom as f32,
            dither: f32::from(u8::from(film.dither)),
            unused: 0,
        };
        self.uniform.write(gpu, &uniform);
    }

    /// Records the bloom, if there is any.
    pub fn spread(&self, encoder: &mut wgpu::CommandEncoder) {
        self.bloom.run(encoder);
    }

    /// Draws into the current viewport.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(group) = &self.group else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }
}
