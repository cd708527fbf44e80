//! The pass that shows the HDR picture (shaders/film/present.wgsl): bloom, exposure, tone curve, gamma, dither.

use super::bloom::BloomPass;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, RenderProgram};
use crate::gpu::layout::gpu_struct;
use crate::gpu::uniform::Uniform;
use crate::render::scene::Scene;
use crate::render::sky::uniform::{LightBuffer, night_gain};
use crate::shaders::Shaders;
use crate::state::look::FilmLook;

gpu_struct! {
    /// WGSL `Present`: uniform buffer of the pass that shows the HDR picture on screen.
    pub struct PresentUniform as "Present" {
        /// Width and height of the picture, pixels.
        size: [f32; 2],
        /// Factor on the automatic or fixed exposure: 2 to the power of the exposure setting, EV.
        exposure_gain: f32,
        /// Exposure (a factor on radiance, before `exposure_gain`) that replaces the automatic one; 0 if automatic.
        fixed_exposure: f32,
        /// Tone curve, as the discriminant of `ToneMapping`.
        tone_curve: u32,
        /// Fraction of the picture's light that is spread around its source as bloom, 0 to 1.
        bloom_fraction: f32,
        /// 1 if dither noise is added to hide the steps of 8-bit colours, else 0.
        dither: f32,
        unused: u32,
    }
}

/// Automatic exposure (factor from radiance to the tone curve's input) of a clear noon with the sun 60 degrees high.
/// Divided by `night_gain`, it is also the fixed exposure at 0 EV.
pub const NOON_EXPOSURE: f32 = 0.444;

/// The pass that shows the HDR picture on screen: it smooths edges and applies bloom, exposure, tone curve and dither.
pub struct PresentPass {
    uniform: Uniform<PresentUniform>,
    light_buffer: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    bloom: BloomPass,
    /// HDR picture that the bind group `group` holds, and whether its bloom is on; None before the first picture.
    bound_picture: Option<(wgpu::TextureView, bool)>,
    group: Option<wgpu::BindGroup>,
}

impl PresentPass {
    /// Compiles the pass, which draws into a texture of `target_format`. `light` is the GPU buffer with the automatic
    /// exposure; `smooth` turns on the smoothing of jagged edges.
    pub fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        light: &wgpu::Buffer,
        target_format: wgpu::TextureFormat,
        smooth: bool,
    ) -> Self {
        let bindings = [
            BindingType::Uniform(size_of::<PresentUniform>()),
            BindingType::Uniform(size_of::<LightBuffer>()),
            BindingType::Texture,
            BindingType::Sampler,
            BindingType::Texture,
        ];
        let layout = gpu.bind_group_layout("present", wgpu::ShaderStages::FRAGMENT, &bindings);
        let constants = [("PRESENT_SMOOTH", f64::from(u8::from(smooth)))];
        let module = shaders.module(gpu, "film/present");
        let program = RenderProgram { constants: &constants, ..RenderProgram::new(&module) };
        let onto = AttachmentFormats { formats: &[target_format], depth: None };
        let pipeline = gpu.render_pipeline("present", &program, &[&layout], &onto);
        let clamp = [wgpu::AddressMode::ClampToEdge; 2];
        let sampler = gpu.sampler("hdr", clamp, wgpu::MipmapFilterMode::Nearest);
        Self {
            uniform: Uniform::new(gpu, "present"),
            light_buffer: light.clone(),
            layout,
            pipeline,
            sampler,
            bloom: BloomPass::new(gpu, shaders),
            bound_picture: None,
            group: None,
        }
    }

    /// Sets the picture `hdr` (linear light) to show; allocates bloom textures if `film` has bloom. No-op if unchanged.
    pub fn set_picture(&mut self, gpu: &Gpu, hdr: &wgpu::TextureView, film: &FilmLook) {
        let wanted = Some((hdr.clone(), film.bloom > 0.0));
        if self.bound_picture == wanted {
            return;
        }
        let size = [hdr.texture().width(), hdr.texture().height()];
        self.bloom.set_picture(gpu, (film.bloom > 0.0).then_some((hdr, size)));
        let resources = [
            self.uniform.buffer.as_entire_binding(),
            self.light_buffer.as_entire_binding(),
            wgpu::BindingResource::TextureView(hdr),
            wgpu::BindingResource::Sampler(&self.sampler),
            wgpu::BindingResource::TextureView(self.bloom.texture_view().unwrap_or(hdr)),
        ];
        self.group = Some(gpu.bind_group("present", &self.layout, &resources));
        self.bound_picture = wanted;
    }

    /// Writes the film settings of a scene, for a picture of `size` (width, height) pixels, to the uniform buffer.
    pub fn write_uniform(&self, gpu: &Gpu, scene: &Scene, size: [u32; 2]) {
        let film = &scene.look.film;
        let fixed = NOON_EXPOSURE / night_gain(&scene.look.sky) as f32;
        let uniform = PresentUniform {
            size: size.map(|s| s as f32),
            exposure_gain: (film.exposure_ev as f32).exp2(),
            fixed_exposure: if film.auto_exposure { 0.0 } else { fixed },
            tone_curve: film.tone as u32,
            bloom_fraction: film.bloom as f32,
            dither: f32::from(u8::from(film.dither)),
            unused: 0,
        };
        self.uniform.write(gpu, &uniform);
    }

    /// Records the compute passes that make the bloom of the picture last passed to `set_picture`; none if bloom is
    /// off.
    pub fn record_bloom(&self, encoder: &mut wgpu::CommandEncoder) {
        self.bloom.run(encoder);
    }

    /// Draws the picture of [`Self::set_picture`], with bloom, exposure and tone curve, into the viewport of `pass`.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(group) = &self.group else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }
}
