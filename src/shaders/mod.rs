//! Every shader module, joined from plain WGSL files. Names are prefixed by their part (`sea_`, `noise_`).

pub mod fft;

use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use fft::{Transform, Way};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// One WGSL file.
struct Part {
    file: &'static str,
    text: &'static str,
}

macro_rules! part {
    ($file:literal) => {
        Part { file: $file, text: include_str!(concat!("../../shaders/", $file)) }
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
const SKY: Part = part!("sky/common.wgsl");
const SKY_MODEL: Part = part!("sky/model.wgsl");
const FOG: Part = part!("sky/fog.wgsl");
const AIR: Part = part!("sky/air.wgsl");
const FRAME: Part = part!("common/frame.wgsl");
/// What the passes of the picture read.
const SCENE: Part = part!("common/scene.wgsl");
const MESH: Part = part!("water/mesh.wgsl");
const WATER_SURFACE: Part = part!("water/surface.wgsl");
const WATER_FOAM: Part = part!("water/foam.wgsl");
/// Light and matter of the water.
const MATERIAL: Part = part!("water/material.wgsl");
const WATER_FRESNEL: Part = part!("water/fresnel.wgsl");
const WATER_FACETS: Part = part!("water/facets.wgsl");
const WATER_MIRROR: Part = part!("water/mirror.wgsl");
const WATER_BODY: Part = part!("water/body.wgsl");
const WATER_BED: Part = part!("water/bed.wgsl");
const WATER_FORWARD: Part = part!("water/forward.wgsl");
const DEBUG: Part = part!("views/common.wgsl");

/// Module names and the parts they are joined from; the last part holds the entry points.
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
    ("foam", &[MATHS, SEA, NOISE, TILES, part!("foam/foam.wgsl")]),
    ("sky_transmittance", &[ATMOSPHERE, SKY, part!("sky/transmittance.wgsl")]),
    ("sky_multiple", &[ATMOSPHERE, SKY, part!("sky/multiple.wgsl")]),
    ("sky_view", &[ATMOSPHERE, SKY, part!("sky/view.wgsl")]),
    ("sky_environment", &[ATMOSPHERE, SKY, SKY_MODEL, FOG, part!("sky/environment.wgsl")]),
    ("sky_filter", &[part!("sky/filter.wgsl")]),
    ("sky_light", &[ATMOSPHERE, SKY, SKY_MODEL, FOG, part!("sky/light.wgsl")]),
    ("sky", &[ATMOSPHERE, SKY, SKY_MODEL, FOG, FRAME, SCENE, AIR, part!("sky/background.wgsl")]),
    ("floats", &[ATMOSPHERE, SKY, SKY_MODEL, FOG, FRAME, SCENE, AIR, part!("water/floats.wgsl")]),
    ("mesh", &[MATHS, NOISE, TILES, FRAME, MESH, WATER_SURFACE, part!("water/displace.wgsl")]),
    ("eye", &[MATHS, NOISE, TILES, FRAME, MESH, WATER_SURFACE, part!("water/eye.wgsl")]),
    (
        "water",
        &[
            ATMOSPHERE,
            SKY,
            SKY_MODEL,
            FOG,
            MATHS,
            NOISE,
            TILES,
            FRAME,
            SCENE,
            AIR,
            MATERIAL,
            MESH,
            WATER_SURFACE,
            WATER_FRESNEL,
            WATER_FACETS,
            WATER_MIRROR,
            WATER_BODY,
            WATER_BED,
            WATER_FOAM,
            part!("water/water.wgsl"),
        ],
    ),
    ("bloom", &[part!("film/bloom.wgsl")]),
    ("present", &[SKY, part!("film/present.wgsl")]),
    ("debug_map", &[MATHS, SEA, DEBUG, part!("views/map.wgsl")]),
    ("debug_show", &[part!("views/show.wgsl")]),
];

/// Modules of [`Way::Merged`]; only they have long numbers.
pub const MERGED: [&str; 2] = ["middle", "columns_last"];

/// Modules that hold another whole, and what they add to it.
const EXTENSIONS: &[(&str, &str, &[Part])] = &[
    ("water_forward", "water", &[WATER_FORWARD]),
    ("water_deferred", "water", &[part!("water/light.wgsl")]),
    ("debug_water", "water", &[WATER_FORWARD, DEBUG, part!("views/surface.wgsl")]),
];

/// The parts of every module.
fn modules() -> impl Iterator<Item = (&'static str, Vec<&'static Part>)> {
    let whole = |name: &'static str| MODULES.iter().filter(move |(n, _)| *n == name).flat_map(|(_, parts)| *parts);
    let extended = EXTENSIONS.iter().map(move |(name, base, more)| (*name, whole(base).chain(*more).collect()));
    MODULES.iter().map(|(name, parts)| (*name, parts.iter().collect())).chain(extended)
}

/// The sources that a device's modules are made from.
#[derive(Clone, Debug)]
pub struct Shaders {
    sources: BTreeMap<&'static str, Cow<'static, str>>,
    way: Option<Way>,
    maps: Option<MapFormat>,
}

impl Default for Shaders {
    fn default() -> Self {
        let join = |parts: Vec<&Part>| parts.iter().map(|p| p.text).collect::<Vec<_>>().join("\n");
        Self {
            sources: modules().map(|(name, parts)| (name, Cow::Owned(join(parts)))).collect(),
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
        let source = self.sources.get(name).unwrap_or_else(|| panic!("no shader module {name}"));
        let code = format!("{source}\n{}", transform.straight_code(name).unwrap_or_default());
        maps.shader(code.into()).into_owned()
    }

    /// Compiles a module.
    ///
    /// # Panics
    /// If there is none of that name.
    pub fn module(&self, gpu: &Gpu, name: &str) -> wgpu::ShaderModule {
        let (label, source) = self.sources.get_key_value(name).unwrap_or_else(|| panic!("no shader module {name}"));
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(self.maps(gpu).shader(Cow::Borrowed(source))),
        })
    }

    /// Compiles a module together with what is written out for a transform.
    ///
    /// # Panics
    /// If there is none of that name.
    pub fn straight(&self, gpu: &Gpu, name: &str, transform: Transform) -> wgpu::ShaderModule {
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(Cow::Owned(self.source(name, transform, self.maps(gpu)))),
        })
    }
}

/// File and line (from 1) of a line (from 1) of a joined module.
pub fn locate(module: &str, line: usize) -> Option<(&'static str, usize)> {
    let (_, parts) = modules().find(|(name, _)| *name == module)?;
    let mut rest = line;
    for part in parts {
        // Joining adds one newline after each part.
        let lines = part.text.matches('\n').count() + 1;
        if rest <= lines {
            return Some((part.file, rest));
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
