//! GPU buffers and textures of a simulation. They are allocated for an FFT size and a number of cascades, and enlarged
//! to hold two seas at the first cross-fade, and the waves at a coast.

use super::coast::resources::CoastResources;
use super::maps::{BREAKER_LAYERS, COAST_LAYERS, MAX_CASCADES, MAX_SEA_LAYERS};
use crate::coast::Transfer;
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::readback::{self, StagedTexture};
use crate::shaders::fft::{TWIDDLE_COUNT, twiddle_factors};
use crate::waves::Plan;
use crate::waves::foam::FOAM_LEVEL_COUNT;
use crate::waves::lattice::LatticeWave;
use crate::waves::table::{self, SpectrumTable};
use std::ops::Range;
use std::sync::Arc;

/// Side of the smallest mip level that the wave maps have, texels.
const SMALLEST_MIP_SIDE: u32 = 4;
/// Number of kinds of map, which are the variants of [`MapKind`].
const MAP_KIND_COUNT: u32 = 3;

/// Kind of map that each cascade has. The array texture `Resources::maps` holds first all displacement maps, then all
/// gradient maps, then all slope moments, with the same number of layers each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Displacement map: horizontal displacement Dx, height eta, Dz (m) and dDx/dz, before choppiness is applied.
    Displacement,
    /// Gradient map: slopes d eta/dx and d eta/dz, then dDx/dx and dDz/dz of the displacement, before choppiness.
    Gradients,
    /// Slope moments: means over a texel of sx^2, sz^2 and sx sz, with the slopes sx and sz; from mip level 1 on.
    Moments,
}

/// GPU buffers and textures of a simulation that both implementations of the FFT use: waves, maps and foam.
#[derive(Debug)]
pub struct Resources {
    /// FFT size: number of points of a cascade's FFT lattice along a side, and of texels of its maps.
    pub n: u32,
    /// Number of cells along a side of a foam level (one of the nested square foam grids).
    pub foam_n: u32,
    /// Buffers that describe the waves, one set for each sea. The second set exists from the first cross-fade on.
    pub wave_buffers: Vec<WaveBuffers>,
    /// Index in `wave_buffers` of the current sea; the other set, if any, belongs to the old sea of a cross-fade.
    pub current_wave_buffers_index: usize,
    /// Storage buffer of the FFT twiddle factors e^(2 pi i j / 1024) for j from 0 to 1023, complex f32.
    pub twiddle_factors: wgpu::Buffer,
    /// Result of the row pass, the inverse FFT along x: the eight values of displacement and gradients, packed in two
    /// pairs of complex f32 per point, \[cascade\]\[pair\]\[iz\]\[x\]. Both seas of a cross-fade use the buffer in
    /// turn: room for both would exceed the largest binding at n = 1024.
    pub row_transforms: wgpu::Buffer,
    /// Foam, front and plume of each cell after the last time step, 0 to 1: f32, \[level\]\[z\]\[x\]\[quantity\].
    pub foam_history: wgpu::Buffer,
    /// Texture format of the textures `maps` and `foam`: half floats or 32-bit floats.
    pub format: MapFormat,
    /// Array texture of all wave maps with their mip levels; [`Self::layers_of_kind`] gives the layers of a kind. All
    /// kinds share it because a pass may write to only four storage textures by WebGPU's base limits, and so to four
    /// mip levels.
    pub maps: wgpu::Texture,
    /// Array texture with one layer per foam level, for the renderer: at each cell foam, front of a breaker and
    /// plume of bubbles (x, z, w), each 0 to 1, and the excess over the breaking criterion (y), of which 1 to 2 is the
    /// foam source from 0 to 1.
    pub foam: wgpu::Texture,
    /// The coast up to which the sea runs; None in the open sea.
    pub coast: Option<CoastResources>,
    /// Texture of one texel, to be bound where there is no coast.
    pub placeholder: wgpu::TextureView,
    /// Sampler with linear filtering that repeats along both axes, with which the foam pass reads the wave maps.
    pub repeating_sampler: wgpu::Sampler,
    /// Number of times that buffers or textures have been allocated so far; tests check when it grows.
    pub allocation_count: u32,
    /// Number of times that frequency and spectrum tables of a plan have been computed and uploaded so far, for tests.
    pub wave_table_count: u32,
}

