//! Bloom, light that the lens scatters (shaders/film/bloom.wgsl): the picture is halved step by step and added up
//! again. While bloom is off, it has no textures and records no passes.

use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::shaders::Shaders;

/// Largest number of times that the picture is halved in width and height for bloom.
const MAX_LEVELS: usize = 8;
/// The picture is not halved again for bloom if its shorter side would become less than this, texels.
const MIN_LEVEL_SIDE: u32 = 4;

/// Compute passes for bloom (light that the lens scatters), with their textures: they halve the picture repeatedly,
/// then add each smaller picture to the next larger one.
pub struct BloomPass {
    down: Kernel,
    up: Kernel,
    sampler: wgpu::Sampler,
    format: wgpu::TextureFormat,
    chain: Option<MipChain>,
}

struct MipChain {
    steps: Vec<(bool, wgpu::BindGroup, [u32; 2])>,
    result: wgpu::TextureView,
}

impl BloomPass {
    /// Compiles the two compute passes of bloom, for downsampling and for upsampling.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        let format = shaders.map_format(gpu).texture_format();
        let bindings =
            [BindingType::Texture, BindingType::Sampler, BindingType::StorageTexture(format), BindingType::Texture];
        let module = shaders.module(gpu, "film/bloom");
        let kernel = |entry| Kernel::new(gpu, "bloom", (&module, entry), &bindings, &[]);
        let sampler = gpu.sampler("bloom", [wgpu::AddressMode::ClampToEdge; 2], wgpu::MipmapFilterMode::Nearest);
        Self { down: kernel("downsample"), up: kernel("upsample"), sampler, format, chain: None }
    }

    /// Allocates the textures of bloom for an HDR picture (view; width and height in pixels); None turns bloom off.
    pub fn set_picture(&mut self, gpu: &Gpu, picture: Option<(&wgpu::TextureView, [u32; 2])>) {
        self.chain = picture.map(|(hdr, size)| self.create_chain(gpu, hdr, size));
    }

    /// Texture with the blurred light that bloom adds, half as wide and high as the picture; None while bloom is off.
    pub fn texture_view(&self) -> Option<&wgpu::TextureView> {
        self.chain.as_ref().map(|c| &c.result)
    }

    /// Records the compute passes (downsampling, upsampling) that fill [`Self::texture_view`]; none while bloom is off.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some(chain) = &self.chain else { return };
        for (down, group, size) in &chain.steps {
            let kernel = if *down { &self.down } else { &self.up };
            kernel.run(encoder, group, &[], [size[0].div_ceil(8), size[1].div_ceil(8), 1]);
        }
    }

    fn create_chain(&self, gpu: &Gpu, hdr: &wgpu::TextureView, size: [u32; 2]) -> MipChain {
        let view = |size: [u32; 2]| {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING;
            let texture = gpu.texture("bloom", [size[0], size[1], 1], 1, self.format, usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let step = |kernel: &Kernel, source: &wgpu::TextureView, out: &wgpu::TextureView, finer: &wgpu::TextureView| {
            use wgpu::BindingResource::{Sampler, TextureView};
            let resources = [TextureView(source), Sampler(&self.sampler), TextureView(out), TextureView(finer)];
            kernel.bind(gpu, &resources)
        };
        let mut sizes = vec![size.map(|s| s.div_ceil(2))];
        while let Some(last) = sizes.last().copied()
            && sizes.len() < MAX_LEVELS
            && last[0].min(last[1]).div_ceil(2) >= MIN_LEVEL_SIDE
        {
            sizes.push(last.map(|s| s.div_ceil(2)));
        }
        let down: Vec<_> = sizes.iter().map(|s| view(*s)).collect();
        let mut steps = vec![(true, step(&self.down, hdr, &down[0], hdr), sizes[0])];
        for i in 1..down.len() {
            steps.push((true, step(&self.down, &down[i - 1], &down[i], &down[i - 1]), sizes[i]));
        }
        let mut result = down[down.len() - 1].clone();
        for i in (0..down.len() - 1).rev() {
            let out = view(sizes[i]);
            steps.push((false, step(&self.up, &result, &out, &down[i]), sizes[i]));
            result = out;
        }
        MipChain { steps, result }
    }
}
