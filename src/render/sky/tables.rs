//! Look-up tables of the sky: clear air, the environment that the sea reflects, and the light on the sea
//! (shaders/sky/transmittance.wgsl, multiple.wgsl, view.wgsl, environment.wgsl, filter.wgsl, light.wgsl). They are
//! recomputed only if the light changes.

use super::cloud_field::Clouds;
use super::cloud_passes::SharedTables;
use super::clouds::{CloudPass, CloudView};
use super::panorama::PanoramaTextures;
use super::table_pass::{TABLE_USAGE, TablePass, volume_texture, workgroups};
use super::uniform::{LightBuffer, SkyUniform};
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, mip_view};
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::render::scene::Scene;
use crate::render::water::noise::NoiseTexture;
use crate::shaders::Shaders;
use wgpu::BindingResource::{Sampler, TextureView};

/// Size, texels, of the table of the air's transmittance: width for the ray's elevation, height for its start altitude.
const TRANSMITTANCE_SIZE: [u32; 2] = [256, 64];
const MULTIPLE_SCATTERING_SIZE: [u32; 2] = [64, 32];
const SKY_VIEW_SIZE: [u32; 2] = [192, 128];
const ENVIRONMENT_SIZE: [u32; 2] = [256, 128];
/// Number of mip levels of the environment map (the sky that the sea reflects), down to 8 x 4 texels.
const ENVIRONMENT_MIP_LEVELS: u32 = 6;
/// Size, texels, of the table of the mirrored sky: the two axes of its projection, and layers of growing spread
/// (shaders/sky/mirrored_map.wgsl).
const MIRRORED_SIZE: [u32; 3] = [128, 128, 6];
/// Number of workgroups, of 64 threads each, that sum the light of the sky over directions (shaders/sky/light.wgsl).
const LIGHT_WORKGROUPS: u32 = 4;
/// Size, bytes, of the buffer with the partial sums of the sky's light: for each thread 16 bytes, which are an RGB
/// irradiance and a luminance in f32.
const LIGHT_PARTS_BYTES: u64 = 16 * 64 * LIGHT_WORKGROUPS as u64;

/// Look-up tables of the sky (clear air, environment map, light on the sea), and the compute passes that fill them.
pub struct SkyTables {
    pub uniform: Uniform<SkyUniform>,
    pub light_buffer: wgpu::Buffer,
    pub transmittance: wgpu::TextureView,
    pub sky_view: wgpu::TextureView,
    pub environment: wgpu::TextureView,
    environment_texture: wgpu::Texture,
    /// The environment as rough water mirrors it: a stereographic projection by the spread of the mirrored rays.
    pub mirrored: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
    /// Textures of the sky image, if the sky comes from an image file.
    pub panorama: PanoramaTextures,
    /// Passes that do not depend on the position of the sun: transmittance of the air and multiple scattering in it.
    sun_independent_passes: Vec<TablePass>,
    /// Passes that depend on the position of the sun: clear sky, and the light on the sea without clouds.
    clear_passes: Vec<TablePass>,
    /// Passes that also depend on the clouds: environment map (reflected sky) and light on the sea.
    cloudy_passes: Vec<TablePass>,
    /// Volumetric clouds, if the scene has any.
    pub clouds: CloudPass,
    computed_for: Option<SkyUniform>,
}

impl SkyTables {
    /// Allocates the tables and compiles their passes; nothing is computed yet.
    pub fn new(gpu: &Gpu, shaders: &Shaders, noise: &NoiseTexture) -> Self {
        let format = shaders.map_format(gpu).texture_format();
        let texture =
            |label, [width, height]: [u32; 2], mips| gpu.texture(label, [width, height, 1], mips, format, TABLE_USAGE);
        let whole = |t: &wgpu::Texture| t.create_view(&wgpu::TextureViewDescriptor::default());
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_SRC;
        let surroundings = texture("sky/environment", ENVIRONMENT_SIZE, ENVIRONMENT_MIP_LEVELS);
        let mut sky = Self {
            uniform: Uniform::new(gpu, "sky"),
            light_buffer: gpu.buffer("light", size_of::<LightBuffer>() as u64, usage),
            transmittance: whole(&texture("sky/transmittance", TRANSMITTANCE_SIZE, 1)),
            sky_view: whole(&texture("sky/view", SKY_VIEW_SIZE, 1)),
            environment: whole(&surroundings),
            environment_texture: surroundings.clone(),
            mirrored: volume_texture(gpu, "sky/mirrored", MIRRORED_SIZE, 1, format)
                .create_view(&wgpu::TextureViewDescriptor::default()),
            sampler: gpu.sampler(
                "sky",
                [wgpu::AddressMode::Repeat, wgpu::AddressMode::ClampToEdge],
                wgpu::MipmapFilterMode::Linear,
            ),
            panorama: PanoramaTextures::new(gpu),
            sun_independent_passes: Vec::new(),
            clear_passes: Vec::new(),
            cloudy_passes: Vec::new(),
            clouds: CloudPass::new(gpu, shaders),
            computed_for: None,
        };
        let multiple_scattering = whole(&texture("sky/multiple", MULTIPLE_SCATTERING_SIZE, 1));
        sky.sun_independent_passes = sky.create_sun_independent_passes(gpu, shaders, &multiple_scattering);
        (sky.clear_passes, sky.cloudy_passes) =
            sky.create_sun_dependent_passes(gpu, shaders, noise, &multiple_scattering, &surroundings);
        sky
    }

