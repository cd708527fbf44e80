//! A device with its queue, and short functions that create the buffers, textures and pipelines of the passes.

use super::observer::{Made, report};
use std::num::NonZeroU64;

/// A wgpu device and its queue. Clones stand for the same device.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The wgpu device: creates buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// The wgpu queue: takes command buffers and data for the GPU.
    pub queue: wgpu::Queue,
}

/// Type of the resource (buffer, texture or sampler) that a bind group layout expects at one binding.
#[derive(Clone, Copy, Debug)]
pub enum BindingType {
    /// A uniform buffer, of which the shader reads at least the given number of bytes, from its start.
    Uniform(usize),
    /// A uniform buffer bound at a dynamic offset, from which the shader reads the given number of bytes.
    DynamicUniform(usize),
    /// A storage buffer of at least the given number of bytes (0: of any size) that the shader only reads.
    StorageRead(usize),
    /// A storage buffer of at least the given number of bytes (0: of any size) that the shader reads and writes.
    StorageReadWrite(usize),
    /// A 2d texture of floats that a sampler can filter.
    Texture,
    /// A 2d array texture of floats that a sampler can filter.
    TextureArray,
    /// A 3d texture of floats that a sampler can filter.
    Texture3d,
    /// A 2d texture of floats that is read only texel by texel, without a sampler, so that any float format will do.
    TextureLoaded,
    /// A 2d depth texture.
    DepthTexture,
    /// A 2d storage texture of the given format that the shader only writes.
    StorageTexture(wgpu::TextureFormat),
    /// A 2d array storage texture of the given format that the shader only writes.
    StorageTextureArray(wgpu::TextureFormat),
    /// A 3d storage texture of the given format that the shader only writes.
    StorageTexture3d(wgpu::TextureFormat),
    /// A sampler that may filter, that is, interpolate between texels.
    Sampler,
}

impl BindingType {
    fn to_wgpu(self) -> wgpu::BindingType {
        let buffer = |ty, has_dynamic_offset, bytes| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size: NonZeroU64::new(bytes as u64),
        };
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let texture = |sample_type, view_dimension| wgpu::BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        let filterable = wgpu::TextureSampleType::Float { filterable: true };
        let image = |format, view_dimension| wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format,
            view_dimension,
        };
        use wgpu::TextureViewDimension::{D2, D2Array, D3};
        match self {
            Self::Uniform(bytes) => buffer(wgpu::BufferBindingType::Uniform, false, bytes),
            Self::DynamicUniform(bytes) => buffer(wgpu::BufferBindingType::Uniform, true, bytes),
            Self::StorageRead(bytes) => buffer(storage(true), false, bytes),
            Self::StorageReadWrite(bytes) => buffer(storage(false), false, bytes),
            Self::Texture => texture(filterable, D2),
            Self::TextureArray => texture(filterable, D2Array),
            Self::Texture3d => texture(filterable, D3),
            Self::TextureLoaded => texture(wgpu::TextureSampleType::Float { filterable: false }, D2),
            Self::DepthTexture => texture(wgpu::TextureSampleType::Depth, D2),
            Self::StorageTexture(format) => image(format, D2),
            Self::StorageTextureArray(format) => image(format, D2Array),
            Self::StorageTexture3d(format) => image(format, D3),
            Self::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

/// Shader module of a render pipeline, with its vertex and fragment entry points and override constants.
pub struct RenderProgram<'a> {
    /// Shader module that contains the vertex and the fragment entry point.
    pub module: &'a wgpu::ShaderModule,
    /// Names of the vertex entry point and of the fragment entry point, in this order.
    pub entry_points: [&'a str; 2],
    /// Names and values of the override constants in the module that do not have their default values.
    pub constants: &'a [(&'a str, f64)],
    /// How the vertices are joined to triangles: three by three, or as a strip.
    pub topology: wgpu::PrimitiveTopology,
}

impl<'a> RenderProgram<'a> {
    /// A render program with the entry points named `vertex` and `fragment`, and default values of override constants,
    /// for a list of triangles.
    pub fn new(module: &'a wgpu::ShaderModule) -> Self {
        let topology = wgpu::PrimitiveTopology::TriangleList;
        Self { module, entry_points: ["vertex", "fragment"], constants: &[], topology }
    }
}

