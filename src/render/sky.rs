//! The sky: look-up tables of the clear air, the environment that the sea mirrors, the light on the sea, and the
//! background. Everything but the background is recorded only when the light changed.

use super::Scene;
use super::frame::dip;
use super::kit::{SceneGroup, Slot, Uniform, group, hdr_pipeline, layout};
use super::noise::NoiseTexture;
use super::targets::HDR_FORMAT;
use crate::gpu::layout::Layout;
use crate::gpu::shaders::Shaders;
use crate::model::look::SkyLook;
use bytemuck::{Pod, Zeroable};
use std::mem::offset_of;

const TRANSMITTANCE: [u32; 2] = [256, 64];
const MULTIPLE: [u32; 2] = [32, 32];
const VIEW: [u32; 2] = [192, 128];
const ENVIRONMENT: [u32; 2] = [256, 128];
/// Mips of the environment, down to 8 x 4.
const MIPS: u32 = 6;

/// WGSL `Sky`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SkyUniform {
    sun: [f32; 3],
    haze: f32,
    eye_km: f32,
    dip: f32,
    overcast: f32,
    drift: f32,
}

impl SkyUniform {
    /// For the layout test.
    pub const LAYOUT: Layout = (
        "Sky",
        &[
            ("sun", offset_of!(Self, sun)),
            ("haze", offset_of!(Self, haze)),
            ("eye_km", offset_of!(Self, eye_km)),
            ("dip", offset_of!(Self, dip)),
            ("overcast", offset_of!(Self, overcast)),
            ("drift", offset_of!(Self, drift)),
        ],
        size_of::<Self>(),
    );

    fn new(scene: &Scene) -> Self {
        // Classes of the eye's height, a quarter of an octave apart: the air seen from within one is the same.
        let class = (4.0 * scene.view.eye.y.max(2.0).log2()).round() / 4.0;
        let eye_m = class.exp2();
        Self {
            sun: sun(&scene.look.sky).map(|x| x as f32),
            haze: scene.look.sky.haze as f32,
            eye_km: (0.001 * eye_m) as f32,
            dip: dip(eye_m) as f32,
            overcast: scene.look.sky.overcast as f32,
            drift: 0.0,
        }
    }
}

/// WGSL `Light`: written by the GPU alone.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct LightBuffer {
    sun: [f32; 3],
    exposure: f32,
    sky: [f32; 3],
    key: f32,
    deck: [f32; 3],
    direct: f32,
}

impl LightBuffer {
    /// For the layout test.
    pub const LAYOUT: Layout = (
        "Light",
        &[
            ("sun", offset_of!(Self, sun)),
            ("exposure", offset_of!(Self, exposure)),
            ("sky", offset_of!(Self, sky)),
            ("key", offset_of!(Self, key)),
            ("deck", offset_of!(Self, deck)),
            ("direct", offset_of!(Self, direct)),
        ],
        size_of::<Self>(),
    );
}

/// Unit vector to the sun.
pub fn sun(look: &SkyLook) -> [f64; 3] {
    let (azimuth, elevation) = (look.sun_azimuth_deg.to_radians(), look.sun_deg.to_radians());
    [azimuth.sin() * elevation.cos(), elevation.sin(), -azimuth.cos() * elevation.cos()]
}

/// A compute pass with its resources.
struct Step {
    label: &'static str,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    groups: [u32; 2],
}

impl Step {
    fn new(
        device: &wgpu::Device,
        label: &'static str,
        (module, entry): (&wgpu::ShaderModule, &str),
        slots: &[Slot],
        resources: &[wgpu::BindingResource<'_>],
        groups: [u32; 2],
    ) -> Self {
        let layout = layout(device, label, wgpu::ShaderStages::COMPUTE, slots);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: Some(&pipeline_layout),
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { label, pipeline, group: group(device, label, &layout, resources), groups }
    }

    fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        let descriptor = wgpu::ComputePassDescriptor { label: Some(self.label), timestamp_writes: None };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(self.groups[0], self.groups[1], 1);
    }
}

/// The look-up tables and how they are made.
pub struct Sky {
    pub uniform: Uniform<SkyUniform>,
    pub light: wgpu::Buffer,
    pub transmittance: wgpu::TextureView,
    pub view: wgpu::TextureView,
    pub environment: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
    /// Of the air itself, then of the light in it.
    air: Vec<Step>,
    lit: Vec<Step>,
    made_for: Option<SkyUniform>,
}

