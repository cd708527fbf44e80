//! All shader modules, joined from plain WGSL files. WGSL names begin with their file's topic (`sea_`, `noise_`).

pub mod fft;
pub mod unrolled;

use crate::gpu::Gpu;
use crate::gpu::layout::Declaration;
use crate::gpu::map_format::MapFormat;
use std::collections::BTreeMap;
use unrolled::UnrolledKernel;

/// A piece of a shader module's text.
enum Part {
    /// The text of a WGSL file.
    File(&'static str),
    /// Several parts that are always used together, in this order.
    Group(&'static [Part]),
}

impl Part {
    /// Texts of the WGSL files of a part, in order.
    fn files(&self) -> Vec<&'static str> {
        match self {
            Self::File(text) => vec![*text],
            Self::Group(parts) => parts.iter().flat_map(Self::files).collect(),
        }
    }
}

macro_rules! part {
    ($file:literal) => {
        Part::File(include_str!(concat!("../../shaders/", $file)))
    };
}

const MATHS: Part = part!("common/maths.wgsl");
const SEA: Part = part!("common/sea.wgsl");
const NOISE: Part = part!("common/noise.wgsl");
const SCREEN: Part = part!("common/screen.wgsl");
const TILES: Part = part!("common/tiles.wgsl");
const FFT: Part = part!("waves/fft.wgsl");
const WORKGROUP_FFT: Part = part!("waves/workgroup_fft.wgsl");
const EVOLVE: Part = part!("waves/evolve.wgsl");
const MIP_MEAN: Part = part!("waves/mip_mean.wgsl");
const ATMOSPHERE: Part = part!("sky/atmosphere.wgsl");
const SKY_COMMON: Part = part!("sky/common.wgsl");
const VIEWS: Part = part!("views/common.wgsl");
/// WGSL for the passes that compute the look-up tables of clear air.
const AIR_TABLES: Part = Part::Group(&[ATMOSPHERE, SKY_COMMON]);
/// WGSL functions for the radiance of the sky in a direction, with clouds and fog.
const SKY: Part = Part::Group(&[AIR_TABLES, part!("sky/model.wgsl"), part!("sky/fog.wgsl")]);
/// WGSL for every pass that draws on the HDR picture: bind group 0, the sky, and the air in front of the sea.
const PICTURE: Part =
    Part::Group(&[SKY, part!("common/frame.wgsl"), part!("common/scene.wgsl"), part!("sky/air.wgsl")]);
/// WGSL functions for the displaced water surface.
const SURFACE: Part = Part::Group(&[
    MATHS,
    NOISE,
    TILES,
    part!("water/mesh.wgsl"),
    part!("water/spline.wgsl"),
    part!("water/surface.wgsl"),
]);
/// WGSL for passes that displace the water surface but draw no picture.
const BARE_SURFACE: Part = Part::Group(&[part!("common/frame.wgsl"), SURFACE]);
/// WGSL functions that shade the water: roughness, reflection, light from below, and foam.
const WATER: Part = Part::Group(&[
    PICTURE,
    SURFACE,
    part!("water/footprint.wgsl"),
    part!("water/slope.wgsl"),
    part!("water/material.wgsl"),
    part!("water/fresnel.wgsl"),
    part!("water/facets.wgsl"),
    part!("water/mirror.wgsl"),
    part!("water/body.wgsl"),
    part!("water/bed.wgsl"),
    part!("water/foam.wgsl"),
    part!("water/water.wgsl"),
]);

/// WGSL type of a map texel in a buffer, for maps in half floats and for maps in 32-bit floats.
const MAP_TEXEL_HALF: &str = include_str!("../../shaders/waves/map_texel_half.wgsl");
const MAP_TEXEL_FLOAT: &str = include_str!("../../shaders/waves/map_texel_float.wgsl");

/// Name of each shader module and the parts that it is joined from. The last part holds the entry points; the module
/// has the name of that file's path.
const MODULES: &[(&str, &[Part])] = &[
    ("waves/spectrum", &[MATHS, SEA, NOISE, part!("waves/spectrum.wgsl")]),
    ("waves/rows", &[MATHS, SEA, FFT, WORKGROUP_FFT, EVOLVE, part!("waves/rows.wgsl")]),
    ("waves/columns", &[SEA, FFT, WORKGROUP_FFT, part!("waves/columns.wgsl")]),
    ("waves/mips", &[SEA, MIP_MEAN, part!("waves/mips.wgsl")]),
    ("waves/unrolled_rows_first", &[MATHS, SEA, FFT, EVOLVE, part!("waves/unrolled_rows_first.wgsl")]),
    ("waves/unrolled_rows_second", &[FFT, part!("waves/unrolled_rows_second.wgsl")]),
    ("waves/unrolled_columns_first", &[FFT, part!("waves/unrolled_columns_first.wgsl")]),
    ("waves/unrolled_columns_second", &[FFT, part!("waves/unrolled_columns_second.wgsl")]),
    ("waves/unrolled_mips", &[SEA, MIP_MEAN, part!("waves/unrolled_mips.wgsl")]),
    ("foam/foam", &[MATHS, SEA, NOISE, TILES, part!("foam/foam.wgsl")]),
    ("sky/transmittance", &[AIR_TABLES, part!("sky/transmittance.wgsl")]),
    ("sky/multiple", &[AIR_TABLES, part!("sky/multiple.wgsl")]),
    ("sky/view", &[AIR_TABLES, part!("sky/view.wgsl")]),
    ("sky/environment", &[SKY, part!("sky/environment.wgsl")]),
    ("sky/filter", &[part!("sky/filter.wgsl")]),
    ("sky/light", &[SKY, part!("sky/light.wgsl")]),
    ("sky/background", &[PICTURE, part!("sky/background.wgsl")]),
    ("water/displace", &[BARE_SURFACE, part!("water/displace.wgsl")]),
    ("water/eye", &[BARE_SURFACE, part!("water/eye.wgsl")]),
    ("water/light", &[WATER, part!("water/light.wgsl")]),
    ("water/floats", &[PICTURE, part!("water/floats.wgsl")]),
    ("film/bloom", &[part!("film/bloom.wgsl")]),
    ("film/present", &[SKY_COMMON, SCREEN, part!("film/present.wgsl")]),
    ("views/map", &[MATHS, SEA, SCREEN, VIEWS, part!("views/map.wgsl")]),
    ("views/surface", &[WATER, VIEWS, part!("views/surface.wgsl")]),
    ("views/show", &[SCREEN, part!("views/show.wgsl")]),
];

/// The WGSL sources of all modules.
#[derive(Clone, Debug)]
pub struct Shaders {
    sources: BTreeMap<&'static str, String>,
    /// Structs declared in Rust whose WGSL declarations are added to the modules that use them.
    structs: Vec<Declaration>,
    format: Option<MapFormat>,
}

impl Default for Shaders {
    fn default() -> Self {
        let join = |parts: &[Part]| parts.iter().flat_map(Part::files).collect::<Vec<_>>().join("\n");
        let sources = MODULES.iter().map(|(name, parts)| (*name, join(parts))).collect();
        Self { sources, structs: Vec::new(), format: None }
    }
}

impl Shaders {
    /// Replaces a piece of the text of one module. Tests plant faults with it, which other checks must then find.
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