/// GPU buffers that describe the waves of one sea.
#[derive(Debug)]
pub struct WaveBuffers {
    /// For each cascade and magnitude of the wave vectors in its lattice, the values from which the spectrum pass
    /// computes the directional spectrum: variances (m^2) and spreading parameters, in vectors of four f32. Behind them
    /// lie the densities over frequency and direction of a measured spectrum, if the sea has one.
    pub spectrum_table: wgpu::Buffer,
    /// For each cascade and magnitude of the wave vectors in its lattice: the number of wave cycles in the sea's repeat
    /// period (u32), and the orbit axis ratio (horizontal to vertical) divided by the wave number (f32, m).
    pub wave_table: wgpu::Buffer,
    /// Fourier amplitudes h0 of the waves at time 0, m: complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
    /// With a coast, the same amplitudes in two parts.
    pub split: Option<SplitAmplitudes>,
}

/// Fourier amplitudes h0, parted into those of the waves that a coast transforms and those of all others.
#[derive(Debug)]
pub struct SplitAmplitudes {
    /// All other waves, \[cascade\]\[iz\]\[ix\].
    pub others: wgpu::Buffer,
    /// The waves of the first cascade that the coast transforms, \[iz\]\[ix\].
    pub offshore: wgpu::Buffer,
}

impl SplitAmplitudes {
    fn new(gpu: &Gpu, h0: &wgpu::Buffer, n: u32) -> Self {
        Self {
            others: gpu.storage_buffer("h0/others", h0.size()),
            offshore: gpu.storage_buffer("h0/offshore", 8 * point_count(n)),
        }
    }
}

impl WaveBuffers {
    /// Amplitudes that the row pass reads: of all waves or, with a coast, of those that it leaves alone.
    pub fn row_input(&self) -> &wgpu::Buffer {
        self.split.as_ref().map_or(&self.h0, |split| &split.others)
    }

    fn new(gpu: &Gpu, plan: &Plan, cascades: usize) -> Self {
        let entries = (table::entry_count(plan.n) * cascades) as u64;
        let quadruples = table::directional_terms(plan).1 as u64;
        Self {
            spectrum_table: gpu.storage_buffer("spectrum table", 16 * entries * quadruples),
            wave_table: gpu.storage_buffer("wave table", 8 * entries),
            h0: gpu.storage_buffer("h0", 8 * point_count(plan.n) * cascades as u64),
            split: None,
        }
    }
}

/// Number of cells along a side of a foam level of a sea whose maps have `n` texels along a side.
pub fn foam_cells_per_side(n: u32) -> u32 {
    n.min(256)
}

impl Resources {
    /// Allocates buffers and textures for a plan's FFT size and number of cascades, with maps in the given format.
    /// Fills only the twiddle factors.
    pub fn new(gpu: &Gpu, plan: &Plan, format: MapFormat) -> Self {
        let (n, cascades) = (plan.n, plan.cascades.len());
        let foam_n = foam_cells_per_side(n);
        let twiddle = gpu.storage_buffer("twiddle", (TWIDDLE_COUNT * size_of::<[f32; 2]>()) as u64);
        gpu.queue.write_buffer(&twiddle, 0, bytemuck::cast_slice(&twiddle_factors()));
        Self {
            n,
            foam_n,
            wave_buffers: vec![WaveBuffers::new(gpu, plan, cascades)],
            current_wave_buffers_index: 0,
            twiddle_factors: twiddle,
            row_transforms: gpu.storage_buffer("row transforms", row_transform_bytes(n, cascades)),
            foam_history: gpu.storage_buffer("foam history", 12 * FOAM_LEVEL_COUNT as u64 * point_count(foam_n)),
            format,
            maps: create_map_texture(gpu, n, cascades, format),
            foam: create_array_texture(gpu, "foam", [foam_n, foam_n, FOAM_LEVEL_COUNT as u32], 1, format),
            coast: None,
            placeholder: create_placeholder(gpu, format),
            repeating_sampler: gpu.sampler("repeat", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Linear),
            allocation_count: 1,
            wave_table_count: 0,
        }
    }

