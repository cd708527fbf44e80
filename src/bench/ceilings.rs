//! What the adapter can do at best, measured beside the passes.

use super::clock::Clock;

/// Size of the buffers that are copied: beyond the caches of most GPUs, within the base limits.
const COPY_BYTES: u64 = 128 << 20;
/// Dispatches of nothing in a row.
const CHAIN: u32 = 32;
/// Multiplications and additions of a pixel of the arithmetic ceiling: 8 chains of this many.
const CHAIN_OPS: u32 = 256;
/// Side of the square that is drawn for it.
const SIDE: u32 = 512;

/// Ceilings of an adapter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceilings {
    /// Bytes read and written by a large copy, in 1e9 a second.
    pub copy_gb_s: f64,
    /// An empty dispatch in a pass of its own, in a chain of them, ms.
    pub launch_ms: f64,
    /// Multiplications and additions of a fragment shader that does nothing else, in 1e9 a second.
    pub shading_gflop_s: f64,
}

impl Ceilings {
    /// Measures them.
    ///
    /// # Errors
    /// If waiting for the GPU fails.
    pub async fn measure(clock: &Clock<'_>) -> Result<Self, String> {
        let device = clock.device;
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
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

        let empty = empty_pipeline(device);
        let chain = clock.time(|_, encoder| {
            for _ in 0..CHAIN {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_pipeline(&empty);
                pass.dispatch_workgroups(1, 1, 1);
            }
        });
        let launch_ms = chain.await?.ms() / f64::from(CHAIN);

        let target = crate::gpu::offscreen::target(device, TARGET, [SIDE; 2]);
        let arithmetic = arithmetic_pipeline(device);
        let shading = clock.time(|_, encoder| {
            crate::gpu::offscreen::draw_over(encoder, &target, |pass| {
                pass.set_pipeline(&arithmetic);
                pass.draw(0..3, 0..1);
            });
        });
        let flops = f64::from(SIDE * SIDE) * f64::from(2 * 8 * CHAIN_OPS);
        Ok(Self {
            copy_gb_s: 2e-6 * COPY_BYTES as f64 / copy.ms(),
            launch_ms,
            shading_gflop_s: 1e-6 * flops / shading.await?.ms(),
        })
    }
}

const TARGET: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

fn empty_pipeline(device: &wgpu::Device) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("empty"),
        source: wgpu::ShaderSource::Wgsl("@compute @workgroup_size(1) fn main() {}".into()),
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
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
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
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

fn arithmetic_pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("arithmetic"),
        source: wgpu::ShaderSource::Wgsl(ARITHMETIC.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("arithmetic"),
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
