//! The pass that turns the linear light of a picture into screen colours (shaders/film/tone.wgsl): smoothed edges,
//! bloom, exposure, local exposure, tone curve, encoding, dither.

use super::bloom::BloomPass;
use super::local_exposure::LocalExposurePass;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, RenderProgram};
use crate::gpu::layout::gpu_struct;
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::render::scene::Scene;
use crate::render::sky::uniform::{LightBuffer, night_gain};
use crate::render::targets::cleared_attachment;
use crate::render::water::under;
use crate::shaders::Shaders;
use crate::state::look::{CloudKind, FilmLook};

gpu_struct! {
    /// WGSL `Tone`: uniform buffer of the pass that turns linear light into screen colours.
    pub struct ToneUniform as "Tone" {
        /// Width and height of the picture, pixels.
        size: [f32; 2],
        /// Factor on the automatic or fixed exposure: 2 to the power of the exposure setting, EV, and with automatic
        /// exposure the factor of a camera that faces the sun.
        exposure_gain: f32,
        /// Exposure (a factor on radiance, before `exposure_gain`) that replaces the automatic one; 0 if automatic.
        fixed_exposure: f32,
        /// Tone curve, as the discriminant of `ToneMapping`.
        curve: u32,
        /// Fraction of the picture's light that is spread around its source as bloom, 0 to 1.
        bloom_fraction: f32,
        /// Range of the noise that hides the steps of 8-bit colours, in code values from 0 to 1; 0 without dither.
        dither: f32,
        /// 1 if the picture already holds screen colours, as the false-colour views do; it is then copied. Else 0.
        is_encoded: u32,
        /// Share of the brightness of bright areas of the picture that local exposure takes away, in doublings.
        local_exposure: f32,
        unused: [f32; 3],
    }
}

/// Automatic exposure (factor from radiance to the tone curve's input) of a clear noon with the sun 60 degrees high.
/// Divided by `night_gain`, it is also the fixed exposure at 0 EV.
pub const NOON_EXPOSURE: f32 = 0.786;
/// Format of the finished picture. Eight bits are what screens and files take: the tone pass rounds and dithers, so
/// that the present pass can copy, and a picture costs no more memory traffic than it must.
pub const FINISHED_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Factor on the exposure of a camera that faces the sun or its glitter on the sea, which fill the picture with light:
/// down to 0.28.
fn facing_sun_factor(scene: &Scene) -> f64 {
    let sky = &scene.look.sky;
    let sun = glam::DVec3::from(sky.sun_direction());
    // Glitter lies around the mirror image of the sun.
    let glitter = glam::DVec3::new(sun.x, -sun.y.abs(), sun.z);
    let [by_sun, by_glitter] = [sun, glitter].map(|towards| {
        let angle_deg = towards.dot(scene.view.forward).clamp(-1.0, 1.0).acos().to_degrees();
        (-(angle_deg / 30.0).powi(2)).exp()
    });
    // The sun's surroundings are bright until it is some degrees below the horizon.
    let up = ((sun.y.asin().to_degrees() + 3.0) / 6.0).clamp(0.0, 1.0);
    // A sky image contains its own clouds.
    let overcast = if sky.panorama().is_some() { 0.0 } else { sky.overcast };
    // A rough share of a storm deck's gaps: the map of shaders/sky/cloud_weather.wgsl alone has fewer.
    let gaps = if sky.drawn_clouds() == CloudKind::Storm { (1.0 - sky.cloud_cover).powi(8) } else { 1.0 };
    let brightness = up * gaps * (1.0 - overcast).powi(2) * (1.0 - (1.0 - by_sun) * (1.0 - by_glitter));
    1.0 / (1.0 + 2.6 * brightness)
}

/// Factor on the automatic exposure by where the camera is and looks.
fn camera_factor(scene: &Scene) -> f64 {
    if scene.dives() { under::exposure_factor(scene) } else { facing_sun_factor(scene) }
}

/// The pass that turns the linear light of a picture into screen colours, at the picture's size: it smooths edges and
/// applies bloom, exposure, tone curve and dither.
pub struct TonePass {
    uniform: Uniform<ToneUniform>,
    light_buffer: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    bloom: BloomPass,
    local_exposure: LocalExposurePass,
    picture: Option<TonedPicture>,
}

/// Parts of the film that have textures of their own.
#[derive(Clone, Copy, PartialEq)]
struct PictureParts {
    bloom: bool,
    local_exposure: bool,
}

/// A picture in linear light that the tone pass reads, and its finished colours.
struct TonedPicture {
    /// The picture in linear light.
    hdr: wgpu::TextureView,
    parts: PictureParts,
    group: wgpu::BindGroup,
    /// The finished picture in screen colours, which the pass draws.
    finished: wgpu::TextureView,
}

