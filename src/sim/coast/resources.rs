//! GPU buffers and textures of a coast.

use super::square::CoastSquare;
use super::tables;
use super::uniform::CoastUniform;
use crate::coast::Transfer;
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::uniform::Uniform;
use half::f16;
use std::sync::Arc;

/// Format of the maps that are made once, on the CPU.
const KNOWN_MAP_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// GPU buffers and textures with which the waves at a coast are computed.
#[derive(Debug)]
pub struct CoastResources {
    /// Transfer functions from which all was made.
    pub transfer: Arc<Transfer>,
    /// Square of the world that encloses the coast.
    pub square: CoastSquare,
    /// Uniform buffer of the passes.
    pub uniform: Uniform<CoastUniform>,
    /// For each wave its indices on the lattice: two 16-bit numbers.
    pub waves: wgpu::Buffer,
    /// Envelopes of the transfer functions: two half floats for each \[wave\]\[row\]\[column\].
    pub transfer_envelopes: wgpu::Buffer,
    /// For each group its first wave, number of waves, and turns of its carrier per metre along y.
    pub groups: wgpu::Buffer,
    /// For each \[group\]\[column\] the phase of the carrier, and the turns to the next column.
    pub carriers: wgpu::Buffer,
    /// For each wave its amplitude h0 e^(-i omega t), m, and its ratio of orbit axes divided by the wave number, m.
    pub phasors: wgpu::Buffer,
    /// Sums of the waves of each group at the points, against the carrier: elevation, m, and potential, m^2. One layer for
    /// each group.
    pub envelopes: wgpu::Texture,
    /// For each point set-up, m, and reciprocal of the breaking height, 1/m.
    pub points: wgpu::TextureView,
    /// Elevation, m, and potential of the horizontal displacement, m^2, at each texel of the square.
    pub fields: wgpu::Buffer,
    /// Gains of the layers over the square; see `MapCoast::gains`.
    pub gains: wgpu::TextureView,
    /// Sampler with linear filtering that clamps to the edges.
    pub sampler: wgpu::Sampler,
}

impl CoastResources {
    /// Allocates and fills the buffers and textures, for maps of `n` x `n` texels in the given format.
    pub fn new(gpu: &Gpu, transfer: Arc<Transfer>, n: u32, format: MapFormat) -> Self {
        let square = CoastSquare::around(&transfer, n);
        let uniform = Uniform::new(gpu, "coast");
        uniform.write(gpu, &tables::uniform(&transfer, &square, n));
        let filled = |label, bytes: &[u8]| {
            // A buffer must not be empty.
            let buffer = gpu.storage_buffer(label, (bytes.len() as u64).max(16));
            gpu.queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let known = |label, size: [u32; 2], texels: &[[f16; 4]]| {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
            let texture = gpu.texture(label, [size[0], size[1], 1], 1, KNOWN_MAP_FORMAT, usage);
            gpu.write_texture(&texture, 0, bytemuck::cast_slice(texels));
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let written = |label, size: [u32; 3]| {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::COPY_SRC;
            gpu.texture(label, size, 1, format.texture_format(), usage)
        };
        let size = [transfer.columns as u32, transfer.rows as u32];
        let groups = (transfer.groups.len() as u32).max(1);
        let texels = u64::from(n) * u64::from(n);
        Self {
            square,
            uniform,
            waves: filled("coast/waves", bytemuck::cast_slice(&tables::packed_waves(&transfer, n))),
            transfer_envelopes: filled("coast/transfer", bytemuck::cast_slice(&transfer.envelopes)),
            groups: filled("coast/groups", bytemuck::cast_slice(&tables::groups(&transfer))),
            carriers: filled("coast/carriers", bytemuck::cast_slice(&tables::carriers(&transfer))),
            phasors: gpu.storage_buffer("coast/phasors", 16 * (transfer.waves.len() as u64).max(1)),
            envelopes: written("coast/envelopes", [size[0], size[1], groups]),
            points: known("coast/points", size, &tables::point_texels(&transfer)),
            fields: gpu.storage_buffer("coast/fields", 8 * texels),
            gains: known("coast/gains", [tables::GAINS_MAP_SIDE; 2], &tables::gain_texels(&transfer, &square)),
            sampler: gpu.sampler("coast", [wgpu::AddressMode::ClampToEdge; 2], wgpu::MipmapFilterMode::Nearest),
            transfer,
        }
    }
}