    fn uniform_binding(&self) -> (BindingType, wgpu::BindingResource<'_>) {
        (BindingType::Uniform(size_of::<SkyUniform>()), self.uniform.buffer.as_entire_binding())
    }

    fn create_sun_independent_passes(
        &self,
        gpu: &Gpu,
        shaders: &Shaders,
        multiple_scattering: &wgpu::TextureView,
    ) -> Vec<TablePass> {
        let image = BindingType::StorageTexture(shaders.map_format(gpu).texture_format());
        vec![
            TablePass::new(
                gpu,
                "sky/transmittance",
                (&shaders.module(gpu, "sky/transmittance"), "main"),
                &[self.uniform_binding(), (image, TextureView(&self.transmittance))],
                workgroups(TRANSMITTANCE_SIZE),
            ),
            TablePass::new(
                gpu,
                "sky/multiple",
                (&shaders.module(gpu, "sky/multiple"), "main"),
                &[
                    self.uniform_binding(),
                    (BindingType::Texture, TextureView(&self.transmittance)),
                    (BindingType::Sampler, Sampler(&self.sampler)),
                    (image, TextureView(multiple_scattering)),
                ],
                workgroups(MULTIPLE_SCATTERING_SIZE),
            ),
        ]
    }

    fn create_sun_dependent_passes(
        &self,
        gpu: &Gpu,
        shaders: &Shaders,
        noise: &NoiseTexture,
        multiple_scattering: &wgpu::TextureView,
        surroundings: &wgpu::Texture,
    ) -> (Vec<TablePass>, Vec<TablePass>) {
        let image = BindingType::StorageTexture(shaders.map_format(gpu).texture_format());
        let view = TablePass::new(
            gpu,
            "sky/view",
            (&shaders.module(gpu, "sky/view"), "main"),
            &[
                self.uniform_binding(),
                (BindingType::Texture, TextureView(&self.transmittance)),
                (BindingType::Texture, TextureView(multiple_scattering)),
                (BindingType::Sampler, Sampler(&self.sampler)),
                (image, TextureView(&self.sky_view)),
            ],
            workgroups(SKY_VIEW_SIZE),
        );
        let environment = TablePass::new(
            gpu,
            "sky/environment",
            (&shaders.module(gpu, "sky/environment"), "main"),
            &self.environment_bindings(noise, &mip_view(surroundings, 0), image),
            workgroups(ENVIRONMENT_SIZE),
        );
        let filter = shaders.module(gpu, "sky/filter");
        let mut filters: Vec<TablePass> = Vec::new();
        for level in 1..ENVIRONMENT_MIP_LEVELS {
            let [from, to] = [level - 1, level].map(|i| mip_view(surroundings, i));
            let resources = [TextureView(&from), TextureView(&to)];
            let workgroups = workgroups(ENVIRONMENT_SIZE.map(|side| side >> level));
            filters.push(match filters.first() {
                Some(first) => first.with_resources(gpu, &resources, workgroups),
                None => {
                    let [from, to] = resources;
                    let bindings = [(BindingType::Texture, from), (image, to)];
                    TablePass::new(gpu, "sky/filter", (&filter, "main"), &bindings, workgroups)
                }
            });
        }
        let [width, height, layers] = MIRRORED_SIZE;
        let mirrored = TablePass::new(
            gpu,
            "sky/mirrored",
            (&shaders.module(gpu, "sky/mirrored"), "main"),
            &[
                (BindingType::Texture, TextureView(&self.environment)),
                (BindingType::Sampler, Sampler(&self.sampler)),
                (BindingType::StorageTexture3d(shaders.map_format(gpu).texture_format()), TextureView(&self.mirrored)),
            ],
            [width.div_ceil(8), height.div_ceil(8), layers],
        );
        let [clear_irradiance_parts, clear, sky_irradiance_parts, whole] = self.create_light_passes(gpu, shaders);
        let cloudy = [environment].into_iter().chain(filters).chain([mirrored, sky_irradiance_parts, whole]);
        (vec![view, clear_irradiance_parts, clear], cloudy.collect())
    }

