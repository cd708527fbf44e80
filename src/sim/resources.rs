//! Buffers and textures of a simulation: allocated for an FFT size and a number of cascades, and enlarged for two seas
//! at the first cross-fade.

use super::maps::{FOAM_LEVELS, MAX_CASCADES, MAX_DRAWN};
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::readback::{self, TextureCopy};
use crate::shaders::fft::{TWIDDLES, twiddles};
use crate::waves::Plan;
use crate::waves::lattice::Wave;
use crate::waves::table::{self, Table};
use std::ops::Range;

/// Side of the smallest mip level of a map, texels.
const SMALLEST_MIP: u32 = 4;
/// Number of [`MapKind`]s.
const MAP_KINDS: u32 = 3;

/// A kind of map. Each kind has a third of the layers of `Resources::maps`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Dx, eta, Dz (m) and dDx/dz.
    Displacement,
    /// d eta/dx, d eta/dz, dDx/dx, dDz/dz.
    Gradients,
    /// Second moments of the slopes, from mip level 1 on.
    Moments,
}

/// GPU memory of a simulation that all ways of the transform need.
#[derive(Debug)]
pub struct Resources {
    /// FFT size.
    pub n: u32,
    /// Cells along a side of a foam level.
    pub foam_n: u32,
    /// Wave buffers: those of one sea, and of a second one from the first cross-fade on.
    pub waves: Vec<Waves>,
    /// Index in `waves` of the current sea; the other entry belongs to the sea that fades out.
    pub current: usize,
    /// e^(2 pi i j / 1024), complex f32.
    pub twiddle: wgpu::Buffer,
    /// Lines after the transform along x, four complex f32 per point, \[cascade\]\[pair\]\[iz\]\[x\]. Two seas use it
    /// one after the other, because both at once would exceed the largest binding at n = 1024.
    pub lines: wgpu::Buffer,
    /// Foam, f32, \[level\]\[z\]\[x\].
    pub foam_history: wgpu::Buffer,
    /// Format of the maps and of the foam texture.
    pub format: MapFormat,
    /// All maps with their mip levels; see [`Self::layers`]. One texture, so that a pass can write several mip levels
    /// of all kinds: base limits allow four storage textures.
    pub maps: wgpu::Texture,
    /// Visible foam, one layer per level.
    pub foam: wgpu::Texture,
    /// Linear sampler that repeats along both axes.
    pub repeat: wgpu::Sampler,
    /// Number of times that buffers or textures have been allocated.
    pub allocations: u32,
    /// Number of times that the waves of a plan have been tabulated.
    pub tabulations: u32,
}

/// Buffers of the waves of one sea.
#[derive(Debug)]
pub struct Waves {
    /// Variances and directional lobes: f32 quadruples, as many per triangle entry and cascade as the spectrum needs.
    pub radial: wgpu::Buffer,
    /// Turns (u32) and orbit over wave number (f32, m) per triangle entry and cascade.
    pub wave: wgpu::Buffer,
    /// h0, complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
}

impl Waves {
    fn new(gpu: &Gpu, plan: &Plan, cascades: usize) -> Self {
        let entries = (table::len(plan.n) * cascades) as u64;
        let quadruples = table::terms(plan).1 as u64;
        Self {
            radial: gpu.storage("radial", 16 * entries * quadruples),
            wave: gpu.storage("wave", 8 * entries),
            h0: gpu.storage("h0", 8 * points(plan.n) * cascades as u64),
        }
    }
}

impl Resources {
    /// Allocates for the FFT size and the number of cascades of a plan.
    pub fn new(gpu: &Gpu, plan: &Plan, format: MapFormat) -> Self {
        let (n, cascades) = (plan.n, plan.cascades.len());
        let foam_n = n.min(256);
        let twiddle = gpu.storage("twiddle", (TWIDDLES * size_of::<[f32; 2]>()) as u64);
        gpu.queue.write_buffer(&twiddle, 0, bytemuck::cast_slice(&twiddles()));
        Self {
            n,
            foam_n,
            waves: vec![Waves::new(gpu, plan, cascades)],
            current: 0,
            twiddle,
            lines: gpu.storage("lines", line_bytes(n, cascades)),
            foam_history: gpu.storage("foam history", 4 * FOAM_LEVELS as u64 * points(foam_n)),
            format,
            maps: maps(gpu, n, cascades, format),
            foam: map(gpu, "foam", [foam_n, foam_n, FOAM_LEVELS as u32], 1, format),
            repeat: gpu.sampler("repeat", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Linear),
            allocations: 1,
            tabulations: 0,
        }
    }

    /// The wave buffers of the current sea.
    pub fn sea(&self) -> &Waves {
        &self.waves[self.current]
    }

