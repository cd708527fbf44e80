//! Buffers and textures of a simulation, allocated once for an FFT size and a number of cascades, and once more when the
//! first sea fades into another.

use super::maps::{FOAM_LEVELS, MAX_CASCADES, MAX_DRAWN};
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::readback::{self, TextureCopy};
use crate::shaders::fft::{TWIDDLES, Way, twiddles};
use crate::waves::Plan;
use crate::waves::lattice::Wave;
use crate::waves::table::{self, Table};
use std::ops::Range;

/// Smallest mip of a map is this many texels a side.
const SMALLEST_MIP: u32 = 4;

/// A kind of map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Dx, eta, Dz and dDx/dz.
    Displacement,
    /// d eta/dx, d eta/dz, dDx/dx, dDz/dz.
    Gradients,
    /// Second moments of the slopes, from level 1 down.
    Moments,
}

/// Everything that a simulation holds on the GPU, without parameters.
#[derive(Debug)]
pub struct Resources {
    /// FFT size.
    pub n: u32,
    /// Cascades of the sea.
    pub count: u32,
    /// Cells along a side of a foam level.
    pub foam_n: u32,
    /// The waves of the sea.
    pub sea: Waves,
    /// Those of the sea that fades, or room for the next one. None until a sea fades.
    pub other: Option<Waves>,
    /// e^(2 pi i j / 1024), f32.
    pub twiddle: wgpu::Buffer,
    /// Transformed lines, two complex f32 pairs, \[cascade\]\[pair\]\[iz\]\[x\]; in [`Way::Merged`] half transformed,
    /// \[cascade\]\[pair\]\[iz\]\[k1\]\[t\]. Two seas take turns: both at once would not fit into one binding at n = 1024.
    pub lines: wgpu::Buffer,
    /// How the lines are transformed.
    pub way: Way,
    /// What transforms need besides that are written out.
    pub straight: Option<Straight>,
    /// Foam, f32, \[level\]\[z\]\[x\].
    pub foam_history: wgpu::Buffer,
    /// Of the maps and of the foam.
    pub format: MapFormat,
    /// All maps with mips; see [`Self::layers`]. One texture, so that a pass may write several levels of all of them: base limits
    /// allow four storage textures.
    pub maps: wgpu::Texture,
    /// Visible foam, layer = level.
    pub foam: wgpu::Texture,
    /// Linear, repeating.
    pub repeat: wgpu::Sampler,
    /// How often anything was allocated since the start.
    pub allocations: u32,
}

/// Buffers of transforms that are written out ([`Way::Straight`] and [`Way::Merged`]).
#[derive(Debug)]
pub struct Straight {
    /// Lines whose transform is half done, as large as the lines.
    pub halves: wgpu::Buffer,
    /// Both maps, \[map\]\[cascade\]\[z\]\[x\], on their way to the textures.
    pub maps: wgpu::Buffer,
}

impl Straight {
    fn new(gpu: &Gpu, n: u32, count: u64, format: MapFormat) -> Self {
        let halves = storage(gpu, "halves", line_bytes(n, count));
        Self { halves, maps: storage(gpu, "maps", 2 * u64::from(format.bytes()) * points(n) * count) }
    }
}

/// The waves of one sea.
#[derive(Debug)]
pub struct Waves {
    /// Variances and lobes, as many quadruples of f32 as the sea has parts per triangle entry and cascade.
    pub radial: wgpu::Buffer,
    /// Turns (u32) and orbit over wave number (f32, m) per triangle entry and cascade.
    pub wave: wgpu::Buffer,
    /// h0, complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
    /// Layer of the maps that the first cascade goes to.
    pub first_layer: u32,
}

impl Waves {
    fn new(gpu: &Gpu, n: u32, count: usize, quadruples: usize, first_layer: u32) -> Self {
        let entries = (table::len(n) * count) as u64;
        Self {
            radial: storage(gpu, "radial", 16 * entries * quadruples as u64),
            wave: storage(gpu, "wave", 8 * entries),
            h0: storage(gpu, "h0", 8 * points(n) * count as u64),
            first_layer,
        }
    }
}

