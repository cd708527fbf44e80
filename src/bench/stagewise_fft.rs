//! The baseline: computes the waves as common browser demos do. Every radix-2 stage of the FFT of every field of every
//! cascade is a dispatch from texture to texture, with factors from a texture. A last dispatch per cascade merges the
//! fields into maps. A test checks that these maps equal the program's.
//!
//! The baseline is a fair one: bind groups are created once, and spectra lie in the order of the transform, so that no
//! pass permutes them.

use crate::gpu::Gpu;
use crate::gpu::kit::begin_compute;
use crate::ocean::Maps;
use bytemuck::{Pod, Zeroable};
use std::f64::consts::TAU;

/// Number of complex fields that are transformed for each cascade. Each packs two of the eight real fields of the maps.
const COMPLEX_FIELDS_PER_CASCADE: usize = 4;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct EvolveUniform {
    cascade: u32,
    dk: f32,
    period_fraction_u32: u32,
    unused: u32,
}

/// One compute dispatch of the baseline: a thread for each texel of a cascade's map, in workgroups of 8 x 8 threads.
struct Dispatch {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    workgroups: u32,
}

impl Dispatch {
    fn new(gpu: &Gpu, pipeline: &wgpu::ComputePipeline, resources: &[wgpu::BindingResource<'_>], n: u32) -> Self {
        let group = gpu.bind_group("stage", &pipeline.get_bind_group_layout(0), resources);
        Self { pipeline: pipeline.clone(), group, workgroups: n / 8 }
    }
}

/// The baseline of the benchmark: computes the waves' maps by an FFT with one dispatch per stage, as browser demos do.
pub struct StagewiseFft {
    dispatches: Vec<Dispatch>,
    /// Displacement maps that the baseline writes, one per cascade. Texels: displacement Dx (east), height eta,
    /// displacement Dz (south), all in m, and dDx/dz; before choppiness is applied.
    pub displacement: Vec<wgpu::Texture>,
    /// Gradient maps that the baseline writes, one per cascade. Texels: slopes d eta/dx and d eta/dz, then dDx/dx and
    /// dDz/dz of the horizontal displacement, before choppiness is applied.
    pub gradients: Vec<wgpu::Texture>,
}

impl StagewiseFft {
    /// Creates the dispatches that compute displacement and gradient maps of the current sea of `maps`, for the time
    /// `maps.period_fraction_u32` (in 2^-32 of the sea's repeat period). They read the waves' Fourier amplitudes at
    /// time 0 in the buffer `maps.h0`, which must be filled.
    pub fn new(gpu: &Gpu, maps: &Maps) -> Self {
        let n = maps.n;
        let transform = FieldFft::new(gpu, n);
        let mut out = Self { dispatches: Vec::new(), displacement: Vec::new(), gradients: Vec::new() };
        let evolve = pipeline_with_auto_layout(gpu, "evolve", include_str!("../../shaders/bench/evolve.wgsl"));
        let merge = pipeline_with_auto_layout(gpu, "merge", include_str!("../../shaders/bench/merge.wgsl"));
        for (cascade, place) in (0..).zip(maps.current_ordinary_cascades()) {
            let values = EvolveUniform {
                cascade,
                dk: (TAU / place.patch_m) as f32,
                period_fraction_u32: maps.period_fraction_u32,
                unused: 0,
            };
            let uniform = uniform_buffer(gpu, bytemuck::bytes_of(&values));
            let fields: [[wgpu::TextureView; 2]; COMPLEX_FIELDS_PER_CASCADE] =
                std::array::from_fn(|_| transform.create_field_texture_pair(gpu));
            let mut bound =
                vec![uniform.as_entire_binding(), maps.h0.as_entire_binding(), maps.wave_table.as_entire_binding()];
            bound.extend(fields.iter().map(|pair| wgpu::BindingResource::TextureView(&pair[0])));
            out.dispatches.push(Dispatch::new(gpu, &evolve, &bound, n));
            for pair in &fields {
                out.dispatches.extend(transform.dispatches(gpu, pair));
            }
            let map = |label| {
                let map = storage_texture(gpu, label, n, wgpu::TextureFormat::Rgba16Float);
                let view = map.create_view(&wgpu::TextureViewDescriptor::default());
                (map, view)
            };
            let ((displacement, d), (gradients, g)) = (map("displacement"), map("gradients"));
            let views = fields.iter().map(|pair| &pair[0]).chain([&d, &g]);
            let bound: Vec<_> = views.map(wgpu::BindingResource::TextureView).collect();
            out.dispatches.push(Dispatch::new(gpu, &merge, &bound, n));
            out.displacement.push(displacement);
            out.gradients.push(gradients);
        }
        out
    }