    /// Layer of the current sea's first cascade among the layers of a kind of map.
    pub fn first_layer(&self) -> u32 {
        (self.current * MAX_CASCADES) as u32
    }

    /// Makes the other wave buffers those of the current sea. The first call allocates them, and maps for two seas with
    /// the most cascades each; it returns true, because the maps are new and empty.
    pub fn switch_sea(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let is_first = self.waves.len() == 1;
        if is_first {
            self.waves.push(Waves::new(gpu, plan, MAX_CASCADES));
            self.maps = maps(gpu, self.n, MAX_DRAWN, self.format);
            self.lines = gpu.storage("lines", line_bytes(self.n, MAX_CASCADES));
            self.allocations += 1;
        }
        self.current = 1 - self.current;
        is_first
    }

    /// Number of mip levels of the maps.
    pub fn mips(&self) -> u32 {
        self.maps.mip_level_count()
    }

    /// Layers of a kind of map, one for each cascade that can be drawn.
    pub fn layers(&self, kind: MapKind) -> Range<u32> {
        let layers = self.maps.depth_or_array_layers() / MAP_KINDS;
        kind as u32 * layers..(kind as u32 + 1) * layers
    }

    /// Layers of a kind of map that hold the current sea of `cascades` cascades.
    pub fn sea_layers(&self, kind: MapKind, cascades: usize) -> Range<u32> {
        let first = self.layers(kind).start + self.first_layer();
        first..first + cascades as u32
    }

    /// Records a copy of one mip level of all layers of a map into a buffer that the CPU can read.
    pub fn stage(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, kind: MapKind, level: u32) -> TextureCopy {
        readback::stage_layers(gpu, encoder, &self.maps, level, self.layers(kind))
    }

    /// A view of a kind of map with all its mip levels.
    pub fn map_view(&self, kind: MapKind) -> wgpu::TextureView {
        let layers = self.layers(kind);
        self.maps.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            base_array_layer: layers.start,
            array_layer_count: Some(layers.end - layers.start),
            base_mip_level: u32::from(kind == MapKind::Moments),
            ..Default::default()
        })
    }

    /// Tabulates the waves of a plan of this FFT size and writes them to the current sea's buffers. Returns whether the
    /// buffers had to be replaced by larger ones.
    pub fn upload_tables(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let mut values: Vec<[f32; 4]> = Vec::new();
        let mut waves = Vec::new();
        for table in Table::all(plan) {
            values.extend(table.values.iter().map(|v| v.map(|x| x as f32)));
            // Outside the band there is no wave, and k is 0.
            let slant = |w: &Wave| if w.k > 0.0 { (w.orbit / w.k) as f32 } else { 0.0 };
            waves.extend(table.waves.iter().map(|w| [w.turns, slant(w).to_bits()]));
        }
        self.tabulations += 1;
        let sea = &mut self.waves[self.current];
        let needs_radial = size_of_val(values.as_slice()) as u64 > sea.radial.size();
        if needs_radial {
            sea.radial = gpu.storage("radial", size_of_val(values.as_slice()) as u64);
        }
        // The buffers of the first sea are only large enough for its own cascades.
        let needs_waves = size_of_val(waves.as_slice()) as u64 > sea.wave.size();
        if needs_waves {
            sea.wave = gpu.storage("wave", (8 * table::len(self.n) * MAX_CASCADES) as u64);
            sea.h0 = gpu.storage("h0", 8 * points(self.n) * MAX_CASCADES as u64);
        }
        self.allocations += u32::from(needs_radial || needs_waves);
        gpu.queue.write_buffer(&sea.radial, 0, bytemuck::cast_slice(&values));
        gpu.queue.write_buffer(&sea.wave, 0, bytemuck::cast_slice(&waves));
        needs_radial || needs_waves
    }
}

fn points(n: u32) -> u64 {
    u64::from(n) * u64::from(n)
}

fn line_bytes(n: u32, cascades: usize) -> u64 {
    32 * points(n) * cascades as u64
}

fn maps(gpu: &Gpu, n: u32, cascades: usize, format: MapFormat) -> wgpu::Texture {
    let mips = (n / SMALLEST_MIP).ilog2() + 1;
    map(gpu, "maps", [n, n, MAP_KINDS * cascades as u32], mips, format)
}

/// An array texture that shaders read and write, of width, height and layers.
pub fn map(gpu: &Gpu, label: &str, size: [u32; 3], mips: u32, format: MapFormat) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::STORAGE_BINDING
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST;
    gpu.texture(label, size, mips, format.texture(), usage)
}

/// A view of one mip level or of all, as an array texture.
pub fn array_view(texture: &wgpu::Texture, mip: Option<u32>) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_mip_level: mip.unwrap_or(0),
        mip_level_count: mip.map(|_| 1),
        ..Default::default()
    })
}
