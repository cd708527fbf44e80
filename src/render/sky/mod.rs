//! The sky: look-up tables of the clear air, the environment that the sea mirrors, the light on the sea, and the
//! background. Everything but the background is recorded only when the light changed.

pub mod background;
pub mod panorama;

use super::Scene;
use super::frame::dip;
use super::kit::{Slot, Uniform, group, layout};
use super::water::noise::NoiseTexture;
use crate::gpu::layout::Layout;
use crate::gpu::shaders::Shaders;
use crate::state::fields::linear_rgb;
use crate::state::look::SkyLook;
use bytemuck::{Pod, Zeroable};
use panorama::PanoramaTextures;
use std::mem::offset_of;

const TRANSMITTANCE: [u32; 2] = [256, 64];
const MULTIPLE: [u32; 2] = [64, 32];
const VIEW: [u32; 2] = [192, 128];
const ENVIRONMENT: [u32; 2] = [256, 128];
/// Workgroups of 64 threads that sum the light, and the bytes of their sums (shaders/sky/light.wgsl).
const LIGHT_GROUPS: u32 = 4;
const LIGHT_PARTS_BYTES: u64 = 16 * 64 * LIGHT_GROUPS as u64;
/// Mips of the environment, down to 8 x 4.
const MIPS: u32 = 6;

/// How far the clouds drift before the sea mirrors them anew, km: every few seconds, less than a texel of the environment.
const MIRROR_STEP_KM: f64 = 0.05;

/// WGSL `Sky`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SkyUniform {
    sun: [f32; 3],
    haze: f32,
    tint: [f32; 3],
    sun_radius: f32,
    file_sun: [f32; 3],
    file: f32,
    file_sky: [f32; 3],
    file_gain: f32,
    fog: [f32; 4],
    eye_km: f32,
    dip: f32,
    overcast: f32,
    sun_falloff: f32,
    drift: [f32; 2],
    mirror_drift: [f32; 2],
    unit: f32,
    turn: f32,
    pad: [f32; 2],
}

macro_rules! offsets {
    ($kind:ty: $($field:ident),+) => { &[$((stringify!($field), offset_of!($kind, $field))),+] };
}

impl SkyUniform {
    /// For the layout test.
    pub const LAYOUT: Layout = (
        "Sky",
        offsets!(Self: sun, haze, tint, sun_radius, file_sun, file, file_sky, file_gain, fog, eye_km, dip, overcast,
            sun_falloff, drift, mirror_drift, unit, turn),
        size_of::<Self>(),
    );

    fn new(scene: &Scene) -> Self {
        // Classes of the eye's height, a quarter of an octave apart: the air seen from within one is the same.
        let class = (4.0 * scene.view.eye.y.max(2.0).log2()).round() / 4.0;
        let mut sky = Self::of(&scene.look.sky, class.exp2());
        if sky.overcast > 0.0 {
            let km = scene.sea.cloud_drift_m.map(|d| 0.001 * d);
            sky.drift = km.map(|d| d as f32);
            sky.mirror_drift = km.map(|d| ((d / MIRROR_STEP_KM).round() * MIRROR_STEP_KM) as f32);
        }
        sky
    }

    fn of(look: &SkyLook, eye_m: f64) -> Self {
        let unit = unit(look);
        let near = look.sun_distance_au.recip();
        let file = look.panorama();
        let file_gain = look.file_gain_ev.exp2();
        let scaled = |e: [f64; 3]| e.map(|e| (e * file_gain) as f32);
        Self {
            sun: look.sun_direction().map(|x| x as f32),
            haze: look.haze as f32,
            tint: linear_rgb(look.sun_colour).map(|c| (c * near * near * unit) as f32),
            sun_radius: look.sun_radius_rad() as f32,
            file_sun: file.and_then(|f| f.sun.as_ref()).map_or([0.0; 3], |s| scaled(s.irradiance)),
            file: f32::from(u8::from(file.is_some())),
            file_sky: file.map_or([0.0; 3], |f| scaled(f.irradiance)),
            file_gain: file_gain as f32,
            fog: [
                (0.001 * look.fog_extinction_per_km) as f32,
                look.fog_start_m as f32,
                look.fog_falloff_m as f32,
                look.fog_height_m as f32,
            ],
            eye_km: (0.001 * eye_m) as f32,
            dip: dip(eye_m) as f32,
            // The file has clouds of its own.
            overcast: if file.is_some() { 0.0 } else { look.overcast as f32 },
            sun_falloff: look.sun_falloff as f32,
            drift: [0.0; 2],
            mirror_drift: [0.0; 2],
            unit: unit as f32,
            turn: (look.file_heading_deg / 360.0) as f32,
            pad: [0.0; 2],
        }
    }
}