    /// Number of compute dispatches with which the baseline computes the maps of all cascades.
    pub fn dispatch_count(&self) -> usize {
        self.dispatches.len()
    }

    /// Records all dispatches of the baseline, each in its own compute pass. They write `displacement` and `gradients`.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        for dispatch in &self.dispatches {
            let mut pass = begin_compute(encoder, "stage", None);
            pass.set_pipeline(&dispatch.pipeline);
            pass.set_bind_group(0, &dispatch.group, &[]);
            pass.dispatch_workgroups(dispatch.workgroups, dispatch.workgroups, 1);
        }
    }
}

/// Pipeline and tables for the FFT of a complex field (two packed real quantities of the maps), shared by all fields.
struct FieldFft {
    n: u32,
    stage: wgpu::ComputePipeline,
    butterfly: wgpu::TextureView,
    /// Uniform buffer (stage number, axis) of every radix-2 stage: first the stages along x, then those along z.
    stages: Vec<wgpu::Buffer>,
}

impl FieldFft {
    fn new(gpu: &Gpu, n: u32) -> Self {
        let stages = n.ilog2();
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let butterfly = gpu.texture("butterfly", [n, stages, 1], 1, wgpu::TextureFormat::Rgba32Float, usage);
        gpu.write_texture(&butterfly, 0, bytemuck::cast_slice(&butterflies(n)));
        let uniforms = [0, 1].into_iter().flat_map(|vertical| (0..stages).map(move |stage| [stage, vertical]));
        Self {
            n,
            stage: pipeline_with_auto_layout(gpu, "stage", include_str!("../../shaders/bench/stage.wgsl")),
            butterfly: butterfly.create_view(&wgpu::TextureViewDescriptor::default()),
            stages: uniforms.map(|values| uniform_buffer(gpu, bytemuck::cast_slice(&values))).collect(),
        }
    }

    /// Creates the two n x n textures of a complex field. Each FFT stage reads one and writes the other.
    fn create_field_texture_pair(&self, gpu: &Gpu) -> [wgpu::TextureView; 2] {
        std::array::from_fn(|_| {
            storage_texture(gpu, "field", self.n, wgpu::TextureFormat::Rg32Float)
                .create_view(&wgpu::TextureViewDescriptor::default())
        })
    }

    /// Creates one dispatch for each stage of a field's FFT along x and z. They read one texture of `pair` and write
    /// the other in turn. Their number is even, so the first texture holds the result.
    fn dispatches(&self, gpu: &Gpu, pair: &[wgpu::TextureView; 2]) -> Vec<Dispatch> {
        let bind = |(i, uniform): (usize, &wgpu::Buffer)| {
            let resources = [
                uniform.as_entire_binding(),
                wgpu::BindingResource::TextureView(&self.butterfly),
                wgpu::BindingResource::TextureView(&pair[i % 2]),
                wgpu::BindingResource::TextureView(&pair[(i + 1) % 2]),
            ];
            Dispatch::new(gpu, &self.stage, &resources, self.n)
        };
        self.stages.iter().enumerate().map(bind).collect()
    }
}

/// Table of the butterflies of an FFT of size `n`, with `n` entries for each radix-2 stage: real and imaginary part of
/// the twiddle factor, and the indices of the two points to combine. The first stage reads in bit-reversed order.
fn butterflies(n: u32) -> Vec<[f32; 4]> {
    let bits = n.ilog2();
    let reversed = |i: u32| i.reverse_bits() >> (32 - bits);
    let entry = |stage: u32, i: u32| {
        let span = 1 << stage;
        let turn = (i * (n >> (stage + 1))) % n;
        let angle = TAU * f64::from(turn) / f64::from(n);
        let first = i & !span;
        let places = if stage == 0 { [reversed(first), reversed(first + 1)] } else { [first, first + span] };
        [angle.cos() as f32, angle.sin() as f32, places[0] as f32, places[1] as f32]
    };
    (0..bits).flat_map(|stage| (0..n).map(move |i| entry(stage, i))).collect()
}

/// Creates a compute pipeline from a WGSL text, with a bind group layout that wgpu derives from the shader.
fn pipeline_with_auto_layout(gpu: &Gpu, label: &str, source: &str) -> wgpu::ComputePipeline {
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: None,
        module: &gpu.shader_module(label, source),
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}

fn uniform_buffer(gpu: &Gpu, bytes: &[u8]) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    let buffer = gpu.buffer("stage", bytes.len() as u64, usage);
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}

/// Creates a texture of n x n texels in the given format that shaders write and read.
fn storage_texture(gpu: &Gpu, label: &str, n: u32, format: wgpu::TextureFormat) -> wgpu::Texture {
    let usage =
        wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
    gpu.texture(label, [n, n, 1], 1, format, usage)
}