    /// Buffers that describe the waves of the current sea: spectrum, frequencies and Fourier amplitudes h0.
    pub fn current_waves(&self) -> &WaveBuffers {
        &self.wave_buffers[self.current_wave_buffers_index]
    }

    /// Index of the layer of the current sea's first cascade, the same for each kind of map: 0, or behind all layers that
    /// the other sea of a cross-fade can have.
    pub fn first_layer(&self) -> u32 {
        (self.current_wave_buffers_index * self.most_layers_per_sea()) as u32
    }

    /// Largest number of layers of a kind of map that a sea has: with a coast, it adds its own.
    fn most_layers_per_sea(&self) -> usize {
        if self.coast.is_some() { MAX_SEA_LAYERS + BREAKER_LAYERS } else { MAX_CASCADES }
    }

    /// Allocates what a coast with the given transfer functions needs and fills it, or with None frees that. The maps are
    /// new textures without contents. All bind groups must be renewed.
    pub fn set_coast(&mut self, gpu: &Gpu, plan: &Plan, transfer: Option<Arc<Transfer>>) {
        self.coast = transfer.map(|transfer| CoastResources::new(gpu, transfer, self.n, self.format));
        let added = if self.coast.is_some() { COAST_LAYERS + BREAKER_LAYERS } else { 0 };
        let layers =
            if self.wave_buffers.len() == 1 { plan.cascades.len() + added } else { 2 * self.most_layers_per_sea() };
        if self.layers_of_kind(MapKind::Displacement).end != layers as u32 {
            self.maps = create_map_texture(gpu, self.n, layers, self.format);
        }
        self.allocate_split(gpu);
        self.allocation_count += 1;
    }

    /// Gives all sets of wave buffers parted amplitudes as large as their own if there is a coast, else none.
    fn allocate_split(&mut self, gpu: &Gpu) {
        for waves in &mut self.wave_buffers {
            waves.split = waves.split.take().filter(|s| self.coast.is_some() && s.others.size() == waves.h0.size());
            if self.coast.is_some() && waves.split.is_none() {
                waves.split = Some(SplitAmplitudes::new(gpu, &waves.h0, self.n));
            }
        }
    }

    /// Makes the other set of wave buffers current when a cross-fade to `plan` starts. The first call allocates it, and
    /// maps for two seas with the most cascades, and returns true (bind groups must be renewed); later calls return
    /// false.
    pub fn swap_seas(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let is_first = self.wave_buffers.len() == 1;
        if is_first {
            self.wave_buffers.push(WaveBuffers::new(gpu, plan, MAX_CASCADES));
            self.maps = create_map_texture(gpu, self.n, 2 * self.most_layers_per_sea(), self.format);
            self.allocate_split(gpu);
            self.row_transforms = gpu.storage_buffer("row transforms", row_transform_bytes(self.n, MAX_CASCADES));
            self.allocation_count += 1;
        }
        self.current_wave_buffers_index = 1 - self.current_wave_buffers_index;
        is_first
    }

    /// Amplitudes h0 and wave table, one pair for each computation of waves by the row pass: for each set of wave buffers
    /// its waves and, with a coast, those that it transforms. [`row_input_index`] finds them.
    pub fn row_inputs(&self) -> impl Iterator<Item = [&wgpu::Buffer; 2]> {
        self.wave_buffers.iter().flat_map(|waves| {
            let offshore = waves.split.as_ref().map_or(&waves.h0, |split| &split.offshore);
            [[waves.row_input(), &waves.wave_table], [offshore, &waves.wave_table]]
        })
    }

