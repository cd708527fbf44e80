//! The waves as the browser demos compute them: a dispatch for every radix-2 stage of every field of every cascade, textures
//! that take turns, factors from a texture, at the end a dispatch that merges the fields into maps. Written to be measured
//! beside the program's own passes in one process; it makes the same maps from the same h0, which a test checks.
//!
//! As good as theirs: bind groups are made once, and spectra lie in the order of the transform, so that no pass has to permute
//! them.

use crate::gpu::Gpu;
use crate::ocean::Maps;
use bytemuck::{Pod, Zeroable};
use std::f64::consts::TAU;

/// Fields of a cascade, two real ones in each.
const FIELDS: usize = 4;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Evolve {
    cascade: u32,
    dk: f32,
    phase_time: u32,
    unused: u32,
}

/// A dispatch that has all it needs.
struct Step {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    size: [u32; 2],
}

/// The simulation step of a demo.
pub struct PerStage {
    steps: Vec<Step>,
    /// Dx, eta, Dz and dDx/dz of every cascade.
    pub displacement: Vec<wgpu::Texture>,
    /// d eta/dx, d eta/dz, dDx/dx and dDz/dz of every cascade.
    pub gradients: Vec<wgpu::Texture>,
}

/// What transforms one field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// A dispatch a stage.
    Stages,
    /// Two dispatches, radix 2 in workgroup memory.
    Shared,
}

impl PerStage {
    /// The dispatches for the waves of the maps' current sea at the time of the maps; its h0 must have been computed.
    pub fn new(gpu: &Gpu, maps: &Maps) -> Self {
        let n = maps.n;
        let tools = Tools::new(gpu, n);
        let mut out = Self { steps: Vec::new(), displacement: Vec::new(), gradients: Vec::new() };
        let evolve = pipeline(gpu, "evolve", include_str!("../../shaders/bench/evolve.wgsl"), &[]);
        let merge = pipeline(gpu, "merge", include_str!("../../shaders/bench/merge.wgsl"), &[]);
        for (cascade, place) in (0..).zip(maps.sea()) {
            let values = Evolve { cascade, dk: (TAU / place.patch_m) as f32, phase_time: maps.phase_time, unused: 0 };
            let uniform = uniform(gpu, bytemuck::bytes_of(&values));
            let fields: [[wgpu::TextureView; 2]; FIELDS] = std::array::from_fn(|_| tools.pair(gpu));
            let mut bound =
                vec![uniform.as_entire_binding(), maps.h0.as_entire_binding(), maps.wave.as_entire_binding()];
            bound.extend(fields.iter().map(|pair| wgpu::BindingResource::TextureView(&pair[0])));
            out.steps.push(step(gpu, &evolve, &bound, [n / 8; 2]));
            for pair in &fields {
                out.steps.extend(tools.transform(gpu, pair, Kernel::Stages));
            }
            let map = |label| {
                let map = texture(gpu, label, [n; 2], wgpu::TextureFormat::Rgba16Float);
                let view = map.create_view(&wgpu::TextureViewDescriptor::default());
                (map, view)
            };
            let ((displacement, d), (gradients, g)) = (map("displacement"), map("gradients"));
            let views = fields.iter().map(|pair| &pair[0]).chain([&d, &g]);
            let bound: Vec<_> = views.map(wgpu::BindingResource::TextureView).collect();
            out.steps.push(step(gpu, &merge, &bound, [n / 8; 2]));
            out.displacement.push(displacement);
            out.gradients.push(gradients);
        }
        out
    }

    /// The inverse transform of one complex field of `n` x `n` points by itself.
    pub fn one_field(gpu: &Gpu, n: u32, kernel: Kernel) -> Self {
        let tools = Tools::new(gpu, n);
        let steps = tools.transform(gpu, &tools.pair(gpu), kernel);
        Self { steps, displacement: Vec::new(), gradients: Vec::new() }
    }

    /// Dispatches of a step.
    pub fn dispatches(&self) -> usize {
        self.steps.len()
    }

    /// Records a step, a pass for every dispatch.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder) {
        for step in &self.steps {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&step.pipeline);
            pass.set_bind_group(0, &step.group, &[]);
            pass.dispatch_workgroups(step.size[0], step.size[1], 1);
        }
    }
}