impl Resources {
    /// Allocates for the size and cascades of a plan.
    pub fn new(gpu: &Gpu, plan: &Plan, way: Way, format: MapFormat) -> Self {
        let (n, count) = (plan.n, plan.cascades.len() as u32);
        let foam_n = n.min(256);
        let twiddle = storage(gpu, "twiddle", (TWIDDLES * size_of::<[f32; 2]>()) as u64);
        gpu.queue.write_buffer(&twiddle, 0, bytemuck::cast_slice(&twiddles()));
        Self {
            n,
            count,
            foam_n,
            sea: Waves::new(gpu, n, plan.cascades.len(), table::terms(plan).1, 0),
            other: None,
            twiddle,
            lines: storage(gpu, "lines", line_bytes(n, u64::from(count))),
            way,
            straight: (way != Way::Exchanged).then(|| Straight::new(gpu, n, u64::from(count), format)),
            foam_history: storage(gpu, "foam history", 4 * FOAM_LEVELS as u64 * u64::from(foam_n * foam_n)),
            format,
            maps: maps(gpu, n, count, format),
            foam: map(gpu, "foam", foam_n, FOAM_LEVELS as u32, 1, format),
            repeat: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("repeat"),
                address_mode_u: wgpu::AddressMode::Repeat,
                address_mode_v: wgpu::AddressMode::Repeat,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..Default::default()
            }),
            allocations: 1,
        }
    }

    /// Makes room for a second sea, and either may have as many cascades as there can be. The maps are new and empty.
    fn widen(&mut self, gpu: &Gpu, plan: &Plan) -> Waves {
        self.maps = maps(gpu, self.n, MAX_DRAWN as u32, self.format);
        self.lines = storage(gpu, "lines", line_bytes(self.n, MAX_CASCADES as u64));
        self.straight = self.straight.take().map(|_| Straight::new(gpu, self.n, MAX_CASCADES as u64, self.format));
        self.allocations += 1;
        Waves::new(gpu, self.n, MAX_CASCADES, table::terms(plan).1, MAX_CASCADES as u32)
    }

    /// The sea becomes the one that fades, and there is room for another. Returns whether the maps are new.
    pub fn turn(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let (other, is_new) = match self.other.take() {
            Some(other) => (other, false),
            None => (self.widen(gpu, plan), true),
        };
        self.other = Some(std::mem::replace(&mut self.sea, other));
        is_new
    }

    /// Mip levels of the maps.
    pub fn mips(&self) -> u32 {
        self.maps.mip_level_count()
    }

    /// Layers of a kind of map: one for each cascade that can be drawn.
    pub fn layers(&self, kind: MapKind) -> Range<u32> {
        let room = self.maps.depth_or_array_layers() / MAP_KINDS;
        kind as u32 * room..(kind as u32 + 1) * room
    }

    /// Records the copy of a level of a kind of map, all layers.
    pub fn stage(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, kind: MapKind, level: u32) -> TextureCopy {
        readback::stage_layers(gpu, encoder, &self.maps, level, self.layers(kind))
    }

    /// A kind of map with all its levels.
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

    /// Tabulates a sea of the same size and sends it to the GPU; returns whether its buffers had to grow.
    pub fn upload_tables(&mut self, gpu: &Gpu, plan: &Plan) -> bool {
        let mut values: Vec<[f32; 4]> = Vec::new();
        let mut waves = Vec::new();
        for table in Table::all(plan) {
            values.extend(table.values.iter().map(|v| v.map(|x| x as f32)));
            // Outside the band there is no wave and nothing to divide by.
            let slant = |w: &Wave| if w.k > 0.0 { (w.orbit / w.k) as f32 } else { 0.0 };
            waves.extend(table.waves.iter().map(|w| [w.turns, slant(w).to_bits()]));
        }
        self.count = plan.cascades.len() as u32;
        let sea = &mut self.sea;
        let grows = size_of_val(values.as_slice()) as u64 > sea.radial.size();
        if grows {
            sea.radial = storage(gpu, "radial", size_of_val(values.as_slice()) as u64);
        }
        // The sea that was there first has no room for more cascades than its own.
        let widens = size_of_val(waves.as_slice()) as u64 > sea.wave.size();
        if widens {
            sea.wave = storage(gpu, "wave", (8 * table::len(self.n) * MAX_CASCADES) as u64);
            sea.h0 = storage(gpu, "h0", 8 * points(self.n) * MAX_CASCADES as u64);
        }
        self.allocations += u32::from(grows || widens);
        gpu.queue.write_buffer(&sea.radial, 0, bytemuck::cast_slice(&values));
        gpu.queue.write_buffer(&sea.wave, 0, bytemuck::cast_slice(&waves));
        grows || widens
    }
}

fn points(n: u32) -> u64 {
    u64::from(n) * u64::from(n)
}

fn line_bytes(n: u32, cascades: u64) -> u64 {
    32 * points(n) * cascades
}

fn storage(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}

/// Kinds of maps.
const MAP_KINDS: u32 = 3;

fn maps(gpu: &Gpu, n: u32, layers: u32, format: MapFormat) -> wgpu::Texture {
    let mips = (n / SMALLEST_MIP).ilog2() + 1;
    map(gpu, "maps", n, MAP_KINDS * layers, mips, format)
}

/// An array of maps that shaders read and write.
pub fn map(gpu: &Gpu, label: &str, side: u32, layers: u32, mips: u32, format: MapFormat) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers },
        mip_level_count: mips,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: format.texture(),
        usage: wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// A view of one mip level or of all, as an array.
pub fn view(texture: &wgpu::Texture, mip: Option<u32>) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_mip_level: mip.unwrap_or(0),
        mip_level_count: mip.map(|_| 1),
        ..Default::default()
    })
}
