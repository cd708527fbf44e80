//! A compute pipeline with its one bind group's layout.

use super::map_format::MapFormat;

/// What stands at a binding, in order from 0.
#[derive(Clone, Copy, Debug)]
pub enum Slot {
    /// A uniform struct of this size, chosen by a dynamic offset.
    Uniform(u64),
    /// A storage buffer that is read.
    Read,
    /// A storage buffer that is written.
    Write,
    /// A filterable 2d array texture.
    Texture,
    /// A 2d array of maps that is written.
    Image(MapFormat),
    /// A filtering sampler.
    Sampler,
}

impl Slot {
    fn binding_type(self) -> wgpu::BindingType {
        let buffer = |ty, has_dynamic_offset, size| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size: std::num::NonZeroU64::new(size),
        };
        match self {
            Self::Uniform(size) => buffer(wgpu::BufferBindingType::Uniform, true, size),
            Self::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }, false, 0),
            Self::Write => buffer(wgpu::BufferBindingType::Storage { read_only: false }, false, 0),
            Self::Texture => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                view_dimension: wgpu::TextureViewDimension::D2Array,
                multisampled: false,
            },
            Self::Image(maps) => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: maps.texture(),
                view_dimension: wgpu::TextureViewDimension::D2Array,
            },
            Self::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

/// A compute pipeline, entry point `main`.
#[derive(Debug)]
pub struct Kernel {
    label: &'static str,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

impl Kernel {
    /// Compiles a module's entry point for these bindings and override constants.
    pub fn new(
        device: &wgpu::Device,
        label: &'static str,
        module: &wgpu::ShaderModule,
        slots: &[Slot],
        constants: &[(&str, f64)],
    ) -> Self {
        let entries: Vec<_> = (0..)
            .zip(slots)
            .map(|(binding, slot)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: slot.binding_type(),
                count: None,
            })
            .collect();
        let layout =
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: Some(&pipeline_layout),
            module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        Self { label, pipeline, layout }
    }

    /// Binds resources, in the order of the slots.
    pub fn bind(&self, device: &wgpu::Device, resources: &[wgpu::BindingResource<'_>]) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// Records one dispatch in a pass of its own name.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, group: &wgpu::BindGroup, offsets: &[u32], size: [u32; 3]) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some(self.label), timestamp_writes: None });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, offsets);
        pass.dispatch_workgroups(size[0], size[1], size[2]);
    }
}

/// Slots of one uniform struct in one buffer, told apart by dynamic offsets: all the steps of a submission in one write.
#[derive(Debug)]
pub struct UniformRing<T> {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    stride: usize,
    bytes: Vec<u8>,
    used: usize,
    kind: std::marker::PhantomData<T>,
}

impl<T: bytemuck::Pod> UniformRing<T> {
    /// Room for `slots` structs between two submissions.
    pub fn new(device: &wgpu::Device, label: &str, slots: usize) -> Self {
        let stride = size_of::<T>().next_multiple_of(256);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: (stride * slots) as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, stride, bytes: vec![0; stride * slots], used: 0, kind: std::marker::PhantomData }
    }

    /// Forgets the slots of the last submission.
    pub fn restart(&mut self) {
        self.used = 0;
    }

    /// Adds a struct and returns its dynamic offset.
    ///
    /// # Panics
    /// If more structs are added than there are slots.
    pub fn push(&mut self, value: &T) -> u32 {
        let at = self.used * self.stride;
        self.bytes[at..at + size_of::<T>()].copy_from_slice(bytemuck::bytes_of(value));
        self.used += 1;
        at as u32
    }

    /// Sends the structs to the GPU, before the submission that uses them.
    pub fn upload(&self, queue: &wgpu::Queue) {
        queue.write_buffer(&self.buffer, 0, &self.bytes[..self.used * self.stride]);
    }

    /// The buffer as a binding.
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: 0,
            size: std::num::NonZeroU64::new(size_of::<T>() as u64),
        })
    }
}
