//! Every shader module, joined from plain WGSL files. Names are prefixed by their part (`sea_`, `noise_`).

pub mod fft;
pub mod unrolled;

use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use std::collections::BTreeMap;
use unrolled::UnrolledKernel;

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
const FFT: Part = part!("waves/fft.wgsl");
const WORKGROUP_FFT: Part = part!("waves/workgroup_fft.wgsl");
const EVOLVE: Part = part!("waves/evolve.wgsl");
const MIP_MEAN: Part = part!("waves/mip_mean.wgsl");
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

/// Texels of the maps in a buffer, by their format.
const MAP_TEXEL_HALF: &str = include_str!("../../shaders/waves/map_texel_half.wgsl");
const MAP_TEXEL_FLOAT: &str = include_str!("../../shaders/waves/map_texel_float.wgsl");

/// Module names and the parts they are joined from; the last part holds the entry points.
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

/// The WGSL sources of all modules.
#[derive(Clone, Debug)]
pub struct Shaders {
    sources: BTreeMap<&'static str, String>,
    format: Option<MapFormat>,
}

impl Default for Shaders {
    fn default() -> Self {
        let join = |parts: Vec<&Part>| parts.iter().map(|p| p.text).collect::<Vec<_>>().join("\n");
        Self { sources: modules().map(|(name, parts)| (name, join(parts))).collect(), format: None }
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
        *source = source.replace(from, to);
        self
    }

    /// These sources with maps of one format instead of the device's fastest.
    #[must_use]
    pub fn with_maps(self, format: MapFormat) -> Self {
        Self { format: Some(format), ..self }
    }

    /// Format of the maps on a device.
    pub fn maps(&self, gpu: &Gpu) -> MapFormat {
        self.format.unwrap_or_else(|| MapFormat::of(gpu))
    }

    /// Names and WGSL texts of all modules: unrolled kernels for 256 points, and half-float maps unless a format was
    /// set.
    pub fn all(&self) -> impl Iterator<Item = (&'static str, String)> {
        let format = self.format.unwrap_or(MapFormat::Half);
        self.sources.keys().map(move |&name| {
            let kernel = UnrolledKernel::ALL.into_iter().find(|kernel| kernel.module() == name);
            (name, kernel.map_or_else(|| self.text(name, format), |kernel| self.unrolled_text(kernel, 256, format)))
        })
    }

    /// Compiles a module.
    ///
    /// # Panics
    /// If no module has that name.
    pub fn module(&self, gpu: &Gpu, name: &str) -> wgpu::ShaderModule {
        gpu.module(name, &self.text(name, self.maps(gpu)))
    }

    /// Compiles a kernel of the unrolled transform for lines of `n` points.
    pub fn unrolled(&self, gpu: &Gpu, kernel: UnrolledKernel, n: u32) -> wgpu::ShaderModule {
        gpu.module(kernel.module(), &self.unrolled_text(kernel, n, self.maps(gpu)))
    }

    fn text(&self, name: &str, format: MapFormat) -> String {
        let source = self.sources.get(name).unwrap_or_else(|| panic!("no shader module {name}"));
        // The sources declare half-float storage textures.
        source.replace("rgba16float", format.wgsl())
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
        let (_, text) = shaders.all().find(|(name, _)| *name == "waves/rows").unwrap();
        let line = text.lines().position(|l| l.contains("fn evolve_pack(")).unwrap() + 1;
        let (file, at) = locate("waves/rows", line).unwrap();
        assert_eq!(file, "waves/evolve.wgsl");
        assert!(
            include_str!("../../shaders/waves/evolve.wgsl").lines().nth(at - 1).unwrap().contains("fn evolve_pack(")
        );
    }
}
