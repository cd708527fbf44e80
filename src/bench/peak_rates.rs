//! Measures the peak rates of the adapter, in the same run as the passes that are compared with them.

use super::clock::Stopwatch;
use crate::gpu::kit::{AttachmentFormats, BindingType, RenderProgram, begin_compute};
use crate::gpu::map_format::MapFormat;
use crate::gpu::{Gpu, offscreen};

/// Size of the buffer whose copying is timed, bytes: larger than the caches of most GPUs, within WebGPU's base limits.
const COPY_BYTES: u64 = 128 << 20;
/// Number of empty dispatches, each in a compute pass of its own, in one timed piece of work.
const EMPTY_DISPATCHES: u32 = 32;
/// Number of multiply-adds in each of the eight chains that the arithmetic shader computes for a pixel.
const MULTIPLY_ADDS_PER_CHAIN: u32 = 256;
/// Side of the square picture that the arithmetic and texture-read shaders draw while they are timed, pixels.
const TARGET_SIDE_PX: u32 = 512;
/// Number of texture samples that the shader for the rate of texture reads takes per pixel.
const READS_PER_PIXEL: u32 = 16;
/// Side of the texture that the shader for texture reads samples, texels. It has `SAMPLED_TEXTURE_MIP_LEVELS` mip
/// levels.
const SAMPLED_TEXTURE_SIDE_TEXELS: u32 = 256;
const SAMPLED_TEXTURE_MIP_LEVELS: u32 = 9;

/// Measured peak rates of an adapter (copying, arithmetic, texture reads) and its overhead per dispatch. The measured
/// times of the program's passes are compared with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeakRates {
    /// Rate of a large copy from buffer to buffer: bytes read plus bytes written, 1e9 bytes per second.
    pub copy_gb_s: f64,
    /// Time of one empty dispatch in a compute pass of its own, ms: the mean of many dispatches in a row.
    pub empty_dispatch_ms: f64,
    /// Rate of multiplications and additions in a fragment shader without other work, 1e9 operations per second; a
    /// multiply-add counts as two.
    pub shading_gflop_s: f64,
    /// Rate of trilinear samples of a texture in the format of the maps, in a fragment shader without other work, 1e9
    /// samples per second. All samples lie between the same two mip levels.
    pub giga_texture_reads_per_s: f64,
}

impl PeakRates {
    /// Measures all peak rates on the stopwatch's device.
    ///
    /// # Errors
    /// If waiting for the GPU fails.
    pub async fn measure(stopwatch: &Stopwatch<'_>) -> Result<Self, String> {
        let gpu = stopwatch.gpu;
        let [from, to] = [wgpu::BufferUsages::COPY_SRC, wgpu::BufferUsages::COPY_DST]
            .map(|usage| gpu.buffer("copy", COPY_BYTES, usage));
        let copy = stopwatch.measure(|_, encoder| encoder.copy_buffer_to_buffer(&from, 0, &to, 0, COPY_BYTES)).await?;
        from.destroy();
        to.destroy();

        let module = gpu.shader_module("empty", "@compute @workgroup_size(1) fn main() {}");
        let empty = gpu.compute_pipeline("empty", (&module, "main"), &[], &[]);
        let chain = stopwatch.measure(|_, encoder| {
            for _ in 0..EMPTY_DISPATCHES {
                let mut pass = begin_compute(encoder, "empty", None);
                pass.set_pipeline(&empty);
                pass.dispatch_workgroups(1, 1, 1);
            }
        });
        let empty_dispatch_ms = chain.await?.gpu_or_median_wall_ms() / f64::from(EMPTY_DISPATCHES);

        let target = offscreen::create_target(gpu, TARGET_FORMAT, [TARGET_SIDE_PX; 2]);
        let arithmetic = full_screen_pipeline(gpu, "arithmetic", ARITHMETIC_SHADER, &[]);
        let shading = stopwatch.measure(|_, encoder| {
            offscreen::clear_and_draw(encoder, &target, |pass| {
                pass.set_pipeline(&arithmetic);
                pass.draw(0..3, 0..1);
            });
        });
        let (reading, group) = texture_read_pipeline(gpu);
        let reads = stopwatch.measure(|_, encoder| {
            offscreen::clear_and_draw(encoder, &target, |pass| {
                pass.set_pipeline(&reading);
                pass.set_bind_group(0, &group, &[]);
                pass.draw(0..3, 0..1);
            });
        });
        let flops = f64::from(TARGET_SIDE_PX * TARGET_SIDE_PX) * f64::from(2 * 8 * MULTIPLY_ADDS_PER_CHAIN);
        Ok(Self {
            copy_gb_s: 2e-6 * COPY_BYTES as f64 / copy.gpu_or_median_wall_ms(),
            empty_dispatch_ms,
            shading_gflop_s: 1e-6 * flops / shading.await?.gpu_or_median_wall_ms(),
            giga_texture_reads_per_s: 1e-6 * f64::from(TARGET_SIDE_PX * TARGET_SIDE_PX * READS_PER_PIXEL)
                / reads.await?.gpu_or_median_wall_ms(),
        })
    }
}

