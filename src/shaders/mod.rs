//! Every shader module, joined from plain WGSL files. Names are prefixed by their part (`sea_`, `noise_`).

pub mod fft;

use crate::gpu::Gpu;
use crate::gpu::layout::Declaration;
use crate::gpu::map_format::MapFormat;
use fft::{Transform, Way};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A piece of a module's text.
enum Part {
    /// A WGSL file: its path below shaders/ and its text.
    File(&'static str, &'static str),
    /// Parts that belong together.
    Group(&'static [Part]),
}

impl Part {
    /// The files of a part, in order.
    fn files(&self) -> Vec<(&'static str, &'static str)> {
        match self {
            Self::File(path, text) => vec![(*path, *text)],
            Self::Group(parts) => parts.iter().flat_map(Self::files).collect(),
        }
    }
}

macro_rules! part {
    ($file:literal) => {
        Part::File($file, include_str!(concat!("../../shaders/", $file)))
    };
}

const MATHS: Part = part!("common/maths.wgsl");
const SEA: Part = part!("common/sea.wgsl");
const NOISE: Part = part!("common/noise.wgsl");
const TILES: Part = part!("common/tiles.wgsl");
const FFT_COMMON: Part = part!("waves/fft_common.wgsl");
const FFT: Part = part!("waves/fft.wgsl");
const LONG: Part = part!("waves/long.wgsl");
const COLUMNS_MAPS: Part = part!("waves/columns_maps.wgsl");
const ROWS_WAVES: Part = part!("waves/rows_waves.wgsl");
const MIPS: Part = part!("waves/mips.wgsl");
const ATMOSPHERE: Part = part!("sky/atmosphere.wgsl");
const SKY_COMMON: Part = part!("sky/common.wgsl");
const VIEWS: Part = part!("views/common.wgsl");
/// Clear air and the structs of the sky: what the sky's tables are made with.
const AIR_TABLES: Part = Part::Group(&[ATMOSPHERE, SKY_COMMON]);
/// Radiance of the sky in a direction.
const SKY: Part = Part::Group(&[AIR_TABLES, part!("sky/model.wgsl"), part!("sky/fog.wgsl")]);
/// What every pass of the HDR picture reads.
const PICTURE: Part =
    Part::Group(&[SKY, part!("common/frame.wgsl"), part!("common/scene.wgsl"), part!("sky/air.wgsl")]);
/// The displaced surface.
const SURFACE: Part = Part::Group(&[
    MATHS,
    NOISE,
    TILES,
    part!("water/mesh.wgsl"),
    part!("water/spline.wgsl"),
    part!("water/surface.wgsl"),
]);
/// The surface without the rest of the picture.
const BARE_SURFACE: Part = Part::Group(&[part!("common/frame.wgsl"), SURFACE]);
/// Light and matter of the water.
const WATER: Part = Part::Group(&[
    PICTURE,
    SURFACE,
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

/// Module names and the parts they are joined from; the last part holds the entry points. The name of a module of the
/// picture is the path of that file.
const MODULES: &[(&str, &[Part])] = &[
    ("spectrum", &[MATHS, SEA, NOISE, part!("waves/spectrum.wgsl")]),
    ("rows", &[MATHS, SEA, FFT_COMMON, FFT, ROWS_WAVES, part!("waves/rows.wgsl")]),
    ("rows_first", &[MATHS, SEA, FFT_COMMON, ROWS_WAVES, part!("waves/rows_first.wgsl")]),
    ("lines_second", &[FFT_COMMON, part!("waves/lines_second.wgsl")]),
    ("middle", &[FFT_COMMON, LONG, part!("waves/middle.wgsl")]),
    ("columns", &[SEA, FFT_COMMON, FFT, part!("waves/columns.wgsl")]),
    ("columns_first", &[FFT_COMMON, part!("waves/columns_first.wgsl")]),
    ("columns_second", &[FFT_COMMON, part!("waves/maps_half.wgsl"), COLUMNS_MAPS, part!("waves/columns_second.wgsl")]),
    (
        "columns_last",
        &[FFT_COMMON, LONG, part!("waves/maps_half.wgsl"), COLUMNS_MAPS, part!("waves/columns_last.wgsl")],
    ),
    ("mips_level", &[SEA, MIPS, part!("waves/mips_level.wgsl")]),
    ("mips_chain", &[SEA, MIPS, part!("waves/mips_chain.wgsl")]),
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
    ("film/present", &[SKY_COMMON, part!("film/present.wgsl")]),
    ("views/map", &[MATHS, SEA, VIEWS, part!("views/map.wgsl")]),
    ("views/surface", &[WATER, VIEWS, part!("views/surface.wgsl")]),
    ("views/show", &[part!("views/show.wgsl")]),
];

/// Modules of [`Way::Merged`]; only they have long numbers.
pub const MERGED: [&str; 2] = ["middle", "columns_last"];

/// The files of every module.
fn modules() -> impl Iterator<Item = (&'static str, Vec<(&'static str, &'static str)>)> {
    MODULES.iter().map(|(name, parts)| (*name, parts.iter().flat_map(Part::files).collect()))
}

/// The sources that a device's modules are made from.
#[derive(Clone, Debug)]
pub struct Shaders {
    sources: BTreeMap<&'static str, Cow<'static, str>>,
    /// Structs that Rust shares with the modules.
    structs: Vec<Declaration>,
    way: Option<Way>,
    maps: Option<MapFormat>,
}

impl Default for Shaders {
    fn default() -> Self {
        let join = |files: Vec<(_, &str)>| files.into_iter().map(|(_, text)| text).collect::<Vec<_>>().join("\n");
        Self {
            sources: modules().map(|(name, files)| (name, Cow::Owned(join(files)))).collect(),
            structs: Vec::new(),
            way: None,
            maps: None,
        }
    }
}

impl Shaders {
    /// The same sources with a piece of one module replaced: how tests plant faults.
    ///
    /// # Panics
    /// If `from` does not stand in the module exactly once: a fault that is not planted proves nothing.
    #[must_use]
    pub fn patched(mut self, module: &str, from: &str, to: &str) -> Self {
        let source = self.sources.get_mut(module).unwrap_or_else(|| panic!("no shader module {module}"));
        assert_eq!(source.matches(from).count(), 1, "\"{from}\" should stand once in {module}");
        *source = Cow::Owned(source.replace(from, to));
        self
    }

    /// These sources with structs that Rust declares. A module holds the declarations of those that it names.
    #[must_use]
    pub fn with_structs(mut self, structs: &[Declaration]) -> Self {
        let new = structs.iter().filter(|s| self.structs.iter().all(|known| known.name != s.name)).copied();
        let new: Vec<_> = new.collect();
        self.structs.extend(new);
        self
    }

    /// The same with one way of transforming on every device that can (long numbers are a feature): how it is tested and
    /// measured where it is not the rule.
    #[must_use]
    pub fn with_way(self, way: Way) -> Self {
        Self { way: Some(way), ..self }
    }

    /// How lines of `n` points are transformed on a device.
    pub fn way(&self, gpu: &Gpu, n: u32) -> Way {
        self.way.unwrap_or_else(|| Way::of(gpu)).for_points(n)
    }

    /// The same with maps of one format on every adapter that can filter it.
    #[must_use]
    pub fn with_maps(self, maps: MapFormat) -> Self {
        Self { maps: Some(maps), ..self }
    }

    /// How maps are kept on a device.
    pub fn maps(&self, gpu: &Gpu) -> MapFormat {
        self.maps.unwrap_or_else(|| MapFormat::of(gpu))
    }

    /// Names and joined texts; what is written out is that of 256 points, and maps are of half floats unless they are chosen.
    pub fn all(&self) -> impl Iterator<Item = (&'static str, String)> {
        let maps = self.maps.unwrap_or(MapFormat::Half);
        self.sources.keys().map(move |name| {
            let way = if MERGED.contains(name) { Way::Merged } else { Way::Straight };
            (*name, self.source(name, Transform::new(256, way), maps))
        })
    }

    fn source(&self, name: &str, transform: Transform, maps: MapFormat) -> String {
        format!("{}\n{}", self.text(name, maps), transform.straight_code(name).unwrap_or_default())
    }

    /// A module's text. The declarations of its structs stand last, so that they move no line of the files.
    fn text(&self, name: &str, maps: MapFormat) -> String {
        let source = self.sources.get(name).unwrap_or_else(|| panic!("no shader module {name}"));
        let mut text = maps.shader(Cow::Borrowed(source)).into_owned();
        let mut open: Vec<_> = self.structs.iter().collect();
        while let Some(at) = open.iter().position(|declaration| has_word(&text, declaration.name)) {
            text = format!("{text}\n{}", open.swap_remove(at).wgsl());
        }
        text
    }

    /// Compiles a module.
    ///
    /// # Panics
    /// If there is none of that name.
    pub fn module(&self, gpu: &Gpu, name: &str) -> wgpu::ShaderModule {
        gpu.module(name, &self.text(name, self.maps(gpu)))
    }

    /// Compiles a module together with what is written out for a transform.
    ///
    /// # Panics
    /// If there is none of that name.
    pub fn straight(&self, gpu: &Gpu, name: &str, transform: Transform) -> wgpu::ShaderModule {
        gpu.module(name, &self.source(name, transform, self.maps(gpu)))
    }
}

/// Whether a text contains a name that is not a part of a longer one.
fn has_word(text: &str, name: &str) -> bool {
    let is_end = |c: Option<char>| !c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(name)
        .any(|(at, _)| is_end(text[..at].chars().next_back()) && is_end(text[at + name.len()..].chars().next()))
}

/// File and line (from 1) of a line (from 1) of a joined module.
pub fn locate(module: &str, line: usize) -> Option<(&'static str, usize)> {
    let (_, files) = modules().find(|(name, _)| *name == module)?;
    let mut rest = line;
    for (path, text) in files {
        // Joining adds one newline after each file.
        let lines = text.matches('\n').count() + 1;
        if rest <= lines {
            return Some((path, rest));
        }
        rest -= lines;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found_again() {
        let shaders = Shaders::default();
        let (_, text) = shaders.all().find(|(name, _)| *name == "rows").unwrap();
        let line = text.lines().position(|l| l.contains("fn rows_pack(")).unwrap() + 1;
        let (file, at) = locate("rows", line).unwrap();
        assert_eq!(file, "waves/rows_waves.wgsl");
        assert!(
            include_str!("../../shaders/waves/rows_waves.wgsl").lines().nth(at - 1).unwrap().contains("fn rows_pack(")
        );
    }
}