    /// Number of mip levels of the texture `maps`, with level 0.
    pub fn mip_level_count(&self) -> u32 {
        self.maps.mip_level_count()
    }

    /// Layers of the texture `maps` that are allocated for one kind of map, one for each cascade that could be drawn.
    pub fn layers_of_kind(&self, kind: MapKind) -> Range<u32> {
        let layers = self.maps.depth_or_array_layers() / MAP_KIND_COUNT;
        kind as u32 * layers..(kind as u32 + 1) * layers
    }

    /// Layers of the texture `maps` that hold one kind of map of the current sea, which has `cascades` cascades.
    pub fn current_sea_layers(&self, kind: MapKind, cascades: usize) -> Range<u32> {
        let first = self.layers_of_kind(kind).start + self.first_layer();
        first..first + cascades as u32
    }

    /// Records a copy of mip level `level` of all layers of a kind of map into a new buffer that the CPU can read.
    pub fn stage_maps(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        kind: MapKind,
        level: u32,
    ) -> StagedTexture {
        readback::stage_layers(gpu, encoder, &self.maps, level, self.layers_of_kind(kind))
    }

    /// View of all layers and mip levels of one kind of map; the view of the slope moments starts at mip level 1.
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

    /// Computes the tables of the plan's waves (frequencies, spectrum) and uploads them to the current sea's buffers.
    /// The FFT size must be unchanged. Returns whether larger buffers had to be allocated, which need new bind groups.
    pub fn upload_wave_tables(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let mut values: Vec<[f32; 4]> = Vec::new();
        let mut waves = Vec::new();
        for table in SpectrumTable::for_all_cascades(plan) {
            values.extend(table.term_vectors.iter().map(|v| v.map(|x| x as f32)));
            // A table entry outside the cascade's band has no wave, and its wave number k is 0.
            let slant = |w: &LatticeWave| if w.k > 0.0 { (w.orbit_width_over_height / w.k) as f32 } else { 0.0 };
            waves.extend(table.waves.iter().map(|w| [w.cycles_per_period, slant(w).to_bits()]));
        }
        values.extend(table::tabulated_directions(plan).iter().map(|v| v.map(|x| x as f32)));
        self.wave_table_count += 1;
        let sea = &mut self.wave_buffers[self.current_wave_buffers_index];
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
        self.allocate_split(gpu);
        self.allocation_count += u32::from(needs_spectrum_table || needs_waves);
        let sea = &self.wave_buffers[self.current_wave_buffers_index];
        gpu.queue.write_buffer(&sea.spectrum_table, 0, bytemuck::cast_slice(&values));
        gpu.queue.write_buffer(&sea.wave_table, 0, bytemuck::cast_slice(&waves));
        needs_spectrum_table || needs_waves
    }
}

/// Index in [`Resources::row_inputs`] of the waves of the set of buffers `wave_buffers_index`, or of those that a coast
/// transforms.
pub fn row_input_index(wave_buffers_index: usize, is_offshore: bool) -> usize {
    2 * wave_buffers_index + usize::from(is_offshore)
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

fn create_placeholder(gpu: &Gpu, format: MapFormat) -> wgpu::TextureView {
    create_array_texture(gpu, "placeholder", [1; 3], 1, format).create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        ..Default::default()
    })
}

/// Creates an array texture with `mips` mip levels that shaders read and write. `size` is width, height and layers.
pub fn create_array_texture(gpu: &Gpu, label: &str, size: [u32; 3], mips: u32, format: MapFormat) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::STORAGE_BINDING
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST;
    gpu.texture(label, size, mips, format.texture_format(), usage)
}

/// View of mip level `mip` of a texture, or of all its mip levels if `mip` is None, with all layers, as a 2d array.
pub fn array_view(texture: &wgpu::Texture, mip: Option<u32>) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_mip_level: mip.unwrap_or(0),
        mip_level_count: mip.map(|_| 1),
        ..Default::default()
    })
}