/// How many times brighter than it is the light of dusk and night is carried: a power of two, so that nothing is rounded.
pub fn unit(look: &SkyLook) -> f64 {
    let below_deg = if look.panorama().is_some() { 0.0 } else { -look.sun_place_deg()[0] };
    (1.2 * below_deg).clamp(0.0, 18.0).floor().exp2()
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
    fog_sky: [f32; 3],
    pad_0: f32,
    fog_sun: [f32; 3],
    pad_1: f32,
}

impl LightBuffer {
    /// For the layout test.
    pub const LAYOUT: Layout =
        ("Light", offsets!(Self: sun, exposure, sky, key, deck, direct, fog_sky, fog_sun), size_of::<Self>());
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
    /// A sky from a file.
    pub panorama: PanoramaTextures,
    /// Of the air itself, then of the light in it.
    air: Vec<Step>,
    lit: Vec<Step>,
    made_for: Option<SkyUniform>,
}

impl Sky {
    /// Compiles the passes; nothing is computed yet.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, shaders: &Shaders, noise: &NoiseTexture) -> Self {
        use wgpu::BindingResource::{Sampler, TextureView};
        let maps = shaders.maps(device);
        let texture = |label, size: [u32; 2], mips| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: mips,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: maps.texture(),
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
        let panorama = PanoramaTextures::new(device, queue);
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
                &[sky_slot, Slot::Image(maps)],
                &[sky.clone(), TextureView(&transmittance)],
                tiles(TRANSMITTANCE),
            ),
            Step::new(
                device,
                "sky/multiple",
                (&module("sky_multiple"), "main"),
                &[sky_slot, Slot::Texture, Slot::Sampler, Slot::Image(maps)],
                &[sky.clone(), TextureView(&transmittance), Sampler(&sampler), TextureView(&multiple)],
                tiles(MULTIPLE),
            ),
        ];
        let light_module = module("sky_light");
        let light_parts = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("light/parts"),
            size: LIGHT_PARTS_BYTES,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let measure = |label, entry, groups| {
            let slots = [
                sky_slot,
                Slot::Write(light_size),
                Slot::Texture,
                Slot::Texture,
                Slot::Sampler,
                Slot::Texture,
                Slot::Texture,
                Slot::Sampler,
                Slot::Write(LIGHT_PARTS_BYTES as usize),
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
                light_parts.as_entire_binding(),
            ];
            Step::new(device, label, (&light_module, entry), &slots, &resources, [groups, 1])
        };
        let mut lit = vec![
            Step::new(
                device,
                "sky/view",
                (&module("sky_view"), "main"),
                &[sky_slot, Slot::Texture, Slot::Texture, Slot::Sampler, Slot::Image(maps)],
                &[
                    sky.clone(),
                    TextureView(&transmittance),
                    TextureView(&multiple),
                    Sampler(&sampler),
                    TextureView(&view),
                ],
                tiles(VIEW),
            ),
            measure("sky/light clear parts", "clear_parts", LIGHT_GROUPS),
            measure("sky/light clear", "clear", 1),
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
                    Slot::Texture,
                    Slot::Image(maps),
                ],
                &[
                    sky.clone(),
                    light.as_entire_binding(),
                    TextureView(&view),
                    Sampler(&sampler),
                    TextureView(&noise.view),
                    Sampler(&noise.sampler),
                    TextureView(&panorama.calm_view),
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
            Step::new(
                device,
                "sky/filter",
                (&filter, "main"),
                &[Slot::Texture, Slot::Image(maps)],
                &resources,
                tiles(size),
            )
        }));
        lit.push(measure("sky/light whole parts", "whole_parts", LIGHT_GROUPS));
        lit.push(measure("sky/light whole", "whole", 1));
        Self { uniform, light, transmittance, view, environment, sampler, panorama, air, lit, made_for: None }
    }

    /// Records all tables.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        self.air.iter().chain(&self.lit).for_each(|step| step.run(encoder));
    }

    /// Records what the light of a scene makes stale.
    pub fn update(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
    ) {
        let wanted = SkyUniform::new(scene);
        let other_file = self.panorama.show(device, queue, scene.look.sky.panorama());
        if self.made_for == Some(wanted) && !other_file {
            return;
        }
        self.uniform.write(queue, &wanted);
        // Clouds drift over the background alone.
        let lit = |u: SkyUniform| SkyUniform { drift: [0.0; 2], ..u };
        if self.made_for.is_some_and(|made| lit(made) == lit(wanted)) && !other_file {
            self.made_for = Some(wanted);
            return;
        }
        let air = |u: SkyUniform| [u.haze, u.sun_radius];
        if self.made_for.is_none_or(|made| air(made) != air(wanted)) {
            self.air.iter().for_each(|step| step.run(encoder));
        }
        self.lit.iter().for_each(|step| step.run(encoder));
        self.made_for = Some(wanted);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::device::Gpu;
    use crate::gpu::readback;
    use crate::render::film::present::NOON_EXPOSURE;

    /// The light on the sea under some skies.
    fn lights(skies: &[SkyLook]) -> Vec<LightBuffer> {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let noise = NoiseTexture::new(&gpu.device);
        noise.fill(&gpu.queue);
        let sky = Sky::new(&gpu.device, &gpu.queue, &Shaders::default(), &noise);
        let light = |look: &SkyLook| {
            sky.uniform.write(&gpu.queue, &SkyUniform::of(look, 8.0));
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            sky.air.iter().chain(&sky.lit).for_each(|step| step.run(&mut encoder));
            let copy = readback::stage_buffer(&gpu.device, &mut encoder, &sky.light);
            gpu.queue.submit([encoder.finish()]);
            let bytes = pollster::block_on(readback::read(&gpu.device, copy)).unwrap();
            bytemuck::pod_read_unaligned(&bytes)
        };
        skies.iter().map(light).collect()
    }

    fn at(sun_deg: f64) -> SkyLook {
        SkyLook { sun_deg, ..SkyLook::default() }
    }

    /// Illuminance on the horizontal, lux: the sun above the air gives 128 klx.
    fn lux(light: &LightBuffer, look: &SkyLook) -> f64 {
        let up = look.sun_direction()[1].max(0.0);
        let e: Vec<f64> = (0..3).map(|i| f64::from(light.sky[i]) + f64::from(light.sun[i]) * up).collect();
        (0.2126 * e[0] + 0.7152 * e[1] + 0.0722 * e[2]) / unit(look) * 6400.0
    }

    /// Noon: the light on the sea is that of a clear day, and the film that does not adapt knows its exposure.
    #[test]
    fn light_of_a_clear_noon() {
        let light = lights(&[at(60.0)])[0];
        let green = |c: [f32; 3]| c[1] / 20.0;
        assert!((0.7..0.9).contains(&green(light.sun)), "{light:?}");
        assert!((0.06..0.2).contains(&green(light.sky)), "{light:?}");
        assert!(light.sky[2] > light.sky[0], "{light:?}");
        assert!((light.exposure / NOON_EXPOSURE - 1.0).abs() < 0.02, "{light:?}");
    }

    /// Clear-sky illuminances on the horizontal at noon, with the sun on the horizon, at the end of civil twilight and on a
    /// moonless night (Seidelmann, Explanatory Supplement to the Astronomical Almanac, 1992), within a factor.
    #[test]
    fn light_from_noon_to_night() {
        let cases = [(60.0, 9.5e4, 1.3), (0.0, 700.0, 2.0), (-6.0, 3.4, 3.0), (-24.0, 1.5e-3, 2.5)];
        let skies = cases.map(|(sun, ..)| at(sun));
        let mut before = f64::INFINITY;
        for ((light, look), (sun, expected, factor)) in lights(&skies).iter().zip(&skies).zip(cases) {
            let found = lux(light, look);
            eprintln!("sun {sun}: {found:.3e} lx, {light:?}");
            assert!(found < before && (expected / factor..expected * factor).contains(&found), "{sun}: {found} lx");
            before = found;
        }
    }
}
