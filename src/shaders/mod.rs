//! All shader modules, joined from plain WGSL files. WGSL names begin with their file's topic (`sea_`, `noise_`).

pub mod fft;
pub mod unrolled;

use crate::gpu::Gpu;
use crate::gpu::layout::StructDeclaration;
use crate::gpu::map_format::MapFormat;
use std::collections::BTreeMap;
use unrolled::UnrolledKernel;

/// A piece of the text that a shader module is joined from.
enum SourcePart {
    /// The text of one WGSL file.
    File(&'static str),
    /// Several parts of a module's text, to be joined in this order.
    Group(&'static [SourcePart]),
}

impl SourcePart {
    /// Texts of the WGSL files of this part of a shader module, in the order in which they are joined.
    fn files(&self) -> Vec<&'static str> {
        match self {
            Self::File(text) => vec![*text],
            Self::Group(parts) => parts.iter().flat_map(Self::files).collect(),
        }
    }
}

macro_rules! part {
    ($file:literal) => {
        SourcePart::File(include_str!(concat!(env!("OUT_DIR"), "/shaders/", $file)))
    };
}

const MATHS: SourcePart = part!("common/maths.wgsl");
const SEA: SourcePart = part!("common/sea.wgsl");
const NOISE: SourcePart = part!("common/noise.wgsl");
const SCREEN: SourcePart = part!("common/screen.wgsl");
const TILES: SourcePart = part!("common/tiles.wgsl");
const FFT: SourcePart = part!("waves/fft.wgsl");
const WORKGROUP_FFT: SourcePart = part!("waves/workgroup_fft.wgsl");
const EVOLVE: SourcePart = part!("waves/evolve.wgsl");
const MIP_MEAN: SourcePart = part!("waves/mip_mean.wgsl");
/// WGSL functions for the waves that a coast transforms.
const COAST: SourcePart = part!("coast/waves.wgsl");
const ATMOSPHERE: SourcePart = part!("sky/atmosphere.wgsl");
const SKY_COMMON: SourcePart = part!("sky/common.wgsl");
const VIEWS: SourcePart = part!("views/common.wgsl");
/// WGSL for the passes that compute the sky's look-up tables of scattered and transmitted light without clouds.
const AIR_TABLES: SourcePart = SourcePart::Group(&[ATMOSPHERE, SKY_COMMON]);
/// WGSL functions for the radiance of the sky without clouds in a given direction, and for fog.
const SKY: SourcePart =
    SourcePart::Group(&[AIR_TABLES, part!("sky/model.wgsl"), part!("sky/fog.wgsl"), part!("sky/rainbow.wgsl")]);
/// WGSL functions that read the map of the land, for its colours, and for what rises before a point.
const LAND: SourcePart =
    SourcePart::Group(&[part!("land/map.wgsl"), part!("land/albedo.wgsl"), part!("land/horizon.wgsl")]);
/// WGSL for every pass that draws on the HDR picture: uniforms and textures of the scene, radiance of the sky, and the
/// effect of the air between eye and sea on light.
const PICTURE: SourcePart = SourcePart::Group(&[
    SKY,
    part!("common/frame.wgsl"),
    part!("common/scene.wgsl"),
    part!("sky/air.wgsl"),
    part!("sky/cloud_sun.wgsl"),
]);
/// WGSL functions for the radiance of the sky with clouds.
const CLOUDY_SKY: SourcePart = SourcePart::Group(&[CLOUD_MAP, part!("sky/clouds.wgsl")]);
const CLOUD_MAP: SourcePart = part!("sky/cloud_map.wgsl");
const CLOUD_KINDS: SourcePart = part!("sky/cloud_kinds.wgsl");
const CLOUD_FIELD: SourcePart =
    SourcePart::Group(&[CLOUD_KINDS, part!("sky/cloud_field.wgsl"), part!("sky/cirrus.wgsl")]);
/// WGSL mapping of the table of the mirrored sky.
const MIRRORED_MAP: SourcePart = part!("sky/mirrored_map.wgsl");
/// WGSL functions for the position of the water surface, displaced by the waves.
const SURFACE: SourcePart = SourcePart::Group(&[
    MATHS,
    NOISE,
    TILES,
    part!("water/mesh.wgsl"),
    part!("water/coast_map.wgsl"),
    part!("water/foam_map.wgsl"),
    part!("water/spline.wgsl"),
    part!("water/coast.wgsl"),
    part!("water/surface.wgsl"),
    part!("water/surf.wgsl"),
    part!("water/breaker.wgsl"),
]);
/// WGSL for passes that find the displaced water surface but do not shade it.
const BARE_SURFACE: SourcePart = SourcePart::Group(&[part!("common/frame.wgsl"), SURFACE]);
/// WGSL functions that shade the water: roughness, reflection, light from below the surface, and foam.
const WATER: SourcePart = SourcePart::Group(&[
    PICTURE,
    SURFACE,
    part!("water/footprint.wgsl"),
    part!("water/gusts.wgsl"),
    part!("water/slope.wgsl"),
    part!("water/displaced_slope.wgsl"),
    part!("water/shadow_sun.wgsl"),
    part!("water/shadow.wgsl"),
    part!("water/material.wgsl"),
    part!("water/fresnel.wgsl"),
    part!("water/facets.wgsl"),
    MIRRORED_MAP,
    part!("water/glints.wgsl"),
    part!("water/mirror.wgsl"),
    part!("water/mirrored_rays.wgsl"),
    part!("water/hull_image.wgsl"),
    part!("water/body.wgsl"),
    part!("water/crest.wgsl"),
    LAND,
    part!("land/mirrored.wgsl"),
    part!("water/bed.wgsl"),
    part!("water/shore.wgsl"),
    part!("water/foam.wgsl"),
    part!("water/foam_pattern.wgsl"),
    part!("water/foam_look.wgsl"),
    part!("water/foam_light.wgsl"),
    part!("water/wake.wgsl"),
    part!("water/rings.wgsl"),
    part!("water/water.wgsl"),
]);

/// WGSL functions for the water's light in the lean tier.
const LEAN: SourcePart = SourcePart::Group(&[part!("water/lean_slope.wgsl"), part!("water/lean.wgsl")]);

/// WGSL vertex shader and functions of the passes that light the pixels of the G-buffer.
const LIT_PIXEL: SourcePart = part!("common/lit_pixel.wgsl");

/// WGSL functions for light in the water, and for the surface and the bed as they are seen from below.
const UNDER: SourcePart =
    SourcePart::Group(&[part!("water/medium.wgsl"), part!("water/ceiling.wgsl"), part!("water/floor.wgsl")]);

/// WGSL type of a map texel in a storage buffer, with half floats; `MAP_TEXEL_FLOAT` is the type with 32-bit floats.
const MAP_TEXEL_HALF: &str = include_str!(concat!(env!("OUT_DIR"), "/shaders/waves/map_texel_half.wgsl"));
const MAP_TEXEL_FLOAT: &str = include_str!(concat!(env!("OUT_DIR"), "/shaders/waves/map_texel_float.wgsl"));

/// Name of each shader module, and the parts that are joined to its WGSL text. The last part holds the entry points;
/// the module has the name of that part's file, without `.wgsl`.
const MODULES: &[(&str, &[SourcePart])] = &[
    ("waves/spectrum", &[MATHS, SEA, NOISE, part!("waves/spectrum.wgsl")]),
    ("waves/rows", &[MATHS, SEA, FFT, WORKGROUP_FFT, EVOLVE, part!("waves/rows.wgsl")]),
    ("waves/columns", &[SEA, FFT, WORKGROUP_FFT, part!("waves/columns.wgsl")]),
    ("waves/mips", &[SEA, MIP_MEAN, part!("waves/mips.wgsl")]),
    ("waves/unrolled_rows_first", &[MATHS, SEA, FFT, EVOLVE, part!("waves/unrolled_rows_first.wgsl")]),
    ("waves/unrolled_rows_second", &[FFT, part!("waves/unrolled_rows_second.wgsl")]),
    ("waves/unrolled_columns_first", &[FFT, part!("waves/unrolled_columns_first.wgsl")]),
    ("waves/unrolled_columns_second", &[FFT, part!("waves/unrolled_columns_second.wgsl")]),
    ("waves/unrolled_mips", &[SEA, MIP_MEAN, part!("waves/unrolled_mips.wgsl")]),
    ("coast/split", &[COAST, part!("coast/split.wgsl")]),
    ("coast/phasors", &[MATHS, SEA, COAST, part!("coast/phasors.wgsl")]),
    ("coast/envelopes", &[MATHS, part!("coast/envelopes.wgsl")]),
    ("coast/sum", &[MATHS, part!("coast/sum.wgsl")]),
    ("coast/gradients", &[part!("coast/gradients.wgsl")]),
    ("foam/foam", &[MATHS, SEA, NOISE, TILES, part!("foam/foam.wgsl")]),
    ("sky/transmittance", &[AIR_TABLES, part!("sky/transmittance.wgsl")]),
    ("sky/multiple", &[AIR_TABLES, part!("sky/multiple.wgsl")]),
    ("sky/view", &[AIR_TABLES, part!("sky/view.wgsl")]),
    ("sky/cloud_noise", &[MATHS, NOISE, part!("sky/cloud_noise.wgsl")]),
    ("sky/cloud_noise_mips", &[part!("sky/cloud_noise_mips.wgsl")]),
    ("sky/cloud_weather", &[MATHS, NOISE, ATMOSPHERE, CLOUD_KINDS, part!("sky/cloud_weather.wgsl")]),
    ("sky/cloud_shadow", &[AIR_TABLES, CLOUD_FIELD, part!("sky/cloud_shadow.wgsl")]),
    (
        "sky/cloud_dome",
        &[
            SKY,
            CLOUD_MAP,
            CLOUD_FIELD,
            part!("sky/cloud_rays.wgsl"),
            part!("sky/squalls.wgsl"),
            part!("sky/dome_cirrus.wgsl"),
            part!("sky/cloud_light.wgsl"),
            part!("sky/cloud_dome.wgsl"),
        ],
    ),
    ("sky/environment", &[SKY, CLOUDY_SKY, part!("sky/environment.wgsl")]),
    ("sky/filter", &[part!("sky/filter.wgsl")]),
    ("sky/mirrored", &[SKY_COMMON, MIRRORED_MAP, part!("sky/mirrored.wgsl")]),
    ("sky/light", &[SKY, part!("sky/light.wgsl")]),
    ("sky/background", &[MATHS, NOISE, PICTURE, CLOUDY_SKY, part!("sky/background.wgsl")]),
    ("water/displace", &[BARE_SURFACE, part!("water/shadow.wgsl"), part!("water/displace.wgsl")]),
    ("water/eye", &[BARE_SURFACE, part!("water/eye.wgsl")]),
    ("water/light", &[WATER, LEAN, LIT_PIXEL, part!("water/light.wgsl")]),
    (
        "water/under",
        &[
            WATER,
            LEAN,
            LIT_PIXEL,
            part!("water/light.wgsl"),
            UNDER,
            part!("water/shafts.wgsl"),
            part!("water/under.wgsl"),
        ],
    ),
    (
        "water/hulls",
        &[
            MATHS,
            NOISE,
            PICTURE,
            part!("water/fresnel.wgsl"),
            part!("water/shadow_sun.wgsl"),
            part!("water/body.wgsl"),
            part!("water/medium.wgsl"),
            part!("water/hull_foam.wgsl"),
            part!("water/hulls.wgsl"),
        ],
    ),
    (
        "land/light",
        &[
            MATHS,
            NOISE,
            PICTURE,
            part!("water/fresnel.wgsl"),
            part!("water/material.wgsl"),
            part!("water/coast_map.wgsl"),
            part!("water/foam_map.wgsl"),
            MIRRORED_MAP,
            LAND,
            part!("land/ground.wgsl"),
            part!("land/rock.wgsl"),
            part!("land/cover.wgsl"),
            part!("land/swash.wgsl"),
            LIT_PIXEL,
            part!("land/light.wgsl"),
        ],
    ),
    (
        "drops/spray",
        &[
            PICTURE,
            SURFACE,
            part!("water/material.wgsl"),
            part!("land/map.wgsl"),
            part!("land/albedo.wgsl"),
            part!("drops/drop.wgsl"),
            part!("drops/spray_light.wgsl"),
            part!("drops/spray_puff.wgsl"),
            part!("drops/spray_coast.wgsl"),
            part!("drops/spray.wgsl"),
        ],
    ),
    ("drops/rain", &[PICTURE, SURFACE, part!("drops/drop.wgsl"), part!("drops/rain.wgsl")]),
    ("film/bloom", &[part!("film/bloom.wgsl")]),
    ("film/local_exposure", &[SKY_COMMON, part!("film/local_exposure.wgsl")]),
    ("film/tone", &[SKY_COMMON, SCREEN, part!("film/curves.wgsl"), part!("film/tone.wgsl")]),
    ("film/present", &[SCREEN, part!("film/present.wgsl")]),
    ("views/map", &[MATHS, SEA, SCREEN, VIEWS, part!("views/map.wgsl")]),
    ("views/surface", &[WATER, VIEWS, part!("views/surface.wgsl")]),
];

/// The WGSL sources of all shader modules of the program, with the struct declarations and the map format that complete
/// them when they are compiled.
#[derive(Clone, Debug)]
pub struct Shaders {
    sources: BTreeMap<&'static str, String>,
    /// Structs declared in Rust. A module whose text names one gets its WGSL declaration, which is generated.
    structs: Vec<StructDeclaration>,
    format: Option<MapFormat>,
}

impl Default for Shaders {
    fn default() -> Self {
        let join = |parts: &[SourcePart]| parts.iter().flat_map(SourcePart::files).collect::<Vec<_>>().join("\n");
        let sources = MODULES.iter().map(|(name, parts)| (*name, join(parts))).collect();
        Self { sources, structs: Vec::new(), format: None }
    }
}

impl Shaders {
    /// Replaces the text `from` in the WGSL of the module named `module` by `to`. Tests plant faults with it, to see
    /// that checks find them.
    ///
    /// # Panics
    /// If `from` does not occur exactly once in the module.
    #[must_use]
    pub fn patched(mut self, module: &str, from: &str, to: &str) -> Self {
        let source = self.sources.get_mut(module).unwrap_or_else(|| panic!("no shader module {module}"));
        assert_eq!(source.matches(from).count(), 1, "\"{from}\" should stand once in {module}");
        *source = source.replace(from, to);
        self
    }