    /// Adds structs that are declared in Rust. Each module gets the declarations of the structs that its text names.
    #[must_use]
    pub fn with_structs(mut self, structs: &[Declaration]) -> Self {
        let new = structs.iter().filter(|s| self.structs.iter().all(|known| known.name != s.name)).copied();
        let new: Vec<_> = new.collect();
        self.structs.extend(new);
        self
    }

    /// Fixes the texture format of the maps. Otherwise it is the faster one for the device.
    #[must_use]
    pub fn with_maps(self, format: MapFormat) -> Self {
        Self { format: Some(format), ..self }
    }

    /// Texture format of the maps on a device.
    pub fn maps(&self, gpu: &Gpu) -> MapFormat {
        self.format.unwrap_or_else(|| MapFormat::of(gpu))
    }

    /// Names and WGSL texts of all modules. The FFT kernels for software adapters are those for 256 points; the maps
    /// are half floats unless [`Self::with_maps`] has fixed a format.
    pub fn all(&self) -> impl Iterator<Item = (&'static str, String)> {
        let format = self.format.unwrap_or(MapFormat::Half);
        self.sources.keys().map(move |&name| {
            let kernel = UnrolledKernel::ALL.into_iter().find(|kernel| kernel.module() == name);
            (name, kernel.map_or_else(|| self.text(name, format), |kernel| self.unrolled_text(kernel, 256, format)))
        })
    }

    /// Compiles the shader module with the given name.
    ///
    /// # Panics
    /// If no module has that name.
    pub fn module(&self, gpu: &Gpu, name: &str) -> wgpu::ShaderModule {
        gpu.module(name, &self.text(name, self.maps(gpu)))
    }

    /// Compiles one kernel of the FFT for software adapters, for lines of `n` points.
    pub fn unrolled(&self, gpu: &Gpu, kernel: UnrolledKernel, n: u32) -> wgpu::ShaderModule {
        gpu.module(kernel.module(), &self.unrolled_text(kernel, n, self.maps(gpu)))
    }

    /// WGSL text of a module, with the declarations of the structs that it names at the end.
    fn text(&self, name: &str, format: MapFormat) -> String {
        let source = self.sources.get(name).unwrap_or_else(|| panic!("no shader module {name}"));
        // The sources declare half-float storage textures.
        let mut text = source.replace("rgba16float", format.wgsl());
        let mut open: Vec<_> = self.structs.iter().collect();
        while let Some(at) = open.iter().position(|declaration| has_word(&text, declaration.name)) {
            text = format!("{text}\n{}", open.swap_remove(at).wgsl());
        }
        text
    }

    fn unrolled_text(&self, kernel: UnrolledKernel, n: u32, format: MapFormat) -> String {
        let map_texel = match (kernel, format) {
            (UnrolledKernel::ColumnsSecond, MapFormat::Half) => MAP_TEXEL_HALF,
            (UnrolledKernel::ColumnsSecond, MapFormat::Float) => MAP_TEXEL_FLOAT,
            _ => "",
        };
        [self.text(kernel.module(), format).as_str(), &kernel.code(n), map_texel].join("\n")
    }
}

/// Whether a text contains `name` as a whole word, not as a part of a longer one.
fn has_word(text: &str, name: &str) -> bool {
    let is_end = |c: Option<char>| !c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(name)
        .any(|(at, _)| is_end(text[..at].chars().next_back()) && is_end(text[at + name.len()..].chars().next()))
}
