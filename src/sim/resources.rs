//! GPU buffers and textures of a simulation. They are allocated for an FFT size and a number of cascades, and enlarged
//! to hold two seas at the first cross-fade.

use super::maps::{MAX_CASCADES, MAX_DRAWN_CASCADES};
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::readback::{self, StagedTexture};
use crate::shaders::fft::{TWIDDLE_COUNT, twiddle_factors};
use crate::waves::Plan;
use crate::waves::foam::FOAM_LEVELS;
use crate::waves::lattice::LatticeWave;
use crate::waves::table::{self, Table};
use std::ops::Range;

/// Side of the smallest mip level of the maps, texels.
const SMALLEST_MIP_SIDE: u32 = 4;
/// Number of kinds of map, which are the variants of [`MapKind`].
const MAP_KIND_COUNT: u32 = 3;

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
    pub wave_buffers: Vec<WaveBuffers>,
    /// Index in `wave_buffers` of the current sea; the other entry belongs to the sea that fades out.
    pub current_sea: usize,
    /// FFT twiddle factors e^(2 pi i j / 1024) for j from 0 to 1023, complex f32.
    pub twiddle_factors: wgpu::Buffer,
    /// Fields after the inverse FFT along x, before that along z: two pairs of complex f32 per point,
    /// \[cascade\]\[pair\]\[iz\]\[x\]. Two seas use it in turn, because both would exceed the largest binding at n =
    /// 1024.
    pub row_transforms: wgpu::Buffer,
    /// Foam of each cell after the last time step, 0 to 1: f32, \[level\]\[z\]\[x\].
    pub foam_history: wgpu::Buffer,
    /// Texture format of the maps and of the foam.
    pub format: MapFormat,
    /// Array texture of all maps with their mip levels; [`Self::layers_of_kind`] gives the layers of a kind. One
    /// texture for all kinds lets a pass write several mip levels, because base limits allow four storage textures.
    pub maps: wgpu::Texture,
    /// Array texture of the foam and its source, one layer per foam level, which the renderer samples.
    pub foam: wgpu::Texture,
    /// Linear sampler that repeats along both axes.
    pub repeating_sampler: wgpu::Sampler,
    /// Number of times that buffers or textures have been allocated.
    pub allocation_count: u32,
    /// Number of times that the wave table of a plan has been computed.
    pub wave_table_count: u32,
}

/// GPU buffers that describe the waves of one sea.
#[derive(Debug)]
pub struct WaveBuffers {
    /// Wave table for the spectrum pass: variances and spreading parameters, in vectors of four f32 per entry.
    pub spectrum_table: wgpu::Buffer,
    /// Per entry of the wave table and cascade: the wave's number of cycles per period of the sea (u32), and its orbit
    /// axis ratio divided by its wave number (f32, m).
    pub wave_table: wgpu::Buffer,
    /// Fourier amplitudes h0 of the waves at time 0, m: complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
}

impl WaveBuffers {
    fn new(gpu: &Gpu, plan: &Plan, cascades: usize) -> Self {
        let entries = (table::entry_count(plan.n) * cascades) as u64;
        let quadruples = table::terms(plan).1 as u64;
        Self {
            spectrum_table: gpu.storage_buffer("spectrum table", 16 * entries * quadruples),
            wave_table: gpu.storage_buffer("wave table", 8 * entries),
            h0: gpu.storage_buffer("h0", 8 * point_count(plan.n) * cascades as u64),
        }
    }
}

impl Resources {
    /// Allocates buffers and textures for the FFT size and the number of cascades of a plan.
    pub fn new(gpu: &Gpu, plan: &Plan, format: MapFormat) -> Self {
        let (n, cascades) = (plan.n, plan.cascades.len());
        let foam_n = n.min(256);
        let twiddle = gpu.storage_buffer("twiddle", (TWIDDLE_COUNT * size_of::<[f32; 2]>()) as u64);
        gpu.queue.write_buffer(&twiddle, 0, bytemuck::cast_slice(&twiddle_factors()));
        Self {
            n,
            foam_n,
            wave_buffers: vec![WaveBuffers::new(gpu, plan, cascades)],
            current_sea: 0,
            twiddle_factors: twiddle,
            row_transforms: gpu.storage_buffer("row transforms", row_transform_bytes(n, cascades)),
            foam_history: gpu.storage_buffer("foam history", 4 * FOAM_LEVELS as u64 * point_count(foam_n)),
            format,
            maps: create_map_texture(gpu, n, cascades, format),
            foam: create_array_texture(gpu, "foam", [foam_n, foam_n, FOAM_LEVELS as u32], 1, format),
            repeating_sampler: gpu.sampler("repeat", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Linear),
            allocation_count: 1,
            wave_table_count: 0,
        }
    }

    /// Wave buffers of the current sea.
    pub fn current_waves(&self) -> &WaveBuffers {
        &self.wave_buffers[self.current_sea]
    }