    /// Replaces the whole WGSL of the module named `module`, of which nothing stays. Tests count with it what shaders
    /// execute.
    ///
    /// # Panics
    /// If there is no such module.
    #[must_use]
    pub fn replaced(mut self, module: &str, text: String) -> Self {
        *self.sources.get_mut(module).unwrap_or_else(|| panic!("no shader module {module}")) = text;
        self
    }

    /// Adds structs that are declared in Rust. Each module gets the declarations of the structs that its text names.
    #[must_use]
    pub fn with_structs(mut self, structs: &[StructDeclaration]) -> Self {
        let new = structs.iter().filter(|s| self.structs.iter().all(|known| known.name != s.name)).copied();
        let new: Vec<_> = new.collect();
        self.structs.extend(new);
        self
    }

    /// Makes all modules use maps in the given texture format, instead of the one that is faster on the device.
    #[must_use]
    pub fn with_map_format(self, format: MapFormat) -> Self {
        Self { format: Some(format), ..self }
    }

    /// Texture format of the maps on a device: that of [`Self::with_map_format`], or else the one that is faster there.
    pub fn map_format(&self, gpu: &Gpu) -> MapFormat {
        self.format.unwrap_or_else(|| MapFormat::for_device(gpu))
    }

    /// Names and WGSL texts of all modules. The texts of the FFT kernels for software adapters are for lines of 256
    /// points; the maps are half floats unless [`Self::with_map_format`] has fixed a format.
    pub fn all(&self) -> impl Iterator<Item = (&'static str, String)> {
        let format = self.format.unwrap_or(MapFormat::Half);
        self.sources.keys().map(move |&name| {
            let kernel = UnrolledKernel::ALL.into_iter().find(|kernel| kernel.module_name() == name);
            (name, kernel.map_or_else(|| self.text(name, format), |kernel| self.unrolled_text(kernel, 256, format)))
        })
    }

