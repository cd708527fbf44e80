//! What the adapter can do at best, measured beside the passes.

use super::clock::Clock;
use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;

/// Size of the buffers that are copied: beyond the caches of most GPUs, within the base limits.
const COPY_BYTES: u64 = 128 << 20;
/// Dispatches of nothing in a row.
const CHAIN: u32 = 32;
/// Multiplications and additions of a pixel of the arithmetic ceiling: 8 chains of this many.
const CHAIN_OPS: u32 = 256;
/// Side of the square that is drawn for the last two ceilings.
const SIDE: u32 = 512;
/// Reads of a pixel.
const READS: u32 = 16;
/// Points along a side of the map that is read, and its levels.
const MAP_SIDE: u32 = 256;
const MAP_LEVELS: u32 = 9;

/// Ceilings of an adapter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceilings {
    /// Bytes read and written by a large copy, in 1e9 a second.
    pub copy_gb_s: f64,
    /// An empty dispatch in a pass of its own, in a chain of them, ms.
    pub launch_ms: f64,
    /// Multiplications and additions of a fragment shader that does nothing else, in 1e9 a second.
    pub shading_gflop_s: f64,
    /// Reads of a map by a fragment shader that does nothing else, in 1e9 a second: between two levels of four numbers as
    /// the program's maps have them here, all pixels of a quad at one level.
    pub reads_g_s: f64,
}

impl Ceilings {
    /// Measures them.
    ///
    /// # Errors
    /// If waiting for the GPU fails.
    pub async fn measure(clock: &Clock<'_>) -> Result<Self, String> {
        let gpu = clock.gpu;
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("copy"),
                size: COPY_BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        let (from, to) = (buffer(wgpu::BufferUsages::COPY_SRC), buffer(wgpu::BufferUsages::COPY_DST));
        let copy = clock.time(|_, encoder| encoder.copy_buffer_to_buffer(&from, 0, &to, 0, COPY_BYTES)).await?;
        from.destroy();
        to.destroy();

        let empty = empty_pipeline(gpu);
        let chain = clock.time(|_, encoder| {
            for _ in 0..CHAIN {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_pipeline(&empty);
                pass.dispatch_workgroups(1, 1, 1);
            }
        });
        let launch_ms = chain.await?.ms() / f64::from(CHAIN);

        let target = crate::gpu::offscreen::target(gpu, TARGET, [SIDE; 2]);
        let arithmetic = over_all(gpu, "arithmetic", ARITHMETIC);
        let shading = clock.time(|_, encoder| {
            crate::gpu::offscreen::draw_over(encoder, &target, |pass| {
                pass.set_pipeline(&arithmetic);
                pass.draw(0..3, 0..1);
            });
        });
        let reading = Reading::new(gpu);
        let reads = clock.time(|_, encoder| {
            crate::gpu::offscreen::draw_over(encoder, &target, |pass| {
                pass.set_pipeline(&reading.pipeline);
                pass.set_bind_group(0, &reading.group, &[]);
                pass.draw(0..3, 0..1);
            });
        });
        let flops = f64::from(SIDE * SIDE) * f64::from(2 * 8 * CHAIN_OPS);
        Ok(Self {
            copy_gb_s: 2e-6 * COPY_BYTES as f64 / copy.ms(),
            launch_ms,
            shading_gflop_s: 1e-6 * flops / shading.await?.ms(),
            reads_g_s: 1e-6 * f64::from(SIDE * SIDE * READS) / reads.await?.ms(),
        })
    }
}

const TARGET: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

fn empty_pipeline(gpu: &Gpu) -> wgpu::ComputePipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("empty"),
        source: wgpu::ShaderSource::Wgsl("@compute @workgroup_size(1) fn main() {}".into()),
    });
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("empty"),
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}

/// Eight chains, so that none waits for itself; the factors are read off the place, so that nothing is known beforehand.
const ARITHMETIC: &str = "
@fragment fn fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let by = at.xyxy * 1e-4;
  var a = at;
  var b = at.yxwz;
  for (var i = 0u; i < 256u; i++) {
    a = a * by + at.x;
    b = b * by + at.y;
  }
  return a + b;
}";

/// Each at another place, most of a map's side apart.
const READ: &str = "
@group(0) @binding(0) var map: texture_2d<f32>;
@group(0) @binding(1) var between: sampler;
@fragment fn fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
  var sum = vec4f(0.0);
  for (var i = 0u; i < 16u; i++) {
    sum += textureSampleLevel(map, between, at.xy * 0.0041 + f32(i) * vec2f(0.37, 0.61), 0.5);
  }
  return sum;
}";

/// What reads a map.
struct Reading {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl Reading {
    fn new(gpu: &Gpu) -> Self {
        let pipeline = over_all(gpu, "reads", READ);
        let map = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("reads"),
            size: wgpu::Extent3d { width: MAP_SIDE, height: MAP_SIDE, depth_or_array_layers: 1 },
            mip_level_count: MAP_LEVELS,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: MapFormat::of(gpu).texture(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let between = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("reads"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("reads"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&map.create_view(&Default::default())),
                },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&between) },
            ],
        });
        Self { pipeline, group }
    }
}

const OVER_ALL: &str = "
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}";

/// A pipeline that covers the whole target with a fragment shader.
fn over_all(gpu: &Gpu, label: &str, fragment: &str) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl([OVER_ALL, fragment].concat().into()),
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(TARGET.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