    /// The four passes that integrate the sky's light over all directions: partial sums and total without clouds, which
    /// the environment map needs, then partial sums and total with clouds.
    fn create_light_passes(&self, gpu: &Gpu, shaders: &Shaders) -> [TablePass; 4] {
        let parts = gpu.storage_buffer("light/parts", LIGHT_PARTS_BYTES);
        let module = shaders.module(gpu, "sky/light");
        let bindings = [
            self.uniform_binding(),
            (BindingType::StorageReadWrite(size_of::<LightBuffer>()), self.light_buffer.as_entire_binding()),
            (BindingType::Texture, TextureView(&self.transmittance)),
            (BindingType::Texture, TextureView(&self.sky_view)),
            (BindingType::Sampler, Sampler(&self.sampler)),
            (BindingType::Texture, TextureView(&self.environment)),
            (BindingType::Texture, TextureView(&self.clouds.shadow)),
            (BindingType::StorageReadWrite(LIGHT_PARTS_BYTES as usize), parts.as_entire_binding()),
        ];
        [
            ("sky/light clear parts", "clear_irradiance_parts", LIGHT_WORKGROUPS),
            ("sky/light clear", "clear_irradiance", 1),
            ("sky/light whole parts", "sky_irradiance_parts", LIGHT_WORKGROUPS),
            ("sky/light whole", "sky_irradiance", 1),
        ]
        .map(|(label, entry, groups)| TablePass::new(gpu, label, (&module, entry), &bindings, [groups, 1, 1]))
    }

