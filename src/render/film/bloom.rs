//! shaders/film/bloom.wgsl: a chain of halved pictures, down and up again. Nothing is made or recorded while it is off.

use crate::gpu::map_format::MapFormat;
use crate::gpu::shaders::Shaders;
use crate::render::kit::{Slot, group, layout};

/// Most halvings.
const MOST_LEVELS: usize = 8;
/// Rows of the coarsest level, at least.
const LEAST_ROWS: u32 = 4;

/// The chain for one picture.
pub struct Bloom {
    down: wgpu::ComputePipeline,
    up: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    format: MapFormat,
    chain: Option<Chain>,
}

struct Chain {
    steps: Vec<(bool, wgpu::BindGroup, [u32; 2])>,
    result: wgpu::TextureView,
}

impl Bloom {
    /// Compiles the passes.
    pub fn new(device: &wgpu::Device, shaders: &Shaders) -> Self {
        let format = shaders.maps(device);
        let slots = [Slot::Texture, Slot::Sampler, Slot::Image(format), Slot::Texture];
        let layout = layout(device, "bloom", wgpu::ShaderStages::COMPUTE, &slots);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("bloom"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = shaders.module(device, "bloom");
        let pipeline = |entry| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("bloom"),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("bloom"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self { down: pipeline("down"), up: pipeline("up"), layout, sampler, format, chain: None }
    }

    /// Makes the chain of a picture, or lets it go.
    pub fn bind(&mut self, device: &wgpu::Device, picture: Option<(&wgpu::TextureView, [u32; 2])>) {
        self.chain = picture.map(|(hdr, size)| self.chain(device, hdr, size));
    }

    /// What was spread, half as large as the picture.
    pub fn result(&self) -> Option<&wgpu::TextureView> {
        self.chain.as_ref().map(|c| &c.result)
    }

    /// Records the passes, if there is a chain.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some(chain) = &self.chain else { return };
        for (down, group, size) in &chain.steps {
            let mut pass = encoder
                .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("bloom"), timestamp_writes: None });
            pass.set_pipeline(if *down { &self.down } else { &self.up });
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(size[0].div_ceil(8), size[1].div_ceil(8), 1);
        }
    }

    fn chain(&self, device: &wgpu::Device, hdr: &wgpu::TextureView, size: [u32; 2]) -> Chain {
        let view = |size: [u32; 2]| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("bloom"),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: self.format.texture(),
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let step = |source: &wgpu::TextureView, out: &wgpu::TextureView, finer: &wgpu::TextureView| {
            use wgpu::BindingResource::{Sampler, TextureView};
            let resources = [TextureView(source), Sampler(&self.sampler), TextureView(out), TextureView(finer)];
            group(device, "bloom", &self.layout, &resources)
        };
        let mut sizes = vec![size.map(|s| s.div_ceil(2))];
        while let Some(last) = sizes.last().copied()
            && sizes.len() < MOST_LEVELS
            && last[0].min(last[1]).div_ceil(2) >= LEAST_ROWS
        {
            sizes.push(last.map(|s| s.div_ceil(2)));
        }
        let down: Vec<_> = sizes.iter().map(|s| view(*s)).collect();
        let mut steps = vec![(true, step(hdr, &down[0], hdr), sizes[0])];
        for i in 1..down.len() {
            steps.push((true, step(&down[i - 1], &down[i], &down[i - 1]), sizes[i]));
        }
        let mut result = down[down.len() - 1].clone();
        for i in (0..down.len() - 1).rev() {
            let out = view(sizes[i]);
            steps.push((false, step(&result, &out, &down[i]), sizes[i]));
            result = out;
        }
        Chain { steps, result }
    }
}
