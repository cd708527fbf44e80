//! Compute passes of the volumetric clouds: noise, weather, shadow and dome.

use super::cloud_field::CloudField;
use super::table_pass::{TABLE_USAGE, TablePass, volume_texture, workgroups};
use super::uniform::{LightBuffer, SkyUniform};
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, mip_view};
use crate::render::variants::switch_constant;
use crate::shaders::Shaders;
use wgpu::BindingResource::{Sampler, TextureView};

/// Side of the maps of weather and shadow, texels.
pub const MAP_SIDE: u32 = 256;
/// Side of the 3D noise, texels, for domes with fewer rows than [`FINE_NOISE_ROWS`] and for others.
const NOISE_SIDES: [u32; 2] = [64, 128];
const FINE_NOISE_ROWS: u32 = 512;
const NOISE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Tables of the sky that the passes of the clouds read.
pub struct SharedTables<'a> {
    pub sky: &'a wgpu::Buffer,
    pub light: &'a wgpu::Buffer,
    pub sky_view: &'a wgpu::TextureView,
    pub transmittance: &'a wgpu::TextureView,
    pub sampler: &'a wgpu::Sampler,
}

/// Uniforms of the passes of the maps and of the dome, and the textures that they fill for the picture.
pub struct CloudMaps<'a> {
    pub fields: [&'a wgpu::Buffer; 2],
    pub shadow: &'a wgpu::Texture,
    pub dome: &'a wgpu::TextureView,
}

/// Passes that compute clouds; compiled for the first picture that has any.
pub struct CloudPasses {
    pub noise: TablePass,
    pub noise_mips: Vec<TablePass>,
    pub weather: TablePass,
    pub shadow: TablePass,
    pub shadow_mips: Vec<TablePass>,
    pub dome: TablePass,
    /// Whether the noise has been computed.
    pub has_noise: bool,
}

fn repeating_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("clouds"),
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        address_mode_w: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    })
}

/// Passes of the shader module `name` that compute the mip levels of a texture with two or three dimensions.
fn mip_passes(gpu: &Gpu, shaders: &Shaders, name: &'static str, map: &wgpu::Texture) -> Vec<TablePass> {
    let module = shaders.module(gpu, name);
    let mut passes: Vec<TablePass> = Vec::new();
    for level in 1..map.mip_level_count() {
        let [from, to] = [level - 1, level].map(|i| mip_view(map, i));
        let size = [map.width() >> level, map.height() >> level];
        let (texture, image, groups) = if map.dimension() == wgpu::TextureDimension::D3 {
            let image = BindingType::StorageTexture3d(map.format());
            (BindingType::Texture3d, image, [size[0].div_ceil(4); 3])
        } else {
            (BindingType::Texture, BindingType::StorageTexture(map.format()), workgroups(size))
        };
        let bindings = [(texture, TextureView(&from)), (image, TextureView(&to))];
        passes.push(match passes.first() {
            Some(first) => first.with_resources(gpu, &bindings.map(|(_, resource)| resource), groups),
            None => TablePass::new(gpu, name, (&module, "main"), &bindings, groups),
        });
    }
    passes
}

impl CloudPasses {
    /// Compiles the passes, for a dome of the given size (columns, rows) with or without shafts of rain.
    pub fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        tables: &SharedTables<'_>,
        maps: &CloudMaps<'_>,
        (dome_size, has_squalls): ([u32; 2], bool),
    ) -> Self {
        let format = shaders.map_format(gpu).texture_format();
        let image = BindingType::StorageTexture(format);
        let side = NOISE_SIDES[usize::from(dome_size[1] >= FINE_NOISE_ROWS)];
        let noise_texture = volume_texture(gpu, "sky/cloud noise", [side; 3], side.ilog2() + 1, NOISE_FORMAT);
        let noise = noise_texture.create_view(&wgpu::TextureViewDescriptor::default());
        let finest_noise = mip_view(&noise_texture, 0);
        let weather = gpu.texture("sky/cloud weather", [MAP_SIDE, MAP_SIDE, 1], 1, format, TABLE_USAGE);
        let weather = weather.create_view(&wgpu::TextureViewDescriptor::default());
        let sampler = repeating_sampler(gpu);
        let shadow = mip_view(maps.shadow, 0);
        let whole_shadow = maps.shadow.create_view(&wgpu::TextureViewDescriptor::default());
        let [field, dome_field] =
            maps.fields.map(|field| (BindingType::Uniform(size_of::<CloudField>()), field.as_entire_binding()));
        let sky = (BindingType::Uniform(size_of::<SkyUniform>()), tables.sky.as_entire_binding());
        let light = (BindingType::StorageRead(size_of::<LightBuffer>()), tables.light.as_entire_binding());
        let weather_map = (BindingType::Texture, TextureView(&weather));
        let noise_map = (BindingType::Texture3d, TextureView(&noise));
        let repeat = (BindingType::Sampler, Sampler(&sampler));
        let pass = |name, bindings: &[(BindingType, wgpu::BindingResource<'_>)], groups| {
            let constants = [switch_constant("CLOUD_SQUALLS", has_squalls)];
            let constants = if name == "sky/cloud_dome" { &constants[..] } else { &[] };
            TablePass::with_constants(gpu, name, (&shaders.module(gpu, name), "main"), constants, bindings, groups)
        };
        let weather_bindings = [field.clone(), (image, TextureView(&weather))];
        let shadow_bindings =
            [field, sky.clone(), weather_map.clone(), noise_map.clone(), repeat.clone(), (image, TextureView(&shadow))];
        let dome_bindings = [
            dome_field,
            sky,
            light,
            (BindingType::Texture, TextureView(tables.sky_view)),
            (BindingType::Texture, TextureView(tables.transmittance)),
            (BindingType::Sampler, Sampler(tables.sampler)),
            weather_map,
            noise_map,
            repeat,
            (BindingType::Texture, TextureView(&whole_shadow)),
            (BindingType::StorageTextureArray(format), TextureView(maps.dome)),
        ];
        let noise_bindings = [(BindingType::StorageTexture3d(NOISE_FORMAT), TextureView(&finest_noise))];
        Self {
            noise: pass("sky/cloud_noise", &noise_bindings, [side / 4; 3]),
            noise_mips: mip_passes(gpu, shaders, "sky/cloud_noise_mips", &noise_texture),
            weather: pass("sky/cloud_weather", &weather_bindings, workgroups([MAP_SIDE; 2])),
            shadow: pass("sky/cloud_shadow", &shadow_bindings, workgroups([MAP_SIDE; 2])),
            shadow_mips: mip_passes(gpu, shaders, "sky/filter", maps.shadow),
            dome: pass("sky/cloud_dome", &dome_bindings, workgroups(dome_size)),
            has_noise: false,
        }
    }
}