    /// Bindings of the pass that computes the environment map, whose finest level is `finest`.
    fn environment_bindings<'a>(
        &'a self,
        noise: &'a NoiseTexture,
        finest: &'a wgpu::TextureView,
        image: BindingType,
    ) -> [(BindingType, wgpu::BindingResource<'a>); 10] {
        [
            self.uniform_binding(),
            (BindingType::StorageRead(size_of::<LightBuffer>()), self.light_buffer.as_entire_binding()),
            (BindingType::Texture, TextureView(&self.sky_view)),
            (BindingType::Sampler, Sampler(&self.sampler)),
            (BindingType::TextureArray, TextureView(&noise.view)),
            (BindingType::Sampler, Sampler(&noise.sampler)),
            (BindingType::Texture, TextureView(&self.panorama.without_sun_view)),
            (BindingType::Uniform(size_of::<CloudView>()), self.clouds.view.buffer.as_entire_binding()),
            (BindingType::TextureArray, TextureView(&self.clouds.dome)),
            (image, TextureView(finest)),
        ]
    }

    /// Creates the dome of clouds that a picture of `scene`, `width` pixels wide, needs, unless it exists already.
    pub fn prepare_clouds(&mut self, gpu: &Gpu, scene: &Scene, width: u32, noise: &NoiseTexture) {
        let tables = SharedTables {
            sky: &self.uniform.buffer,
            light: &self.light_buffer,
            sky_view: &self.sky_view,
            transmittance: &self.transmittance,
            sampler: &self.sampler,
        };
        if self.clouds.prepare(gpu, scene, width, &tables) {
            let format = self.environment_texture.format();
            let finest = mip_view(&self.environment_texture, 0);
            let bindings = self.environment_bindings(noise, &finest, BindingType::StorageTexture(format));
            let resources = bindings.map(|(_, resource)| resource);
            let pass = self.cloudy_passes[0].with_resources(gpu, &resources, workgroups(ENVIRONMENT_SIZE));
            self.cloudy_passes[0] = pass;
        }
    }

    /// Records the passes that compute all tables of the sky, even those that are up to date.
    pub fn record_all_tables(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        let passes = self.sun_independent_passes.iter().chain(&self.clear_passes).chain(&self.cloudy_passes);
        passes.for_each(|pass| pass.run(encoder, timer));
    }

    /// Writes the sky's uniform buffer for a scene, and records the passes of the tables that do not match this scene.
    pub fn record_outdated_tables(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        scene: &Scene,
    ) {
        let wanted = SkyUniform::new(scene);
        let other_file = self.panorama.set_image(gpu, scene.look.sky.panorama());
        let before = self.computed_for.replace(wanted);
        if before != Some(wanted) {
            self.uniform.write(gpu, &wanted);
        }
        let mut is_outdated = other_file || before.is_none_or(|made| !made.same_tables_as(&wanted));
        if before.is_none_or(|made| !made.same_air_tables_as(&wanted)) {
            self.sun_independent_passes.iter().for_each(|pass| pass.run(encoder, timer));
        }
        let clouds = Clouds::new(scene);
        if let Some(clouds) = &clouds {
            is_outdated |= self.clouds.record_maps(gpu, encoder, timer, clouds, &wanted);
        }
        if is_outdated {
            self.clear_passes.iter().for_each(|pass| pass.run(encoder, timer));
        }
        match &clouds {
            Some(clouds) => {
                if self.clouds.record_dome(gpu, encoder, timer, scene, (clouds, &wanted)) && !is_outdated {
                    // The passes that follow begin with the light of the clear sky.
                    self.clear_passes.iter().for_each(|pass| pass.run(encoder, timer));
                    is_outdated = true;
                }
            }
            None => self.clouds.clear(gpu),
        }
        if is_outdated {
            self.cloudy_passes.iter().for_each(|pass| pass.run(encoder, timer));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::readback;
    use crate::render::film::tone::NOON_EXPOSURE;
    use crate::render::sky::uniform::night_gain;
    use crate::state::look::SkyLook;

    /// Light on the sea under each of the given skies.
    fn lights(skies: &[SkyLook]) -> Vec<LightBuffer> {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let noise = NoiseTexture::new(&gpu);
        noise.fill(&gpu);
        let shaders = Shaders::default().with_structs(crate::render::SHARED_STRUCTS);
        let sky = SkyTables::new(&gpu, &shaders, &noise);
        let light = |look: &SkyLook| {
            sky.uniform.write(&gpu, &SkyUniform::for_look(look, 8.0));
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            sky.sun_independent_passes
                .iter()
                .chain(&sky.clear_passes)
                .chain(&sky.cloudy_passes)
                .for_each(|pass| pass.run(&mut encoder, &Timer::default()));
            let copy = readback::stage_buffer(&gpu, &mut encoder, &sky.light_buffer);
            gpu.submit(encoder);
            let bytes = pollster::block_on(readback::read(&gpu, copy)).unwrap();
            bytemuck::pod_read_unaligned(&bytes)
        };
        skies.iter().map(light).collect()
    }

    fn at(sun_elevation_deg: f64) -> SkyLook {
        SkyLook { sun_elevation_deg, ..SkyLook::default() }
    }

    /// Illuminance of a horizontal plane by `light`, lux, if the sun above the atmosphere gives 128 klx.
    fn lux(light: &LightBuffer, look: &SkyLook) -> f64 {
        let up = look.sun_direction()[1].max(0.0);
        let e: Vec<f64> =
            (0..3).map(|i| f64::from(light.sky_irradiance[i]) + f64::from(light.sun_irradiance[i]) * up).collect();
        (0.2126 * e[0] + 0.7152 * e[1] + 0.0722 * e[2]) / night_gain(look) * 6400.0
    }

    /// At noon the sea has the light of a clear day, and the automatic exposure equals [`NOON_EXPOSURE`].
    #[test]
    fn light_of_a_clear_noon() {
        let light = lights(&[at(60.0)])[0];
        let green = |c: [f32; 3]| c[1] / 20.0;
        assert!((0.7..0.9).contains(&green(light.sun_irradiance)), "{light:?}");
        assert!((0.06..0.2).contains(&green(light.sky_irradiance)), "{light:?}");
        assert!(light.sky_irradiance[2] > light.sky_irradiance[0], "{light:?}");
        assert!((light.exposure / NOON_EXPOSURE - 1.0).abs() < 0.02, "{light:?}");
    }

    /// Clear skies at noon, at sunset, at the end of civil twilight and in a moonless night give a horizontal plane the
    /// illuminances of Seidelmann (Explanatory Supplement, 1992), within the factor given for each.
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
