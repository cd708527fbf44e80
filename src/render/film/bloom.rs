//! Bloom, light that the lens scatters (shaders/film/bloom.wgsl): the picture is halved step by step and added up
//! again. While bloom is off, it has no textures and records no passes.

use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use std::cell::RefCell;

/// Largest number of times that the picture is halved in width and height for bloom.
const MAX_LEVELS: usize = 8;
/// The picture is not halved again for bloom if its shorter side would become less than this, texels.
const MIN_LEVEL_SIDE: u32 = 4;

/// Compute passes for bloom (light that the lens scatters), with their textures: they halve the picture repeatedly,
/// then add each smaller picture to the next larger one.
pub struct BloomPass {
    downsample: Kernel,
    upsample: Kernel,
    sampler: wgpu::Sampler,
    format: wgpu::TextureFormat,
    chain: Option<MipChain>,
}

struct MipChain {
    steps: Vec<BloomStep>,
    result: wgpu::TextureView,
    /// All textures of the chain, which are destroyed with it.
    textures: Vec<wgpu::Texture>,
}

/// One compute dispatch of bloom, which halves a picture in width and height or adds it to the next larger one.
struct BloomStep {
    /// Whether this step halves a picture; otherwise it adds a smaller picture to a larger one.
    is_downsampling: bool,
    /// Bind group of the textures that the step reads and writes.
    group: wgpu::BindGroup,
    /// Width and height of the picture that the step writes, texels.
    size: [u32; 2],
}

impl BloomPass {
    /// Compiles the two compute passes of bloom, for downsampling and for upsampling; allocates no textures yet.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        let format = shaders.map_format(gpu).texture_format();
        let bindings =
            [BindingType::Texture, BindingType::Sampler, BindingType::StorageTexture(format), BindingType::Texture];
        let module = shaders.module(gpu, "film/bloom");
        let kernel = |entry| Kernel::new(gpu, "bloom", (&module, entry), &bindings, &[]);
        let sampler = gpu.sampler("bloom", [wgpu::AddressMode::ClampToEdge; 2], wgpu::MipmapFilterMode::Nearest);
        Self { downsample: kernel("downsample"), upsample: kernel("upsample"), sampler, format, chain: None }
    }

    /// Allocates the textures of bloom for an HDR picture (view; width and height in pixels); None turns bloom off.
    pub fn set_picture(&mut self, gpu: &Gpu, picture: Option<(&wgpu::TextureView, [u32; 2])>) {
        for texture in self.chain.take().iter().flat_map(|chain| &chain.textures) {
            texture.destroy();
        }
        self.chain = picture.map(|(hdr, size)| self.create_chain(gpu, hdr, size));
    }

    /// Texture with the blurred light that bloom adds, half as wide and high as the picture; None while bloom is off.
    pub fn texture_view(&self) -> Option<&wgpu::TextureView> {
        self.chain.as_ref().map(|c| &c.result)
    }

    /// Records the compute passes (downsampling, upsampling) that fill [`Self::texture_view`]; none while bloom is off.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        let Some(chain) = &self.chain else { return };
        for BloomStep { is_downsampling, group, size } in &chain.steps {
            let kernel = if *is_downsampling { &self.downsample } else { &self.upsample };
            let workgroups = [size[0].div_ceil(8), size[1].div_ceil(8), 1];
            kernel.run(encoder, timer.compute_pass("bloom"), group, &[], workgroups);
        }
    }

    fn create_chain(&self, gpu: &Gpu, hdr: &wgpu::TextureView, size: [u32; 2]) -> MipChain {
        let textures = RefCell::<Vec<wgpu::Texture>>::default();
        let view = |size: [u32; 2]| {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING;
            let texture = gpu.texture("bloom", [size[0], size[1], 1], 1, self.format, usage);
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            textures.borrow_mut().push(texture);
            view
        };
        let bind = |kernel: &Kernel, source: &wgpu::TextureView, out: &wgpu::TextureView, finer: &wgpu::TextureView| {
            use wgpu::BindingResource::{Sampler, TextureView};
            let resources = [TextureView(source), Sampler(&self.sampler), TextureView(out), TextureView(finer)];
            kernel.bind(gpu, &resources)
        };
        let downsampling = |source: &wgpu::TextureView, out: &wgpu::TextureView, size: [u32; 2]| {
            let group = bind(&self.downsample, source, out, source);
            BloomStep { is_downsampling: true, group, size }
        };
        let mut sizes = vec![size.map(|s| s.div_ceil(2))];
        while let Some(last) = sizes.last().copied()
            && sizes.len() < MAX_LEVELS
            && last[0].min(last[1]).div_ceil(2) >= MIN_LEVEL_SIDE
        {
            sizes.push(last.map(|s| s.div_ceil(2)));
        }
        let halved: Vec<_> = sizes.iter().map(|s| view(*s)).collect();
        let mut steps = vec![downsampling(hdr, &halved[0], sizes[0])];
        for i in 1..halved.len() {
            steps.push(downsampling(&halved[i - 1], &halved[i], sizes[i]));
        }
        let mut result = halved[halved.len() - 1].clone();
        for i in (0..halved.len() - 1).rev() {
            let out = view(sizes[i]);
            let group = bind(&self.upsample, &result, &out, &halved[i]);
            steps.push(BloomStep { is_downsampling: false, group, size: sizes[i] });
            result = out;
        }
        let textures = textures.into_inner();
        MipChain { steps, result, textures }
    }
}