const TARGET_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// WGSL fragment shader that measures the rate of arithmetic. Eight chains of multiply-adds, independent of each other,
/// hide latency. The factors depend on the pixel, so that the compiler cannot precompute them.
const ARITHMETIC_SHADER: &str = "
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

/// WGSL fragment shader that measures texture reads. Consecutive samples are far apart, so that caches help little.
const TEXTURE_READ_SHADER: &str = "
@group(0) @binding(0) var map: texture_2d<f32>;
@group(0) @binding(1) var between: sampler;
@fragment fn fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
  var sum = vec4f(0.0);
  for (var i = 0u; i < 16u; i++) {
    sum += textureSampleLevel(map, between, at.xy * 0.0041 + f32(i) * vec2f(0.37, 0.61), 0.5);
  }
  return sum;
}";

/// Creates the pipeline that measures texture reads, and the bind group with the texture and sampler that it reads.
fn texture_read_pipeline(gpu: &Gpu) -> (wgpu::RenderPipeline, wgpu::BindGroup) {
    let layout =
        gpu.bind_group_layout("reads", wgpu::ShaderStages::FRAGMENT, &[BindingType::Texture, BindingType::Sampler]);
    let (format, usage) = (MapFormat::for_device(gpu).texture_format(), wgpu::TextureUsages::TEXTURE_BINDING);
    let map = gpu.texture(
        "reads",
        [SAMPLED_TEXTURE_SIDE_TEXELS, SAMPLED_TEXTURE_SIDE_TEXELS, 1],
        SAMPLED_TEXTURE_MIP_LEVELS,
        format,
        usage,
    );
    let view = map.create_view(&wgpu::TextureViewDescriptor::default());
    let sampler = gpu.sampler("reads", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Linear);
    let resources = [wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&sampler)];
    let group = gpu.bind_group("reads", &layout, &resources);
    (full_screen_pipeline(gpu, "reads", TEXTURE_READ_SHADER, &[&layout]), group)
}

const FULL_SCREEN_VERTEX_SHADER: &str = "
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}";

/// Creates a pipeline that runs the fragment shader in the WGSL text `fragment` on every pixel of the render target.
fn full_screen_pipeline(
    gpu: &Gpu,
    label: &str,
    fragment: &str,
    layouts: &[&wgpu::BindGroupLayout],
) -> wgpu::RenderPipeline {
    let module = gpu.shader_module(label, &[FULL_SCREEN_VERTEX_SHADER, fragment].concat());
    gpu.render_pipeline(
        label,
        &RenderProgram::new(&module),
        layouts,
        &AttachmentFormats { formats: &[TARGET_FORMAT], depth: None, blend: None },
    )
}