    /// Compiles the shader module with the given name, such as `waves/rows`, for maps in the format for the device.
    ///
    /// # Panics
    /// If no module has that name.
    pub fn module(&self, gpu: &Gpu, name: &str) -> wgpu::ShaderModule {
        gpu.shader_module(name, &self.text(name, self.map_format(gpu)))
    }

    /// Compiles one of the four FFT kernels for software adapters, for lines of `n` points. Its text is generated.
    pub fn unrolled_module(&self, gpu: &Gpu, kernel: UnrolledKernel, n: u32) -> wgpu::ShaderModule {
        gpu.shader_module(kernel.module_name(), &self.unrolled_text(kernel, n, self.map_format(gpu)))
    }

    /// WGSL text of a module for maps in `format`, followed by the declarations of the structs that it names.
    fn text(&self, name: &str, format: MapFormat) -> String {
        let source = self.sources.get(name).unwrap_or_else(|| panic!("no shader module {name}"));
        // The sources declare half-float storage textures.
        let mut text = source.replace("rgba16float", format.wgsl_format_name());
        let mut open: Vec<_> = self.structs.iter().collect();
        while let Some(at) = open.iter().position(|declaration| has_word(&text, declaration.name)) {
            text = format!("{text}\n{}", open.swap_remove(at).wgsl_declaration());
        }
        text
    }

    fn unrolled_text(&self, kernel: UnrolledKernel, n: u32, format: MapFormat) -> String {
        let map_texel = match (kernel, format) {
            (UnrolledKernel::ColumnsSecond, MapFormat::Half) => MAP_TEXEL_HALF,
            (UnrolledKernel::ColumnsSecond, MapFormat::Float) => MAP_TEXEL_FLOAT,
            _ => "",
        };
        [self.text(kernel.module_name(), format).as_str(), &kernel.function_text(n), map_texel].join("\n")
    }
}

/// Whether `text` contains `name` as a whole word, not as a part of a longer one.
fn has_word(text: &str, name: &str) -> bool {
    let is_end = |c: Option<char>| !c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(name)
        .any(|(at, _)| is_end(text[..at].chars().next_back()) && is_end(text[at + name.len()..].chars().next()))
}
