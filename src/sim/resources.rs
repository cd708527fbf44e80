//! Buffers and textures of a simulation, allocated once for an FFT size and a number of cascades.

use super::transform::{TWIDDLES, twiddles};
use crate::gpu::layout::FOAM_LEVELS;
use crate::model::Plan;
use crate::model::table::{self, Table};

/// Format of every map.
pub const MAP_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Smallest mip of a map is this many texels a side.
const SMALLEST_MIP: u32 = 4;

/// Everything that a simulation holds on the GPU, without parameters.
#[derive(Debug)]
pub struct Resources {
    /// FFT size.
    pub n: u32,
    /// Cascades.
    pub count: u32,
    /// Cells along a side of a foam level.
    pub foam_n: u32,
    /// Variances and lobes, as many quadruples of f32 as the sea has parts per triangle entry and cascade.
    pub radial: wgpu::Buffer,
    /// Turns (u32) and orbit (f32) per triangle entry and cascade.
    pub wave: wgpu::Buffer,
    /// e^(2 pi i j / 1024), f32.
    pub twiddle: wgpu::Buffer,
    /// h0, complex f32, \[cascade\]\[iz\]\[ix\] in FFT order.
    pub h0: wgpu::Buffer,
    /// Transformed lines, two complex f32 pairs, \[cascade\]\[pair\]\[iz\]\[x\].
    pub lines: wgpu::Buffer,
    /// Foam, f32, \[level\]\[z\]\[x\].
    pub foam_history: wgpu::Buffer,
    /// Displacement maps with mips, layer = cascade.
    pub displacement: wgpu::Texture,
    /// Gradient maps with mips.
    pub gradients: wgpu::Texture,
    /// Slope moments with mips, from half the size down.
    pub moments: wgpu::Texture,
    /// Visible foam, layer = level.
    pub foam: wgpu::Texture,
    /// Linear, repeating.
    pub repeat: wgpu::Sampler,
}

impl Resources {
    /// Allocates for the size and cascades of a plan.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, plan: &Plan) -> Self {
        let (n, count) = (plan.n, plan.cascades.len() as u32);
        let foam_n = n.min(256);
        let points = u64::from(n) * u64::from(n) * u64::from(count);
        let entries = table::len(n) as u64 * u64::from(count);
        let storage = |label, size| {
            let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let map = |label, side: u32, layers, mips| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers },
                mip_level_count: mips,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: MAP_FORMAT,
                usage: wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::COPY_SRC
                    | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            })
        };
        let mips = (n / SMALLEST_MIP).ilog2() + 1;
        let twiddle = storage("twiddle", (TWIDDLES * size_of::<[f32; 2]>()) as u64);
        queue.write_buffer(&twiddle, 0, bytemuck::cast_slice(&twiddles()));
        Self {
            n,
            count,
            foam_n,
            radial: radial(device, entries * table::terms(plan).1 as u64),
            wave: storage("wave", 8 * entries),
            twiddle,
            h0: storage("h0", 8 * points),
            lines: storage("lines", 32 * points),
            foam_history: storage("foam history", 4 * FOAM_LEVELS as u64 * u64::from(foam_n * foam_n)),
            displacement: map("displacement", n, count, mips),
            gradients: map("gradients", n, count, mips),
            moments: map("moments", n / 2, count, mips - 1),
            foam: map("foam", foam_n, FOAM_LEVELS as u32, 1),
            repeat: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("repeat"),
                address_mode_u: wgpu::AddressMode::Repeat,
                address_mode_v: wgpu::AddressMode::Repeat,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..Default::default()
            }),
        }
    }

    /// Mip levels of the displacement and gradient maps.
    pub fn mips(&self) -> u32 {
        self.displacement.mip_level_count()
    }

    /// Tabulates a sea of the same size and cascades and sends it to the GPU; returns whether `radial` had to grow.
    pub fn upload_tables(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, plan: &Plan) -> bool {
        let mut values: Vec<[f32; 4]> = Vec::new();
        let mut waves = Vec::new();
        for table in Table::all(plan) {
            values.extend(table.values.iter().map(|v| v.map(|x| x as f32)));
            waves.extend(table.waves.iter().map(|w| [w.turns, (w.orbit as f32).to_bits()]));
        }
        let grows = size_of_val(values.as_slice()) as u64 > self.radial.size();
        if grows {
            self.radial = radial(device, values.len() as u64);
        }
        queue.write_buffer(&self.radial, 0, bytemuck::cast_slice(&values));
        queue.write_buffer(&self.wave, 0, bytemuck::cast_slice(&waves));
        grows
    }
}

fn radial(device: &wgpu::Device, quadruples: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("radial"),
        size: 16 * quadruples,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
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