impl Sky {
    /// Compiles the passes; nothing is computed yet.
    pub fn new(device: &wgpu::Device, shaders: &Shaders, noise: &NoiseTexture) -> Self {
        use wgpu::BindingResource::{Sampler, TextureView};
        let texture = |label, size: [u32; 2], mips| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: mips,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: HDR_FORMAT,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING,
                view_formats: &[],
            })
        };
        let whole = |t: &wgpu::Texture| t.create_view(&wgpu::TextureViewDescriptor::default());
        let mip = |t: &wgpu::Texture, level| {
            t.create_view(&wgpu::TextureViewDescriptor {
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        let uniform = Uniform::<SkyUniform>::new(device, "sky");
        let light = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("light"),
            size: size_of::<LightBuffer>() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("sky"),
            address_mode_u: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let transmittance = whole(&texture("sky/transmittance", TRANSMITTANCE, 1));
        let multiple = whole(&texture("sky/multiple", MULTIPLE, 1));
        let view = whole(&texture("sky/view", VIEW, 1));
        let surroundings = texture("sky/environment", ENVIRONMENT, MIPS);
        let environment = whole(&surroundings);
        let bottom = mip(&surroundings, 0);

        let (sky_slot, light_size) = (Slot::Uniform(size_of::<SkyUniform>()), size_of::<LightBuffer>());
        let sky = uniform.buffer.as_entire_binding();
        let tiles = |size: [u32; 2]| size.map(|s| s.div_ceil(8));
        let module = |name| shaders.module(device, name);
        let air = vec![
            Step::new(
                device,
                "sky/transmittance",
                (&module("sky_transmittance"), "main"),
                &[sky_slot, Slot::Image],
                &[sky.clone(), TextureView(&transmittance)],
                tiles(TRANSMITTANCE),
            ),
            Step::new(
                device,
                "sky/multiple",
                (&module("sky_multiple"), "main"),
                &[sky_slot, Slot::Texture, Slot::Sampler, Slot::Image],
                &[sky.clone(), TextureView(&transmittance), Sampler(&sampler), TextureView(&multiple)],
                tiles(MULTIPLE),
            ),
        ];
        let light_module = module("sky_light");
        let measure = |label, entry| {
            let slots = [
                sky_slot,
                Slot::Write(light_size),
                Slot::Texture,
                Slot::Texture,
                Slot::Sampler,
                Slot::Texture,
                Slot::Texture,
                Slot::Sampler,
            ];
            let resources = [
                sky.clone(),
                light.as_entire_binding(),
                TextureView(&transmittance),
                TextureView(&view),
                Sampler(&sampler),
                TextureView(&environment),
                TextureView(&noise.view),
                Sampler(&noise.sampler),
            ];
            Step::new(device, label, (&light_module, entry), &slots, &resources, [1, 1])
        };
        let mut lit = vec![
            Step::new(
                device,
                "sky/view",
                (&module("sky_view"), "main"),
                &[sky_slot, Slot::Texture, Slot::Texture, Slot::Sampler, Slot::Image],
                &[
                    sky.clone(),
                    TextureView(&transmittance),
                    TextureView(&multiple),
                    Sampler(&sampler),
                    TextureView(&view),
                ],
                tiles(VIEW),
            ),
            measure("sky/light clear", "clear"),
            Step::new(
                device,
                "sky/environment",
                (&module("sky_environment"), "main"),
                &[
                    sky_slot,
                    Slot::Read(light_size),
                    Slot::Texture,
                    Slot::Sampler,
                    Slot::Texture,
                    Slot::Sampler,
                    Slot::Image,
                ],
                &[
                    sky.clone(),
                    light.as_entire_binding(),
                    TextureView(&view),
                    Sampler(&sampler),
                    TextureView(&noise.view),
                    Sampler(&noise.sampler),
                    TextureView(&bottom),
                ],
                tiles(ENVIRONMENT),
            ),
        ];
        let filter = module("sky_filter");
        lit.extend((1..MIPS).map(|level| {
            let views = [mip(&surroundings, level - 1), mip(&surroundings, level)];
            let resources = [TextureView(&views[0]), TextureView(&views[1])];
            let size = ENVIRONMENT.map(|s| s >> level);
            Step::new(device, "sky/filter", (&filter, "main"), &[Slot::Texture, Slot::Image], &resources, tiles(size))
        }));
        lit.push(measure("sky/light whole", "whole"));
        Self { uniform, light, transmittance, view, environment, sampler, air, lit, made_for: None }
    }

    /// Records all tables.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        self.air.iter().chain(&self.lit).for_each(|step| step.run(encoder));
    }

    /// Records what the light of a scene makes stale.
    pub fn update(&mut self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, scene: &Scene) {
        let wanted = SkyUniform::new(scene);
        if self.made_for == Some(wanted) {
            return;
        }
        self.uniform.write(queue, &wanted);
        if self.made_for.is_none_or(|made| made.haze != wanted.haze) {
            self.air.iter().for_each(|step| step.run(encoder));
        }
        self.lit.iter().for_each(|step| step.run(encoder));
        self.made_for = Some(wanted);
    }
}

/// shaders/sky.wgsl: what stands behind the sea.
pub struct Background {
    pipeline: wgpu::RenderPipeline,
}

impl Background {
    /// Compiles the pass.
    pub fn new(device: &wgpu::Device, shaders: &Shaders, scene: &SceneGroup) -> Self {
        let module = shaders.module(device, "sky");
        Self { pipeline: hdr_pipeline(device, "sky", &module, &[Some(&scene.layout)], scene.film, false) }
    }

    /// Draws it.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &scene.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::device::Gpu;
    use crate::gpu::readback;

    /// Noon: the light on the sea is that of a clear day, and nothing is NaN.
    #[test]
    fn light_of_a_clear_noon() {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let noise = NoiseTexture::new(&gpu.device, &gpu.queue);
        let sky = Sky::new(&gpu.device, &Shaders::default(), &noise);
        let (s, c) = 60f32.to_radians().sin_cos();
        let uniform =
            SkyUniform { sun: [c, s, 0.0], haze: 1.0, eye_km: 0.008, dip: dip(8.0) as f32, overcast: 0.0, drift: 0.0 };
        sky.uniform.write(&gpu.queue, &uniform);
        for step in sky.air.iter().chain(&sky.lit) {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            step.run(&mut encoder);
            gpu.queue.submit([encoder.finish()]);
        }
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let copy = readback::stage_buffer(&gpu.device, &mut encoder, &sky.light);
        gpu.queue.submit([encoder.finish()]);
        let bytes = pollster::block_on(readback::read(&gpu.device, copy)).unwrap();
        let light: LightBuffer = bytemuck::pod_read_unaligned(&bytes);
        let green = |c: [f32; 3]| c[1] / 20.0;
        assert!((0.7..0.9).contains(&green(light.sun)), "{light:?}");
        assert!((0.06..0.2).contains(&green(light.sky)), "{light:?}");
        assert!(light.sky[2] > light.sky[0], "{light:?}");
    }
}