impl TonePass {
    /// Compiles the pass. `light` is the GPU buffer with the automatic exposure; `smooth` turns on the smoothing of
    /// jagged edges.
    pub fn new(gpu: &Gpu, shaders: &Shaders, light: &wgpu::Buffer, smooth: bool) -> Self {
        let bindings = [
            BindingType::Uniform(size_of::<ToneUniform>()),
            BindingType::Uniform(size_of::<LightBuffer>()),
            BindingType::Texture,
            BindingType::Sampler,
            BindingType::Texture,
            BindingType::Texture,
        ];
        let layout = gpu.bind_group_layout("tone", wgpu::ShaderStages::FRAGMENT, &bindings);
        let constants = [("TONE_SMOOTH", f64::from(u8::from(smooth)))];
        let module = shaders.module(gpu, "film/tone");
        let program = RenderProgram { constants: &constants, ..RenderProgram::new(&module) };
        let onto = AttachmentFormats { formats: &[FINISHED_FORMAT], depth: None, blend: None };
        let pipeline = gpu.render_pipeline("tone", &program, &[&layout], &onto);
        let clamp = [wgpu::AddressMode::ClampToEdge; 2];
        let sampler = gpu.sampler("hdr", clamp, wgpu::MipmapFilterMode::Nearest);
        Self {
            uniform: Uniform::new(gpu, "tone"),
            light_buffer: light.clone(),
            layout,
            pipeline,
            sampler,
            bloom: BloomPass::new(gpu, shaders),
            local_exposure: LocalExposurePass::new(gpu, shaders),
            picture: None,
        }
    }

    /// Sets the picture `hdr` (linear light) that the pass reads, and allocates its finished picture, and
    /// the textures of bloom and local exposure if `film` has them. No-op if unchanged. Returns the finished picture.
    pub fn set_picture(&mut self, gpu: &Gpu, hdr: &wgpu::TextureView, film: &FilmLook) -> &wgpu::TextureView {
        let parts = PictureParts { bloom: film.bloom > 0.0, local_exposure: film.local_exposure > 0.0 };
        if let Some(old) = self.picture.take_if(|p| p.hdr != *hdr || p.parts != parts) {
            old.finished.texture().destroy();
        }
        let picture = self.picture.take().unwrap_or_else(|| self.bind_picture(gpu, hdr, parts));
        &self.picture.insert(picture).finished
    }

    fn bind_picture(&mut self, gpu: &Gpu, hdr: &wgpu::TextureView, parts: PictureParts) -> TonedPicture {
        let size = [hdr.texture().width(), hdr.texture().height()];
        self.bloom.set_picture(gpu, parts.bloom.then_some((hdr, size)));
        self.local_exposure.set_picture(gpu, parts.local_exposure.then_some(hdr));
        let resources = [
            self.uniform.buffer.as_entire_binding(),
            self.light_buffer.as_entire_binding(),
            wgpu::BindingResource::TextureView(hdr),
            wgpu::BindingResource::Sampler(&self.sampler),
            wgpu::BindingResource::TextureView(self.bloom.texture_view().unwrap_or(hdr)),
            wgpu::BindingResource::TextureView(self.local_exposure.texture_view().unwrap_or(hdr)),
        ];
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let finished = gpu.texture("finished picture", [size[0], size[1], 1], 1, FINISHED_FORMAT, usage);
        TonedPicture {
            hdr: hdr.clone(),
            parts,
            group: gpu.bind_group("tone", &self.layout, &resources),
            finished: finished.create_view(&wgpu::TextureViewDescriptor::default()),
        }
    }

    /// Writes the film settings of a scene, for a picture of `size` (width, height) pixels, to the uniform buffer. If
    /// `is_encoded`, the picture holds screen colours instead of light.
    pub fn write_uniform(&self, gpu: &Gpu, scene: &Scene, size: [u32; 2], is_encoded: bool) {
        let film = &scene.look.film;
        let fixed = NOON_EXPOSURE / night_gain(&scene.look.sky) as f32;
        let uniform = ToneUniform {
            size: size.map(|s| s as f32),
            exposure_gain: (film.exposure_ev.exp2() * if film.auto_exposure { camera_factor(scene) } else { 1.0 })
                as f32,
            fixed_exposure: if film.auto_exposure { 0.0 } else { fixed },
            curve: film.tone as u32,
            bloom_fraction: film.bloom as f32,
            dither: if film.dither { 1.0 / 255.0 } else { 0.0 },
            is_encoded: u32::from(is_encoded),
            local_exposure: film.local_exposure as f32,
            unused: [0.0; 3],
        };
        self.uniform.write(gpu, &uniform);
    }

    /// Records the compute passes that make the bloom of the picture last passed to `set_picture`, and find how bright its
    /// areas are; none for what is off.
    pub fn record_measures(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        self.bloom.run(encoder, timer);
        self.local_exposure.run(encoder, timer);
    }

    /// Records the pass, the last one of a frame, which draws the finished picture of [`Self::set_picture`]; nothing
    /// without a picture.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        let Some(picture) = &self.picture else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("tone"),
            color_attachments: &[Some(cleared_attachment(&picture.finished, wgpu::Color::BLACK))],
            timestamp_writes: timer.last_render_pass("tone"),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &picture.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