/// Formats of the colour and depth textures that a render pipeline draws on, and its depth test.
pub struct AttachmentFormats<'a> {
    /// Texture formats of the colour textures that are drawn on, in the order of the fragment shader's outputs.
    pub formats: &'a [wgpu::TextureFormat],
    /// How depth is tested and written. None if nothing is drawn on a depth texture.
    pub depth: Option<DepthState>,
    /// How the shader's colours are mixed with those drawn before. None if they replace them.
    pub blend: Option<wgpu::BlendState>,
}

/// Depth texture format of a render pipeline, and how the pipeline tests and writes depth.
#[derive(Clone, Copy, Debug)]
pub struct DepthState {
    /// Texture format of the depth texture.
    pub format: wgpu::TextureFormat,
    /// Depth test: a fragment is drawn if its depth has this relation (such as `Greater`) to the stored depth.
    pub compare: wgpu::CompareFunction,
    /// Whether fragments that pass the depth test write their depth to the depth texture.
    pub writes_depth: bool,
}

impl Gpu {
    /// Creates a command encoder. `label` is its name in debuggers.
    pub fn encoder(&self, label: &str) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(label) })
    }

    /// Finishes an encoder and submits its commands to the GPU. Does not wait for their execution.
    pub fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.queue.submit([encoder.finish()]);
    }

    /// Creates a buffer of `bytes` bytes for the given uses, not mapped. `label` is its name in debuggers.
    pub fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes,
            usage,
            mapped_at_creation: false,
        })
    }

    /// Creates a storage buffer of `bytes` bytes, which copies can also read and write. `label` is for debuggers.
    pub fn storage_buffer(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        let copies = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        self.buffer(label, bytes, wgpu::BufferUsages::STORAGE | copies)
    }

    /// Creates a 2d texture (an array if there are several layers) of the given size in texels, without multisampling.
    pub fn texture(
        &self,
        label: &str,
        [width, height, layers]: [u32; 3],
        mip_levels: u32,
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: layers },
            mip_level_count: mip_levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// Queues a write of one mip level of a texture's first layer. `bytes` holds its rows without padding between them.
    pub fn write_texture(&self, texture: &wgpu::Texture, mip_level: u32, bytes: &[u8]) {
        self.write_texture_layer(texture, 0, mip_level, bytes);
    }

    /// Queues a write of one mip level of a layer of a texture. `bytes` holds its rows without padding between them.
    pub fn write_texture_layer(&self, texture: &wgpu::Texture, layer: u32, mip_level: u32, bytes: &[u8]) {
        let [width, height] = [texture.width(), texture.height()].map(|side| (side >> mip_level).max(1));
        let row = bytes.len() as u32 / height;
        self.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                mip_level,
                origin: wgpu::Origin3d { z: layer, ..wgpu::Origin3d::ZERO },
                ..texture.as_image_copy()
            },
            bytes,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: Some(height) },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// Creates a sampler that filters linearly within a mip level, and between mip levels as `mipmap_filter` says. `u`
    /// and `v` are the address modes of the two texture coordinates: repeat, clamp or mirror outside 0 to 1.
    pub fn sampler(
        &self,
        label: &str,
        [u, v]: [wgpu::AddressMode; 2],
        mipmap_filter: wgpu::MipmapFilterMode,
    ) -> wgpu::Sampler {
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some(label),
            address_mode_u: u,
            address_mode_v: v,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter,
            ..Default::default()
        })
    }

    /// Creates a bind group layout for the shader stages `visibility`. `bindings` are the types of bindings 0, 1, 2 ...
    pub fn bind_group_layout(
        &self,
        label: &str,
        visibility: wgpu::ShaderStages,
        bindings: &[BindingType],
    ) -> wgpu::BindGroupLayout {
        let entry = |(binding, binding_type): (u32, &BindingType)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: binding_type.to_wgpu(),
            count: None,
        };
        let entries: Vec<_> = (0..).zip(bindings).map(entry).collect();
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries };
        let layout = self.device.create_bind_group_layout(&descriptor);
        report(&Made::Layout(&layout, bindings));
        layout
    }

    /// Creates a bind group with the given layout. `resources` become its bindings 0, 1, 2 and so on.
    pub fn bind_group(
        &self,
        label: &str,
        layout: &wgpu::BindGroupLayout,
        resources: &[wgpu::BindingResource<'_>],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
    }

    /// Compiles the WGSL text `source` to a shader module. `label` is its name in error messages and debuggers.
    pub fn shader_module(&self, label: &str, source: &str) -> wgpu::ShaderModule {
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        report(&Made::Module(&module, label, source));
        module
    }

    /// Creates a compute pipeline from an entry point of a module, the layouts of its bind groups 0, 1, 2 and so on,
    /// and names and values of override constants.
    pub fn compute_pipeline(
        &self,
        label: &str,
        (module, entry): (&wgpu::ShaderModule, &str),
        layouts: &[&wgpu::BindGroupLayout],
        constants: &[(&str, f64)],
    ) -> wgpu::ComputePipeline {
        report(&Made::Compute(label, module, entry, layouts, constants));
        self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: Some(&self.pipeline_layout(label, layouts)),
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        })
    }

    /// Creates a render pipeline that draws triangle lists without vertex buffers. `layouts` are the layouts of its
    /// bind groups 0, 1, 2 and so on; `onto` gives the formats of the textures that it draws on, and its depth test.
    pub fn render_pipeline(
        &self,
        label: &str,
        program: &RenderProgram<'_>,
        layouts: &[&wgpu::BindGroupLayout],
        onto: &AttachmentFormats<'_>,
    ) -> wgpu::RenderPipeline {
        report(&Made::Render(label, program, onto));
        let RenderProgram { module, entry_points: [vertex, fragment], constants, topology } = *program;
        let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
        let write_mask = wgpu::ColorWrites::ALL;
        let target = |&format| Some(wgpu::ColorTargetState { format, blend: onto.blend, write_mask });
        let targets: Vec<_> = onto.formats.iter().map(target).collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: Some(&self.pipeline_layout(label, layouts)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState { topology, ..Default::default() },
            depth_stencil: onto.depth.map(|depth| wgpu::DepthStencilState {
                format: depth.format,
                depth_write_enabled: Some(depth.writes_depth),
                depth_compare: Some(depth.compare),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(fragment),
                compilation_options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn pipeline_layout(&self, label: &str, layouts: &[&wgpu::BindGroupLayout]) -> wgpu::PipelineLayout {
        let layouts: Vec<_> = layouts.iter().map(|layout| Some(*layout)).collect();
        self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        })
    }
}

/// A compute pipeline whose shader uses one bind group (group 0), with the layout of that bind group. A clone is the same
/// pipeline: nothing is compiled again.
#[derive(Clone, Debug)]
pub struct Kernel {
    label: &'static str,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

impl Kernel {
    /// Compiles the compute shader `program`, a module and the name of its entry point. `bindings` are the types of
    /// bindings 0, 1, 2 and so on; `constants` are names and values of override constants.
    pub fn new(
        gpu: &Gpu,
        label: &'static str,
        program: (&wgpu::ShaderModule, &str),
        bindings: &[BindingType],
        constants: &[(&str, f64)],
    ) -> Self {
        let layout = gpu.bind_group_layout(label, wgpu::ShaderStages::COMPUTE, bindings);
        let pipeline = gpu.compute_pipeline(label, program, &[&layout], constants);
        Self { label, pipeline, layout }
    }

    /// Creates a bind group for the kernel. `resources` are its bindings 0, 1, 2 and so on.
    pub fn bind(&self, gpu: &Gpu, resources: &[wgpu::BindingResource<'_>]) -> wgpu::BindGroup {
        gpu.bind_group(self.label, &self.layout, resources)
    }

    /// Records a dispatch of `size` (x, y, z) workgroups in a compute pass of its own, with the bind group `group`.
    /// `offsets` are the dynamic offsets, bytes, of the group's dynamic uniform buffers, in the order of the bindings.
    /// The pass writes `timestamps`, if given.
    pub fn run(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
        group: &wgpu::BindGroup,
        offsets: &[u32],
        size: [u32; 3],
    ) {
        let mut pass = begin_compute(encoder, self.label, timestamps);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, offsets);
        pass.dispatch_workgroups(size[0], size[1], size[2]);
    }
}

/// Begins a compute pass that writes `timestamps`, if given. `label` is its name in debuggers.
pub fn begin_compute<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
) -> wgpu::ComputePass<'a> {
    encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some(label), timestamp_writes: timestamps })
}

/// View of mip level `mip_level` of a texture, which becomes level 0 of the view.
pub fn mip_view(texture: &wgpu::Texture, mip_level: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        base_mip_level: mip_level,
        mip_level_count: Some(1),
        ..Default::default()
    })
}
