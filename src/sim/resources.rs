//! GPU buffers and textures of a simulation. They are allocated for an FFT size and a number of cascades, and enlarged
//! to hold two seas at the first cross-fade.

use super::maps::{FOAM_LEVELS, MAX_CASCADES, MAX_DRAWN};
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::readback::{self, TextureCopy};
use crate::shaders::fft::{TWIDDLES, twiddles};
use crate::waves::Plan;
use crate::waves::lattice::LatticeWave;
use crate::waves::table::{self, Table};
use std::ops::Range;

/// Side of the smallest mip level of the maps, texels.
const SMALLEST_MIP: u32 = 4;
/// Number of kinds of map, which are the variants of [`MapKind`].
const MAP_KINDS: u32 = 3;

/// Kind of map. The array texture `Resources::maps` holds the same number of layers of each kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Displacement map: Dx, height eta, Dz (m) and dDx/dz, before choppiness is applied.
    Displacement,
    /// Gradient map: slopes d eta/dx and d eta/dz, then dDx/dx and dDz/dz of the horizontal displacement.
    Gradients,
    /// Slope moments: local means of the squares and the product of both slopes, from mip level 1 on.
    Moments,
}

/// GPU buffers and textures of a simulation that every implementation of the FFT needs.
#[derive(Debug)]
pub struct Resources {
    /// FFT size: number of points along a side of a cascade's lattice.
    pub n: u32,
    /// Number of cells along a side of a foam level.
    pub foam_n: u32,
    /// Wave buffers, one set for each sea. The second set exists from the first cross-fade on.
    pub waves: Vec<Waves>,
    /// Index in `waves` of the current sea; the other entry belongs to the sea that fades out.
    pub current: usize,
    /// FFT twiddle factors e^(2 pi i j / 1024) for j from 0 to 1023, complex f32.
    pub twiddle: wgpu::Buffer,
    /// Fields after the inverse FFT along x, before that along z: two pairs of complex f32 per point,
    /// \[cascade\]\[pair\]\[iz\]\[x\]. Two seas use it in turn, because both would exceed the largest binding at n =
    /// 1024.
    pub lines: wgpu::Buffer,
    /// Foam of each cell after the last time step, 0 to 1: f32, \[level\]\[z\]\[x\].
    pub foam_history: wgpu::Buffer,
    /// Texture format of the maps and of the foam.
    pub format: MapFormat,
    /// Array texture of all maps with their mip levels; [`Self::layers`] gives the layers of a kind. One texture for
    /// all kinds lets a pass write several mip levels, because base limits allow four storage textures.
    pub maps: wgpu::Texture,
    /// Array texture of the foam and its source, one layer per foam level, which the renderer samples.
    pub foam: wgpu::Texture,
    /// Linear sampler that repeats along both axes.
    pub repeat: wgpu::Sampler,
    /// Number of times that buffers or textures have been allocated.
    pub allocations: u32,
    /// Number of times that the wave table of a plan has been computed.
    pub tabulations: u32,
}

/// GPU buffers that describe the waves of one sea.
#[derive(Debug)]
pub struct Waves {
    /// Wave table for the spectrum pass: variances and spreading parameters, in vectors of four f32 per entry.
    pub radial: wgpu::Buffer,
    /// Per entry of the wave table and cascade: the wave's number of cycles per period of the sea (u32), and its orbit
    /// axis ratio divided by its wave number (f32, m).
    pub wave: wgpu::Buffer,
    /// Fourier amplitudes h0 of the waves at time 0, m: complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
}

impl Waves {
    fn new(gpu: &Gpu, plan: &Plan, cascades: usize) -> Self {
        let entries = (table::entry_count(plan.n) * cascades) as u64;
        let quadruples = table::terms(plan).1 as u64;
        Self {
            radial: gpu.storage("radial", 16 * entries * quadruples),
            wave: gpu.storage("wave", 8 * entries),
            h0: gpu.storage("h0", 8 * points(plan.n) * cascades as u64),
        }
    }
}

impl Resources {
    /// Allocates buffers and textures for the FFT size and the number of cascades of a plan.
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

    /// Wave buffers of the current sea.
    pub fn sea(&self) -> &Waves {
        &self.waves[self.current]
    }

    /// Index of the current sea's first cascade among the layers of each kind of map.
    pub fn first_layer(&self) -> u32 {
        (self.current * MAX_CASCADES) as u32
    }

    /// Swaps the wave buffers of both seas when a cross-fade starts. The first call allocates the second set, and maps
    /// for two seas with the largest number of cascades. It returns true, because the new maps are empty.
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

    /// Number of mip levels of the map texture.
    pub fn mips(&self) -> u32 {
        self.maps.mip_level_count()
    }

    /// Layers of `maps` that belong to a kind of map, one for each cascade that can be drawn.
    pub fn layers(&self, kind: MapKind) -> Range<u32> {
        let layers = self.maps.depth_or_array_layers() / MAP_KINDS;
        kind as u32 * layers..(kind as u32 + 1) * layers
    }

    /// Layers of `maps` that hold one kind of map of the current sea, which has `cascades` cascades.
    pub fn sea_layers(&self, kind: MapKind, cascades: usize) -> Range<u32> {
        let first = self.layers(kind).start + self.first_layer();
        first..first + cascades as u32
    }

    /// Records a copy of one mip level of all layers of a kind of map into a buffer that the CPU can read.
    pub fn stage(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, kind: MapKind, level: u32) -> TextureCopy {
        readback::stage_layers(gpu, encoder, &self.maps, level, self.layers(kind))
    }

    /// View of all layers and mip levels of a kind of map.
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

    /// Computes the wave table of a plan, whose FFT size must be unchanged, and uploads it to the current sea's
    /// buffers. Returns whether larger buffers had to be allocated.
    pub fn upload_tables(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let mut values: Vec<[f32; 4]> = Vec::new();
        let mut waves = Vec::new();
        for table in Table::for_all_cascades(plan) {
            values.extend(table.values.iter().map(|v| v.map(|x| x as f32)));
            // A table entry outside the cascade's band has no wave, and its wave number k is 0.
            let slant = |w: &LatticeWave| if w.k > 0.0 { (w.orbit_axis_ratio / w.k) as f32 } else { 0.0 };
            waves.extend(table.waves.iter().map(|w| [w.cycles_per_period, slant(w).to_bits()]));
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
            sea.wave = gpu.storage("wave", (8 * table::entry_count(self.n) * MAX_CASCADES) as u64);
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

/// Creates an array texture that shaders read and write. `size` is width, height and number of layers.
pub fn map(gpu: &Gpu, label: &str, size: [u32; 3], mips: u32, format: MapFormat) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::STORAGE_BINDING
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST;
    gpu.texture(label, size, mips, format.texture(), usage)
}

/// View of one mip level of a texture as an array texture, or of all levels if `mip` is None.
pub fn array_view(texture: &wgpu::Texture, mip: Option<u32>) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_mip_level: mip.unwrap_or(0),
        mip_level_count: mip.map(|_| 1),
        ..Default::default()
    })
}