/// What all fields share.
struct Tools {
    n: u32,
    stage: wgpu::ComputePipeline,
    shared: Option<wgpu::ComputePipeline>,
    butterfly: wgpu::TextureView,
    /// One for every stage, along rows and then along columns.
    stages: Vec<wgpu::Buffer>,
}

impl Tools {
    fn new(gpu: &Gpu, n: u32) -> Self {
        let stages = n.ilog2();
        let butterfly = texture(gpu, "butterfly", [n, stages], wgpu::TextureFormat::Rgba32Float);
        gpu.queue.write_texture(
            butterfly.as_image_copy(),
            bytemuck::cast_slice(&factors(n)),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(16 * n), rows_per_image: None },
            butterfly.size(),
        );
        let uniforms = |vertical: u32| (0..stages).map(move |stage| [stage, vertical]);
        // A workgroup has 256 threads at most.
        let fits = n <= gpu.device.limits().max_compute_invocations_per_workgroup;
        let shared = || {
            pipeline(
                gpu,
                "shared radix 2",
                include_str!("../../shaders/bench/shared_radix2.wgsl"),
                &[("N", f64::from(n))],
            )
        };
        Self {
            n,
            stage: pipeline(gpu, "stage", include_str!("../../shaders/bench/stage.wgsl"), &[]),
            shared: fits.then(shared),
            butterfly: butterfly.create_view(&wgpu::TextureViewDescriptor::default()),
            stages: (uniforms(0).chain(uniforms(1)))
                .map(|values| uniform(gpu, bytemuck::cast_slice(&values)))
                .collect(),
        }
    }

    /// The textures that take turns.
    fn pair(&self, gpu: &Gpu) -> [wgpu::TextureView; 2] {
        std::array::from_fn(|_| {
            texture(gpu, "field", [self.n; 2], wgpu::TextureFormat::Rg32Float)
                .create_view(&wgpu::TextureViewDescriptor::default())
        })
    }

    /// The steps that transform the first of a pair, and leave the result there: the number of stages is even.
    fn transform(&self, gpu: &Gpu, pair: &[wgpu::TextureView; 2], kernel: Kernel) -> Vec<Step> {
        let half = self.stages.len() / 2;
        let (pipeline, uniforms, size): (_, Vec<_>, _) = match (kernel, &self.shared) {
            (Kernel::Shared, Some(shared)) => (shared, vec![&self.stages[0], &self.stages[half]], [self.n, 1]),
            _ => (&self.stage, self.stages.iter().collect(), [self.n / 8; 2]),
        };
        let bind = |(i, uniform): (usize, &wgpu::Buffer)| {
            let bound = [
                uniform.as_entire_binding(),
                wgpu::BindingResource::TextureView(&self.butterfly),
                wgpu::BindingResource::TextureView(&pair[i % 2]),
                wgpu::BindingResource::TextureView(&pair[(i + 1) % 2]),
            ];
            step(gpu, pipeline, &bound, size)
        };
        uniforms.into_iter().enumerate().map(bind).collect()
    }
}

/// Factor and both places of every point of every stage; the first stage reads in the order of reversed bits.
fn factors(n: u32) -> Vec<[f32; 4]> {
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

fn pipeline(gpu: &Gpu, label: &str, source: &str, constants: &[(&str, f64)]) -> wgpu::ComputePipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
        cache: None,
    })
}

fn step(gpu: &Gpu, pipeline: &wgpu::ComputePipeline, bound: &[wgpu::BindingResource<'_>], size: [u32; 2]) -> Step {
    let entries: Vec<_> = (0..)
        .zip(bound)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    Step { pipeline: pipeline.clone(), group, size }
}

fn uniform(gpu: &Gpu, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("step"),
        size: bytes.len() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}

fn texture(gpu: &Gpu, label: &str, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    // Only what is computed is written by shaders: the table need not be.
    let written = match format {
        wgpu::TextureFormat::Rgba32Float => wgpu::TextureUsages::COPY_DST,
        _ => wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC,
    };
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | written,
        view_formats: &[],
    })
}