    /// Index of the current sea's first cascade among the layers of each kind of map.
    pub fn first_layer(&self) -> u32 {
        (self.current_sea * MAX_CASCADES) as u32
    }

    /// Swaps the wave buffers of both seas when a cross-fade starts. The first call allocates the second set, and maps
    /// for two seas with the largest number of cascades. It returns true, because the new maps are empty.
    pub fn swap_seas(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let is_first = self.wave_buffers.len() == 1;
        if is_first {
            self.wave_buffers.push(WaveBuffers::new(gpu, plan, MAX_CASCADES));
            self.maps = create_map_texture(gpu, self.n, MAX_DRAWN_CASCADES, self.format);
            self.row_transforms = gpu.storage_buffer("row transforms", row_transform_bytes(self.n, MAX_CASCADES));
            self.allocation_count += 1;
        }
        self.current_sea = 1 - self.current_sea;
        is_first
    }

    /// Number of mip levels of the map texture.
    pub fn mip_level_count(&self) -> u32 {
        self.maps.mip_level_count()
    }

    /// Layers of `maps` that belong to a kind of map, one for each cascade that can be drawn.
    pub fn layers_of_kind(&self, kind: MapKind) -> Range<u32> {
        let layers = self.maps.depth_or_array_layers() / MAP_KIND_COUNT;
        kind as u32 * layers..(kind as u32 + 1) * layers
    }

    /// Layers of `maps` that hold one kind of map of the current sea, which has `cascades` cascades.
    pub fn current_sea_layers(&self, kind: MapKind, cascades: usize) -> Range<u32> {
        let first = self.layers_of_kind(kind).start + self.first_layer();
        first..first + cascades as u32
    }

    /// Records a copy of one mip level of all layers of a kind of map into a buffer that the CPU can read.
    pub fn stage_maps(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        kind: MapKind,
        level: u32,
    ) -> StagedTexture {
        readback::stage_layers(gpu, encoder, &self.maps, level, self.layers_of_kind(kind))
    }

    /// View of all layers and mip levels of a kind of map.
    pub fn map_view(&self, kind: MapKind) -> wgpu::TextureView {
        let layers = self.layers_of_kind(kind);
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
    pub fn upload_wave_tables(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let mut values: Vec<[f32; 4]> = Vec::new();
        let mut waves = Vec::new();
        for table in Table::for_all_cascades(plan) {
            values.extend(table.values.iter().map(|v| v.map(|x| x as f32)));
            // A table entry outside the cascade's band has no wave, and its wave number k is 0.
            let slant = |w: &LatticeWave| if w.k > 0.0 { (w.orbit_axis_ratio / w.k) as f32 } else { 0.0 };
            waves.extend(table.waves.iter().map(|w| [w.cycles_per_period, slant(w).to_bits()]));
        }
        self.wave_table_count += 1;
        let sea = &mut self.wave_buffers[self.current_sea];
        let needs_spectrum_table = size_of_val(values.as_slice()) as u64 > sea.spectrum_table.size();
        if needs_spectrum_table {
            sea.spectrum_table = gpu.storage_buffer("spectrum table", size_of_val(values.as_slice()) as u64);
        }
        // The buffers of the first sea are only large enough for its own cascades.
        let needs_waves = size_of_val(waves.as_slice()) as u64 > sea.wave_table.size();
        if needs_waves {
            sea.wave_table = gpu.storage_buffer("wave table", (8 * table::entry_count(self.n) * MAX_CASCADES) as u64);
            sea.h0 = gpu.storage_buffer("h0", 8 * point_count(self.n) * MAX_CASCADES as u64);
        }
        self.allocation_count += u32::from(needs_spectrum_table || needs_waves);
        gpu.queue.write_buffer(&sea.spectrum_table, 0, bytemuck::cast_slice(&values));
        gpu.queue.write_buffer(&sea.wave_table, 0, bytemuck::cast_slice(&waves));
        needs_spectrum_table || needs_waves
    }
}

fn point_count(n: u32) -> u64 {
    u64::from(n) * u64::from(n)
}

fn row_transform_bytes(n: u32, cascades: usize) -> u64 {
    32 * point_count(n) * cascades as u64
}

fn create_map_texture(gpu: &Gpu, n: u32, cascades: usize, format: MapFormat) -> wgpu::Texture {
    let mips = (n / SMALLEST_MIP_SIDE).ilog2() + 1;
    create_array_texture(gpu, "maps", [n, n, MAP_KIND_COUNT * cascades as u32], mips, format)
}

/// Creates an array texture that shaders read and write. `size` is width, height and number of layers.
pub fn create_array_texture(gpu: &Gpu, label: &str, size: [u32; 3], mips: u32, format: MapFormat) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::STORAGE_BINDING
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST;
    gpu.texture(label, size, mips, format.texture_format(), usage)
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
