//! Calls WGSL functions of the program: a compute kernel that is appended to one of its modules answers a question a
//! thread.

use super::gpu;
use seastate::gpu::{Gpu, readback};
use seastate::shaders::Shaders;
use wgpu::BufferUsages;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

/// The program's modules with the structs that Rust declares.
pub fn shaders() -> Shaders {
    Shaders::default()
        .with_structs(seastate::sim::uniforms::SHARED_STRUCTS)
        .with_structs(seastate::render::SHARED_STRUCTS)
}

/// A module with a kernel whose questions are `Q` and whose answers are `A` values of vec4f.
pub struct Kernel<const Q: usize, const A: usize> {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    groups: Vec<(u32, wgpu::BindGroup)>,
}

impl<const Q: usize, const A: usize> Kernel<Q, A> {
    /// Compiles a module with `text`, which defines `fn answer(question: Question) -> Answer`.
    pub fn new(gpu: &Gpu, shaders: &Shaders, module: &str, text: &str) -> Self {
        let (_, source) = shaders.all().find(|(name, _)| *name == module).expect("the module");
        let source = format!(
            "{source}
            alias Question = array<vec4f, {Q}>;
            alias Answer = array<vec4f, {A}>;
            @group(2) @binding(0) var<storage, read> questions: array<Question>;
            @group(2) @binding(1) var<storage, read_write> answers: array<Answer>;
            @compute @workgroup_size(64)
            fn ask(@builtin(global_invocation_id) id: vec3u) {{
              if id.x < arrayLength(&answers) {{
                answers[id.x] = answer(questions[id.x]);
              }}
            }}
            {text}"
        );
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("test"),
            // The program's layouts have bindings that a test has nothing for.
            layout: None,
            module: &gpu.shader_module("test", &source),
            entry_point: Some("ask"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { gpu: gpu.clone(), pipeline, groups: Vec::new() }
    }

    /// Binds resources, each with its binding, to a group of the module.
    pub fn bind(&mut self, group: u32, resources: &[(u32, wgpu::BindingResource<'_>)]) {
        let bound = self.group(group, resources);
        self.groups.retain(|(index, _)| *index != group);
        self.groups.push((group, bound));
    }

    /// The answers to some questions.
    pub fn ask(&self, questions: &[[[f32; 4]; Q]]) -> Vec<[[f64; 4]; A]> {
        let gpu = &self.gpu;
        let none = vec![[[f32::NAN; 4]; A]; questions.len()];
        let questions_buffer = buffer(gpu, bytemuck::cast_slice(questions.as_flattened()), BufferUsages::STORAGE);
        let answers =
            buffer(gpu, bytemuck::cast_slice(none.as_flattened()), BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let own = self.group(2, &[(0, questions_buffer.as_entire_binding()), (1, answers.as_entire_binding())]);
        let mut encoder = gpu.encoder("test");
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(2, &own, &[]);
            self.groups.iter().for_each(|(index, group)| pass.set_bind_group(*index, group, &[]));
            pass.dispatch_workgroups(questions.len().div_ceil(64) as u32, 1, 1);
        }
        let staging = readback::stage_buffer(gpu, &mut encoder, &answers);
        gpu.submit(encoder);
        let bytes = pollster::block_on(readback::read(gpu, staging)).expect("read-back");
        let numbers: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        numbers.chunks(A).map(|answer| std::array::from_fn(|i| answer[i].map(f64::from))).collect()
    }

    fn group(&self, index: u32, resources: &[(u32, wgpu::BindingResource<'_>)]) -> wgpu::BindGroup {
        let entries: Vec<_> = resources
            .iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding: *binding, resource: resource.clone() })
            .collect();
        self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(index),
            entries: &entries,
        })
    }
}

/// A buffer with contents.
pub fn buffer(gpu: &Gpu, contents: &[u8], usage: BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
}

/// The answers of a module without resources to some questions; `answer` is the body of a function of the vec4f `a` and
/// `b`.
pub fn ask(shaders: &Shaders, module: &str, answer: &str, questions: &[[[f32; 4]; 2]]) -> Vec<[f64; 4]> {
    let text = format!(
        "fn answer_of(a: vec4f, b: vec4f) -> vec4f {{ {answer} }}
        fn answer(q: Question) -> Answer {{ return Answer(answer_of(q[0], q[1])); }}"
    );
    let answers = Kernel::<2, 1>::new(&gpu(), shaders, module, &text).ask(questions);
    answers.into_iter().map(|[answer]| answer).collect()
}
